/// The small table of linearly transformed cosines, data/ltc-frostbite-engine.bin, as textures for the shaders.

import { Gl, formats, makeTexture } from "./webgl";

/// Samples per axis: inclinations along x, roughness along y.
export const lobeTableSide = 64;

/// The texels of both textures, half floats.
export interface LobeTexels {
    /// Four for each sample.
    readonly shapes: Uint16Array;
    /// Two for each sample.
    readonly albedos: Uint16Array;
}

/// \param bytes of the file: six half floats for each of 64 x 64 samples, the inclination innermost.
/// \throws Error if their number is wrong
export function lobeTexels(bytes: Uint8Array): LobeTexels {
    const count = lobeTableSide ** 2;
    if (bytes.length !== 12 * count) throw new Error(`the table of lobes has ${bytes.length} bytes`);
    const halves = new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.length / 2);
    const shapes = new Uint16Array(4 * count);
    const albedos = new Uint16Array(2 * count);
    for (let i = 0; i < count; ++i) {
        shapes.set(halves.subarray(6 * i, 6 * i + 4), 4 * i);
        albedos.set(halves.subarray(6 * i + 4, 6 * i + 6), 2 * i);
    }
    return { shapes, albedos };
}

export interface LobeTable {
    readonly shapes: WebGLTexture;
    readonly albedos: WebGLTexture;
}

/// \throws Error if the number of bytes is wrong
export function makeLobeTable(gl: Gl, bytes: Uint8Array): LobeTable {
    const { shapes, albedos } = lobeTexels(bytes);
    return {
        shapes: makeTexture(gl, formats.rgba16f, lobeTableSide, lobeTableSide, shapes),
        albedos: makeTexture(gl, formats.rg16f, lobeTableSide, lobeTableSide, albedos),
    };
}
