/// The small table of linearly transformed cosines, data/ltc-frostbite-engine.bin, as textures for the shaders.

import { Gl, formats, makeTexture } from "./webgl";

const side = 64;

export interface LobeTable {
    readonly shapes: WebGLTexture;
    readonly albedos: WebGLTexture;
}

/// \param bytes of the file: six half floats for each of 64 x 64 samples, the inclination innermost.
/// \throws Error if their number is wrong
export function makeLobeTable(gl: Gl, bytes: Uint8Array): LobeTable {
    if (bytes.length !== 12 * side * side) throw new Error(`the table of lobes has ${bytes.length} bytes`);
    const halves = new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.length / 2);
    const shapes = new Uint16Array(4 * side * side);
    const albedos = new Uint16Array(2 * side * side);
    for (let i = 0; i < side * side; ++i) {
        shapes.set(halves.subarray(6 * i, 6 * i + 4), 4 * i);
        albedos.set(halves.subarray(6 * i + 4, 6 * i + 6), 2 * i);
    }
    return {
        shapes: makeTexture(gl, formats.rgba16f, side, side, shapes),
        albedos: makeTexture(gl, formats.rg16f, side, side, albedos),
    };
}
