/**
 * The package as a program sees it: known values, errors, memory, and its files.
 *
 * Usage: node package_test.mjs PACKAGE
 */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const folder = resolve(process.argv[2]);
const read = file => import(pathToFileURL(join(folder, file)));
const { load, techniques } = await read("nusselt.js");

// Instances have memory of their own, and all come from one module. Node.js has others for itself.
const bytesOfModule = readFileSync(join(folder, "nusselt.wasm")).length;
let compilations = 0;
for (const name of ["compile", "instantiate"]) {
    const original = WebAssembly[name];
    WebAssembly[name] = (source, ...rest) => {
        compilations += Number(source.byteLength === bytesOfModule);
        return original(source, ...rest);
    };
}
const instances = [...await Promise.all([load(), load()]), await load()];
assert.equal(new Set(instances.map(({ exports }) => exports.memory)).size, 3);
assert.equal(compilations, 1);
const [nusselt] = instances;

/** Columns of lights that are given as rows. */
function columnsOf(rows) {
    return Float32Array.from({ length: rows.length * rows[0].length },
                             (_, i) => rows[i % rows.length][Math.floor(i / rows.length)]);
}

// Square windows of a half space: a side of a cube around the point has a sixth of the sphere.
const side = [-1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1];
const sixth = 4 * Math.PI / 6;
const windows = nusselt.prepare("PolygonSolidAngle", 5, columnsOf([side, side, side, side, side]));
assert.equal(windows.count, 5);
for (const measure of windows.measure()) assert.ok(Math.abs(measure - sixth) < 1e-6, `${measure} sr`);
const u = Float32Array.from({ length: 3 * 10 }, (_, i) => (i + 0.5) / 30);
const { wi, pdf, p } = windows.sample(u);
assert.deepEqual([wi.length, pdf.length, p.length], [45, 15, 45]);
for (const density of pdf) assert.ok(Math.abs(density * sixth - 1) < 1e-6);
windows.invert(wi).forEach((x, i) => assert.ok(Math.abs(x - u[i]) < 1e-5, `${x} for ${u[i]}`));
for (let i = 0; i < 5; ++i) assert.ok(Math.abs(p[2 * 5 + i] - 1) < 1e-6, "points are in the window");

// Samples into arrays that are there already.
const again = windows.sample(u, { wi, pdf, p });
assert.equal(again.wi, wi);

// A triangle is a quadrilateral with a repeated vertex; octagons have more slots.
const triangle = [0, 0, 1, 1, 0, 1, 0, 1, 1];
const octagon = Array.from({ length: 8 }, (_, j) => [Math.cos(j * Math.PI / 4), Math.sin(j * Math.PI / 4), 1]).flat();
const areas = rows => nusselt.prepare("PolygonArea", rows.length, columnsOf(rows)).measure();
assert.deepEqual([...areas([triangle, triangle])], [0.5, 0.5]);
assert.deepEqual([...areas([[...triangle, 0, 1, 1]])], [0.5]);
assert.ok(Math.abs(areas([octagon])[0] - Math.SQRT2 * 2) < 1e-6);

// Lights with numbers beyond the limits are empty for all techniques, and their neighbours are what they are.
const lobe = [1, 0.1, 1, -0.1, 1];
const shapes = {
    polygon: side, rectangle: side, line: [-1, 0, 1, 1, 0, 1], cylinder: [-1, 0, 1, 1, 0, 1, 0.1],
    sphere: [1, 0, 1, 0.5], disk: [1, 0, 1, 0, 0, 1, 0.5], ellipse: [1, 0, 1, 0.5, 0, 0, 0, 0.25, 0.5],
    ellipsoid: [1, 0, 1, 0.5, 0, 0, 0, 0.25, 0, 0, 0.25, 0.75],
};
const rowOf = light => {
    const shape = shapes[light.replace("_on_lobe", "")];
    return { size: shape.length, row: light.endsWith("_on_lobe") ? [...shape, ...lobe] : shape };
};
for (const { name, light } of techniques) {
    const { size, row } = rowOf(light);
    const bad = [];
    for (const number of [NaN, Infinity, -Infinity, 1e38, -3e38])
        for (let k = 0; k < size; ++k) bad.push(row.map((value, i) => i === k ? number : value));
    if (light.startsWith("cylinder")) for (const radius of [-0.1, -1e30]) bad.push(row.map((value, i) => i === 6 ? radius : value));
    const rows = [row, ...bad, row];
    const lights = nusselt.prepare(name, rows.length, columnsOf(rows));
    const measures = lights.measure();
    assert.ok(measures[0] > 0 && measures[0] === measures.at(-1), name);
    assert.ok(measures.slice(1, -1).every(measure => measure === 0), `${name}: ${measures}`);
    const samples = lights.sample(new Float32Array(rows.length * (light.startsWith("line") ? 1 : 2)).fill(0.3));
    assert.ok(samples.pdf[0] > 0 && samples.pdf.slice(1, -1).every(density => density === 0), name);
    for (const values of [samples.wi, lights.pdf(samples.wi), lights.invert(samples.wi)])
        assert.ok(values.every(Number.isFinite), name);
    assert.ok(lights.pdf(samples.wi).slice(1, -1).every(density => density === 0), name);
    lights.free();
}

// Wrong use has an error that says what is wrong.
const fails = (run, message) =>
    assert.throws(run, error => error.message.startsWith("nusselt: ") && message.test(error.message));
fails(() => nusselt.prepare("PolygonAera", 1, new Float32Array(12)), /no technique PolygonAera; there are Polygon/);
fails(() => nusselt.prepare("PolygonArea", 1, new Float32Array(13)), /takes no 1 lights from 13 numbers/);
fails(() => nusselt.prepare("PolygonArea", 0, new Float32Array(0)), /takes no 0 lights/);
fails(() => nusselt.prepare("PolygonArea", 1, new Float32Array(27)), /takes no 1 lights/);
fails(() => nusselt.prepare("LineArea", 1.5, new Float32Array(9)), /takes no 1.5 lights/);
// Matrices that are not those of lobes: mirrored, singular, not finite.
for (const { name, light } of techniques.filter(({ light }) => light.endsWith("_on_lobe"))) {
    const { row } = rowOf(light);
    for (const edit of [{ 0: -1 }, { 2: -1 }, { 2: 0 }, { 0: 0, 1: 0 }, { 1: NaN }, { 2: Infinity }, { 4: Infinity, 3: -Infinity }]) {
        const wrong = [...row.slice(0, -5), ...lobe.map((value, k) => edit[k] ?? value)];
        fails(() => nusselt.prepare(name, 3, columnsOf([row, row, wrong])), /the lobe of light 2 has m11 = .*; both must be positive and finite/);
    }
    const mirrored = [...row.slice(0, -5), -1, 0.1, 1, -0.1, -1]; // in both x and z: the determinant is positive
    nusselt.prepare(name, 1, columnsOf([mirrored])).free();
}
fails(() => windows.sample(new Float32Array(11)), /11 random numbers are no multiple of 10/);
fails(() => windows.pdf(new Float32Array(0)), /0 coordinates are no multiple of 15/);
fails(() => windows.pdf([0, 0, 1]), /the coordinates must be a Float32Array/);
fails(() => nusselt.prepare("PolygonArea", 1, side), /the columns of lights must be a Float32Array/);
// Nothing is written if one of several arrays does not fit, whether columns have a gap in the module or not.
for (const count of [4, 5]) {
    const lights = nusselt.prepare("PolygonArea", count, columnsOf(Array(count).fill(side)));
    const numbers = new Float32Array(2 * count);
    for (const [name, length] of [["wi", 3 * count + 1], ["pdf", count - 1], ["p", 4 * count]]) {
        const into = { wi: new Float32Array(3 * count), pdf: new Float32Array(count), p: new Float32Array(3 * count) };
        into[name] = new Float32Array(length);
        fails(() => lights.sample(numbers, into), new RegExp(`${name} has ${length} numbers in place of`));
        assert.ok(Object.values(into).flatMap(values => [...values]).every(value => value === 0));
    }
    lights.free();
}
// The zeros of this array take no memory, because nothing reads them.
fails(() => nusselt.prepare("PolygonProjectedSolidAngle", 1e7, new Float32Array(9e7)), /no memory for \d+ bytes/);
windows.free();
fails(() => windows.measure(), /have been freed/);
windows.free();

// Memory is given back: the module has room for 2 GB, which are 31 times as many lights.
const many = new Float32Array(7 * 1e6);
for (let i = 0; i < 35; ++i) nusselt.prepare("CylinderArea", 1e6, many).free();

// What package.json names is there; the module alone gives the same; a page together with it remains below a megabyte.
const { exports, license, type } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
assert.deepEqual([license, type], ["MIT", "module"]);
for (const file of Object.values(exports).flatMap(value => typeof value === "string" ? [value] : Object.values(value)))
    assert.ok(existsSync(join(folder, file)), file);
for (const file of ["README.md", "LICENSE", "licences/emscripten"]) assert.ok(existsSync(join(folder, file)), file);
const { instantiate } = await read("bare.js");
const bare = await instantiate(readFileSync(join(folder, "nusselt.wasm")));
assert.deepEqual(bare.prepare("PolygonArea", 1, columnsOf([side])).measure(), Float32Array.of(4));
assert.ok(readFileSync(join(folder, "nusselt.global.js")).length < 400e3);

// The measurement that docs/wasm.md shows keeps what it promises, for each technique of the package.
const root = new URL("../../", import.meta.url);
const { columns, rows } = JSON.parse(readFileSync(new URL("docs/data/wasm.json", root), "utf8")).tables[0];
const column = name => rows.map(row => row[columns.findIndex(column => column.name === name)]);
assert.deepEqual([...new Set(column("technique"))].sort(), techniques.map(({ name }) => name).sort());
for (const ratio of column("sample_ratio")) assert.ok(ratio <= 2.5, `samples take ${ratio} times as long as in native code`);

// The examples of the documentation run.
for (const page of ["docs/wasm.md", "wasm/package/README.md"]) {
    const examples = [...readFileSync(new URL(page, root), "utf8").matchAll(/^```js\n(.*?)^```/gms)];
    assert.equal(examples.length, 1, page);
    const text = examples[0][1].replace('"nusselt"', JSON.stringify(pathToFileURL(join(folder, "nusselt.js"))));
    await import(`data:text/javascript,${encodeURIComponent(text)}`);
}
