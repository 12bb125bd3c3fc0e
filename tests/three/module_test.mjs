/// Tests of the module for three.js without a device: which triangles cast shadows, and where lights are.

import assert from "node:assert/strict";
import {
    BoxGeometry, BufferGeometry, Float32BufferAttribute, InstancedMesh, Matrix4, Mesh, MeshStandardMaterial, PlaneGeometry,
    RectAreaLight, Scene, SphereGeometry,
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
assert.equal(lights.update(), false, "no version number tells of draw ranges");
lights.needsUpdate = true;
assert.equal(lights.update(), true);
assert.equal(lights.triangleCount, 14);

// Triangles that are nowhere cast no shadow.
const broken = new BufferGeometry();
broken.setAttribute("position", new Float32BufferAttribute([0, 0, 0, 1, 0, 0, NaN, 1, 0], 3));
scene.add(caster(broken), caster(new BufferGeometry()));
lights.update();
assert.equal(lights.triangleCount, 14);

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
    [() => new RectAreaLight(0xffffff, 1, 2, 1), [{ width: 0 }, { height: NaN }, { width: Infinity }, { intensity: NaN }]],
    [() => new TubeLight(0xffffff, 1, 1, 0.1), [{ length: 0 }, { length: NaN }, { radius: -1 }, { radius: NaN }, { intensity: Infinity }]],
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
assert.throws(() => lights.update(), /5 polygonal lights are too many: at most 4/);
