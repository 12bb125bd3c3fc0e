/// The triangles that cast shadows, in textures in the layout of web/shaders/triangles.glsl and shadows.glsl.

import {
    BufferAttribute, DataTexture, FloatType, InstancedMesh, InterleavedBufferAttribute, Layers, Matrix4, Mesh, Object3D, RGBAFormat, Scene,
    Vector3,
} from "three";
import { makeHierarchy } from "../library/hierarchy";
import { isInRange } from "../library/layout";
import { rowLength } from "../library/webgl";
import { TubeLight } from "./tube_light";

type Attribute = BufferAttribute | InterleavedBufferAttribute;

interface Caster {
    readonly mesh: Mesh;
    readonly position: Attribute;
    /// The same mesh, if it has instances.
    readonly instances: InstancedMesh | null;
}

function castersOf(scene: Scene, layers: Layers): Caster[] {
    const casters: Caster[] = [];
    scene.traverseVisible((object: Object3D) => {
        if (!object.castShadow || !(object instanceof Mesh) || object instanceof TubeLight || !object.layers.test(layers)) return;
        const { position } = object.geometry.attributes;
        if (position !== undefined)
            casters.push({ mesh: object, position, instances: object instanceof InstancedMesh ? object : null });
    });
    return casters;
}

/// What holds the numbers of an attribute, and its version: both change with the numbers.
function stateOfAttribute(attribute: Attribute | null): unknown[] {
    const buffer = attribute instanceof InterleavedBufferAttribute ? attribute.data : attribute;
    return [attribute, buffer, buffer?.version];
}

/// Changes with the triangles of a mesh, except by bones and morphs.
function stateOf({ mesh, position, instances }: Caster): unknown[] {
    const { index, drawRange } = mesh.geometry;
    return [mesh, ...stateOfAttribute(position), ...stateOfAttribute(index), drawRange.start, drawRange.count,
        ...stateOfAttribute(instances?.instanceMatrix ?? null), instances?.count, ...mesh.matrixWorld.elements];
}

/// Corners of triangles in world space, nine numbers each. Those with corners that are nowhere or too far away are left out.
function addCorners({ mesh, position, instances }: Caster, corners: number[]): void {
    const { index, drawRange } = mesh.geometry;
    const { start } = drawRange;
    const count = Math.min(index === null ? position.count : index.count, start + drawRange.count) - start;
    const vertex = new Vector3();
    const local = new Matrix4();
    for (let instance = 0; instance < (instances?.count ?? 1); ++instance) {
        const matrix = new Matrix4().copy(mesh.matrixWorld);
        if (instances !== null) {
            instances.getMatrixAt(instance, local);
            matrix.multiply(local);
        }
        for (let i = start; i + 2 < start + count; i += 3) {
            const triangle: number[] = [];
            for (let corner = i; corner < i + 3; ++corner) {
                mesh.getVertexPosition(index === null ? corner : index.getX(corner), vertex); // with morphs and bones
                triangle.push(...vertex.applyMatrix4(matrix).toArray());
            }
            if (triangle.every(isInRange)) corners.push(...triangle);
        }
    }
}

/// An array of texels in rows, as makeArrayTexture() makes it. \param count of texels
function makeTexture(count: number, fill: (texels: Float32Array) => void): DataTexture {
    const rows = Math.max(1, Math.ceil(count / rowLength));
    const texels = new Float32Array(4 * rowLength * rows);
    fill(texels);
    const texture = new DataTexture(texels, rowLength, rows, RGBAFormat, FloatType);
    texture.needsUpdate = true;
    return texture;
}

export class Occluders {
    triangles = makeTexture(0, () => {});
    nodes = makeTexture(0, () => {});
    nodeCount = 0;
    triangleCount = 0;
    /// Of a sphere around all triangles.
    radius = 0;
    private state: unknown[] = [];

    /// Gathers the scene again if meshes moved, came or went, or have other vertices, by their attributes and the versions of these.
    /// \param layers   meshes in one of them count.
    /// \param isForced whether the scene has changed in another way, as by bones and morphs.
    /// \return whether it did
    update(scene: Scene, layers: Layers, isForced: boolean): boolean {
        const casters = castersOf(scene, layers);
        const state = casters.flatMap(stateOf);
        if (!isForced && state.length === this.state.length && state.every((value, i) => value === this.state[i])) return false;
        this.state = state;
        this.dispose();
        const corners: number[] = [];
        for (const caster of casters) addCorners(caster, corners);
        const { nodes, nodeCount, order } = makeHierarchy(corners);
        this.nodeCount = nodeCount;
        this.triangleCount = order.length;
        this.nodes = makeTexture(2 * nodeCount, texels => texels.set(nodes));
        this.triangles = makeTexture(3 * order.length, texels => order.forEach((from, to) => {
            for (let corner = 0; corner < 3; ++corner)
                texels.set(corners.slice(9 * from + 3 * corner, 9 * from + 3 * corner + 3), 12 * to + 4 * corner);
        }));
        this.radius = nodeCount === 0 ? 0 : 0.5 * Math.hypot(nodes[4] - nodes[0], nodes[5] - nodes[1], nodes[6] - nodes[2]);
        return true;
    }

    dispose(): void {
        this.triangles.dispose();
        this.nodes.dispose();
    }
}
