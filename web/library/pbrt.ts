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

type Value = readonly (number | string)[];
type Parameters = ReadonlyMap<string, Value>;
/// Three rows of four numbers.
type Transform = readonly (readonly number[])[];

const identity: Transform = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];

function product(a: Transform, b: Transform): Transform {
    return a.map(row => [0, 1, 2, 3].map(j => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j] + (j === 3 ? row[3] : 0)));
}

function rotation(degrees: number, axis: Vector): Transform {
    const [x, y, z] = normalize(axis);
    const c = Math.cos(degrees * Math.PI / 180);
    const s = Math.sin(degrees * Math.PI / 180);
    const d = 1 - c;
    return [[x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0], [x * y * d + z * s, y * y * d + c, y * z * d - x * s, 0],
        [x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0]];
}

function apply(m: Transform, p: Vector): Vector {
    const row = (r: readonly number[]) => r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
    return [row(m[0]), row(m[1]), row(m[2])];
}

function vectorsOf(values: Value): Vector[] {
    const result: Vector[] = [];
    for (let i = 0; i + 2 < values.length; i += 3) result.push([Number(values[i]), Number(values[i + 1]), Number(values[i + 2])]);
    return result;
}

function vectorOf(parameters: Parameters, name: string, standard: Vector): Vector {
    const value = parameters.get(name);
    return value === undefined ? standard : vectorsOf(value)[0];
}

function numberOf(parameters: Parameters, name: string, standard: number): number {
    return Number(parameters.get(name)?.[0] ?? standard);
}

/// Strings keep their quotes.
function tokensOf(text: string): string[] {
    return text.replace(/#.*$/gm, "").match(/"[^"]*"|\[|\]|[^\s"[\]]+/g) ?? [];
}

const reflectanceOf = (eta: number, k: number): number => ((eta - 1) ** 2 + k * k) / ((eta + 1) ** 2 + k * k);

function makeMaterial(name: string, parameters: Parameters): Material {
    const type = parameters.get("type")?.[0];
    // By default, pbrt takes the root for alpha; perceptual roughness is the root of that.
    const given = numberOf(parameters, "roughness", 0);
    const alpha = given === 0 ? 0.01 : parameters.get("remaproughness")?.[0] === "false" ? given : Math.sqrt(given);
    const roughness = Math.sqrt(Math.min(Math.max(alpha, 0.001), 1));
    const diffuse = vectorOf(parameters, "reflectance", [0.5, 0.5, 0.5]);
    const black: Vector = [0, 0, 0];
    if (type === "diffuse") return { name, isGlossy: false, diffuse, f0: black, roughness: 1 };
    if (type === "coateddiffuse") {
        const f0 = reflectanceOf(numberOf(parameters, "eta", 1.5), 0);
        return { name, isGlossy: true, diffuse, f0: [f0, f0, f0], roughness };
    }
    if (type === "conductor") {
        const eta = vectorOf(parameters, "eta", black);
        const k = vectorOf(parameters, "k", black);
        const f0: Vector = [reflectanceOf(eta[0], k[0]), reflectanceOf(eta[1], k[1]), reflectanceOf(eta[2], k[2])];
        return { name, isGlossy: true, diffuse: black, f0, roughness };
    }
    throw new Error(`material "${name}": the type ${type} is not supported`);
}

interface State {
    transform: Transform;
    material: number;
    radiance: Vector | null;
    block: number;
}

class Reader {
    private state: State = { transform: identity, material: -1, radiance: null, block: 0 };
    private readonly stack: State[] = [];
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
        return { view: { ...this.view, fov: this.fov }, materials: this.materials, polygons: this.polygons, tubes: this.tubes };
    }

    read(path: string): void {
        const text = this.files.get(path);
        if (text === undefined) throw new Error(`${path} is missing`);
        const tokens = tokensOf(text);
        let at = 0;
        const next = () => tokens[at++] ?? "";
        const name = () => next().slice(1, -1);
        const number = () => Number(next());
        const vector = (): Vector => [number(), number(), number()];
        const values = (): Value => {
            const read = (token: string) =>
                token.startsWith('"') ? token.slice(1, -1) : isNaN(Number(token)) ? token : Number(token);
            const first = next();
            if (first !== "[") return [read(first)];
            const list: (number | string)[] = [];
            for (let token = next(); token !== "]" && token !== ""; token = next()) list.push(read(token));
            return list;
        };
        const parameters = (): Parameters => {
            const result = new Map<string, Value>();
            while ((tokens[at] ?? "").startsWith('"')) result.set(name().split(/\s+/)[1], values());
            return result;
        };
        while (at < tokens.length) {
            const directive = next();
            switch (directive) {
            case "Film": case "Sampler": case "PixelFilter": name(); parameters(); break;
            case "Scale": this.scale(vector()); break;
            case "LookAt": this.view = { eye: vector(), target: vector(), up: vector(), fov: this.fov }; break;
            case "Camera": this.camera(name(), parameters()); break;
            case "WorldBegin": this.state.transform = identity; break;
            case "AttributeBegin":
                this.stack.push(this.state);
                this.state = { ...this.state, block: ++this.blocks };
                break;
            case "AttributeEnd": this.state = this.stack.pop() ?? this.state; break;
            case "Translate": { const [x, y, z] = vector(); this.transform([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z]]); break; }
            case "Rotate": { const degrees = number(); this.transform(rotation(degrees, vector())); break; }
            case "MakeNamedMaterial": this.materials.push(makeMaterial(name(), parameters())); break;
            case "NamedMaterial": this.useMaterial(name()); break;
            case "AreaLightSource": name(); this.state.radiance = vectorOf(parameters(), "L", [1, 1, 1]); break;
            case "Shape": this.shape(name(), parameters()); break;
            case "Include": {
                const parts = [...path.split("/").slice(0, -1), ...name().split("/")];
                this.read(parts.reduce<string[]>((done, part) => part === ".." ? done.slice(0, -1) : [...done, part], []).join("/"));
                break;
            }
            default: throw new Error(`${path}: ${directive} is not supported`);
            }
        }
    }

    private transform(t: Transform): void { this.state.transform = product(this.state.transform, t); }

    private scale(v: Vector): void {
        // Before the camera, only the reflection that makes pbrt's camera space right-handed.
        if (this.view === null) this.isMirrored = v.join() === "-1,1,1";
        else this.transform([[v[0], 0, 0, 0], [0, v[1], 0, 0], [0, 0, v[2], 0]]);
    }

    private camera(type: string, parameters: Parameters): void {
        if (type !== "perspective" || !this.isMirrored) throw new Error("cameras must be perspective, after Scale -1 1 1");
        this.fov = numberOf(parameters, "fov", 90);
    }

    private useMaterial(name: string): void {
        this.state.material = this.materials.findIndex(material => material.name === name);
        if (this.state.material < 0) throw new Error(`there is no material "${name}"`);
    }

    private shape(type: string, parameters: Parameters): void {
        const { transform, material, radiance, block } = this.state;
        const points = (name: string) => vectorsOf(parameters.get(name) ?? []).map(p => apply(transform, p));
        const P = points("P");
        if (type === "polygon") {
            this.polygons.push({ vertices: P, material, radiance, block });
        } else if (type === "trianglemesh") {
            for (const indices of vectorsOf(parameters.get("indices") ?? []))
                this.polygons.push({ vertices: indices.map(i => P[i]), material, radiance, block });
        } else if (type === "line") {
            const isCylinder = parameters.get("finite")?.[0] !== "false";
            const radius = numberOf(parameters, "radius", 0);
            this.tubes.push({ begin: points("p0")[0], end: points("p1")[0], radius, radiance: radiance ?? [0, 0, 0], isCylinder, block });
        } else {
            throw new Error(`shapes of type ${type} are not supported`);
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
