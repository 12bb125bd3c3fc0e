/**
 * Compares the bits of all results of the package with those of native code, which `native results` wrote to a file.
 *
 * Usage: node lab/wasm/compare_bits.mjs PACKAGE FILE
 */
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { casesOf } from "./cases.mjs";

const [folder, file] = process.argv.slice(2);
const { load, techniques } = await import(pathToFileURL(resolve(folder, "nusselt.js")));
const nusselt = await load();

function resultsOf(name, { count, inputs: { lights, u, directions } }) {
    const prepared = nusselt.prepare(name, count, lights);
    const { wi, pdf, p } = prepared.sample(u);
    const results = {
        wi, pdf, p, measure: prepared.measure(), densities: prepared.pdf(wi), inverses: prepared.invert(wi),
        otherDensities: prepared.pdf(directions), otherInverses: prepared.invert(directions),
    };
    prepared.free();
    return results;
}

const bitsOf = array => new Uint32Array(array.buffer, array.byteOffset, array.length);

/** How many numbers differ. NaN is NaN: instructions differ in its bits, and points without density may be NaN. */
function differences(results, expected) {
    let count = 0;
    for (const [key, array] of Object.entries(results)) {
        const actual = bitsOf(array);
        const native = bitsOf(expected[key]);
        if (actual.length !== native.length) return Infinity;
        for (let i = 0; i < actual.length; ++i)
            if (actual[i] !== native[i] && !(Number.isNaN(array[i]) && Number.isNaN(expected[key][i]))) ++count;
    }
    return count;
}

/** Names of results that are not finite, points without density aside. */
function notFinite(results) {
    const count = results.measure.length;
    return Object.entries(results).filter(([key, array]) => array.some((x, i) => {
        if (Number.isFinite(x)) return false;
        const column = Math.floor(i / count);
        return key !== "p" || results.pdf[Math.floor(column / 3) * count + i % count] > 0;
    })).map(([key]) => key);
}

/** The case with other last bits of its random numbers. */
function changed(it) {
    const u = it.inputs.u.slice();
    bitsOf(u).forEach((bits, i, all) => { all[i] = bits ^ 1; });
    return { ...it, inputs: { ...it.inputs, u } };
}

const failures = [];
const compared = new Set();
const latest = new Map(); // of the techniques for each kind of light
let numbers = 0;
for (const it of casesOf(file)) {
    const { name, light } = techniques[it.technique];
    const fail = problem => failures.push(`${name}, ${it.columns} columns: ${problem}`);
    const results = resultsOf(name, it);
    const different = differences(results, it.results);
    if (different > 0) fail(`${different} numbers differ`);
    for (const key of notFinite(results)) fail(`${key} is not finite`);
    numbers += Object.values(results).reduce((sum, array) => sum + array.length, 0);

    // The comparison must see last bits, and other techniques.
    if (differences(resultsOf(name, changed(it)), it.results) === 0) fail("last bits of random numbers change nothing");
    if (compared.has(name)) continue;
    compared.add(name);
    const other = latest.get(light);
    if (other && differences(resultsOf(other, it), it.results) === 0) fail(`${other} passes for it`);
    latest.set(light, name);
}
if (compared.size !== techniques.length)
    failures.push(`${compared.size} of ${techniques.length} techniques were compared`);

console.log(failures.join("\n") || `${numbers} numbers of ${compared.size} techniques have the bits of native code`);
process.exitCode = failures.length > 0 ? 1 : 0;
