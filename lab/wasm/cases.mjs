/** Reads what `native results` writes (native.cpp). */
import { readFileSync } from "node:fs";

/** All cases of a file, one after the other: inputs, and the results of native code. */
export function* casesOf(file) {
    const bytes = readFileSync(file);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    for (let offset = 0; offset < buffer.byteLength;) {
        const numbers = length => {
            const array = new Float32Array(buffer, offset, length);
            offset += array.byteLength;
            return array;
        };
        const [technique, columns, count, rounds, random] = new Int32Array(buffer, offset, 5);
        offset += 20;
        const samples = count * rounds;
        const inputs = {
            lights: numbers(count * columns), u: numbers(samples * random), directions: numbers(3 * samples),
        };
        const results = {
            wi: numbers(3 * samples), pdf: numbers(samples), p: numbers(3 * samples), measure: numbers(count),
            densities: numbers(samples), inverses: numbers(samples * random),
            otherDensities: numbers(samples), otherInverses: numbers(samples * random),
        };
        yield { technique, columns, count, rounds, random, inputs, results };
    }
}
