/// Reads scenes in the part of pbrt's format, version 4, that the scenes of the page use. Anything else is an error:
/// the page has to show what the C++ renderer does.

import { isInRange } from "./layout";
import { Parameters, Range, Words } from "./pbrt_words";
import { Vector, cross, length, normalize, subtract } from "./vectors";

export interface Material {
    readonly name: string;
    /// Whether it has a specular part: the Frostbite BRDF, else that of Lambert.
    readonly isGlossy: boolean;
    readonly diffuse: Vector;
    readonly f0: Vector;
    /// Perceptual: alpha of GGX is its square.
    readonly roughness: number;
}

/// A convex, planar polygon or triangle [m]. Those that emit do so on the side of their normal.
export interface Polygon {
    readonly vertices: readonly Vector[];
    readonly material: number;
    /// Radiance [W/(sr m^2)], null for those that do not emit.
    readonly radiance: Vector | null;
    /// Lights of one block of the file belong together.
    readonly block: number;
}

export interface Tube {
    readonly begin: Vector;
    readonly end: Vector;
    readonly radius: number;
    readonly radiance: Vector;
    /// Whether it is a closed cylinder, or a line: the limit of a small radius.
    readonly isCylinder: boolean;
    readonly block: number;
}

export interface View {
    readonly eye: Vector;
    readonly target: Vector;
    readonly up: Vector;
    /// Field of view along the shorter axis [degrees].
    readonly fov: number;
}

export interface Scene {
    readonly view: View;
    readonly materials: readonly Material[];
    readonly polygons: readonly Polygon[];
    readonly tubes: readonly Tube[];
}

/// Three rows of four numbers.
type Transform = readonly (readonly number[])[];

const identity: Transform = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];

function product(a: Transform, b: Transform): Transform {
    const entry = (row: readonly number[], j: number) => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j];
    return a.map(row => [0, 1, 2, 3].map(j => entry(row, j) + (j === 3 ? row[3] : 0)));
}

const translation = ([x, y, z]: Vector): Transform => [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z]];

function rotation(degrees: number, axis: Vector): Transform {
    const [x, y, z] = normalize(axis);
    const c = Math.cos(degrees * Math.PI / 180);
    const s = Math.sin(degrees * Math.PI / 180);
    const d = 1 - c;
    return [[x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0],
        [x * y * d + z * s, y * y * d + c, y * z * d - x * s, 0],
        [x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0]];
}

function apply(m: Transform, p: Vector): Vector {
    const row = (r: readonly number[]) => r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
    return [row(m[0]), row(m[1]), row(m[2])];
}

const reflectanceOf = (eta: number, k: number): number => ((eta - 1) ** 2 + k * k) / ((eta + 1) ** 2 + k * k);

const atLeast0: Range = { least: 0 };
const above0: Range = { least: 0, isOpen: true };
const from0To1: Range = { least: 0, most: 1 };
/// As in the C++ renderer.
const radiances: Range = { least: 0, most: 1e30 };

function makeMaterial(name: string, parameters: Parameters, words: Words): Material {
    const type = parameters.text("type", "");
    const isGlossy = type === "coateddiffuse" || type === "conductor";
    // By default, pbrt takes the root for alpha; perceptual roughness is the root of that.
    const given = isGlossy ? parameters.number("float", "roughness", 0, atLeast0) : 1;
    const remaps = isGlossy && parameters.flag("remaproughness", true);
    const alpha = given === 0 ? 0.01 : remaps ? Math.sqrt(given) : given;
    const roughness = Math.sqrt(Math.min(Math.max(alpha, 0.001), 1));
    const black: Vector = [0, 0, 0];
    if (type === "conductor") {
        const eta = parameters.vector("rgb", "eta", null, above0);
        const k = parameters.vector("rgb", "k", null, atLeast0);
        const f0: Vector = [reflectanceOf(eta[0], k[0]), reflectanceOf(eta[1], k[1]), reflectanceOf(eta[2], k[2])];
        return { name, isGlossy, diffuse: black, f0, roughness };
    }
    const diffuse = parameters.vector("rgb", "reflectance", [0.5, 0.5, 0.5], from0To1);
    if (type === "diffuse") return { name, isGlossy, diffuse, f0: black, roughness: 1 };
    if (type === "coateddiffuse") {
        const f0 = reflectanceOf(parameters.number("float", "eta", 1.5, above0), 0);
        return { name, isGlossy, diffuse, f0: [f0, f0, f0], roughness };
    }
    return words.fail(`material "${name}": the type "${type}" is not supported`);
}

/// What AttributeBegin stores.
interface Attributes {
    readonly transform: Transform;
    readonly material: number;
    readonly radiance: Vector | null;
    readonly block: number;
}

class Reader {
    private state: Attributes = { transform: identity, material: -1, radiance: null, block: 0 };
    private readonly stack: Attributes[] = [];
    private blocks = 0;
    private isMirrored = false;
    private isInWorld = false;
    private view: View | null = null;
    private fov = 90;
    private readonly materials: Material[] = [];
    private readonly polygons: Polygon[] = [];
    private readonly tubes: Tube[] = [];
    /// The files that include each other, from the scene to what is being read.
    private readonly open: string[] = [];

    constructor(private readonly files: ReadonlyMap<string, string>) {}

    /// \param path of what has been read, for messages
    scene(path: string): Scene {
        if (this.view === null) throw new Error(`${path}: the scene has no camera`);
        if (this.stack.length > 0) throw new Error(`${path}: an AttributeEnd is missing`);
        return { view: { ...this.view, fov: this.fov }, materials: this.materials, polygons: this.polygons,
            tubes: this.tubes };
    }

    read(path: string): void {
        const text = this.files.get(path);
        if (text === undefined) throw new Error(`${path} is missing`);
        this.open.push(path);
        const words = new Words(path, text);
        for (let directive = words.nextDirective(); directive !== null; directive = words.nextDirective())
            this.readDirective(directive, words);
        this.open.pop();
    }

    private readDirective(directive: string, words: Words): void {
        switch (directive) {
        // The page has its own resolution and number of samples.
        case "Film":
            words.only("rgb");
            words.withParameters(p => [p.number("integer", "xresolution", 0), p.number("integer", "yresolution", 0),
                p.text("filename", "")]);
            break;
        case "Sampler":
            words.only("independent");
            words.withParameters(p => p.number("integer", "pixelsamples", 1));
            break;
        case "PixelFilter": words.only("box"); words.withParameters(p => this.filter(p, words)); break;
        case "Scale": this.scale(words.vector(), words); break;
        case "LookAt": this.lookAt(words); break;
        case "Camera": words.only("perspective"); words.withParameters(p => this.camera(p, words)); break;
        case "WorldBegin": this.isInWorld = true; break;
        case "AttributeBegin":
            this.stack.push(this.state);
            this.state = { ...this.state, block: ++this.blocks };
            break;
        case "AttributeEnd": this.endAttributes(words); break;
        case "Translate": this.transform(translation(words.vector()), words); break;
        case "Rotate": {
            const degrees = words.number();
            const axis = words.vector();
            if (length(axis) === 0) words.fail("the axis is zero");
            this.transform(rotation(degrees, axis), words);
            break;
        }
        case "MakeNamedMaterial": {
            const name = words.text();
            if (this.materials.some(row => row.name === name)) words.fail(`there is a material "${name}" already`);
            this.materials.push(words.withParameters(p => makeMaterial(name, p, words)));
            break;
        }
        case "NamedMaterial": this.useMaterial(words); break;
        case "AreaLightSource": {
            words.only("diffuse");
            const radiance = words.withParameters(p => p.vector("rgb", "L", [1, 1, 1], radiances));
            this.state = { ...this.state, radiance };
            break;
        }
        case "Shape": {
            const type = words.text();
            if (!this.isInWorld) words.fail("a WorldBegin is missing before");
            words.withParameters(p => this.shape(type, p, words));
            break;
        }
        case "Include": this.include(words); break;
        default: words.fail("this directive is not supported");
        }
    }

    private include(words: Words): void {
        const parts = words.path.split("/").slice(0, -1);
        for (const part of words.text().split("/")) {
            if (part === "..") parts.pop();
            else parts.push(part);
        }
        const path = parts.join("/");
        if (!this.files.has(path)) words.fail(`${path} is missing`);
        if (this.open.includes(path)) words.fail(`${path} includes itself`);
        this.read(path);
    }

    private transform(t: Transform, words: Words): void {
        // The camera has none but LookAt, and WorldBegin forgets them.
        if (!this.isInWorld) words.fail("transforms before WorldBegin are not supported");
        this.state = { ...this.state, transform: product(this.state.transform, t) };
    }

    private scale(v: Vector, words: Words): void {
        // Before the camera, only the reflection that makes pbrt's camera space right-handed.
        if (this.view === null && v.join() === "-1,1,1") this.isMirrored = true;
        else this.transform([[v[0], 0, 0, 0], [0, v[1], 0, 0], [0, 0, v[2], 0]], words);
    }

    private lookAt(words: Words): void {
        const [eye, target, up] = [words.vector(), words.vector(), words.vector()];
        if (length(cross(subtract(target, eye), up)) === 0)
            words.fail("the viewing direction is zero or parallel to the up vector");
        this.view = { eye, target, up, fov: this.fov };
    }

    private filter(parameters: Parameters, words: Words): void {
        for (const name of ["xradius", "yradius"])
            if (parameters.number("float", name, 0.5) !== 0.5)
                words.fail("filters must be boxes of one pixel, with a radius of 0.5");
    }

    private camera(parameters: Parameters, words: Words): void {
        if (!this.isMirrored) words.fail("cameras must stand after Scale -1 1 1");
        this.fov = parameters.number("float", "fov", 90, { least: 0, most: 180, isOpen: true });
    }

    private endAttributes(words: Words): void {
        const before = this.stack.pop();
        if (before === undefined) return words.fail("there is no AttributeBegin before");
        this.state = before;
    }

    private useMaterial(words: Words): void {
        const name = words.text();
        const material = this.materials.findIndex(row => row.name === name);
        if (material < 0) words.fail(`there is no material "${name}"`);
        this.state = { ...this.state, material };
    }

    private shape(type: string, parameters: Parameters, words: Words): void {
        const { transform, material, radiance, block } = this.state;
        const point = (p: Vector): Vector => {
            const moved = apply(transform, p);
            if (!moved.every(isInRange)) words.fail(`the point (${moved.join(", ")}) is too far away`);
            return moved;
        };
        const points = (): Vector[] => {
            if (material < 0) words.fail(`a ${type} needs a NamedMaterial before`);
            return (parameters.vectors("point3", "P") ?? words.fail(`a ${type} needs "point3 P"`)).map(point);
        };
        const add = (vertices: readonly Vector[]) => {
            if (!normalOf(vertices).every(Number.isFinite)) words.fail("the area between three corners is zero");
            this.polygons.push({ vertices, material, radiance, block });
        };
        if (type === "polygon") {
            const vertices = points();
            if (vertices.length < 3) words.fail("a polygon needs three vertices");
            add(vertices);
        } else if (type === "trianglemesh") {
            const corners = points();
            const indices = parameters.vectors("integer", "indices", { least: 0, most: corners.length - 1 }) ??
                words.fail('a trianglemesh needs "integer indices"');
            for (const triangle of indices) add(triangle.map(i => corners[i]));
        } else if (type === "line") {
            const isCylinder = parameters.flag("finite", true);
            const radius = parameters.number("float", "radius", null, above0);
            const begin = point(parameters.vector("point3", "p0", null));
            const end = point(parameters.vector("point3", "p1", null));
            if (length(subtract(begin, end)) === 0) words.fail("the ends of the line are the same");
            this.tubes.push({ begin, end, radius, radiance: radiance ?? [0, 0, 0], isCylinder, block });
        } else {
            words.fail(`shapes of type "${type}" are not supported`);
        }
    }
}

/// \param files texts by path
/// \param path  of the scene, one of them
/// \throws Error for what it does not support
export function readScene(files: ReadonlyMap<string, string>, path: string): Scene {
    const reader = new Reader(files);
    reader.read(path);
    return reader.scene(path);
}

/// The normal of a polygon, right-handed with its winding.
export function normalOf(vertices: readonly Vector[]): Vector {
    return normalize(cross(subtract(vertices[1], vertices[0]), subtract(vertices[2], vertices[0])));
}
