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

const failures = [];
const seen = new Set();
let numbers = 0;
let last;
for (const it of casesOf(file)) {
    const { name } = techniques[it.technique];
    seen.add(name);
    const results = resultsOf(name, it);
    const different = differences(results, it.results);
    if (different > 0) failures.push(`${name}, ${it.columns} columns: ${different} numbers differ`);
    for (const key of notFinite(results)) failures.push(`${name}, ${it.columns} columns: ${key} is not finite`);
    numbers += Object.values(results).reduce((sum, array) => sum + array.length, 0);
    last ??= it;
}
if (seen.size !== techniques.length) failures.push(`${seen.size} of ${techniques.length} techniques were compared`);

// The comparison must see the last bit of one number, and another technique.
const changed = { ...last, inputs: { ...last.inputs, u: last.inputs.u.slice() } };
bitsOf(changed.inputs.u)[last.inputs.u.findIndex((u, i) => u > 0.1 && last.results.pdf[i] > 0)] ^= 1;
if (differences(resultsOf(techniques[last.technique].name, changed), last.results) === 0)
    failures.push("the last bit of a random number changes nothing");
const other = techniques.find(({ light }, i) => light === techniques[last.technique].light && i !== last.technique);
if (differences(resultsOf(other.name, last), last.results) === 0)
    failures.push(`${other.name} passes for another technique`);

console.log(failures.join("\n") || `${numbers} numbers of ${seen.size} techniques have the bits of native code`);
process.exitCode = failures.length > 0 ? 1 : 0;
