/// Draws the images of the page.

import { makeImageShader } from "../library/image_shader";
import { LobeTable, makeLobeTable } from "../library/lobe_table";
import { Scene, View } from "../library/pbrt";
import { SceneTextures, lightKinds, makeSceneTextures } from "../library/scene_textures";
import { Sources, assembleShader } from "../library/shaders";
import { heuristics, samplers, techniqueOf } from "../library/techniques";
import {
    Gl, PendingProgram, Program, Target, UniformValue, beginProgram, completion, deleteTarget, draw, formats, makeTarget, readTarget,
} from "../library/webgl";
import { cameraOf, matrixOf, raysOf } from "./camera";
import { Side } from "./state";

/// How an image is made. Images with different seeds are independent.
export interface ImageSettings extends Side {
    readonly samples: number;
    readonly shadows: boolean;
    readonly seed: number;
}

/// A sum of frames.
class Frames {
    count = 0;
    private sums: [Target, Target];

    constructor(private readonly gl: Gl, width: number, height: number) {
        this.sums = [makeTarget(gl, formats.rgba32f, width, height), makeTarget(gl, formats.rgba32f, width, height)];
        this.clear();
    }

    get sum(): Target { return this.sums[0]; }
    get next(): Target { return this.sums[1]; }

    clear(): void {
        this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.sum.framebuffer);
        this.gl.clearBufferfv(this.gl.COLOR, 0, [0, 0, 0, 0]);
        this.count = 0;
    }

    advance(): void {
        this.sums.reverse();
        ++this.count;
    }

    delete(): void {
        for (const target of this.sums) deleteTarget(this.gl, target);
    }
}

export type ImageName = "left" | "right" | "reference";
const imageNames: readonly ImageName[] = ["left", "right", "reference"];

/// Root mean square errors over pixels and channels.
export interface Errors {
    readonly left: number;
    readonly right: number;
}

const errorBlock = 16; ///< kBlock of errors.frag

export interface Display {
    /// Share of the width that shows the left image.
    readonly wipe: number;
    readonly exposure: number;
    readonly showsError: boolean;
}

export class Renderer {
    width = 0;
    height = 0;
    private readonly programs = new Map<string, PendingProgram>();
    private readonly lobes: LobeTable;
    private scene: Scene | null = null;
    private textures: SceneTextures | null = null;
    private visible: Target | null = null;
    private blocks: Target | null = null;
    private images: Record<ImageName, Frames> | null = null;
    private camera = new Map<string, UniformValue>();
    private view: View | null = null;

    /// \throws Error where WebGL 2 or textures of floats are missing
    constructor(private readonly gl: Gl, private readonly sources: Sources, table: Uint8Array) {
        if (gl.getExtension("EXT_color_buffer_float") === null)
            throw new Error("This device cannot draw into textures of floats (EXT_color_buffer_float).");
        this.lobes = makeLobeTable(gl, table);
    }

    /// Takes another scene or view; frames start anew by clear().
    setScene(scene: Scene): void {
        const { gl, textures } = this;
        for (const old of textures ? [textures.triangles, textures.nodes, textures.materials] : []) gl.deleteTexture(old);
        this.scene = scene;
        this.textures = makeSceneTextures(gl, scene);
    }

    setView(view: View): void { this.view = view; }

    resize(width: number, height: number): void {
        const { gl } = this;
        if (width === this.width && height === this.height) return;
        for (const name of imageNames) this.images?.[name].delete();
        for (const target of [this.visible, this.blocks]) if (target !== null) deleteTarget(gl, target);
        this.width = gl.canvas.width = width;
        this.height = gl.canvas.height = height;
        this.visible = makeTarget(gl, formats.r32i, width, height, true);
        this.blocks = makeTarget(gl, formats.rgba32f, Math.ceil(width / errorBlock), Math.ceil(height / errorBlock));
        const frames = () => new Frames(gl, width, height);
        this.images = { left: frames(), right: frames(), reference: frames() };
    }

    clear(names: readonly ImageName[] = imageNames): void {
        for (const name of names) this.images?.[name].clear();
    }

    frameCount(name: ImageName): number { return this.images?.[name].count ?? 0; }

    /// The fragment shader of an image, complete.
    shaderText(side: Side): string {
        if (this.scene === null) throw new Error("there is no scene");
        const sampler = samplers.find(row => row.name === side.sampler) ?? samplers[0];
        return makeImageShader(this.sources, techniqueOf(side.technique), sampler.constant, lightKinds(this.scene));
    }

    private pending(key: string, vertex: string, fragment: () => string): PendingProgram {
        const known = this.programs.get(key);
        if (known !== undefined) return known;
        const begun = beginProgram(this.gl, assembleShader(this.sources, `#include "${vertex}"\n`), fragment());
        this.programs.set(key, begun);
        return begun;
    }

    private pass(name: string, vertex = "screen.vert"): Program {
        return this.pending(name, vertex, () => assembleShader(this.sources, `#include "${name}"\n`)).finish();
    }

    private imageProgram(side: Side): PendingProgram {
        const kinds = this.scene === null ? [] : lightKinds(this.scene);
        return this.pending([side.technique, side.sampler, ...kinds].join(), "screen.vert", () => this.shaderText(side));
    }

    /// Whether an image can be drawn without waiting for a compiler. Begins to compile.
    isReady(side: Side): boolean { return this.imageProgram(side).isReady(); }

    /// Finds what the camera sees, for the next frames.
    /// \param place where rays pass all pixels, in [0, 1)^2
    look(place: readonly [number, number]): void {
        const { gl, view, textures, visible, width, height } = this;
        if (view === null || textures === null || visible === null) return;
        const camera = cameraOf(view, width / height);
        const rays = raysOf(camera, width, height);
        this.camera = new Map<string, UniformValue>([
            ["clip_from_world", matrixOf(camera, width, height, [place[0] - 0.5, place[1] - 0.5])], ["eye", camera.eye],
            ["ray_corner", rays.corner], ["ray_right", rays.right], ["ray_down", rays.down], ["place_in_pixel", place],
            ["image_height", height], ["triangles", textures.triangles],
        ]);
        gl.bindFramebuffer(gl.FRAMEBUFFER, visible.framebuffer);
        gl.clearBufferiv(gl.COLOR, 0, [-1, 0, 0, 0]);
        gl.clearBufferfi(gl.DEPTH_STENCIL, 0, 1, 0);
        gl.enable(gl.DEPTH_TEST);
        draw(gl, this.pass("visibility.frag", "visibility.vert"), visible, this.camera, 3 * textures.triangleCount);
        gl.disable(gl.DEPTH_TEST);
    }

    /// Adds a frame to an image.
    add(name: ImageName, settings: ImageSettings): void {
        const { gl, textures, visible, images, lobes } = this;
        if (textures === null || visible === null || images === null) return;
        const image = images[name];
        const heuristic = heuristics.find(row => row.name === settings.heuristic) ?? heuristics[0];
        draw(gl, this.imageProgram(settings).finish(), image.next, new Map<string, UniformValue>([
            ...this.camera, ...textures.uniforms, ["materials", textures.materials], ["nodes", textures.nodes],
            ["visible_numbers", visible.texture], ["lobe_shapes", lobes.shapes], ["lobe_albedos", lobes.albedos],
            ["has_shadows", settings.shadows], ["seed", settings.seed], ["first_sample", image.count * settings.samples],
            ["sample_count", settings.samples], ["heuristic", heuristic.number], ["visibility_estimate", 0.5],
            ["frames_before", image.sum.texture],
        ]));
        image.advance();
    }

    private sums(): [string, UniformValue][] {
        const { images } = this;
        return images === null ? [] : imageNames.map(name => [`${name}_frames`, images[name].sum.texture]);
    }

    display(display: Display): void {
        draw(this.gl, this.pass("display.frag"), null, new Map<string, UniformValue>([
            ...this.sums(), ["wipe", display.wipe * this.width], ["exposure", 2 ** display.exposure],
            ["shows_error", display.showsError],
        ]));
    }

    /// Resolves when all frames are drawn.
    completion(): Promise<void> { return completion(this.gl); }

    /// Errors from the reference.
    async errors(): Promise<Errors> {
        const { gl, blocks, width, height } = this;
        if (blocks === null) return { left: NaN, right: NaN };
        draw(gl, this.pass("errors.frag"), blocks, new Map(this.sums()));
        const sums = await readTarget(gl, blocks);
        const error = (channel: number) => {
            let sum = 0;
            for (let i = channel; i < sums.length; i += 4) sum += sums[i];
            return Math.sqrt(sum / (3 * width * height));
        };
        return { left: error(0), right: error(1) };
    }

    /// The sum of the frames of an image: red, green, blue and their number, row by row from the bottom.
    read(name: ImageName): Promise<Float32Array> {
        if (this.images === null) throw new Error("there is no image");
        return readTarget(this.gl, this.images[name].sum);
    }
}
