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
const nusselt = await load();

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

// Wrong use has an error that says what is wrong.
const fails = (run, message) =>
    assert.throws(run, error => error.message.startsWith("nusselt: ") && message.test(error.message));
fails(() => nusselt.prepare("PolygonAera", 1, new Float32Array(12)), /no technique PolygonAera; there are Polygon/);
fails(() => nusselt.prepare("PolygonArea", 1, new Float32Array(13)), /takes no 1 lights from 13 numbers/);
fails(() => nusselt.prepare("PolygonArea", 0, new Float32Array(0)), /takes no 0 lights/);
fails(() => nusselt.prepare("PolygonArea", 1, new Float32Array(27)), /takes no 1 lights/);
fails(() => nusselt.prepare("LineArea", 1.5, new Float32Array(9)), /takes no 1.5 lights/);
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
