/// Starts the page and draws its frames.

import { halton } from "../library/halton";
import { Scene, View, readScene } from "../library/pbrt";
import { techniqueOf } from "../library/techniques";
import { fitHeuristic, makeControls, makeNumbers } from "./controls";
import { element } from "./dom";
import { Lamp, changedScene, floorOf, lampsOf, withLines } from "./lamps";
import { Errors, ImageName, ImageSettings, Renderer } from "./renderer";
import { sceneOf } from "./scenes";
import { makeStage } from "./stage";
import { Side, State, linkOf, stateOf } from "./state";

/// What web/build.py puts into the page.
interface Data {
    readonly licence: string;
    readonly sources: Record<string, string>;
    readonly scenes: Record<string, string>;
    /// Bytes of the table of lobes, in base 64.
    readonly lobes: string;
}

const mostFramesInFlight = 2;
const referenceSeed = 1;
/// Frames of devices for which the reference takes less noise and more code [ms].
const referenceFrameTime = 100;
/// Widths for "automatic" [pixels]: the first one, unless frames take less or more time than these [ms].
const firstWidth = 480;
const fast = { frameTime: 20, width: 960 };
const slow = { frameTime: 400, width: 320 };
/// The reference waits for so many frames, since its program takes time to compile.
const framesBeforeReference = 8;
const errorInterval = 500; ///< [ms]
const storeDelay = 300; ///< after the last change [ms]

class Page {
    private state: State;
    private readonly files: ReadonlyMap<string, string>;
    private readonly renderer: Renderer;
    private scene: Scene;
    private lamps: Lamp[];
    private readonly controls;
    private readonly numbers = makeNumbers();
    private readonly stage;
    private automaticWidth = firstWidth;
    /// Images whose programs have drawn.
    private readonly warm = new Set<string>();
    private frame = 0;
    /// Frames that the device has not finished.
    private framesInFlight = 0;
    /// Whether the device may be compiling: it does nothing else then.
    private isCompiling = false;
    private lastTime = 0;
    private frameTime = 0;
    private steadyFrames = 0;
    private lastChange = 0;
    private referenceTechnique = "projected";
    private errors: Errors | null = null;
    private lastErrors = 0;
    private isDirty = true;
    private storing = 0;

    constructor(private readonly data: Data) {
        this.state = stateOf(location.hash);
        this.fitHeuristics();
        this.files = new Map(Object.entries(data.scenes));
        this.scene = this.readScene();
        this.lamps = lampsOf(this.scene);
        const change = (edit: (state: State) => void) => this.change(edit);
        this.stage = makeStage({ change, view: () => this.view(), state: () => this.state });
        this.controls = makeControls({
            change,
            chooseScene: name => this.change(state => Object.assign(state, { scene: name, camera: null, lamps: [], roughness: null })),
            shaderText: side => this.shaderText(side),
            link: () => this.link(),
        });
        document.getElementById("page")?.append(this.stage.node, this.numbers.node, this.controls.node, help());
        const gl = this.stage.canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "high-performance" });
        if (gl === null) throw new Error("This browser or device has no WebGL 2.");
        const lobes = Uint8Array.from(atob(data.lobes), c => c.charCodeAt(0));
        this.renderer = new Renderer(gl, new Map(Object.entries(data.sources)), lobes);
        this.showLamps();
        this.update(null);
        window.addEventListener("hashchange", () => this.change(state => Object.assign(state, stateOf(location.hash))));
        this.stage.canvas.addEventListener("webglcontextlost", () => fail(new Error("The device was reset; load the page again.")));
        const loop = () => {
            try {
                if (!this.isCompiling && this.framesInFlight < mostFramesInFlight) this.draw();
                requestAnimationFrame(loop);
            } catch (error) {
                fail(error);
            }
        };
        requestAnimationFrame(loop);
    }

    /// Resolves to the mean of an image, for tests: red, green, blue and the number of frames, row by row from the
    /// bottom.
    async image(name: ImageName): Promise<number[]> {
        const sums = await this.renderer.read(name);
        return Array.from(sums, (sum, i) => i % 4 === 3 ? sum : sum / sums[i - i % 4 + 3]);
    }

    frames(name: ImageName): number { return this.renderer.frameCount(name); }

    /// A complete fragment shader, as it runs.
    shaderText(side: Side): string { return this.renderer.shaderText(side).replace("\n", `\n${this.data.licence}\n`); }

    private readScene(): Scene { return readScene(this.files, sceneOf(this.state.scene).file); }

    private view(): View { return { ...this.scene.view, ...this.state.camera }; }

    /// Leads to what is shown.
    link(): string {
        const link = linkOf(this.state);
        return location.href.replace(/#.*/, "") + (link === "" ? "" : `#${link}`);
    }

    private change(edit: (state: State) => void): void {
        const before = this.state;
        const edited = stateOf(linkOf(before));
        edit(edited);
        // Rounded as in links, so that these lead to the same image.
        this.state = stateOf(linkOf(edited));
        this.fitHeuristics();
        this.lastChange = performance.now();
        if (before.scene !== this.state.scene) {
            this.scene = this.readScene();
            this.lamps = lampsOf(this.scene);
            this.showLamps();
        }
        this.update(before);
    }

    private fitHeuristics(): void {
        fitHeuristic(this.state.left);
        fitHeuristic(this.state.right);
    }

    private showLamps(): void {
        this.stage.setLamps(this.lamps);
        this.controls.setLamps(this.lamps);
    }

    /// Follows the state. \param before null for the first time
    private update(before: State | null): void {
        const { state, renderer } = this;
        const changed = (...keys: (keyof State)[]) =>
            before === null || keys.some(key => JSON.stringify(before[key]) !== JSON.stringify(state[key]));
        if (changed("scene", "lamps", "roughness", "thickTubes")) {
            const scene = changedScene(this.scene, this.lamps, state.lamps, state.roughness);
            renderer.setScene(state.thickTubes ? scene : withLines(scene));
        }
        if (changed("scene", "camera")) renderer.setView(this.view());
        this.resize();
        if (changed("scene", "lamps", "roughness", "camera", "shadows", "thickTubes", "accumulates", "smoothsEdges", "mostFrames")) this.clear();
        for (const name of ["left", "right"] as const) if (changed(name, "samples")) renderer.clear([name]);
        if (changed("compares")) renderer.clear(["right"]);
        this.stage.show(state, [techniqueOf(state.left.technique).label, techniqueOf(state.right.technique).label]);
        this.controls.show(state, this.scene.materials[floorOf(this.scene)].roughness);
        this.isDirty = true;
        this.steadyFrames = 0;
        this.errors = null;
        if (before !== null) this.storeSoon();
    }

    /// Puts the state into the address. Browsers count how often pages do that.
    private storeSoon(): void {
        clearTimeout(this.storing);
        this.storing = setTimeout(() => {
            const link = this.link();
            if (link !== location.href) history.replaceState(null, "", link);
        }, storeDelay);
    }

    private clear(): void {
        this.renderer.clear();
        this.frame = 0;
    }

    private resize(): void {
        const width = this.state.width || this.automaticWidth;
        if (width === this.renderer.width) return;
        this.renderer.resize(width, width * 9 / 16);
        this.frame = 0;
    }

    /// The images of this frame.
    private wanted(): [ImageName, ImageSettings][] {
        const { state, renderer } = this;
        const { samples, shadows } = state;
        const images: [ImageName, ImageSettings][] = [["left", { ...state.left, samples, shadows, seed: 0 }]];
        if (state.compares) images.push(["right", { ...state.right, samples, shadows, seed: 0 }]);
        const isUnfinished = (name: ImageName) => !this.addsUp(name) || renderer.frameCount(name) < state.mostFrames;
        const unfinished = images.filter(([name]) => isUnfinished(name));
        // On slow devices, the reference takes a part of the time, and none while something moves.
        const isFast = this.frameTime < referenceFrameTime;
        const isResting = performance.now() - this.lastChange > 300 && this.frame >= framesBeforeReference;
        const hasTime = isFast || this.frame % 4 === 3 || unfinished.length === 0;
        if (state.reference && isResting && hasTime && isUnfinished("reference")) {
            if (renderer.frameCount("reference") === 0) this.referenceTechnique = isFast ? "projected_ltc" : "projected";
            unfinished.push(["reference", { technique: this.referenceTechnique, heuristic: "clamped_optimal", sampler: "sobol",
                samples: 1, shadows, seed: referenceSeed }]);
        }
        return unfinished;
    }

    private addsUp(name: ImageName): boolean { return this.state.accumulates || name === "reference"; }

    /// A program that has never drawn may be compiled only then: one in each frame, so that what is ready is seen
    /// before.
    private add(images: readonly [ImageName, ImageSettings][]): void {
        const { state, renderer } = this;
        for (const [name, settings] of images) {
            const key = [settings.technique, settings.sampler, state.scene, state.thickTubes].join();
            if (!this.warm.has(key)) {
                if (this.isCompiling || !renderer.isReady(settings)) continue;
                this.isCompiling = true;
                this.steadyFrames = 0;
                this.warm.add(key);
            }
            if (!this.addsUp(name)) renderer.clear([name]);
            renderer.add(name, this.addsUp(name) ? settings : { ...settings, seed: 2 + this.frame });
            this.isDirty = true;
        }
    }

    private draw(): void {
        const { state, renderer } = this;
        const images = this.wanted();
        if (images.length === 0 && !this.isDirty) return;
        // Without adding up, edges would tremble.
        renderer.look(state.accumulates && state.smoothsEdges ? [halton(this.frame + 1, 2), halton(this.frame + 1, 3)] : [0.5, 0.5]);
        this.add(images);
        if (images.length > 0) ++this.frame;
        if (this.isDirty) {
            const hasLeft = renderer.frameCount("left") > 0;
            const hasRight = state.compares && renderer.frameCount("right") > 0;
            const wipe = hasLeft && hasRight ? state.wipe : hasRight ? 0 : 1;
            renderer.display({ wipe, exposure: state.exposure, showsError: state.shows === "error" && renderer.frameCount("reference") > 0 });
            this.isDirty = false;
        }
        if (this.isCompiling) this.showNumbers();
        ++this.framesInFlight;
        void renderer.completion().then(() => this.finishFrame(images.length > 0));
    }

    /// \param isTimed whether it added to an image
    private finishFrame(isTimed: boolean): void {
        const { state, renderer } = this;
        --this.framesInFlight;
        this.isCompiling = false;
        if (renderer.frameCount("left") > 0) document.documentElement.dataset.state = "ready";
        const now = performance.now();
        const interval = now - this.lastTime;
        this.lastTime = now;
        // Those before took part in compiling.
        if (isTimed && ++this.steadyFrames > 3) this.frameTime = this.steadyFrames < 8 ? interval : 0.9 * this.frameTime + 0.1 * interval;
        if (state.width === 0 && this.steadyFrames === 8 && this.automaticWidth === firstWidth) this.chooseWidth();
        if (isTimed && now - this.lastErrors > errorInterval && renderer.frameCount("reference") > 0) {
            this.lastErrors = now;
            void renderer.errors().then(errors => {
                this.errors = errors;
                this.isDirty = true;
            });
        }
        this.showNumbers();
    }

    private showNumbers(): void {
        const { state, renderer } = this;
        this.numbers.show({
            size: `${renderer.width} × ${renderer.height}`, isCompiling: this.isCompiling,
            frameTime: this.steadyFrames > 3 ? this.frameTime : 0, leftSamples: state.samples * renderer.frameCount("left"), rightSamples: state.samples * renderer.frameCount("right"),
            referenceSamples: renderer.frameCount("reference"), errors: state.reference ? this.errors : null,
            compares: state.compares,
        });
    }

    private chooseWidth(): void {
        const width = this.frameTime < fast.frameTime ? fast.width : this.frameTime > slow.frameTime ? slow.width : firstWidth;
        if (width === this.automaticWidth) return;
        this.automaticWidth = width;
        this.update(this.state);
    }
}

function help(): HTMLElement {
    const rows = [
        ["Drag, arrow keys", "turn the view; with Shift, or two fingers, move it"],
        ["Wheel, + and −, pinch", "zoom"],
        ["Handles of the lights", "drag or arrow keys move them, with Shift they turn; Page Up and Page Down move them in depth"],
        ["Divider", "drag or arrow keys move it"],
        ["Home", "puts the view or the light that has the focus back"],
    ];
    return element("details", { class: "keys" }, element("summary", {}, "Mouse, touch and keys"),
        element("dl", {}, ...rows.flatMap(([keys, effect]) => [element("dt", {}, keys), element("dd", {}, effect)])));
}

function fail(error: unknown): void {
    const node = document.getElementById("failure");
    if (node === null) return;
    node.hidden = false;
    node.textContent = error instanceof Error ? error.message : String(error);
    document.documentElement.dataset.state = "failed";
}

declare global {
    interface Window {
        /// For tests and for curious people at the console.
        nusselt?: Page;
    }
}

try {
    window.nusselt = new Page(JSON.parse(document.getElementById("data")?.textContent ?? "") as Data);
} catch (error) {
    fail(error);
}
