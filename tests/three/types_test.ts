/** Compiled, never run: each line after `@ts-expect-error` must be an error. */
import { Mesh, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { AreaLights, FrameSum, TubeLight } from "nusselt-three";

const scene = new Scene();
const camera = new PerspectiveCamera();
const tube: Mesh = new TubeLight(0xffe0c0, 40, 1.5, 0.02);
const lights = new AreaLights(scene);
lights.add(tube);
lights.samples = 2;
lights.active = lights.shadows = lights.needsUpdate = true;
const frames = new FrameSum(new WebGLRenderer());
if (lights.update() || lights.update(camera) || frames.isOutdated(camera)) frames.restart();
frames.render(scene, camera);
const pixels: Float32Array = frames.read();
console.log(pixels, frames.count, lights.triangleCount, new TubeLight().length);
frames.dispose();

// @ts-expect-error a scene is missing
new AreaLights();
// @ts-expect-error no camera
lights.update(scene);
// @ts-expect-error only the module sets it
lights.triangleCount = 3;
// @ts-expect-error for the module alone
lights.occluders;
// @ts-expect-error for the module alone
new TubeLight().toWorld();
// @ts-expect-error no number
lights.samples = "2";
