/// Reads scenes in the part of pbrt's format, version 4, that the scenes of the page use. Anything else is an error:
/// the page has to show what the C++ renderer does.

import { Vector, cross, normalize, subtract } from "./vectors";

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

/// What stands behind the name of a parameter.
interface Parameter {
    readonly type: string;
    readonly values: readonly string[];
}

/// The parameters of a directive. Each is looked at once; the rest are errors, since the image would lack what they
/// mean.
class Parameters {
    /// \param where what messages begin with
    constructor(private readonly parameters: Map<string, Parameter>, private readonly where: string) {}

    private take(type: string, name: string): readonly string[] | null {
        const found = this.parameters.get(name);
        if (found === undefined) return null;
        this.parameters.delete(name);
        if (found.type !== type)
            throw new Error(`${this.where}: "${found.type} ${name}" is not supported, only "${type} ${name}"`);
        return found.values;
    }

    /// A text, in quotes or, for the type bool, without.
    text(type: "string" | "bool", name: string, standard: string): string {
        const values = this.take(type, name);
        if (values === null) return standard;
        if (values.length !== 1) throw new Error(`${this.where}: "${name}" needs one value, not ${values.length}`);
        return values[0].replace(/^"|"$/g, "");
    }

    numbers(type: string, name: string): readonly number[] | null {
        return this.take(type, name)?.map(text => numberOf(text, this.where)) ?? null;
    }

    number(type: "float" | "integer", name: string, standard: number): number {
        const values = this.numbers(type, name);
        if (values === null) return standard;
        if (values.length !== 1) throw new Error(`${this.where}: "${name}" needs one number, not ${values.length}`);
        return values[0];
    }

    vectors(type: string, name: string): Vector[] | null {
        const values = this.numbers(type, name);
        if (values === null) return null;
        if (values.length === 0 || values.length % 3 !== 0)
            throw new Error(`${this.where}: "${name}" needs three numbers for each vector, not ${values.length}`);
        const vector = (i: number): Vector => [values[i], values[i + 1], values[i + 2]];
        return Array.from({ length: values.length / 3 }, (_, i) => vector(3 * i));
    }

    vector(type: "rgb" | "point3", name: string, standard: Vector): Vector {
        const vectors = this.vectors(type, name);
        if (vectors !== null && vectors.length !== 1)
            throw new Error(`${this.where}: "${name}" needs one vector, not ${vectors.length}`);
        return vectors?.[0] ?? standard;
    }

    /// \throws Error for parameters that nobody has looked at
    finish(): void {
        for (const [name, { type }] of this.parameters)
            throw new Error(`${this.where}: the parameter "${type} ${name}" is not supported`);
    }
}

function numberOf(text: string, where: string): number {
    const value = Number(text);
    if (text === "" || !Number.isFinite(value))
        throw new Error(`${where}: ${text || "the end of the file"} is not a number`);
    return value;
}

/// Strings keep their quotes.
function tokensOf(text: string): string[] {
    return text.replace(/#.*$/gm, "").match(/"[^"]*"|\[|\]|[^\s"[\]]+/g) ?? [];
}

const reflectanceOf = (eta: number, k: number): number => ((eta - 1) ** 2 + k * k) / ((eta + 1) ** 2 + k * k);

function makeMaterial(name: string, parameters: Parameters): Material {
    const type = parameters.text("string", "type", "");
    const isGlossy = type === "coateddiffuse" || type === "conductor";
    // By default, pbrt takes the root for alpha; perceptual roughness is the root of that.
    const given = isGlossy ? parameters.number("float", "roughness", 0) : 1;
    const remaps = isGlossy && parameters.text("bool", "remaproughness", "true") === "true";
    const alpha = given === 0 ? 0.01 : remaps ? Math.sqrt(given) : given;
    const roughness = Math.sqrt(Math.min(Math.max(alpha, 0.001), 1));
    const black: Vector = [0, 0, 0];
    if (type === "conductor") {
        const eta = parameters.vector("rgb", "eta", black);
        const k = parameters.vector("rgb", "k", black);
        const f0: Vector = [reflectanceOf(eta[0], k[0]), reflectanceOf(eta[1], k[1]), reflectanceOf(eta[2], k[2])];
        return { name, isGlossy, diffuse: black, f0, roughness };
    }
    const diffuse = parameters.vector("rgb", "reflectance", [0.5, 0.5, 0.5]);
    if (type === "diffuse") return { name, isGlossy, diffuse, f0: black, roughness: 1 };
    if (type === "coateddiffuse") {
        const f0 = reflectanceOf(parameters.number("float", "eta", 1.5), 0);
        return { name, isGlossy, diffuse, f0: [f0, f0, f0], roughness };
    }
    throw new Error(`material "${name}": the type "${type}" is not supported`);
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
    private view: View | null = null;
    private fov = 90;
    private readonly materials: Material[] = [];
    private readonly polygons: Polygon[] = [];
    private readonly tubes: Tube[] = [];

    constructor(private readonly files: ReadonlyMap<string, string>) {}

    scene(): Scene {
        if (this.view === null) throw new Error("the scene has no camera");
        if (this.stack.length > 0) throw new Error("an AttributeEnd is missing");
        return { view: { ...this.view, fov: this.fov }, materials: this.materials, polygons: this.polygons,
            tubes: this.tubes };
    }

    read(path: string): void {
        const text = this.files.get(path);
        if (text === undefined) throw new Error(`${path} is missing`);
        const tokens = tokensOf(text);
        let at = 0;
        let directive = "";
        const where = () => `${path}, ${directive}`;
        const next = () => tokens[at++] ?? "";
        const name = (): string => {
            const token = next();
            if (!/^".*"$/s.test(token))
                throw new Error(`${where()}: ${token || "the end of the file"} is not a text in quotes`);
            return token.slice(1, -1);
        };
        const number = () => numberOf(next(), where());
        const vector = (): Vector => [number(), number(), number()];
        const values = (): string[] => {
            const first = next();
            if (first !== "[") return [first];
            const list: string[] = [];
            for (let token = next(); token !== "]"; token = next()) {
                if (token === "") throw new Error(`${where()}: a ] is missing`);
                list.push(token);
            }
            return list;
        };
        /// Reads parameters and hands them to a function, which has to look at all of them.
        const withParameters = <T>(use: (parameters: Parameters) => T): T => {
            const found = new Map<string, Parameter>();
            while ((tokens[at] ?? "").startsWith('"')) {
                const [type, key] = name().split(/\s+/);
                found.set(key ?? "", { type, values: values() });
            }
            const parameters = new Parameters(found, where());
            const result = use(parameters);
            parameters.finish();
            return result;
        };
        /// A directive whose first word has to be one that the page can stand for.
        const only = (supported: string) => {
            const type = name();
            if (type !== supported) throw new Error(`${where()}: "${type}" is not supported, only "${supported}"`);
        };
        while (at < tokens.length) {
            directive = next();
            switch (directive) {
            // The page has its own resolution and number of samples.
            case "Film":
                only("rgb");
                withParameters(p => [p.number("integer", "xresolution", 0), p.number("integer", "yresolution", 0),
                    p.text("string", "filename", "")]);
                break;
            case "Sampler": only("independent"); withParameters(p => p.number("integer", "pixelsamples", 1)); break;
            case "PixelFilter":
                only("box");
                withParameters(p => this.filter(p.number("float", "xradius", 0.5), p.number("float", "yradius", 0.5)));
                break;
            case "Scale": this.scale(vector()); break;
            case "LookAt": this.view = { eye: vector(), target: vector(), up: vector(), fov: this.fov }; break;
            case "Camera": only("perspective"); withParameters(p => this.camera(p)); break;
            case "WorldBegin": this.state = { ...this.state, transform: identity }; break;
            case "AttributeBegin":
                this.stack.push(this.state);
                this.state = { ...this.state, block: ++this.blocks };
                break;
            case "AttributeEnd": this.endAttributes(where()); break;
            case "Translate": this.transform(translation(vector())); break;
            case "Rotate": { const degrees = number(); this.transform(rotation(degrees, vector())); break; }
            case "MakeNamedMaterial": {
                const key = name();
                this.materials.push(withParameters(p => makeMaterial(key, p)));
                break;
            }
            case "NamedMaterial": this.useMaterial(name()); break;
            case "AreaLightSource":
                only("diffuse");
                this.state = { ...this.state, radiance: withParameters(p => p.vector("rgb", "L", [1, 1, 1])) };
                break;
            case "Shape": { const type = name(); withParameters(p => this.shape(type, p, where())); break; }
            case "Include": {
                const parts: string[] = [];
                for (const part of [...path.split("/").slice(0, -1), ...name().split("/")]) {
                    if (part === "..") parts.pop();
                    else parts.push(part);
                }
                this.read(parts.join("/"));
                break;
            }
            default: throw new Error(`${path}: ${directive} is not supported`);
            }
        }
    }

    private transform(t: Transform): void {
        this.state = { ...this.state, transform: product(this.state.transform, t) };
    }

    private scale(v: Vector): void {
        // Before the camera, only the reflection that makes pbrt's camera space right-handed.
        if (this.view === null) this.isMirrored = v.join() === "-1,1,1";
        else this.transform([[v[0], 0, 0, 0], [0, v[1], 0, 0], [0, 0, v[2], 0]]);
    }

    private filter(x: number, y: number): void {
        if (x !== 0.5 || y !== 0.5) throw new Error("filters must be boxes of one pixel, with a radius of 0.5");
    }

    private camera(parameters: Parameters): void {
        if (!this.isMirrored) throw new Error("cameras must stand after Scale -1 1 1");
        this.fov = parameters.number("float", "fov", 90);
    }

    private endAttributes(where: string): void {
        const before = this.stack.pop();
        if (before === undefined) throw new Error(`${where}: there is no AttributeBegin before`);
        this.state = before;
    }

    private useMaterial(name: string): void {
        const material = this.materials.findIndex(row => row.name === name);
        if (material < 0) throw new Error(`there is no material "${name}"`);
        this.state = { ...this.state, material };
    }

    private shape(type: string, parameters: Parameters, where: string): void {
        const { transform, material, radiance, block } = this.state;
        const points = (name: string): Vector[] => {
            const vectors = parameters.vectors("point3", name);
            if (vectors === null) throw new Error(`${where}: a ${type} needs "point3 ${name}"`);
            return vectors.map(p => apply(transform, p));
        };
        const needMaterial = () => {
            if (material < 0) throw new Error(`${where}: a ${type} needs a NamedMaterial before`);
        };
        if (type === "polygon") {
            needMaterial();
            const vertices = points("P");
            if (vertices.length < 3) throw new Error(`${where}: a polygon needs three vertices`);
            this.polygons.push({ vertices, material, radiance, block });
        } else if (type === "trianglemesh") {
            needMaterial();
            const corners = points("P");
            for (const indices of parameters.vectors("integer", "indices") ?? []) {
                const vertices = indices.map(i => corners[i]);
                if (vertices.includes(undefined as unknown as Vector))
                    throw new Error(`${where}: the mesh has no vertex of an index`);
                this.polygons.push({ vertices, material, radiance, block });
            }
        } else if (type === "line") {
            const isCylinder = parameters.text("bool", "finite", "true") !== "false";
            const radius = parameters.number("float", "radius", 0);
            const [begin, end] = [points("p0")[0], points("p1")[0]];
            this.tubes.push({ begin, end, radius, radiance: radiance ?? [0, 0, 0], isCylinder, block });
        } else {
            throw new Error(`${where}: shapes of type "${type}" are not supported`);
        }
    }
}

/// \param files texts by path
/// \param path  of the scene, one of them
/// \throws Error for what it does not support
export function readScene(files: ReadonlyMap<string, string>, path: string): Scene {
    const reader = new Reader(files);
    reader.read(path);
    return reader.scene();
}

/// The normal of a polygon, right-handed with its winding.
export function normalOf(vertices: readonly Vector[]): Vector {
    return normalize(cross(subtract(vertices[1], vertices[0]), subtract(vertices[2], vertices[0])));
}
