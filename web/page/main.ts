/// Starts the page and draws its frames.

import { halton } from "../library/halton";
import { Scene, View, readScene } from "../library/pbrt";
import { techniqueOf } from "../library/techniques";
import { isUsable } from "./camera";
import { fitHeuristic, makeControls, makeNumbers } from "./controls";
import { element } from "./dom";
import { Lamp, changedScene, lampsOf, withLines } from "./lamps";
import { FrameWork, Pacing } from "./pacing";
import { Errors, ImageName, ImageSettings, Place, Renderer } from "./renderer";
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

/// Each seed of the state has so many: the first one for both images, the second one for the reference, and others for
/// frames that do not add up.
const seedsOfState = 65536;
const errorInterval = 500; ///< [ms]
const storeDelay = 300; ///< after the last change [ms]

class Page {
    private state: State;
    private readonly files: ReadonlyMap<string, string>;
    private readonly renderer: Renderer;
    private readonly pacing = new Pacing();
    private scene: Scene;
    private lamps: Lamp[];
    private readonly controls;
    private readonly numbers = makeNumbers();
    private readonly stage;
    /// Counts changes of the state.
    private changes = 0;
    /// Counts frames that did not add up.
    private singleFrames = 0;
    private referenceTechnique = "projected";
    private errors: Errors | null = null;
    private lastErrors = 0;
    private isDirty = true;
    private storing = 0;
    /// After a failure, until something changes.
    private isStopped = false;
    private isLost = false;

    constructor(private readonly data: Data) {
        this.state = stateOf(location.hash);
        this.files = new Map(Object.entries(data.scenes));
        this.scene = this.readScene();
        this.lamps = lampsOf(this.scene);
        this.fit();
        const change = (edit: (state: State) => void) => this.change(edit);
        this.stage = makeStage({ change, view: () => this.view(), state: () => this.state });
        this.controls = makeControls({
            change,
            chooseScene: name => this.change(state => Object.assign(state,
                { scene: name, camera: null, lamps: [], roughness: null })),
            bringLampsIntoView: () => this.stage.bringLampsIntoView(),
            shaderText: side => this.shaderText(side),
            link: () => this.link(),
        });
        const gl = this.stage.canvas.getContext("webgl2", { antialias: false, depth: false,
            powerPreference: "high-performance" });
        if (gl === null) throw new Error("This browser or device has no WebGL 2.");
        const lobes = Uint8Array.from(atob(data.lobes), c => c.charCodeAt(0));
        this.renderer = new Renderer(gl, new Map(Object.entries(data.sources)), lobes);
        // Without a renderer, controls would do nothing but hide the message that says why.
        document.getElementById("page")?.append(this.stage.node, this.numbers.node, this.controls.node, help());
        this.showLamps();
        this.attempt(() => this.update(null));
        window.addEventListener("hashchange", () => this.change(state => Object.assign(state, stateOf(location.hash))));
        this.stage.canvas.addEventListener("webglcontextlost", () => {
            this.isLost = true;
            this.stop(new Error("The device was reset; load the page again."));
        });
        const loop = () => {
            if (!this.isStopped && this.pacing.isFree) this.attempt(() => this.draw());
            requestAnimationFrame(loop);
        };
        requestAnimationFrame(loop);
    }

    /// Resolves to an image, for tests: the number of frames, the mean of red, green and blue, row by row from the
    /// bottom, and how many samples were not finite.
    async image(name: ImageName): Promise<{ count: number; mean: number[]; rejected: number }> {
        const { sums, count } = await this.renderer.read(name);
        return {
            count, mean: Array.from(sums.filter((_, i) => i % 4 !== 3), sum => sum / count),
            rejected: sums.reduce((total, value, i) => i % 4 === 3 ? total + value : total, 0),
        };
    }

    frames(name: ImageName): number { return this.renderer.frameCount(name); }

    /// A complete fragment shader, with its loops.
    shaderText(side: Side): string { return this.renderer.shaderText(side).replace("\n", `\n${this.data.licence}\n`); }

    /// Leads to what is shown.
    link(): string {
        const link = linkOf(this.state);
        return location.href.replace(/#.*/, "") + (link === "" ? "" : `#${link}`);
    }

    /// Does something, and shows what goes wrong: in listeners and promises, nobody else would.
    private attempt(action: () => void): void {
        try {
            action();
        } catch (error) {
            this.stop(error);
        }
    }

    private stop(error: unknown): void {
        this.isStopped = true;
        fail(error);
    }

    private readScene(): Scene { return readScene(this.files, sceneOf(this.state.scene).file); }

    private view(): View { return { ...this.scene.view, ...this.state.camera }; }

    private change(edit: (state: State) => void): void {
        if (this.isLost) return;
        this.attempt(() => {
            if (this.isStopped) restart();
            this.isStopped = false;
            const before = this.state;
            const edited = stateOf(linkOf(before));
            edit(edited);
            // Rounded as in links, so that these lead to the same image.
            this.state = stateOf(linkOf(edited));
            if (before.scene !== this.state.scene) {
                this.scene = this.readScene();
                this.lamps = lampsOf(this.scene);
                this.showLamps();
            }
            this.fit();
            this.update(before);
        });
    }

    /// Replaces what does not go with the rest of the state.
    private fit(): void {
        fitHeuristic(this.state.left);
        fitHeuristic(this.state.right);
        if (!isUsable(this.view())) this.state.camera = null;
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
        const { floor } = sceneOf(state.scene);
        if (changed("scene", "lamps", "roughness", "thickTubes")) {
            const scene = changedScene(this.scene, this.lamps, state.lamps, floor, state.roughness);
            renderer.setScene(state.thickTubes ? scene : withLines(scene));
        }
        if (changed("scene", "camera")) renderer.setView(this.view());
        this.resize();
        if (changed("scene", "lamps", "roughness", "camera", "shadows", "thickTubes")) renderer.clear();
        if (changed("accumulates", "smoothsEdges", "mostFrames", "seed")) renderer.clear();
        for (const name of ["left", "right"] as const) if (changed(name, "samples")) renderer.clear([name]);
        if (!state.compares) renderer.drop(["right"]);
        if (!state.reference) renderer.drop(["reference"]);
        this.stage.show(state, [techniqueOf(state.left.technique).label, techniqueOf(state.right.technique).label]);
        this.controls.show(state, this.scene.materials.find(material => material.name === floor)?.roughness ?? 1);
        this.showFailures();
        this.isDirty = true;
        this.pacing.change(performance.now());
        ++this.changes;
        this.errors = null;
        if (before !== null) this.storeSoon();
    }

    private showFailures(): void {
        const { state: { left, right }, renderer } = this;
        this.controls.showFailures({ left: renderer.failureOf(left), right: renderer.failureOf(right) });
    }

    /// Puts the state into the address. Browsers count how often pages do that.
    private storeSoon(): void {
        clearTimeout(this.storing);
        this.storing = setTimeout(() => {
            const link = this.link();
            if (link !== location.href) history.replaceState(null, "", link);
        }, storeDelay);
    }

    private resize(): void {
        const width = this.state.width || this.pacing.width;
        this.renderer.resize(width, width * 9 / 16);
    }

    /// The images of this frame, whose programs need not be ready.
    private imagesToDraw(): [ImageName, ImageSettings][] {
        const { state, renderer, pacing } = this;
        const { samples, shadows } = state;
        const seed = seedsOfState * state.seed;
        const sides = state.compares ? ["left", "right"] as const : ["left"] as const;
        const isUnfinished = ([name, side]: [ImageName, ImageSettings]) => renderer.stateOf(side) !== "failed" &&
            (!this.addsUp(name) || renderer.frameCount(name) < state.mostFrames);
        const images = sides.map((name): [ImageName, ImageSettings] => [name,
            { ...state[name], samples, shadows, seed }])
            .filter(isUnfinished);
        if (state.reference && pacing.allowsReference(performance.now(), images.length === 0)) {
            if (renderer.frameCount("reference") === 0)
                this.referenceTechnique = pacing.isFast ? "projected_ltc" : "projected";
            const reference: [ImageName, ImageSettings] = ["reference", { technique: this.referenceTechnique,
                heuristic: "clamped_optimal", sampler: "sobol", samples: 1, shadows, seed: seed + 1 }];
            if (isUnfinished(reference)) images.push(reference);
        }
        return images;
    }

    private addsUp(name: ImageName): boolean { return this.state.accumulates || name === "reference"; }

    /// Where camera rays pass the pixels in the next frame of an image: a function of its number, so that an image is
    /// one of the state. Without adding up, edges would tremble.
    private placeOf(name: ImageName): Place {
        if (!this.state.accumulates || !this.state.smoothsEdges) return [0.5, 0.5];
        const number = this.renderer.frameCount(name) + 1;
        return [halton(number, 2), halton(number, 3)];
    }

    /// Draws the images whose programs are ready. One in each frame may draw for the first time, which may compile it,
    /// so that what is warm is seen before.
    private add(images: readonly [ImageName, ImageSettings][]): FrameWork {
        const { renderer, pacing } = this;
        let count = 0;
        let compiles = false;
        for (const [name, settings] of images) {
            const program = renderer.stateOf(settings);
            const isFirst = program === "ready";
            if (!isFirst && program !== "warm" || isFirst && (compiles || pacing.isCompiling)) continue;
            compiles ||= isFirst;
            if (!this.addsUp(name)) renderer.clear([name]);
            const seed = this.addsUp(name) ? settings.seed
                : settings.seed + 2 + this.singleFrames++ % (seedsOfState - 2);
            if (renderer.add(name, { ...settings, seed }, this.placeOf(name))) ++count;
            else this.showFailures();
        }
        return { images: count, compiles };
    }

    private draw(): void {
        const { state, renderer, pacing } = this;
        const work = this.add(this.imagesToDraw());
        if (work.images > 0) this.isDirty = true;
        if (!this.isDirty && !work.compiles) return;
        if (this.isDirty) this.display();
        pacing.begin(work);
        if (work.compiles) this.showNumbers();
        void renderer.completion().then(() => this.attempt(() => {
            if (pacing.end(performance.now(), work, state.width === 0)) this.update(this.state);
            this.finishFrame(work);
        }));
    }

    private display(): void {
        const { state, renderer } = this;
        const hasLeft = renderer.frameCount("left") > 0;
        const hasRight = state.compares && renderer.frameCount("right") > 0;
        renderer.display({
            wipe: hasLeft && hasRight ? state.wipe : hasRight ? 0 : 1, exposure: state.exposure,
            showsError: state.shows === "error" && renderer.frameCount("reference") > 0,
        });
        this.isDirty = false;
    }

    private finishFrame(work: FrameWork): void {
        const { renderer, changes } = this;
        if (this.isStopped) return;
        const isShown = renderer.frameCount("left") > 0 || renderer.failureOf(this.state.left) !== null;
        if (isShown) document.documentElement.dataset.state = "ready";
        const now = performance.now();
        if (work.images > 0 && now - this.lastErrors > errorInterval) {
            this.lastErrors = now;
            renderer.errors().then(errors => {
                if (changes !== this.changes) return;
                this.errors = errors;
                this.showNumbers();
            }).catch(error => this.stop(error));
        }
        this.showNumbers();
    }

    private showNumbers(): void {
        const { state, renderer, pacing } = this;
        const samplesOf = (name: ImageName) => state.samples * renderer.frameCount(name);
        this.numbers.show({
            size: `${renderer.width} × ${renderer.height}`, isCompiling: pacing.isCompiling,
                frameTime: pacing.frameTime,
            leftSamples: samplesOf("left"), rightSamples: samplesOf("right"),
                referenceSamples: renderer.frameCount("reference"),
            errors: this.errors, compares: state.compares,
        });
    }
}

function help(): HTMLElement {
    const rows = [
        ["Drag, arrow keys", "turn the view; with Shift, or two fingers, move it"],
        ["Wheel, + and −, pinch", "zoom"],
        ["Handles of the lights",
            "drag or arrow keys move them, with Shift they turn; Page Up and Page Down move them in depth"],
        ["Divider", "drag or arrow keys move it"],
        ["Home", "puts back the view or the light that has the focus, and moves the divider to the left"],
    ];
    return element("details", { class: "keys" }, element("summary", {}, "Mouse, touch and keys"),
        element("dl", {}, ...rows.flatMap(([keys, effect]) => [element("dt", {}, keys), element("dd", {}, effect)])));
}

/// Shows what is wrong; an empty text takes it away.
function showFailure(text: string): void {
    const node = document.getElementById("failure");
    if (node === null) return;
    node.hidden = text === "";
    node.textContent = text;
}

function fail(error: unknown): void {
    showFailure(error instanceof Error ? error.message : String(error));
    document.documentElement.dataset.state = "failed";
}

function restart(): void {
    showFailure("");
    document.documentElement.dataset.state = "loading";
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
