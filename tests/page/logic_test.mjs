// What of the live page needs no browser: links, cameras, pacing, scenes, unrolled loops. live_page_test.py bundles
// this file.
import assert from "node:assert/strict";
import fs from "node:fs";
import test from "node:test";

import { constantOf, makeImageShader } from "../../web/library/image_shader";
import { readScene } from "../../web/library/pbrt";
import { polygonUniforms } from "../../web/library/light_uniforms";
import { heuristics, samplers, techniques } from "../../web/library/techniques";
import { unrollLoops } from "../../web/library/unroll";
import { add } from "../../web/library/vectors";
import { cameraOf, isUsable, orbit, pan, project, stepIntoView, zoom } from "../../web/page/camera";
import { Pacing } from "../../web/page/pacing";
import { initialState, linkOf, stateOf } from "../../web/page/state";

const data = JSON.parse(fs.readFileSync(process.env.PAGE_DATA, "utf8"));
const sources = new Map(Object.entries(data.sources));
const files = new Map(Object.entries(data.scenes));

test("links that do not fit leave the initial state", () => {
    const hostile = ["%", "constructor=1", "toString=1", "__proto__=x", "hasOwnProperty=1", "width=%", "width=-1",
        "samples=", "seed=NaN",
        "left=constructor", "exposure=Infinity", "camera=1,2,3", "camera=NaN,0,0,0,0,0", "camera=1e999,0,0,0,0,0",
            "=", "&&=&",
        "roughness=x", "frames=1e999", "x".repeat(1 << 20), `show=${"%41".repeat(1 << 18)}`];
    for (const link of hostile) assert.deepEqual(stateOf(`#${link}`), initialState(), link.slice(0, 40));
});

test("lamps that are not numbers are untouched", () => {
    assert.deepEqual(stateOf("lamps=NaN,,;;").lamps.map(lamp => lamp.brightness), [1, 1, 1]);
    assert.equal(stateOf(`lamps=${"0,0,0,0,0,2;".repeat(100000)}`).lamps.length, 8);
});

test("links keep the state", () => {
    const link = "scene=room&left=projected_ltc&left-heuristic=power&right=arvo&right-sampler=independent&" +
        "compare=0&wipe=0.25&samples=4&accumulate=0&smooth=0&frames=16&seed=7&shadows=0&thick=1&reference=0&" +
        "show=error&roughness=0.5&exposure=-1&width=640&camera=1,2,3,0,0,0&lamps=1,0,0,10,20,0.5";
    assert.equal(linkOf(stateOf(link)), link);
    assert.deepEqual(stateOf(link.replace(/,/g, "%2C")), stateOf(link));
    assert.equal(stateOf("samples=5").samples, 4);
    assert.equal(stateOf("exposure=100").exposure, 4);
});

const view = { eye: [0, 1, 4], target: [0, 1, 0], up: [0, 1, 0], fov: 40 };

test("views without an image are recognised", () => {
    assert.ok(isUsable(view));
    for (const [eye, target] of [[[0, 5, 0], [0, 0, 0]], [[0, -5, 0.001], [0, 0, 0]], [[0, 0, 1e-4], [0, 0, 0]],
        [[0, 0, 60], [0, 0, 0]],
        [[0, 1, 1000], [0, 1, 996]], [[1, 1, 1], [1, 1, 1]]])
        assert.ok(!isUsable({ ...view, eye, target }), String(eye));
});

test("keys and pointers stay among usable views, also after links have rounded them", () => {
    let now = view;
    for (let i = 0; i < 2000; ++i) {
        const step = i % 3;
        now = step === 0 ? orbit(now, 0.3, i < 1000 ? 0.2 : -0.2) : step === 1 ? zoom(now, i % 500 < 250 ? 1.3 : 0.7)
            : pan(now, cameraOf(now, 16 / 9), 0.5, 0.1);
        const { camera } = stateOf(linkOf({ ...initialState(), camera: { eye: now.eye, target: now.target } }));
        assert.ok(isUsable({ ...now, ...camera }), String(now.eye));
        now = { ...now, ...camera };
    }
});

test("lights are brought back to the nearest place in the image", () => {
    const camera = cameraOf(view, 16 / 9);
    const brought = p => add(p, stepIntoView(camera, p, 4));
    const close = (a, b) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) < 1e-9, `${a} in place of ${b}`));
    close(brought([0.5, 1.2, 0]), [0.5, 1.2, 0]);
    close(brought([0, 1, 9]), [0, 1, 0]); // behind
    close(brought([0, 1, 4]), [0, 1, 0]); // at the eye
    close(brought([9, 1, 0]), [0.8 * 4 * camera.tangentX, 1, 0]);
    for (const p of [[-30, 60, 80], [1e6, -1e6, 4], [0, -5, 3.9]])
        assert.ok(project(camera, brought(p)).every(share => share > 0.09 && share < 0.91), String(p));
});

test("frames that draw nothing say nothing about a device", () => {
    const pacing = new Pacing();
    pacing.change(0);
    let now = 0;
    const frame = (images, time, compiles = false) => {
        pacing.begin({ images, compiles });
        now += time;
        return pacing.end(now, { images, compiles }, true);
    };
    for (let i = 0; i < 20; ++i) assert.ok(!frame(0, 16));
    assert.equal(pacing.frameTime, 0);
    assert.equal(pacing.width, 480);
    assert.ok(!pacing.allowsReference(now, false));
    frame(1, 3000, true);
    let changes = 0;
    for (let i = 0; i < 20; ++i) changes += frame(1, 500);
    assert.equal(changes, 1);
    assert.equal(pacing.width, 320);
    assert.ok(Math.abs(pacing.frameTime - 500) < 1);
});

test("devices get the width that they have time for", () => {
    for (const [time, width] of [[10, 960], [100, 480], [500, 320]]) {
        const pacing = new Pacing();
        for (let i = 1; i <= 10; ++i) {
            pacing.begin({ images: 1, compiles: false });
            pacing.end(i * time, { images: 1, compiles: false }, true);
        }
        assert.equal(pacing.width, width);
        assert.equal(pacing.isFast, time < 100);
    }
});

test("a program that compiles holds frames back", () => {
    const pacing = new Pacing();
    const [first, second] = [{ images: 1, compiles: false }, { images: 1, compiles: true }];
    pacing.begin(first);
    assert.ok(pacing.isFree);
    pacing.begin(second);
    pacing.end(1, first, false);
    assert.ok(!pacing.isFree);
    pacing.end(2, second, false);
    assert.ok(pacing.isFree);
});

const head = `Scale -1 1 1 LookAt 0 1 4 0 1 0 0 1 0 Camera "perspective" "float fov" 40 WorldBegin
MakeNamedMaterial "m" "string type" "diffuse" "rgb reflectance" [ 1 1 1 ] NamedMaterial "m" `;
const panel = `AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] `;
const line = `AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] Shape "line" "point3 p0" [ 0 0 0 ]`;
const read = text => readScene(new Map([["scene.pbrt", text]]), "scene.pbrt");

test("scenes are read, or an error says what is wrong", () => {
    const scene = read(head + panel);
    assert.equal(scene.polygons.length, 1);
    assert.deepEqual(scene.polygons[0].radiance, [1, 1, 1]);
    const wrong = [
        [`AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "float scale" 2`, /scale/],
        [`AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "bool twosided" true`, /twosided/],
        [`AreaLightSource "diffuse" "spectrum L" [ 1 1 1 ]`, /spectrum L/],
        [`AreaLightSource "goniometric"`, /goniometric/],
        [`MakeNamedMaterial "n" "string type" "diffuse" "texture reflectance" "t"`, /texture reflectance/],
        [`MakeNamedMaterial "n" "string type" "dielectric"`, /dielectric/],
        [`MakeNamedMaterial "n" "string type" "diffuse" "rgb reflectance" [ 1 1 ]`, /three numbers/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 x ]`, /x is not a number/],
        [`Shape "polygon"`, /point3 P/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 ]`, /three vertices/],
        [`Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "integer indices" [ 0 1 3 ]`, /at most 2, not 3/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "float alpha" 0.5`, /alpha/],
        [`Shape "sphere" "float radius" 1`, /sphere/],
        [`Translate 1 2`, /not a number/],
        [`AttributeEnd`, /AttributeBegin/],
        [`AttributeBegin`, /AttributeEnd/],
        [`NamedMaterial "other"`, /other/],
        [`NamedMaterial other`, /quotes/],
        [`PixelFilter "gaussian"`, /gaussian/],
        [`PixelFilter "box" "float xradius" 1 "float yradius" 1`, /0.5/],
        [`Include "missing.pbrt"`, /missing.pbrt/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0`, /\]/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 2 0 0 ]`, /area between three corners is zero/],
        [`Scale 0 1 1 Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0 ]`, /area between three corners is zero/],
        [`Shape "polygon" "point3 P" [ ]`, /three numbers/],
        [`Shape "polygon" "point3" [ 0 0 0 1 0 0 1 1 0 ]`, /a type and a name/],
        [`Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "point3 P" [ 0 0 0 1 0 0 1 1 0 ]`, /"P" is there twice/],
        [`Shape "polygon" "point3 P"`, /the end of the file stands in place of a value/],
        [`Shape "polygon" "point3 P" ]`, /\] stands in place/],
        [`Shape "polygon "point3 P" [ 0 0 0 1 0 0 1 1 0 ]`, /type "polygon " are not supported/],
        [`Shape "polygon`, /" is not a text in quotes/],
        [`Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 ]`, /needs "integer indices"/],
        [`Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "integer indices" [ ]`, /three numbers/],
        [`Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "integer indices" [ 0 1 -1 ]`, /at least 0/],
        [`Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 ] "integer indices" [ 0 1 .5 ]`, /whole number/],
        [`${line} "float radius" 0.1 "point3 p1" [ 0 0 0 ]`, /ends of the line are the same/],
        [`${line} "float radius" 0.1`, /"point3 p1" needs one vector, not 0/],
        [`${line} "float radius" 0.1 "point3 p1" [ 0 0 1 0 0 2 ]`, /"point3 p1" needs one vector, not 2/],
        [`${line} "point3 p1" [ 0 0 1 ]`, /"float radius" needs one number, not 0/],
        [`${line} "point3 p1" [ 0 0 1 ] "float radius" -0.1`, /"float radius" must be above 0, not -0.1/],
        [`${line} "point3 p1" [ 0 0 1 ] "float radius" 0`, /must be above 0, not 0/],
        [`${line} "point3 p1" [ 0 0 1 ] "float radius" [ 1 2 ]`, /one number, not 2/],
        [`${line} "point3 p1" [ 0 0 1 ] "float radius" 1 "bool finite" maybe`, /true or false, not maybe/],
        [`AreaLightSource "diffuse" "rgb L" [ -1 1 1 ]`, /at least 0 and at most 1e\+30, not -1/],
        [`AreaLightSource "diffuse" "rgb L" [ 2e30 1 1 ]`, /at most 1e\+30/],
        [`MakeNamedMaterial "m" "string type" "diffuse"`, /there is a material "m" already/],
        [`MakeNamedMaterial "n" "string type" diffuse`, /a text in quotes, not diffuse/],
        [`MakeNamedMaterial "n" "string type" "diffuse" "rgb reflectance" [ 1.5 1 1 ]`, /at most 1, not 1.5/],
        [`MakeNamedMaterial "n" "string type" "coateddiffuse" "float roughness" -1`, /at least 0, not -1/],
        [`MakeNamedMaterial "n" "string type" "coateddiffuse" "float eta" 0`, /above 0, not 0/],
        [`MakeNamedMaterial "n" "string type" "coateddiffuse" "bool remaproughness" 1`, /true or false, not 1/],
        [`MakeNamedMaterial "n" "string type" "conductor" "rgb eta" [ 1 1 1 ]`, /"rgb k" needs one vector, not 0/],
        [`Rotate 30 0 0 0`, /the axis is zero/],
        [`Translate 1e38 0 0`, /1e38 is too large/],
        [`Translate 8e37 0 0 Translate 8e37 0 0 Shape "polygon" "point3 P" [ 0 0 0 1 0 0 1 1 0 ]`, /too far away/],
        [`LookAt 0 1 4 0 1 4 0 1 0`, /viewing direction is zero/],
        [`LookAt 0 1 4 0 2 4 0 1 0`, /parallel to the up vector/],
        [`Camera "perspective" "float fov" 180`, /above 0 and below 180, not 180/],
        [`Camera "perspective" "float fov" 0`, /above 0 and below 180, not 0/],
        [`Include "scene.pbrt"`, /scene.pbrt includes itself/],
        ...["NaN", "Infinity", "-Infinity", "0x10", "1_000", "1e", ".", "+", "1,5", '"1"', "1f", "0b1", "1e999"]
            .map(number => [`Translate 0 0 ${number}`, /is not a number|is too large/]),
    ];
    for (const [text, message] of wrong) assert.throws(() => read(head + panel + text), message, text);
    assert.throws(() => read("WorldBegin " + panel), /NamedMaterial/);
});

test("numbers are those of C++, and messages say in which line they are", () => {
    for (const [number, value] of [["1", 1], ["+1.", 1], [".5", 0.5], ["-2.5E+1", -25], ["1e-2", 0.01]]) {
        const { polygons } = read(`${head}Translate ${number} 0 0 ${panel}`);
        assert.equal(polygons[0].vertices[0][0], value);
    }
    assert.throws(() => read(`${head}\n# a " comment\r\n${panel}\n  "float alpha"\n   NaN`),
        { message: 'scene.pbrt:5: Shape: the parameter "float alpha" is not supported' });
    assert.throws(() => read(`${head}\n\nShape "polygon" "point3 P" [ 0 0 0\n1 0 0\n1 1 NaN ]`),
        { message: "scene.pbrt:6: Shape: NaN is not a number" });
    const files = [["a/b.pbrt", `${head} Include "../c.pbrt"`], ["c.pbrt", "\nWorldEnd"]];
    assert.throws(() => readScene(new Map(files), "a/b.pbrt"),
        { message: "c.pbrt:2: WorldEnd: this directive is not supported" });
    assert.throws(() => readScene(new Map([["a/b.pbrt", `${head}\nInclude "c.pbrt"`]]), "a/b.pbrt"),
        { message: "a/b.pbrt:3: Include: a/c.pbrt is missing" });
    assert.throws(() => read("Translate 1 0 0"),
        { message: "scene.pbrt:1: Translate: transforms before WorldBegin are not supported" });
    assert.throws(() => read(panel), { message: "scene.pbrt:1: Shape: a WorldBegin is missing before" });
});

test("scenes of the page have the material of their floor, and lights", () => {
    for (const { file, floor } of JSON.parse(fs.readFileSync(process.env.PAGE_SCENES, "utf8"))) {
        const scene = readScene(files, file);
        assert.ok(scene.materials.some(material => material.name === floor && material.isGlossy), file);
        assert.ok(isUsable(scene.view));
    }
});

test("polygonal lights have a place for each vertex, or are refused", () => {
    const light = n => ({ radiance: [1, 1, 1], vertices: Array.from({ length: n },
        (_, i) => [Math.cos(i), Math.sin(i), 1]) });
    const uniforms = polygonUniforms([light(3), light(4)]);
    assert.equal(uniforms.get("polygon_vertices").length, 24);
    assert.throws(() => polygonUniforms([light(5)]), /5 vertices/);
    assert.throws(() => polygonUniforms(Array(5).fill(light(4))), /5 polygonal lights/);
});

test("heuristics and samplers are constants of the library", () => {
    const numbers = heuristics.map(row => constantOf(sources, "nusselt/estimate/mis.glsl", row.constant));
    assert.equal(new Set(numbers).size, heuristics.length);
    for (const row of samplers) constantOf(sources, "nusselt/random/light_random.glsl", row.constant);
    assert.throws(() => constantOf(sources, "nusselt/estimate/mis.glsl", "kNusseltMisOther"), /no constant/);
});

test("loops are unrolled", () => {
    const text = `const int kEnd = 2 + 1; // a } in a comment
NUSSELT_UNROLL for (int j = 0; j < kEnd; ++j) {
    if (j + 1 < kEnd) a[j + 1] = b[j];
    NUSSELT_UNROLL for (int k = 1; k < kEnd - 1; ++k) c[k] = d[j];
}
NUSSELT_UNROLL for (int j = kEnd - 1; j > 0; --j) e(j);
NUSSELT_UNROLL for (int j = 0; j < count; ++j) f(j);`;
    const squeezed = unrollLoops(text).replace(/\s+/g, "");
    assert.equal(squeezed,
        "constintkEnd=2+1;{{{a[0+1]=b[0];{{c[1]=d[0];}}}}{{a[1+1]=b[1];{{c[1]=d[1];}}}}{{{{c[1]=d[2];}}}}}" +
        "NUSSELT_UNROLLfor(intj=kEnd-1;j>0;--j)e(j);NUSSELT_UNROLLfor(intj=0;j<count;++j)f(j);");
});

test("shaders of all techniques keep no marked loop that counts upwards", () => {
    for (const technique of techniques) {
        for (const kinds of [["polygon", "line"], ["polygon", "cylinder"]]) {
            const text = makeImageShader(sources, technique, "kNusseltSamplerSobol", kinds);
            assert.doesNotMatch(unrollLoops(text), /NUSSELT_UNROLL for \(int (\w+) = [^;]+; \1 < /, technique.name);
            assert.doesNotMatch(text, /@\w+@/);
        }
    }
});
