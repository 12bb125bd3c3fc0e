/// The image with its divider and the handles of the lamps: pointers, touch and keys.

import { View } from "../library/pbrt";
import { Vector, add, dot, length, subtract, times } from "../library/vectors";
import { Camera, cameraOf, orbit, pan, project, stepIntoView, zoom } from "./camera";
import { element } from "./dom";
import { Lamp } from "./lamps";
import { LampState, State, untouchedLamp } from "./state";

/// What the stage does with the rest of the page.
export interface StageActions {
    change(edit: (state: State) => void): void;
    /// The view as it is now.
    view(): View;
    state(): State;
}

const aspect = 16 / 9;
const lampStep = 0.05; ///< of a key [m]
const lampTurn = 5;    ///< of a key [degrees]
const orbitStep = 0.06; ///< of a key [rad]

/// Moves and turns of a lamp, to the right, upwards and away from the eye.
function moveLamp(state: State, index: number, camera: Camera, right: number, up: number, away = 0): void {
    const lamp = state.lamps[index] ?? untouchedLamp;
    const step = add(add(times(right, camera.right), times(up, camera.up)), times(away, camera.forward));
    setLamp(state, index, { ...lamp, move: add(lamp.move, step) });
}

function bringIntoView(state: State, index: number, lamp: Lamp, view: View): void {
    const own = state.lamps[index] ?? untouchedLamp;
    const distance = length(subtract(view.target, view.eye));
    const step = stepIntoView(cameraOf(view, aspect), add(lamp.center, own.move), distance);
    if (length(step) > 0) setLamp(state, index, { ...own, move: add(own.move, step) });
}

function turnLamp(state: State, index: number, turn: number, tilt: number): void {
    const lamp = state.lamps[index] ?? untouchedLamp;
    setLamp(state, index, { ...lamp, turn: (lamp.turn + turn) % 360, tilt: (lamp.tilt + tilt) % 360 });
}

function setLamp(state: State, index: number, lamp: LampState): void {
    for (let i = 0; i < index; ++i) state.lamps[i] ??= { ...untouchedLamp };
    state.lamps[index] = lamp;
}

/// Calls back for the movements of a pointer that is held down on a node, in parts of the width of the stage.
function onDrag(node: HTMLElement, stage: HTMLElement, move: (dx: number, dy: number,
    event: PointerEvent) => void): void {
    let last: { x: number; y: number } | null = null;
    node.addEventListener("pointerdown", event => {
        if (event.button !== 0) return;
        node.setPointerCapture(event.pointerId);
        last = { x: event.clientX, y: event.clientY };
        event.stopPropagation();
    });
    node.addEventListener("pointermove", event => {
        if (last === null || !node.hasPointerCapture(event.pointerId)) return;
        const width = stage.clientWidth;
        move((event.clientX - last.x) / width, (event.clientY - last.y) / width, event);
        last = { x: event.clientX, y: event.clientY };
    });
    for (const type of ["pointerup", "pointercancel"]) node.addEventListener(type, () => { last = null; });
}

/// Steps to the right and upwards of arrow keys, else null.
function arrowOf(key: string): readonly [number, number] | null {
    switch (key) {
    case "ArrowLeft": return [-1, 0];
    case "ArrowRight": return [1, 0];
    case "ArrowUp": return [0, 1];
    case "ArrowDown": return [0, -1];
    default: return null;
    }
}

export interface Stage {
    readonly node: HTMLElement;
    readonly canvas: HTMLCanvasElement;
    show(state: State, labels: readonly [string, string]): void;
    setLamps(lamps: readonly Lamp[]): void;
    /// Moves lamps outside of the image to the nearest place in it.
    bringLampsIntoView(): void;
}

export function makeStage(actions: StageActions): Stage {
    const canvas = element("canvas", {
        id: "canvas", tabindex: 0, role: "application",
        "aria-label": "The scene. Arrow keys turn the view, with Shift they move it; plus and minus zoom; " +
            "Home resets it.",
    });
    const divider = element("div", {
        id: "divider", class: "divider", role: "slider", tabindex: 0, "aria-label": "Divider between the images",
            "aria-valuemin": 0,
        "aria-valuemax": 100,
    });
    const names = [element("span", { class: "name" }), element("span", { class: "name" })];
    const handles = element("div", { class: "handles", role: "group", "aria-label": "Lights" });
    const node = element("div", { class: "stage live" }, canvas, divider, handles,
        element("div", { class: "names" }, ...names));
    const camera = () => cameraOf(actions.view(), aspect);
    const setView = (change: (view: View) => View) => {
        const { eye, target } = change(actions.view());
        actions.change(state => { state.camera = { eye, target }; });
    };
    /// The width of the image at a distance along the view [m].
    const widthAt = (p: Vector) => 2 * camera().tangentX * dot(subtract(p, camera().eye), camera().forward);

    listenToCanvas(canvas, node, setView, () => widthAt(actions.view().target), camera);
    canvas.addEventListener("keydown", event => {
        const arrow = arrowOf(event.key);
        if (arrow !== null && event.shiftKey) setView(view => pan(view, camera(), 0.1 * arrow[0], 0.1 * arrow[1]));
        else if (arrow !== null) setView(view => orbit(view, orbitStep * arrow[0], orbitStep * arrow[1]));
        else if (event.key === "+" || event.key === "=") setView(view => zoom(view, 1.1));
        else if (event.key === "-") setView(view => zoom(view, 1 / 1.1));
        else if (event.key === "Home") actions.change(state => { state.camera = null; });
        else return;
        event.preventDefault();
    });

    const setWipe = (wipe: number) => actions.change(state => { state.wipe = Math.min(Math.max(wipe, 0), 1); });
    onDrag(divider, node, (_dx, _dy, event) => {
        const box = node.getBoundingClientRect();
        setWipe((event.clientX - box.left) / box.width);
    });
    divider.addEventListener("keydown", event => {
        const arrow = arrowOf(event.key);
        if (arrow !== null) setWipe(actions.state().wipe + 0.02 * (arrow[0] + arrow[1]));
        else if (event.key === "Home" || event.key === "End") setWipe(event.key === "Home" ? 0 : 1);
        else return;
        event.preventDefault();
    });

    let lamps: readonly Lamp[] = [];
    const positionOf = (lamp: Lamp, index: number) => add(lamp.center, actions.state().lamps[index]?.move ?? [0, 0, 0]);
    const makeHandle = (lamp: Lamp, index: number): HTMLElement => {
        const handle = element("div", {
            role: "application", tabindex: 0, class: "handle", id: `handle-${index}`,
            "aria-label": `${lamp.label} ${index + 1}: arrow keys move it, Page Up and Page Down move it in depth, ` +
                "with Shift arrows turn it, Enter brings it into view, Home resets it",
            title: `${lamp.label}: drag to move, with Shift to turn`,
        });
        onDrag(handle, node, (dx, dy, event) => {
            // Behind the camera, a lamp would go the other way.
            if (project(camera(), positionOf(lamp, index)) === null)
                actions.change(state => bringIntoView(state, index, lamp, actions.view()));
            const scale = widthAt(positionOf(lamp, index));
            actions.change(state => {
                if (event.shiftKey) turnLamp(state, index, 360 * dx, 360 * dy);
                else moveLamp(state, index, camera(), scale * dx, -scale * dy);
            });
        });
        handle.addEventListener("keydown", event => {
            const arrow = arrowOf(event.key);
            const away = event.key === "PageUp" ? 1 : event.key === "PageDown" ? -1 : 0;
            if (arrow === null && away === 0 && event.key !== "Home" && event.key !== "Enter") return;
            actions.change(state => {
                if (event.key === "Enter") bringIntoView(state, index, lamp, actions.view());
                else if (arrow === null && away === 0) setLamp(state, index, { ...untouchedLamp });
                else if (arrow !== null && event.shiftKey) turnLamp(state, index, lampTurn * arrow[0],
                    -lampTurn * arrow[1]);
                else moveLamp(state, index, camera(), lampStep * (arrow?.[0] ?? 0), lampStep * (arrow?.[1] ?? 0),
                    lampStep * away);
            });
            event.preventDefault();
        });
        return handle;
    };

    return {
        node, canvas,
        bringLampsIntoView() {
            actions.change(state => lamps.forEach((lamp, index) => bringIntoView(state, index, lamp, actions.view())));
        },
        setLamps(list) {
            lamps = list;
            handles.replaceChildren(...lamps.map(makeHandle));
        },
        show(state, labels) {
            divider.hidden = !state.compares;
            divider.style.left = `${100 * state.wipe}%`;
            const percent = Math.round(100 * state.wipe);
            divider.setAttribute("aria-valuenow", String(percent));
            divider.setAttribute("aria-valuetext", `${percent} % of the left image`);
            names.forEach((name, i) => { name.textContent = labels[i]; });
            names[1].hidden = !state.compares;
            lamps.forEach((lamp, i) => {
                // Lights outside of the image have their handle at the border, where it brings them back.
                const [x, y] = project(camera(), positionOf(lamp, i)) ?? [0.5, 1];
                const inside = (at: number) => `${100 * Math.min(Math.max(at, 0.02), 0.98)}%`;
                const handle = handles.children[i] as HTMLElement;
                handle.style.left = inside(x);
                handle.style.top = inside(y);
            });
        },
    };
}

/// Turns, moves and zooms the view by the mouse and by fingers.
/// \param width of the image at the target [m]
function listenToCanvas(canvas: HTMLElement, node: HTMLElement, setView: (change: (view: View) => View) => void,
                        width: () => number, camera: () => Camera): void {
    const pointers = new Map<number, { x: number; y: number }>();
    canvas.addEventListener("pointerdown", event => {
        if (event.button !== 0) return;
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    canvas.addEventListener("pointermove", event => {
        const before = pointers.get(event.pointerId);
        if (before === undefined) return;
        const now = { x: event.clientX, y: event.clientY };
        const dx = (now.x - before.x) / node.clientWidth;
        const dy = (now.y - before.y) / node.clientWidth;
        const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
        const move = (share: number) => setView(view => pan(view, camera(), -share * width() * dx,
            share * width() * dy));
        if (other !== undefined) {
            const distance = (p: { x: number; y: number }) => Math.max(1, Math.hypot(p.x - other.x, p.y - other.y));
            setView(view => zoom(view, distance(now) / distance(before)));
            move(0.5); // each of two fingers
        } else if (event.shiftKey) {
            move(1);
        } else {
            setView(view => orbit(view, -4 * dx, 4 * dy));
        }
        pointers.set(event.pointerId, now);
    });
    for (const type of ["pointerup", "pointercancel"] as const)
        canvas.addEventListener(type, event => pointers.delete(event.pointerId));
    canvas.addEventListener("wheel", event => {
        // Without a click or a key before, the wheel moves the page.
        if (!event.ctrlKey && document.activeElement !== canvas) return;
        event.preventDefault();
        setView(view => zoom(view, 2 ** (-Math.min(Math.max(event.deltaY, -200), 200) / 400)));
    }, { passive: false });
}
