/// Vectors of three numbers.

export type Vector = readonly [number, number, number];

export const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (s: number, a: Vector): Vector => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);
export const normalize = (a: Vector): Vector => times(1 / length(a), a);

/// The rotation of a vector about a unit axis, counter-clockwise as seen from its tip [rad].
export function rotate(v: Vector, axis: Vector, angle: number): Vector {
    const along = times(dot(axis, v), axis);
    const across = subtract(v, along);
    return add(along, add(times(Math.cos(angle), across), times(Math.sin(angle), cross(axis, v))));
}
