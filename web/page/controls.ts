/// The panel of controls and the numbers below the image.

import { heuristics, knowsIntegrals, samplers, techniqueOf, techniques } from "../library/techniques";
import { Control, Option, button, checkbox, copyText, element, select, slider } from "./dom";
import { Lamp } from "./lamps";
import { Errors } from "./renderer";
import { scenes } from "./scenes";
import { LampState, Side, State, limits, untouchedLamp, widths } from "./state";

/// What controls do with the rest of the page.
export interface Actions {
    /// Changes the state and shows it.
    change(edit: (state: State) => void): void;
    /// Another scene, with its own view and lamps.
    chooseScene(name: string): void;
    bringLampsIntoView(): void;
    shaderText(side: Side): string;
    link(): string;
}

const optionsOf = (rows: readonly { name: string; label: string }[]): Option[] =>
    rows.map(({ name, label }) => ({ value: name, text: label }));

/// The heuristics that a technique can be combined with; none for a single technique.
function heuristicsOf(side: Side): string[] {
    const technique = techniqueOf(side.technique);
    if (technique.lobes === undefined) return [];
    return heuristics.filter(row => knowsIntegrals(technique) || !row.needsIntegrals).map(row => row.name);
}

/// Replaces a heuristic that does not go with the technique.
export function fitHeuristic(side: Side): void {
    const allowed = heuristicsOf(side);
    if (allowed.length > 0 && !allowed.includes(side.heuristic)) side.heuristic = allowed[0];
}

/// What is wrong with the programs of both images; null for nothing.
export type Failures = Readonly<Record<"left" | "right", string | null>>;

interface SideControls {
    readonly node: HTMLElement;
    show(state: State): void;
    showFailure(failure: string | null): void;
}

function sideControls(key: "left" | "right", title: string, actions: Actions): SideControls {
    const edit = (change: (side: Side) => void) => actions.change(state => change(state[key]));
    let current: Side | null = null;
    const technique = select("Technique", key, optionsOf(techniques),
        value => edit(side => { side.technique = value; }));
    const heuristic = select("Heuristic", `${key}-heuristic`, optionsOf(heuristics),
        value => edit(side => { side.heuristic = value; }));
    const sampler = select("Random numbers", `${key}-sampler`, optionsOf(samplers),
        value => edit(side => { side.sampler = value; }));
    const source = element("p", { class: "note" });
    const failure = element("p", { class: "failure", role: "alert", hidden: true });
    const message = element("span", { class: "copied", role: "status" });
    const copy = button("Copy this shader", { id: `${key}-copy` }, () => {
        if (current !== null) void copyText(actions.shaderText(current), message, "the shader");
    });
    // The same words name a control of the other image.
    for (const [control, label] of [[technique.list, "Technique"], [heuristic.list, "Heuristic"],
        [sampler.list, "Random numbers"], [copy, "Copy this shader"]] as const)
        control.setAttribute("aria-label", `${label}, ${title.toLowerCase()}`);
    const node = element("fieldset", { class: "side" }, element("legend", {}, title), technique.node, heuristic.node,
        sampler.node, source, failure, element("p", {}, copy, " ", message));
    return {
        node,
        show(state) {
            current = state[key];
            const allowed = heuristicsOf(current);
            for (const option of heuristic.list.options) option.disabled = !allowed.includes(option.value);
            heuristic.list.disabled = allowed.length === 0;
            const chosen = techniqueOf(current.technique);
            sampler.list.disabled = chosen.lights === null;
            technique.show(current.technique);
            heuristic.show(current.heuristic);
            sampler.show(current.sampler);
            source.textContent = chosen.isBiased === true ? `${chosen.source}. Biased: differs from the reference.`
                : chosen.source;
        },
        showFailure(text) {
            failure.hidden = text === null;
            // Drivers repeat the whole text of the shader.
            failure.textContent = text === null ? "" : `This device does not compile the shader: ${text.slice(0, 300)}`;
        },
    };
}

const stops = (value: number): string => `${value > 0 ? "+" : ""}${value} EV`;

/// Brightness in stops, for which 0 turns a lamp off at the lower end.
const darkest = limits.brightness.min;
const brightnessOf = (value: number): number => value <= darkest ? 0 : 2 ** value;
const stopsOf = (brightness: number): number => brightness === 0 ? darkest : Math.max(Math.log2(brightness), darkest);

function lampControl(lamp: Lamp, index: number, actions: Actions): Control<LampState> {
    const text = (value: number) => value <= darkest ? "off" : stops(Number(value.toFixed(1)));
    const control = slider(`Brightness: ${lamp.label.toLowerCase()}`, `lamp-${index}`,
        { ...limits.brightness, step: 0.5 }, text, value =>
            actions.change(state => {
                state.lamps[index] = { ...state.lamps[index] ?? untouchedLamp, brightness: brightnessOf(value) };
            }));
    return { node: control.node, show: state => control.show(stopsOf(state.brightness)) };
}

export interface Controls {
    readonly node: HTMLElement;
    /// \param roughness of the floor, that of the scene if the state has none
    show(state: State, roughness: number): void;
    showFailures(failures: Failures): void;
    setLamps(lamps: readonly Lamp[]): void;
}

export function makeControls(actions: Actions): Controls {
    const left = sideControls("left", "Left image", actions);
    const right = sideControls("right", "Right image", actions);
    const change = actions.change;
    const compares = checkbox("Compare with the right image", "compare",
        value => change(state => { state.compares = value; }));
    const samples = slider("Samples per pixel and frame", "samples", { ...limits.samples, step: 1 },
        value => String(2 ** value),
        value => change(state => { state.samples = 2 ** value; }));
    const accumulates = checkbox("Accumulate frames", "accumulate",
        value => change(state => { state.accumulates = value; }));
    const smooths = checkbox("Smooth edges", "smooth", value => change(state => { state.smoothsEdges = value; }));
    const shadows = checkbox("Shadows", "shadows", value => change(state => { state.shadows = value; }));
    const thick = checkbox("Thick tubes (compile for minutes without a GPU)", "thick",
        value => change(state => { state.thickTubes = value; }));
    const reference = checkbox("Reference", "reference", value => change(state => {
        state.reference = value;
        if (!value) state.shows = "image";
    }));
    const shows = checkbox("Show the error", "error", value => change(state => {
        state.shows = value ? "error" : "image";
        if (value) state.reference = true;
    }));
    const roughness = slider("Roughness of the floor", "roughness", { ...limits.roughness, step: 0.01 },
        value => value.toFixed(2),
        value => change(state => { state.roughness = value; }));
    const exposure = slider("Exposure", "exposure", { ...limits.exposure, step: 0.25 }, stops,
        value => change(state => { state.exposure = value; }));
    const sizes = widths.map(width => ({ value: String(width),
        text: width === 0 ? "Automatic" : `${width} × ${width * 9 / 16}` }));
    const size = select("Size", "size", sizes, value => change(state => { state.width = Number(value); }));
    const scene = select("Scene", "scene", optionsOf(scenes), actions.chooseScene);
    const message = element("span", { class: "copied", role: "status" });
    const reset = button("Reset lights and view", { id: "reset" }, () => change(state => {
        state.camera = null;
        state.lamps = [];
        state.roughness = null;
    }));
    const bring = button("Bring lights into view", { id: "bring" }, actions.bringLampsIntoView);
    const link = button("Copy a link", { id: "link" }, () => void copyText(actions.link(), message, "the link"));
    const lampFields = element("div", { class: "row" });
    let lamps: Control<LampState>[] = [];
    const node = element("section", { class: "panel", "aria-label": "Controls" },
        element("div", { class: "sides" }, left.node, right.node),
        element("div", { class: "row" }, compares.node, accumulates.node, smooths.node, shadows.node, thick.node,
            reference.node, shows.node),
        element("div", { class: "row" }, samples.node, roughness.node, exposure.node),
        lampFields,
        element("div", { class: "row" }, scene.node, size.node, bring, reset, link, message));
    return {
        node,
        showFailures(failures) {
            left.showFailure(failures.left);
            right.showFailure(failures.right);
        },
        setLamps(list) {
            lamps = list.map((lamp, i) => lampControl(lamp, i, actions));
            lampFields.replaceChildren(...lamps.map(lamp => lamp.node));
        },
        show(state, floorRoughness) {
            left.show(state);
            right.show(state);
            compares.show(state.compares);
            samples.show(Math.log2(state.samples));
            accumulates.show(state.accumulates);
            smooths.show(state.smoothsEdges);
            shadows.show(state.shadows);
            thick.show(state.thickTubes);
            reference.show(state.reference);
            shows.show(state.shows === "error");
            roughness.show(state.roughness ?? floorRoughness);
            exposure.show(state.exposure);
            size.show(String(state.width));
            scene.show(state.scene);
            lamps.forEach((lamp, i) => lamp.show(state.lamps[i] ?? untouchedLamp));
        },
    };
}

function timeText(milliseconds: number): string {
    if (milliseconds <= 0) return "–";
    return `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms, ${(1000 / milliseconds).toFixed(1)} per second`;
}

/// What is measured while images add up.
export interface Numbers {
    readonly size: string;
    readonly isCompiling: boolean;
    /// 0 where unknown [ms].
    readonly frameTime: number;
    readonly leftSamples: number;
    readonly rightSamples: number;
    readonly referenceSamples: number;
    readonly errors: Errors | null;
    readonly compares: boolean;
}

export function makeNumbers(): { readonly node: HTMLElement; show(numbers: Numbers): void } {
    const field = (label: string, id: string) => {
        const value = element("dd", { id }, "–");
        return { value, node: element("div", {}, element("dt", {}, label), value) };
    };
    const size = field("Size", "number-size");
    const time = field("Frame", "number-time");
    const samples = field("Samples per pixel", "number-samples");
    const reference = field("Samples of the reference", "number-reference");
    // Of linear radiance, over all pixels and channels.
    const left = field("RMSE of radiance, left", "number-left");
    const right = field("RMSE of radiance, right", "number-right");
    const rejected = field("Samples that are not finite", "number-rejected");
    rejected.node.hidden = true;
    const error = (value: number | undefined) => value === undefined || !Number.isFinite(value) ? "–"
        : value.toPrecision(3);
    return {
        node: element("dl", { class: "facts numbers-now" }, ...[size, time, samples, reference, left, right,
            rejected].map(f => f.node)),
        show(numbers) {
            size.value.textContent = numbers.size;
            time.value.textContent = numbers.isCompiling ? "compiling …" : timeText(numbers.frameTime);
            const { leftSamples, rightSamples, compares } = numbers;
            samples.value.textContent = compares && leftSamples !== rightSamples ? `${leftSamples}, ${rightSamples}`
                : String(leftSamples);
            reference.value.textContent = String(numbers.referenceSamples);
            left.value.textContent = error(numbers.errors?.left);
            right.value.textContent = compares ? error(numbers.errors?.right) : "–";
            const count = numbers.errors?.rejected ?? 0;
            rejected.node.hidden = count === 0;
            rejected.value.textContent = String(count);
        },
    };
}
