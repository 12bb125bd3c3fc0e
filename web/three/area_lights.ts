/// RectAreaLights and TubeLights of a three.js scene with shadows.

import {
    Camera, Constant, DataTexture, HalfFloatType, Layers, Mesh, MeshStandardMaterial, Object3D, RGBAFormat, RGFormat, RectAreaLight, Scene,
    Vector3,
} from "three";
import shaderPart from "generated/area_lights.glsl";
import lobeBytes from "../../data/ltc-frostbite-engine.bin";
import { isInRange } from "../library/layout";
import { PolygonLight, TubularLight, Uniforms, lightVertices, mostLights, polygonUniforms, tubeUniforms } from "../library/light_uniforms";
import { lobeTableSide, lobeTexels } from "../library/lobe_table";
import { Occluders } from "./occluders";
import { TubeLight } from "./tube_light";

/// In place of the chunk with three.js's loops over lights: without its closed form for RectAreaLights.
const lightsChunk = "#include <lights_fragment_begin>";
const replacement = `#ifdef NUSSELT_AREA_LIGHTS
#undef RE_Direct_RectArea
#endif
${lightsChunk}
#ifdef NUSSELT_AREA_LIGHTS
reflectedLight.directSpecular += nusselt_reflected_light(material, geometryPosition, geometryNormal, geometryViewDir);
#endif
`;
const mainBegins = "void main() {";

/// A light emits along its local -z axis; its scale does not count. The corners run counter-clockwise for those whom it
/// shines on.
function worldPolygon(light: RectAreaLight): PolygonLight {
    const center = new Vector3().setFromMatrixPosition(light.matrixWorld);
    const side = (x: number, y: number, size: number) =>
        new Vector3(x, y, 0).transformDirection(light.matrixWorld).multiplyScalar(0.5 * size);
    const [x, y] = [side(1, 0, light.width), side(0, 1, light.height)];
    const corner = (u: number, v: number) => center.clone().addScaledVector(x, u).addScaledVector(y, v).toArray();
    const radiance = light.color.clone().multiplyScalar(light.intensity).toArray();
    return { vertices: [corner(1, -1), corner(-1, -1), corner(-1, 1), corner(1, 1)], radiance };
}

const areInRange = (uniforms: Uniforms): boolean => [...uniforms.values()].flat().every(isInRange);
const differ = (a: readonly number[], b: readonly number[]): boolean => a.some((x, k) => x !== b[k]);

/// Lights of no extent, such as those in groups of scale 0, and lights with numbers that shaders cannot take do not shine.
const panelShines = (panel: PolygonLight): boolean => {
    const [a, b, c] = panel.vertices;
    return differ(a, b) && differ(b, c) && areInRange(polygonUniforms([panel]));
};
const tubeShines = (tube: TubularLight): boolean =>
    tube.radius > 0 && differ(tube.begin, tube.end) && areInRange(tubeUniforms("line", [tube], () => 0));

const firstLayer = new Layers();

/// Which lights a material has: its program has room for those of one object.
const owners = new WeakMap<MeshStandardMaterial, AreaLights>();

/// Arrays in shaders, which three.js wants in full length: numbers per light.
const arrays: Record<string, number> = {
    polygon_vertices: 3 * lightVertices, polygon_edges: 3 * lightVertices, polygon_normals: 3, polygon_radiances: 3,
    polygon_numbers: 1, line_begins: 3, line_directions: 4, line_radiances: 4, line_numbers: 1,
};

/// Textures of the small table of linearly transformed cosines.
function lobeTextures(): [DataTexture, DataTexture] {
    const { shapes, albedos } = lobeTexels(lobeBytes);
    const make = (texels: Uint16Array, format: Constant) => {
        const texture = new DataTexture(texels, lobeTableSide, lobeTableSide, format, HalfFloatType);
        texture.needsUpdate = true;
        return texture;
    };
    return [make(shapes, RGBAFormat), make(albedos, RGFormat)];
}

function materialsOf(object: Object3D): MeshStandardMaterial[] {
    const materials = object instanceof Mesh ? [object.material].flat() : [];
    return materials.filter((material): material is MeshStandardMaterial => material instanceof MeshStandardMaterial);
}

/// What a material defines for its program, without what AreaLights adds.
function withoutOurs(material: MeshStandardMaterial): Record<string, string | number> {
    const { NUSSELT_AREA_LIGHTS: _, NUSSELT_TUBE_LIGHTS: __, ...others } = material.defines ?? {};
    return others;
}

/// The area lights of a scene, for its standard and physical materials.
export class AreaLights {
    /// Whether meshes with castShadow cast shadows on those with receiveShadow.
    shadows = true;
    /// Set this after changes that no version number tells: of bones and morph targets.
    needsUpdate = false;
    /// Number of the next frame, which chooses its random numbers.
    frame = 0;

    private readonly occluders = new Occluders();
    /// With what gives them back their own programs.
    private readonly materials = new Map<MeshStandardMaterial, () => void>();
    private sampleCount = 1;
    private readonly uniforms: Record<string, { value: unknown }>;
    private hasTubes = false;
    private isActive = true;
    private lightState = "";
    /// Whether something has changed since update() last returned.
    private hasChanged = false;

    constructor(private readonly scene: Scene) {
        const [lobe_shapes, lobe_albedos] = lobeTextures();
        const values: Record<string, unknown> = {
            lobe_shapes, lobe_albedos, triangles: null, nodes: null, node_count: 0, scene_radius: 0, has_shadows: true, seed: 0,
            first_sample: 0, sample_count: 1, polygon_count: 0, line_count: 0,
        };
        for (const [name, size] of Object.entries(arrays)) values[name] = new Float32Array(mostLights * size);
        for (const name of ["polygon_numbers", "line_numbers"]) values[name] = new Int32Array(mostLights);
        this.uniforms = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { value }]));
    }

    /// Lights all standard and physical materials of an object and of what is below it. Call it again for what is added.
    add(root: Object3D): void {
        root.traverse((object: Object3D) => {
            for (const material of materialsOf(object)) this.addMaterial(material);
        });
    }

    /// Adds to what the program of a material has.
    private addMaterial(material: MeshStandardMaterial): void {
        if (this.materials.has(material)) return;
        if (owners.has(material))
            throw new Error(`AreaLights: the material "${material.name}" has other area lights; dispose() of them first`);
        owners.set(material, this);
        const compileBefore = material.onBeforeCompile;
        const makeKeyBefore = material.customProgramCacheKey;
        const keyBefore = material.customProgramCacheKey();
        this.materials.set(material, () => {
            owners.delete(material);
            material.onBeforeCompile = compileBefore;
            material.customProgramCacheKey = makeKeyBefore;
            material.defines = withoutOurs(material);
            material.needsUpdate = true;
        });
        material.onBeforeCompile = (shader, renderer) => {
            compileBefore.call(material, shader, renderer);
            Object.assign(shader.uniforms, this.uniforms);
            const text = shader.fragmentShader;
            if (!text.includes(lightsChunk) || !text.includes(mainBegins))
                throw new Error(`AreaLights: the shader of material "${material.name}" lacks ${lightsChunk}; was it made by other code?`);
            shader.fragmentShader = text.replace(lightsChunk, replacement)
                .replace(mainBegins, () => `#ifdef NUSSELT_AREA_LIGHTS\n${shaderPart}\n#endif\n${mainBegins}`);
        };
        material.customProgramCacheKey = () => `${keyBefore} nusselt`;
        this.setDefines(material);
    }

    private setDefines(material: MeshStandardMaterial): void {
        const others = withoutOurs(material);
        material.defines = this.isActive ? { ...others, NUSSELT_AREA_LIGHTS: "", NUSSELT_TUBE_LIGHTS: Number(this.hasTubes) } : others;
        material.needsUpdate = true;
    }

    /// Two per pixel, light and frame: one for the diffuse part, one for the specular part. A whole number, at least 1.
    get samples(): number { return this.sampleCount; }
    set samples(value: number) { this.sampleCount = Math.max(1, Math.round(value) || 1); }

    /// Whether materials use these lights. If not, they are what they were, with three.js's own RectAreaLights.
    get active(): boolean { return this.isActive; }
    set active(value: boolean) {
        if (value === this.isActive) return;
        this.isActive = value;
        for (const material of this.materials.keys()) this.setDefines(material);
    }

    /// Triangles that cast shadows.
    get triangleCount(): number { return this.occluders.triangleCount; }

    /// Follows the scene; to be called before each frame. Meshes that cast shadows and have changed cost the time to build
    /// their hierarchy again; lights may always move.
    /// \param camera of the frame. As for three.js, lights and meshes count that share a layer with it; without a camera, those
    ///               in layer 0.
    /// \return whether something has changed, so that frames before cannot be added up with those that follow.
    /// \throws Error for more than four lights of a kind
    update(camera?: Camera): boolean {
        const layers = camera?.layers ?? firstLayer;
        this.scene.updateMatrixWorld();
        // What has moved is still news after a call that throws.
        if (this.occluders.update(this.scene, layers, this.needsUpdate)) this.hasChanged = true;
        this.needsUpdate = false;
        this.set("triangles", this.occluders.triangles);
        this.set("nodes", this.occluders.nodes);
        this.set("node_count", this.occluders.nodeCount);
        this.set("scene_radius", this.occluders.radius);
        this.set("has_shadows", this.shadows);
        this.set("sample_count", this.samples);
        // Sums of frames are best for samples without a gap; the number stays exact in a float.
        this.set("first_sample", this.frame * this.samples % 2 ** 20);
        ++this.frame;
        if (this.updateLights(layers)) this.hasChanged = true;
        const { hasChanged } = this;
        this.hasChanged = false;
        return hasChanged;
    }

    private set(name: string, value: unknown): void { this.uniforms[name].value = value; }

    private updateLights(layers: Layers): boolean {
        const panels: PolygonLight[] = [];
        const lines: TubularLight[] = [];
        this.scene.traverseVisible((object: Object3D) => {
            if (!object.layers.test(layers)) return;
            if (object instanceof RectAreaLight) {
                const panel = worldPolygon(object);
                if (panelShines(panel)) panels.push(panel);
            }
            if (object instanceof TubeLight) {
                const line = object.toWorld();
                if (!tubeShines(line)) return;
                object.updateLook();
                lines.push(line);
            }
        });
        const uniforms: Uniforms = new Map([...polygonUniforms(panels),
            ...tubeUniforms("line", lines, line => panels.length + lines.indexOf(line))]);
        for (const [name, values] of uniforms) {
            const { value } = this.uniforms[name];
            if (value instanceof Float32Array || value instanceof Int32Array) value.set(values);
            else this.set(name, values[0]);
        }
        if (this.hasTubes !== lines.length > 0) {
            this.hasTubes = lines.length > 0;
            for (const material of this.materials.keys()) this.setDefines(material);
        }
        const state = JSON.stringify([[...uniforms], this.shadows, this.samples, this.isActive]);
        const hasChanged = state !== this.lightState;
        this.lightState = state;
        return hasChanged;
    }

    /// Frees textures, and gives materials back their own programs.
    dispose(): void {
        for (const restore of this.materials.values()) restore();
        this.materials.clear();
        this.occluders.dispose();
        for (const name of ["lobe_shapes", "lobe_albedos"]) (this.uniforms[name].value as DataTexture).dispose();
    }
}
