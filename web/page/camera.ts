/// The camera as rays and as a matrix.

import { View } from "../library/pbrt";
import { Vector, add, cross, dot, length, normalize, rotate, subtract, times } from "../library/vectors";

export interface Camera {
    readonly eye: Vector;
    /// Unit vectors.
    readonly forward: Vector;
    readonly right: Vector;
    readonly up: Vector;
    /// Tangents of half the field of view.
    readonly tangentX: number;
    readonly tangentY: number;
}

/// \param aspect width over height, at least 1
export function cameraOf(view: View, aspect: number): Camera {
    const forward = normalize(subtract(view.target, view.eye));
    const right = normalize(cross(forward, view.up));
    const tangentY = Math.tan(view.fov * Math.PI / 360);
    return { eye: view.eye, forward, right, up: cross(right, forward), tangentX: aspect * tangentY, tangentY };
}

/// The ray through pixel coordinates (x, y) from the upper left corner is corner + x right + y down.
export function raysOf(camera: Camera, width: number, height: number): { corner: Vector; right: Vector; down: Vector } {
    const left = times(-camera.tangentX, camera.right);
    const top = times(camera.tangentY, camera.up);
    return {
        corner: add(camera.forward, add(left, top)),
        right: times(2 * camera.tangentX / width, camera.right),
        down: times(-2 * camera.tangentY / height, camera.up),
    };
}

const near = 0.02;
const far = 200;

/// clip_from_world, column by column.
/// \param offset of the image, in pixels to the left and upwards
export function matrixOf(camera: Camera, width: number, height: number,
    offset: readonly [number, number]): Float32Array {
    const x = times(1 / camera.tangentX, camera.right);
    const y = times(1 / camera.tangentY, camera.up);
    const f = camera.forward;
    const shifted = (v: Vector, shift: number): Vector => add(v, times(shift, f));
    const rows = [shifted(x, -2 * offset[0] / width), shifted(y, 2 * offset[1] / height),
        times((far + near) / (far - near), f), f];
    const constants = rows.map(row => -dot(row, camera.eye));
    constants[2] -= 2 * far * near / (far - near);
    return Float32Array.from([0, 1, 2, 3].flatMap(k => rows.map((row, i) => k < 3 ? row[k] : constants[i])));
}

/// Where a point appears, from 0 to 1 from the left and from the top; null behind the camera.
export function project(camera: Camera, p: Vector): readonly [number, number] | null {
    const v = subtract(p, camera.eye);
    const depth = dot(v, camera.forward);
    if (depth <= near) return null;
    return [0.5 + 0.5 * dot(v, camera.right) / (depth * camera.tangentX),
        0.5 - 0.5 * dot(v, camera.up) / (depth * camera.tangentY)];
}

/// The share of the image from its centre that lights are brought back to.
const innerPart = 0.8;

/// The step to the nearest place in the image [m]: none from a place that is there.
/// \param distance along the view for what is behind the camera [m]
export function stepIntoView(camera: Camera, p: Vector, distance: number): Vector {
    if ((project(camera, p) ?? [-1]).every(share => share >= 0 && share <= 1)) return [0, 0, 0];
    const v = subtract(p, camera.eye);
    const depth = dot(v, camera.forward);
    const newDepth = depth > near ? depth : distance;
    const inside = (x: number, tangent: number) => {
        const most = innerPart * tangent * newDepth;
        return Math.min(Math.max(x, -most), most);
    };
    const [x, y] = [dot(v, camera.right), dot(v, camera.up)];
    const across = add(times(inside(x, camera.tangentX) - x, camera.right),
        times(inside(y, camera.tangentY) - y, camera.up));
    return add(across, times(newDepth - depth, camera.forward));
}

/// What keys and pointers can reach: cosines with the vertical axis, distances of eye and target, and coordinates [m].
const steepest = 0.98;
const nearest = 0.3;
const farthest = 50;
const outermost = 100;
/// Links round numbers.
const slack = 1.001;

/// Whether a view has an image: neither vertical, nor too near or far.
export function isUsable(view: View): boolean {
    const offset = subtract(view.eye, view.target);
    const distance = length(offset);
    return Math.max(...view.eye.map(Math.abs), ...view.target.map(Math.abs)) <= outermost &&
        distance * slack >= nearest && distance <= farthest * slack &&
        Math.abs(dot(offset, view.up)) <= steepest * slack * distance * length(view.up);
}

const moved = (before: View, after: View): View => isUsable(after) ? after : before;

/// Turns the eye around the target, by angles to the right and upwards [rad]. The view never becomes vertical.
export function orbit(view: View, right: number, up: number): View {
    const offset = rotate(subtract(view.eye, view.target), view.up, right);
    const tilted = rotate(offset, normalize(cross(view.up, offset)), -up);
    const isLevel = Math.abs(dot(normalize(tilted), view.up)) < steepest;
    return moved(view, { ...view, eye: add(view.target, isLevel ? tilted : offset) });
}

/// Moves the eye towards the target by a factor of the distance.
export function zoom(view: View, factor: number): View {
    const offset = subtract(view.eye, view.target);
    const distance = Math.min(Math.max(length(offset) / factor, nearest), farthest);
    return moved(view, { ...view, eye: add(view.target, times(distance, normalize(offset))) });
}

/// Moves both along the image [m].
export function pan(view: View, camera: Camera, right: number, up: number): View {
    const step = add(times(right, camera.right), times(up, camera.up));
    return moved(view, { ...view, eye: add(view.eye, step), target: add(view.target, step) });
}
