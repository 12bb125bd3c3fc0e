/**
 * Times samples in WebAssembly and in native code with packs of SSE 4.2: the same functions, the same lights,
 * alternating. Prints medians [ns per light or sample] and their ratios: of the functions of the module, and of
 * `sample()` of the package, which also copies random numbers in and samples out.
 *
 * Usage: node lab/wasm/time_samples.mjs PACKAGE NATIVE [REPETITIONS [FILE.JSON]]
 */
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

import { casesOf } from "./cases.mjs";

// No power of two, for which all columns would share the same lines of caches. Runs last less than a millisecond: the
// scheduler interrupts longer ones where others wait.
const COUNT = 1000;
const ROUNDS = 4;
const [folder, native, repetitions = "101", json] = process.argv.slice(2);
const { load, techniques } = await import(pathToFileURL(resolve(folder, "nusselt.js")));

const directory = mkdtempSync(join(tmpdir(), "nusselt-"));
const file = join(directory, "native");
execFileSync(native, ["results", String(COUNT), String(ROUNDS), file]);
// Each case with ordinary lights follows that with hostile ones. Bounds for eight vertices are timed with six.
const cases = [...casesOf(file)].filter((it, i) => i % 2 === 1 && [null, 4, 6].includes(verticesOf(it)));
rmSync(directory, { recursive: true });

/** Of a polygon, else null. */
function verticesOf({ technique, columns }) {
    const { light } = techniques[technique];
    return light.startsWith("polygon") ? (columns - (light.endsWith("_on_lobe") ? 5 : 0)) / 3 : null;
}

const child = spawn(native, ["time", String(COUNT), String(ROUNDS)], { stdio: ["pipe", "pipe", "inherit"] });
const answers = createInterface({ input: child.stdout })[Symbol.asyncIterator]();

async function nativeTimes({ technique, columns }) {
    child.stdin.write(`${technique} ${columns}\n`);
    const [prepare, sample] = (await answers.next()).value.split(" ").map(Number);
    return { prepare, sample };
}

/** The times of a second run; the first one brings memory and code into caches. */
function nanoseconds(run) {
    run();
    const start = process.hrtime.bigint();
    run();
    return Number(process.hrtime.bigint() - start);
}

const module = await WebAssembly.compile(readFileSync(join(folder, "nusselt.wasm")));
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => {};
const { exports } = await WebAssembly.instantiate(module, imports);
exports._initialize();

/** Memory of the module for numbers. */
function allocate(length, values) {
    const address = exports.malloc(4 * length);
    if (values) new Float32Array(exports.memory.buffer, address, length).set(values);
    return address;
}

function moduleTimes({ technique, columns, inputs }) {
    const row = exports.nusselt_row(technique, columns);
    const groups = COUNT / 4;
    const samples = COUNT * ROUNDS;
    const addresses = [exports.malloc(groups * exports.nusselt_group_size(row)),
                       allocate(inputs.lights.length, inputs.lights), allocate(inputs.u.length, inputs.u),
                       allocate(3 * samples), allocate(samples), allocate(3 * samples)];
    const [prepared, lights, ...columnsOfSamples] = addresses;
    const prepare = nanoseconds(() => exports.nusselt_prepare(row, lights, columns, groups, prepared));
    const sample = nanoseconds(() => exports.nusselt_sample(row, prepared, groups, ROUNDS, ...columnsOfSamples));
    for (const address of addresses) exports.free(address);
    return { prepare: prepare / COUNT, sample: sample / samples };
}

const nusselt = await load();

function packageTimes({ technique, inputs }) {
    const lights = nusselt.prepare(techniques[technique].name, COUNT, inputs.lights);
    const samples = lights.sample(inputs.u);
    const sample = nanoseconds(() => lights.sample(inputs.u, samples));
    lights.free();
    return { sample: sample / COUNT / ROUNDS };
}

const median = values => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const rows = cases.map(it => ({ it, native: [], module: [], package: [] }));
// Engines compile a module quickly first, and well while it runs.
for (const { it } of rows) for (let i = 0; i < 20; ++i) moduleTimes(it);
for (let i = 0; i < Number(repetitions); ++i) {
    for (const row of rows) {
        row.native.push(await nativeTimes(row.it));
        row.module.push(moduleTimes(row.it));
        row.package.push(packageTimes(row.it));
    }
}
child.stdin.end();

const names = ["technique", "vertices", "native_prepare_ns", "native_sample_ns", "module_prepare_ns",
               "module_sample_ns", "package_sample_ns", "prepare_ratio", "sample_ratio", "package_ratio"];
const table = rows.map(({ it, ...times }) => {
    const of = (who, what) => median(times[who].map(time => time[what]));
    const [prepare, sample] = [of("native", "prepare"), of("native", "sample")];
    const inModule = [of("module", "prepare"), of("module", "sample")];
    const inPackage = of("package", "sample");
    return [techniques[it.technique].name, verticesOf(it), prepare, sample, ...inModule, inPackage,
            inModule[0] / prepare, inModule[1] / sample, inPackage / sample];
});
const shown = cell => typeof cell === "number" && !Number.isInteger(cell) ? cell.toFixed(2) : cell ?? "-";
console.log(`| ${names.join(" | ")} |\n|${"---|".repeat(names.length)}`);
for (const row of table) console.log(`| ${row.map(shown).join(" | ")} |`);
const ratios = table.map(row => row[names.indexOf("sample_ratio")]);
const [least, middle, most] = [Math.min(...ratios), median(ratios), Math.max(...ratios)].map(x => x.toFixed(2));
console.log(`\nSamples in the module take ${least} to ${most} times as long as native ones, ${middle} in the median.`);
if (json) {
    const columns = names.map(name => name.endsWith("_ns") ? { name, unit: "ns" } : { name });
    const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    writeFileSync(json, JSON.stringify({
        bench: "wasm", command: `lab/wasm/time.sh ${repetitions} ${json}`, version,
        machine: { processor: cpus()[0].model, threads: cpus().length },
        settings: { repetitions: Number(repetitions), node: process.version },
        tables: [{ name: "samples", columns, rows: table }],
    }, null, 1) + "\n");
}
