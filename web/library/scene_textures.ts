/// A scene in textures and uniforms, in the layout of web/shaders/scene.glsl, shadows.glsl and lights.glsl.

import { makeHierarchy } from "./hierarchy";
import { models } from "./layout";
import { LightKind, Uniforms, polygonUniforms, tubeUniforms } from "./light_uniforms";
import { Polygon, Scene, Tube } from "./pbrt";
import { Vector, add, cross, normalize, subtract, times } from "./vectors";
import { Gl, makeArrayTexture } from "./webgl";

/// Tubes look like prisms with as many sides, as in the C++ renderer.
const tubeSides = 32;

export interface SceneTextures {
    readonly triangles: WebGLTexture;
    readonly triangleCount: number;
    readonly nodes: WebGLTexture;
    readonly materials: WebGLTexture;
    readonly uniforms: Uniforms;
}

export function lightKinds(scene: Scene): LightKind[] {
    const kinds: LightKind[] = [];
    if (scene.polygons.some(polygon => polygon.radiance !== null)) kinds.push("polygon");
    if (scene.tubes.some(tube => !tube.isCylinder)) kinds.push("line");
    if (scene.tubes.some(tube => tube.isCylinder)) kinds.push("cylinder");
    return kinds;
}

/// Three corners, a material and the number of a light, -1 for none.
interface Triangle {
    readonly corners: readonly [Vector, Vector, Vector];
    readonly material: number;
    readonly light: number;
}

function fan(vertices: readonly Vector[], material: number, light: number): Triangle[] {
    return vertices.slice(2).map((c, i) => ({ corners: [vertices[0], vertices[i + 1], c], material, light }));
}

/// Sides and caps.
function prism(tube: Tube, material: number): Triangle[] {
    const axis = normalize(subtract(tube.end, tube.begin));
    const x = normalize(cross(axis, Math.abs(axis[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0]));
    const y = cross(axis, x);
    // The cross section has the area of the circle.
    const angle = 2 * Math.PI / tubeSides;
    const radius = tube.radius * Math.sqrt(angle / Math.sin(angle));
    const ring = (center: Vector) => Array.from({ length: tubeSides }, (_, i) =>
        add(center, add(times(radius * Math.cos(i * angle), x), times(radius * Math.sin(i * angle), y))));
    const near = ring(tube.begin);
    const far = ring(tube.end);
    const sides = near.flatMap((p, i) => {
        const next = (i + 1) % tubeSides;
        return fan([p, near[next], far[next], far[i]], material, -1);
    });
    return [...sides, ...fan([...near].reverse(), material, -1), ...fan(far, material, -1)];
}

/// Three texels.
const materialTexels = (model: number, diffuse: Vector, f0: Vector, roughness: number, emission: Vector): number[] =>
    [...diffuse, model, ...f0, roughness, ...emission, 0];

const black: Vector = [0, 0, 0];

class Builder {
    readonly occluders: Triangle[] = [];
    readonly others: Triangle[] = [];
    readonly materials: number[];
    readonly uniforms: Uniforms;

    constructor(private readonly scene: Scene) {
        this.materials = scene.materials.flatMap(m =>
            materialTexels(m.isGlossy ? models.frostbite : models.lambert, m.diffuse, m.f0, m.roughness, black));
        const lights = scene.polygons.filter(polygon => polygon.radiance !== null);
        for (const polygon of scene.polygons) {
            const light = lights.indexOf(polygon);
            this.occluders.push(...fan(polygon.vertices, light < 0 ? polygon.material : this.addEmitter(polygon),
                light));
        }
        for (const tube of scene.tubes) {
            this.materials.push(...materialTexels(models.noSurface, black, black, 1, tube.radiance));
            this.others.push(...prism(tube, this.materials.length / 12 - 1));
        }
        const number = (tube: Tube) => lights.length + scene.tubes.indexOf(tube);
        const tubesOf = (isCylinder: boolean) => scene.tubes.filter(tube => tube.isCylinder === isCylinder);
        this.uniforms = new Map([...polygonUniforms(lights), ...tubeUniforms("line", tubesOf(false), number),
            ...tubeUniforms("cylinder", tubesOf(true), number)]);
    }

    /// The material of a surface that emits.
    private addEmitter(polygon: Polygon): number {
        const m = this.scene.materials[polygon.material];
        this.materials.push(...materialTexels(m.isGlossy ? models.frostbite : models.lambert, m.diffuse, m.f0,
            m.roughness,
            polygon.radiance ?? black));
        return this.materials.length / 12 - 1;
    }
}

/// The radius of a sphere around all triangles [m].
function radiusOf(triangles: readonly Triangle[]): number {
    const sides = [0, 1, 2].map(k => {
        const values = triangles.flatMap(triangle => triangle.corners.map(corner => corner[k]));
        return values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b));
    });
    return 0.5 * Math.hypot(...sides);
}

/// \throws Error for more lights than shaders have room for
export function makeSceneTextures(gl: Gl, scene: Scene): SceneTextures {
    const builder = new Builder(scene);
    const hierarchy = makeHierarchy(builder.occluders.flatMap(triangle => triangle.corners.flat()));
    const triangles = [...hierarchy.order.map(i => builder.occluders[i]), ...builder.others];
    const texels = triangles.flatMap(({ corners: [a, b, c], material, light }) => [...a, material, ...b, light, ...c,
        0]);
    builder.uniforms.set("node_count", [hierarchy.nodeCount]);
    builder.uniforms.set("scene_radius", [radiusOf(triangles)]);
    return {
        triangles: makeArrayTexture(gl, Float32Array.from(texels)),
        triangleCount: triangles.length,
        nodes: makeArrayTexture(gl, hierarchy.nodes),
        materials: makeArrayTexture(gl, Float32Array.from(builder.materials)),
        uniforms: builder.uniforms,
    };
}
