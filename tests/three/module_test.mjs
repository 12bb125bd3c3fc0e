/// Tests of the module for three.js without a device: which triangles cast shadows, and where lights are.

import assert from "node:assert/strict";
import {
    BoxGeometry, BufferAttribute, BufferGeometry, Float32BufferAttribute, InstancedMesh, InterleavedBuffer, InterleavedBufferAttribute,
    Matrix4, Mesh, MeshStandardMaterial, PerspectiveCamera, PlaneGeometry, RectAreaLight, Scene, SphereGeometry,
} from "three";
import { AreaLights, TubeLight } from "./nusselt-three.js";

const box = new BoxGeometry(1, 1, 1); // 12 triangles
const material = new MeshStandardMaterial();

function caster(geometry) {
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = true;
    return mesh;
}

const scene = new Scene();
const lights = new AreaLights(scene);
lights.add(scene);
assert.equal(lights.update(), true);
assert.equal(lights.update(), false, "nothing has changed");
assert.equal(lights.triangleCount, 0);

const mesh = caster(box);
scene.add(mesh, new Mesh(box, material)); // the second one casts no shadow
assert.equal(lights.update(), true);
assert.equal(lights.triangleCount, 12);
mesh.position.x = 1;
assert.equal(lights.update(), true, "a mesh has moved");
assert.equal(lights.update(), false);

const instances = new InstancedMesh(box, material, 3);
instances.castShadow = true;
for (let i = 0; i < 3; ++i) instances.setMatrixAt(i, new Matrix4().makeTranslation(0, 2 * i, 0));
scene.add(instances);
lights.update();
assert.equal(lights.triangleCount, 12 + 36);
instances.visible = false;
lights.update();
assert.equal(lights.triangleCount, 12);

const plane = caster(new PlaneGeometry(1, 1));
scene.add(plane);
plane.geometry.setDrawRange(3, 3);
lights.update();
assert.equal(lights.triangleCount, 13);
plane.geometry.setDrawRange(0, Infinity);
assert.equal(lights.update(), true);
assert.equal(lights.triangleCount, 14);
assert.equal(lights.update(), false);
lights.needsUpdate = true;
assert.equal(lights.update(), true);

// Triangles that are nowhere, or farther away than shaders can reach, cast no shadow.
const broken = new BufferGeometry();
broken.setAttribute("position", new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, NaN, 1, 0, 0, 0, 0, 1, 0, 0, 3.4e38, 1, 0]), 3));
const beyond = new BufferGeometry();
beyond.setAttribute("position", new BufferAttribute(new Float64Array([0, 0, 0, 1, 0, 0, 1e39, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3.4e38, 0]), 3));
scene.add(caster(broken), caster(beyond), caster(new BufferGeometry()));
lights.update();
assert.equal(lights.triangleCount, 14);
assert.ok(lights.occluders.radius < 10);

// Other buffers count, whether attributes share them or not, and so do other indices.
const quads = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1]; // six vertices
const edited = new BufferGeometry();
edited.setAttribute("position", new Float32BufferAttribute(quads, 3));
scene.add(caster(edited));
const changesOf = edit => {
    edit();
    const hasChanged = lights.update();
    assert.equal(lights.update(), false);
    return [hasChanged, lights.triangleCount - 14, lights.occluders.triangles.image.data.reduce((sum, x) => Math.max(sum, x))];
};
const interleaved = new InterleavedBuffer(new Float32Array([...quads.slice(0, 9), 0, 0, 5]), 3);
const attribute = new InterleavedBufferAttribute(interleaved, 3, 0);
for (const [edit, triangles, largest] of [
    [() => {}, 2, 1.5],
    [() => edited.setAttribute("position", new Float32BufferAttribute(quads.map(x => 3 * x), 3)), 2, 3],
    [() => edited.setIndex([0, 1, 2]), 1, 3],
    [() => edited.setIndex([3, 4, 5]), 1, 3],
    [() => edited.setAttribute("position", attribute), 0, 1.5], // there is no vertex 4
    [() => edited.setIndex([1, 2, 3]), 1, 5],
    [() => { interleaved.array[11] = 7; interleaved.needsUpdate = true; }, 1, 7],
    [() => { attribute.data = new InterleavedBuffer(new Float32Array(12).fill(8), 3); }, 1, 8],
    [() => edited.setIndex(null), 1, 8],
    [() => edited.deleteAttribute("position"), 0, 1.5],
]) assert.deepEqual(changesOf(edit), [true, triangles, largest], edit.toString());

// As for three.js, only layers count that the camera sees.
const camera = new PerspectiveCamera();
camera.layers.set(1);
mesh.layers.enable(1);
assert.equal(lights.update(camera), true);
assert.equal(lights.triangleCount, 12);
const seen = new RectAreaLight(0xffffff, 1, 1, 1);
seen.layers.set(1);
scene.add(seen);
lights.update(camera);
assert.equal(lights.uniforms.polygon_count.value, 1);
assert.equal(lights.update(), true);
assert.deepEqual([lights.triangleCount, lights.uniforms.polygon_count.value], [14, 0]);
scene.remove(seen);

// Lights cast no shadow themselves, and moving them builds nothing.
const panel = new RectAreaLight(0xffffff, 2, 3, 1);
const tube = new TubeLight(0xff0000, 5, 2, 0.1);
tube.castShadow = true;
scene.add(panel, tube);
assert.equal(lights.update(), true);
assert.equal(lights.triangleCount, 14);
tube.position.y = 1;
assert.equal(lights.update(), true);
assert.equal(lights.update(), false);
tube.length = 3;
assert.equal(lights.update(), true);
assert.equal(tube.geometry.parameters.height, 3);
assert.deepEqual(tube.toWorld(), { begin: [0, -0.5, 0], end: [0, 2.5, 0], radius: 0.1, radiance: [5, 0, 0] });

/// Checks that all triangles are in leaves whose boxes, and those above, have them inside.
function checkHierarchy({ nodes, triangles, nodeCount, triangleCount }) {
    const [boxes, corners] = [nodes.image.data, triangles.image.data];
    let next = 0;
    for (let node = 0; node < nodeCount; ++node) {
        const leaf = boxes[8 * node + 7];
        if (leaf < 0) continue;
        assert.equal(Math.floor(leaf / 8), next, "leaves follow each other");
        next += leaf % 8;
        for (let above = 0; above <= node; ++above) {
            if (boxes[8 * above + 3] <= node) continue; // another branch
            for (let i = 12 * Math.floor(leaf / 8); i < 12 * next; ++i)
                if (i % 4 < 3) assert(corners[i] >= boxes[8 * above + i % 4] && corners[i] <= boxes[8 * above + 4 + i % 4]);
        }
    }
    assert.equal(next, triangleCount);
}
checkHierarchy(lights.occluders);
const many = new Scene();
// A flat grid, a sphere, and many triangles in one place.
many.add(caster(new PlaneGeometry(1, 1, 40, 40)), caster(new SphereGeometry(1, 40, 20)));
for (let i = 0; i < 30; ++i) many.add(caster(box));
const lightsOfMany = new AreaLights(many);
lightsOfMany.update();
assert.equal(lightsOfMany.triangleCount, 3200 + 1520 + 360);
checkHierarchy(lightsOfMany.occluders);

// Thousands of triangles in one place take neither long nor a deep stack.
const piled = new Scene();
for (let i = 0; i < 1000; ++i) piled.add(caster(box));
const lightsOfPile = new AreaLights(piled);
const begin = performance.now();
lightsOfPile.update();
assert.ok(performance.now() - begin < 5000);
checkHierarchy(lightsOfPile.occluders);

// Lights of no extent and with numbers that are not finite do not shine, and numbers in uniforms stay finite.
const flat = new Scene();
const flatLights = new AreaLights(flat);
const countOf = () => {
    flatLights.update();
    for (const { value } of Object.values(flatLights.uniforms))
        if (value instanceof Float32Array) assert.ok(value.every(Number.isFinite));
    return flatLights.uniforms.polygon_count.value + flatLights.uniforms.line_count.value;
};
for (const [make, edits] of [
    [() => new RectAreaLight(0xffffff, 1, 2, 1), [{ width: 0 }, { height: NaN }, { width: Infinity }, { intensity: NaN },
        { width: 1e39 }, { intensity: 1e39 }, { width: 1e-200, height: 1e-200 }]],
    [() => new TubeLight(0xffffff, 1, 1, 0.1), [{ length: 0 }, { length: NaN }, { radius: -1 }, { radius: NaN }, { radius: 1e39 },
        { intensity: Infinity }]],
]) {
    const light = make();
    flat.add(light);
    assert.equal(countOf(), 1);
    for (const edit of edits) {
        const before = Object.fromEntries(Object.keys(edit).map(name => [name, light[name]]));
        Object.assign(light, edit);
        assert.equal(countOf(), 0, JSON.stringify(Object.entries(edit)));
        Object.assign(light, before);
    }
    light.scale.set(0, 0, 0);
    light.updateMatrixWorld();
    assert.equal(countOf(), 0);
    flat.remove(light);
}
for (const [given, kept] of [[3, 3], [0, 1], [0.5, 1], [-1, 1], [NaN, 1], [2.4, 2]]) {
    flatLights.samples = given;
    assert.equal(flatLights.samples, kept);
}

// A material has the lights of one object, and gets its own program back.
const lit = caster(box);
flat.add(lit);
const hook = lit.material.onBeforeCompile;
flatLights.add(flat);
assert.notEqual(lit.material.onBeforeCompile, hook);
assert.throws(() => new AreaLights(flat).add(flat), /has other area lights; dispose\(\) of them first/);
flatLights.dispose();
assert.equal(lit.material.onBeforeCompile, hook);
assert.deepEqual(lit.material.defines.NUSSELT_AREA_LIGHTS, undefined);
new AreaLights(flat).add(flat);

for (let i = 0; i < 4; ++i) scene.add(new RectAreaLight());
mesh.position.x = 2;
assert.throws(() => lights.update(), /5 polygonal lights are too many: at most 4/);
// What moved in the meantime is not forgotten.
scene.remove(...scene.children.filter(child => child instanceof RectAreaLight && child !== panel));
assert.equal(lights.update(), true);
assert.equal(lights.update(), false);
