/// Lights in uniforms, in the layout of web/shaders/lights.glsl.

import { lightVertices, mostLights } from "./layout";
import { normalOf } from "./pbrt";
import { Vector, length, normalize, subtract } from "./vectors";

export { lightVertices, mostLights };

export type LightKind = "polygon" | "line" | "cylinder";

/// The values of uniforms by name.
export type Uniforms = Map<string, readonly number[]>;

/// A convex, planar polygon [m], which emits on the side of its normal.
export interface PolygonLight {
    readonly vertices: readonly Vector[];
    /// [W/(sr m^2)].
    readonly radiance: Vector | null;
}

export interface TubularLight {
    readonly begin: Vector;
    readonly end: Vector;
    readonly radius: number;
    readonly radiance: Vector;
}

const black: Vector = [0, 0, 0];

/// \throws Error for more lights or vertices than shaders have room for
export function polygonUniforms(lights: readonly PolygonLight[]): Uniforms {
    if (lights.length > mostLights)
        throw new Error(`${lights.length} polygonal lights are too many: at most ${mostLights}`);
    const largest = Math.max(0, ...lights.map(light => light.vertices.length));
    if (largest > lightVertices)
        throw new Error(`a polygonal light has ${largest} vertices: at most ${lightVertices} are possible`);
    const slots = Array.from({ length: lightVertices }, (_, j) => j);
    // Unused slots repeat the last vertex; the last edge closes the polygon.
    const vertices = lights.flatMap(({ vertices: v }) => slots.map(j => v[Math.min(j, v.length - 1)]));
    const edges = lights.flatMap(({ vertices: v }) => slots.map(j =>
        j === lightVertices - 1 ? subtract(v[0], v[v.length - 1]) : j < v.length - 1 ? subtract(v[j + 1], v[j])
            : black));
    return new Map<string, readonly number[]>([
        ["polygon_vertices", vertices.flat()],
        ["polygon_edges", edges.flat()],
        ["polygon_normals", lights.flatMap(light => normalOf(light.vertices))],
        ["polygon_radiances", lights.flatMap(light => light.radiance ?? black)],
        ["polygon_numbers", [...lights.keys()]],
        ["polygon_count", [lights.length]],
    ]);
}

/// \param number of a tube among all lights of the scene
/// \throws Error for more lights than shaders have room for
export function tubeUniforms<T extends TubularLight>(kind: LightKind, tubes: readonly T[],
    number: (tube: T) => number): Uniforms {
    if (tubes.length > mostLights) throw new Error(`${tubes.length} tubes are too many: at most ${mostLights}`);
    return new Map<string, readonly number[]>([
        [`${kind}_begins`, tubes.flatMap(tube => tube.begin)],
        [`${kind}_directions`, tubes.flatMap(({ begin, end }) =>
            [...normalize(subtract(end, begin)), length(subtract(end, begin))])],
        [`${kind}_radiances`, tubes.flatMap(tube => [...tube.radiance, tube.radius])],
        [`${kind}_numbers`, tubes.map(number)],
        [`${kind}_count`, [tubes.length]],
    ]);
}
