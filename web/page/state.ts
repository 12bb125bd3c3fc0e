/// What the page shows, and links to it.

import { heuristics, samplers, techniques } from "../library/techniques";
import { Vector } from "../library/vectors";
import { scenes } from "./scenes";

/// How one of the two images is made.
export interface Side {
    technique: string;
    heuristic: string;
    sampler: string;
}

/// Changes of a lamp of the scene.
export interface LampState {
    move: Vector;
    /// Turns about its centre: about the vertical axis, then about the horizontal one across the view [degrees].
    turn: number;
    tilt: number;
    /// Factor of the radiance.
    brightness: number;
}

export interface State {
    scene: string;
    left: Side;
    right: Side;
    /// Whether both images are shown; else, that on the left alone.
    compares: boolean;
    /// Where they meet, from 0 at the left to 1.
    wipe: number;
    /// Samples per pixel, frame and light.
    samples: number;
    /// Whether frames add up, else each one shows its noise.
    accumulates: boolean;
    /// Whether rays pass pixels in other places in each frame that adds up, else through their centres.
    smoothsEdges: boolean;
    /// How many add up at most. An image of so many frames is a function of the state; only links change it.
    mostFrames: number;
    /// Of the random numbers; only links change it.
    seed: number;
    shadows: boolean;
    /// Whether tubes of scenes that are cylinders remain so; else, they are lines, whose programs compile much faster.
    thickTubes: boolean;
    /// Whether a reference adds up meanwhile.
    reference: boolean;
    shows: "image" | "error";
    /// Perceptual roughness of the floor; null for that of the scene.
    roughness: number | null;
    /// In stops.
    exposure: number;
    /// Pixels in a row; 0 to choose by the speed of the device.
    width: number;
    /// The eye and what it looks at; null for those of the scene.
    camera: { eye: Vector; target: Vector } | null;
    lamps: LampState[];
}

export const widths = [0, 160, 320, 480, 640, 960, 1280, 1920] as const;

export const untouchedLamp: LampState = { move: [0, 0, 0], turn: 0, tilt: 0, brightness: 1 };

export function initialState(): State {
    return {
        scene: "floor",
        left: { technique: "area", heuristic: "clamped_optimal", sampler: "sobol" },
        right: { technique: "projected", heuristic: "clamped_optimal", sampler: "sobol" },
        compares: true, wipe: 0.5, samples: 1, accumulates: true, smoothsEdges: true, mostFrames: 4096, seed: 0,
        shadows: true, thickTubes: false, reference: true, shows: "image",
        roughness: null, exposure: 0, width: 0, camera: null, lamps: [],
    };
}

const mostLamps = 8;

/// What both controls and links can reach. Exposure and brightness are slid in stops.
export const limits = {
    exposure: { min: -4, max: 4 },
    roughness: { min: 0, max: 1 },
    samples: { min: 0, max: 4 }, ///< as powers of two
    brightness: { min: -6, max: 3 },
} as const;

const shortNumber = (x: number): string => String(Number(x.toFixed(4)));
const numbersOf = (text: string): number[] => text.split(",").map(Number);

function clamp(x: number, low: number, high: number): number {
    return Math.min(Math.max(x, low), high);
}

/// Reads and writes one part of the state. Texts that do not fit are ignored; the page itself checks cameras, which
/// depend on the scene.
interface Field {
    write(state: State): string;
    read(state: State, text: string): void;
}

function choice<T extends string>(options: readonly T[], get: (state: State) => T,
    set: (state: State, value: T) => void): Field {
    return {
        write: get,
        read(state, text) {
            const found = options.find(option => option === text);
            if (found !== undefined) set(state, found);
        },
    };
}

function number(low: number, high: number, get: (state: State) => number,
    set: (state: State, value: number) => void): Field {
    return {
        write: state => shortNumber(get(state)),
        read(state, text) {
            const value = Number(text);
            if (text !== "" && Number.isFinite(value)) set(state, clamp(value, low, high));
        },
    };
}

function flag(get: (state: State) => boolean, set: (state: State, value: boolean) => void): Field {
    return choice(["0", "1"], state => get(state) ? "1" : "0", (state, value) => set(state, value === "1"));
}

const names = (rows: readonly { name: string }[]): string[] => rows.map(row => row.name);

function sideFields(side: "left" | "right"): [string, Field][] {
    const field = (key: keyof Side, options: string[]) =>
        choice(options, state => state[side][key], (state, value) => { state[side][key] = value; });
    return [
        [side, field("technique", names(techniques))],
        [`${side}-heuristic`, field("heuristic", names(heuristics))],
        [`${side}-sampler`, field("sampler", names(samplers))],
    ];
}

function lampText(lamp: LampState): string {
    return [...lamp.move, lamp.turn, lamp.tilt, lamp.brightness].map(shortNumber).join(",");
}

function lampOf(text: string): LampState {
    const [x, y, z, turn, tilt, brightness, ...others] = numbersOf(text);
    const values = [x, y, z, turn, tilt, brightness];
    if (others.length > 0 || !values.every(Number.isFinite)) return { ...untouchedLamp };
    const near = (v: number) => clamp(v, -100, 100);
    return { move: [near(x), near(y), near(z)], turn, tilt, brightness: clamp(brightness, 0,
        2 ** limits.brightness.max) };
}

function cameraOf(text: string): State["camera"] {
    const values = numbersOf(text);
    if (values.length !== 6 || !values.every(Number.isFinite)) return null;
    const [a, b, c, d, e, f] = values;
    return { eye: [a, b, c], target: [d, e, f] };
}

/// By names in links, which are no members of Object.prototype here.
const fields = new Map<string, Field>([
    ["scene", choice(names(scenes), state => state.scene, (state, value) => { state.scene = value; })],
    ...sideFields("left"),
    ...sideFields("right"),
    ["compare", flag(state => state.compares, (state, value) => { state.compares = value; })],
    ["wipe", number(0, 1, state => state.wipe, (state, value) => { state.wipe = value; })],
    ["samples", number(1, 2 ** limits.samples.max, state => state.samples,
        (state, value) => { state.samples = 2 ** Math.round(Math.log2(value)); })],
    ["accumulate", flag(state => state.accumulates, (state, value) => { state.accumulates = value; })],
    ["smooth", flag(state => state.smoothsEdges, (state, value) => { state.smoothsEdges = value; })],
    ["frames", number(1, 65536, state => state.mostFrames,
        (state, value) => { state.mostFrames = Math.round(value); })],
    ["seed", number(0, 32767, state => state.seed, (state, value) => { state.seed = Math.round(value); })],
    ["shadows", flag(state => state.shadows, (state, value) => { state.shadows = value; })],
    ["thick", flag(state => state.thickTubes, (state, value) => { state.thickTubes = value; })],
    ["reference", flag(state => state.reference, (state, value) => { state.reference = value; })],
    ["show", choice(["image", "error"] as const, state => state.shows, (state, value) => { state.shows = value; })],
    ["roughness", {
        write: state => state.roughness === null ? "" : shortNumber(state.roughness),
        read: (state, text) => {
            const { min, max } = limits.roughness;
            if (text !== "" && Number.isFinite(Number(text))) state.roughness = clamp(Number(text), min, max);
        },
    }],
    ["exposure", number(limits.exposure.min, limits.exposure.max, state => state.exposure,
        (state, value) => { state.exposure = value; })],
    ["width", {
        write: state => String(state.width),
        read: (state, text) => { state.width = widths.find(width => String(width) === text) ?? 0; },
    }],
    ["camera", {
        write: ({ camera }) => camera === null ? "" : [...camera.eye, ...camera.target].map(shortNumber).join(","),
        read: (state, text) => { state.camera = cameraOf(text); },
    }],
    ["lamps", {
        write: state => state.lamps.map(lampText).join(";"),
        read: (state, text) => { state.lamps = text === "" ? [] : text.split(";").slice(0, mostLamps).map(lampOf); },
    }],
]);

/// The part of a link after "#": what differs from the initial state.
export function linkOf(state: State): string {
    const initial = initialState();
    return [...fields]
        .map(([name, field]) => [name, field.write(state), field.write(initial)] as const)
        .filter(([, text, standard]) => text !== standard)
        .map(([name, text]) => `${name}=${text}`)
        .join("&");
}

/// Some programs that send links escape commas and semicolons.
function decoded(text: string): string {
    try {
        return decodeURIComponent(text);
    } catch {
        return ""; // not a text: fits no field
    }
}

export function stateOf(link: string): State {
    const state = initialState();
    for (const part of link.replace(/^#/, "").split("&")) {
        const at = part.indexOf("=");
        if (at > 0) fields.get(part.slice(0, at))?.read(state, decoded(part.slice(at + 1)));
    }
    return state;
}
