/// The example: a scene with two area lights, orbit and drag controls, and a sum of frames.

import { WebGLRenderer } from "three";
import { DragControls } from "three/addons/controls/DragControls.js";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RectAreaLightUniformsLib } from "three/addons/lights/RectAreaLightUniformsLib.js";
import { readScene } from "../../library/pbrt";
import { AreaLights, FrameSum } from "../index";
import { makeExample } from "./scene";

const mostFrames = 1024;
const leastAspect = 4 / 3;
const degrees = 180 / Math.PI;
const mostPixels = 960 * 540; ///< of the canvas; it is scaled to the size of the window

function find<T extends HTMLElement>(id: string): T {
    const node = document.getElementById(id);
    if (node === null) throw new Error(`the page has no ${id}`);
    return node as T;
}

function fail(error: unknown): void {
    const node = find("failure");
    node.hidden = false;
    node.textContent = error instanceof Error ? error.message : String(error);
    document.documentElement.dataset.state = "failed";
}

function start() {
    const data = JSON.parse(find("data").textContent ?? "") as { scenes: Record<string, string>; scene: string };
    const { scene, camera, target, floor, lamps } = makeExample(readScene(new Map(Object.entries(data.scenes)), data.scene));
    const renderer = new WebGLRenderer({ canvas: find<HTMLCanvasElement>("canvas"), powerPreference: "high-performance" });
    RectAreaLightUniformsLib.init(); // for three.js alone

    const lights = new AreaLights(scene);
    lights.add(scene);
    const frames = new FrameSum(renderer);

    const orbit = new OrbitControls(camera, renderer.domElement);
    orbit.target.fromArray(target.toArray());
    const drag = new DragControls(lamps, camera, renderer.domElement);
    drag.recursive = false;
    drag.addEventListener("dragstart", () => { orbit.enabled = false; });
    drag.addEventListener("dragend", () => { orbit.enabled = true; });

    const roughness = find<HTMLInputElement>("roughness");
    roughness.value = String(floor.roughness);
    roughness.addEventListener("input", () => {
        floor.roughness = Number(roughness.value);
        frames.restart();
    });
    const shadows = find<HTMLInputElement>("shadows");
    shadows.addEventListener("change", () => { lights.shadows = shadows.checked; });
    const active = find<HTMLInputElement>("active");
    active.addEventListener("change", () => { lights.active = active.checked; });

    const example = { scene, camera, orbit, lights, frames, renderer, floor, lamps, mostFrames, mostPixels };
    const view = find("view");
    const { fov } = camera;
    const resize = () => {
        const { clientWidth: width, clientHeight: height } = view;
        const scale = Math.min(1, Math.sqrt(example.mostPixels / (width * height)));
        renderer.setSize(Math.round(scale * width), Math.round(scale * height), false);
        if (width === 0 || height === 0) return;
        camera.aspect = width / height;
        // High pictures show as much of the width as those of 4 : 3, or the lights would be outside.
        const highness = Math.max(1, leastAspect / camera.aspect);
        camera.fov = 2 * degrees * Math.atan(highness * Math.tan(0.5 * fov / degrees));
        camera.updateProjectionMatrix();
    };
    new ResizeObserver(resize).observe(view);
    resize();

    const loop = () => {
        try {
            if (lights.update(camera)) frames.restart();
            orbit.update();
            if (frames.count < example.mostFrames || frames.isOutdated(camera)) frames.render(scene, camera);
            find("numbers").textContent = `${frames.count} frames, ${lights.triangleCount} triangles`;
            document.documentElement.dataset.state = "ready";
            requestAnimationFrame(loop);
        } catch (error) {
            fail(error);
        }
    };
    requestAnimationFrame(loop);
    return example;
}

declare global {
    interface Window {
        /// For tests and for curious people at the console.
        example?: ReturnType<typeof start>;
    }
}

try {
    window.example = start();
} catch (error) {
    fail(error);
}
