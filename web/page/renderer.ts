/// Draws the images of the page.

import { constantOf, makeImageShader } from "../library/image_shader";
import { errorBlock } from "../library/layout";
import { LobeTable, makeLobeTable } from "../library/lobe_table";
import { Scene, View } from "../library/pbrt";
import { SceneTextures, lightKinds, makeSceneTextures } from "../library/scene_textures";
import { Sources, assembleShader } from "../library/shaders";
import { heuristics, samplers, techniqueOf } from "../library/techniques";
import { unrollLoops } from "../library/unroll";
import {
    Gl, PendingProgram, Program, Target, UniformValue, beginProgram, completion, deleteTarget, draw, formats,
        makeDepthTarget, makeTarget,
    readTarget,
} from "../library/webgl";
import { cameraOf, matrixOf, raysOf } from "./camera";
import { Side } from "./state";

/// How an image is made. Images with different seeds are independent.
export interface ImageSettings extends Side {
    readonly samples: number;
    readonly shadows: boolean;
    readonly seed: number;
}

/// Where camera rays pass all pixels, in [0, 1)^2.
export type Place = readonly [number, number];

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

/// Root mean square errors over pixels and channels, NaN where an image or the reference has no frames; and how many
/// samples were not finite.
export interface Errors {
    readonly left: number;
    readonly right: number;
    readonly rejected: number;
}

export interface Display {
    /// Share of the width that shows the left image.
    readonly wipe: number;
    readonly exposure: number;
    readonly showsError: boolean;
}

/// Drivers compile a program, and many of them once more when it draws for the first time: programs that have drawn are
/// warm.
export type ProgramState = "compiling" | "ready" | "warm" | "failed";

/// A program that makes images.
interface ImageProgram {
    readonly pending: PendingProgram;
    isWarm: boolean;
    /// What is wrong with it.
    failure: string | null;
}

const messageOf = (error: unknown): string => error instanceof Error ? error.message : String(error);

export class Renderer {
    width = 0;
    height = 0;
    private readonly passes = new Map<string, PendingProgram>();
    private readonly programs = new Map<string, ImageProgram>();
    private readonly lobes: LobeTable;
    private scene: Scene | null = null;
    private textures: SceneTextures | null = null;
    private visible: Target | null = null;
    private blocks: Target | null = null;
    private readonly images = new Map<ImageName, Frames>();
    private camera = new Map<string, UniformValue>();
    private view: View | null = null;
    /// What `visible` shows, null for something else.
    private visiblePlace: Place | null = null;

    /// \throws Error where WebGL 2 or textures of floats are missing
    constructor(private readonly gl: Gl, private readonly sources: Sources, table: Uint8Array) {
        if (gl.getExtension("EXT_color_buffer_float") === null)
            throw new Error("This device cannot draw into textures of floats (EXT_color_buffer_float).");
        this.lobes = makeLobeTable(gl, table);
    }

    /// Takes another scene or view; frames start anew by clear().
    setScene(scene: Scene): void {
        const { gl, textures } = this;
        for (const old of textures ? [textures.triangles, textures.nodes, textures.materials] : [])
            gl.deleteTexture(old);
        this.scene = scene;
        this.textures = makeSceneTextures(gl, scene);
        this.visiblePlace = null;
    }

    setView(view: View): void {
        this.view = view;
        this.visiblePlace = null;
    }

    /// \throws Error where the device has no memory for images of this size
    resize(width: number, height: number): void {
        const { gl } = this;
        if (width === this.width && height === this.height) return;
        this.drop(imageNames);
        for (const target of [this.visible, this.blocks]) if (target !== null) deleteTarget(gl, target);
        this.visible = this.blocks = this.visiblePlace = null;
        this.width = gl.canvas.width = width;
        this.height = gl.canvas.height = height;
        this.visible = makeDepthTarget(gl, formats.r32i, width, height);
        this.blocks = makeTarget(gl, formats.rgba32f, Math.ceil(width / errorBlock), Math.ceil(height / errorBlock));
    }

    /// Gives back the memory of images that are not wanted.
    drop(names: readonly ImageName[]): void {
        for (const name of names) {
            this.images.get(name)?.delete();
            this.images.delete(name);
        }
    }

    clear(names: readonly ImageName[] = imageNames): void {
        for (const name of names) this.images.get(name)?.clear();
    }

    frameCount(name: ImageName): number { return this.images.get(name)?.count ?? 0; }

    /// The fragment shader of an image, complete; the page unrolls its loops before it compiles it.
    shaderText(side: Side): string {
        if (this.scene === null) throw new Error("there is no scene");
        const sampler = samplers.find(row => row.name === side.sampler) ?? samplers[0];
        return makeImageShader(this.sources, techniqueOf(side.technique), sampler.constant, lightKinds(this.scene));
    }

    private begin(vertex: string, fragment: string): PendingProgram {
        return beginProgram(this.gl, assembleShader(this.sources, `#include "${vertex}"\n`), fragment);
    }

    private pass(name: string, vertex = "screen.vert"): Program {
        let pass = this.passes.get(name);
        if (pass === undefined) {
            pass = this.begin(vertex, assembleShader(this.sources, `#include "${name}"\n`));
            this.passes.set(name, pass);
        }
        return pass.finish();
    }

    private imageProgram(side: Side): ImageProgram {
        const kinds = this.scene === null ? [] : lightKinds(this.scene);
        const key = [side.technique, side.sampler, ...kinds].join();
        let program = this.programs.get(key);
        if (program === undefined) {
            const text = this.shaderText(side);
            const fragment = techniqueOf(side.technique).keepsLoops ? text : unrollLoops(text);
            program = { pending: this.begin("screen.vert", fragment), isWarm: false, failure: null };
            this.programs.set(key, program);
        }
        return program;
    }

    /// Whether an image can be drawn without waiting for a compiler. Begins to compile.
    stateOf(side: Side): ProgramState {
        const { pending, isWarm, failure } = this.imageProgram(side);
        return failure !== null ? "failed" : isWarm ? "warm" : pending.isReady() ? "ready" : "compiling";
    }

    /// What is wrong with the program of an image, null if nothing is known to be.
    failureOf(side: Side): string | null { return this.imageProgram(side).failure; }

    private drawVisibility(place: Place): void {
        const { gl, view, textures, visible, width, height } = this;
        if (view === null || textures === null || visible === null
            || this.visiblePlace?.join() === place.join()) return;
        this.visiblePlace = place;
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

    /// The image, with room for frames.
    private framesOf(name: ImageName): Frames {
        let image = this.images.get(name);
        if (image === undefined) {
            image = new Frames(this.gl, this.width, this.height);
            this.images.set(name, image);
        }
        return image;
    }

    /// Adds a frame to an image.
    /// \returns whether it did: not where the program has a failure
    add(name: ImageName, settings: ImageSettings, place: Place): boolean {
        const { gl, textures, visible, lobes, sources } = this;
        if (textures === null || visible === null) return false;
        const program = this.imageProgram(settings);
        let finished: Program;
        try {
            finished = program.pending.finish();
        } catch (error) {
            program.failure = messageOf(error);
            return false;
        }
        this.drawVisibility(place);
        const image = this.framesOf(name);
        const heuristic = heuristics.find(row => row.name === settings.heuristic) ?? heuristics[0];
        draw(gl, finished, image.next, new Map<string, UniformValue>([
            ...this.camera, ...textures.uniforms, ["materials", textures.materials], ["nodes", textures.nodes],
            ["visible_numbers", visible.texture], ["lobe_shapes", lobes.shapes], ["lobe_albedos", lobes.albedos],
            ["has_shadows", settings.shadows], ["seed", settings.seed],
                ["first_sample", image.count * settings.samples],
            ["sample_count", settings.samples], ["visibility_estimate", 0.5], ["frames_before", image.sum.texture],
            ["heuristic", constantOf(sources, "nusselt/estimate/mis.glsl", heuristic.constant)],
        ]));
        program.isWarm = true;
        image.advance();
        return true;
    }

    /// The sums of all images and the numbers of their frames, null without any. Those without frames have another's
    /// sum.
    private sums(): [string, UniformValue][] | null {
        const any = [...this.images.values()].find(image => image.count > 0);
        if (any === undefined) return null;
        return imageNames.flatMap((name): [string, UniformValue][] => [
            [`${name}_frames`, (this.images.get(name) ?? any).sum.texture], [`${name}_count`, this.frameCount(name)],
        ]);
    }

    /// Shows images, if there are any.
    display(display: Display): void {
        const sums = this.sums();
        if (sums === null) return;
        draw(this.gl, this.pass("display.frag"), null, new Map<string, UniformValue>([
            ...sums, ["wipe", display.wipe * this.width], ["exposure", 2 ** display.exposure],
            ["shows_error", display.showsError],
        ]));
    }

    /// Resolves when all frames are drawn.
    completion(): Promise<void> { return completion(this.gl); }

    /// Errors from the reference.
    async errors(): Promise<Errors> {
        const { gl, blocks, width, height } = this;
        const isKnown = (name: ImageName) => this.frameCount(name) > 0 && this.frameCount("reference") > 0;
        const [knowsLeft, knowsRight] = [isKnown("left"), isKnown("right")];
        const images = this.sums();
        if (blocks === null || images === null) return { left: NaN, right: NaN, rejected: 0 };
        draw(gl, this.pass("errors.frag"), blocks, new Map(images));
        const sums = await readTarget(gl, blocks);
        const total = (channel: number) => sums.reduce((sum, value, i) => i % 4 === channel ? sum + value : sum, 0);
        const error = (channel: number) => Math.sqrt(total(channel) / (3 * width * height));
        return { left: knowsLeft ? error(0) : NaN, right: knowsRight ? error(1) : NaN, rejected: total(2) };
    }

    /// The frames of an image: the sums of red, green and blue, and how many samples were not finite, row by row from
    /// the bottom; and their number.
    async read(name: ImageName): Promise<{ readonly sums: Float32Array; readonly count: number }> {
        const image = this.images.get(name);
        if (image === undefined) throw new Error("there is no image");
        const { count } = image;
        return { sums: await readTarget(this.gl, image.sum), count };
    }
}
