/// A scene of the live page as a scene of three.js.

import {
    BackSide, BufferGeometry, Color, Float32BufferAttribute, Matrix4, Mesh, MeshBasicMaterial, MeshPhysicalMaterial,
    MeshStandardMaterial, Object3D, PerspectiveCamera, PlaneGeometry, RectAreaLight, Scene, Vector3,
} from "three";
import { Material, Polygon, Scene as PbrtScene, Tube } from "../../library/pbrt";
import { Vector } from "../../library/vectors";
import { TubeLight } from "../index";

export interface Example {
    readonly scene: Scene;
    readonly camera: PerspectiveCamera;
    readonly target: Vector3;
    readonly floor: MeshStandardMaterial;
    /// What can be dragged.
    readonly lamps: Object3D[];
}

const vectorOf = (v: Vector): Vector3 => new Vector3().fromArray(v);

function makeMaterial({ name, isGlossy, diffuse, f0, roughness }: Material): MeshStandardMaterial {
    const isMetal = isGlossy && Math.max(...diffuse) === 0;
    const material = new MeshPhysicalMaterial({ roughness, metalness: Number(isMetal), specularIntensity: Number(isGlossy) });
    material.name = name;
    material.color.setRGB(...(isMetal ? f0 : diffuse));
    return material;
}

function makeMesh(polygons: readonly Polygon[], material: MeshStandardMaterial): Mesh {
    const triangles = polygons.flatMap(({ vertices: v }) => v.slice(2).flatMap((c, i) => [v[0], v[i + 1], c]));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(triangles.flat(), 3));
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
}

/// A panel that shows what its light emits, with the light as its child. Only rectangles become lights.
function makePanel({ vertices: v, radiance }: Polygon, black: MeshStandardMaterial): Mesh {
    const [a, b, c] = v.map(vectorOf);
    const x = new Vector3().subVectors(a, b);
    const y = new Vector3().subVectors(c, b);
    const [width, height] = [x.length(), y.length()];
    // The corners run counter-clockwise for those whom the light shines on: -z points to them.
    const z = new Vector3().crossVectors(x, y).normalize();
    const color = new Color().setRGB(...(radiance ?? [0, 0, 0]));
    const front = new MeshBasicMaterial({ side: BackSide });
    front.color.copy(color);
    const panel = new Mesh(new PlaneGeometry(width, height), front);
    panel.add(new Mesh(panel.geometry, black), new RectAreaLight(color, 1, width, height));
    panel.position.fromArray(a.clone().add(c).multiplyScalar(0.5).toArray());
    panel.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(x.normalize(), y.normalize(), z));
    panel.castShadow = true;
    return panel;
}

function makeTube({ begin, end, radius, radiance }: Tube): TubeLight {
    const [a, b] = [vectorOf(begin), vectorOf(end)];
    const axis = new Vector3().subVectors(b, a);
    const tube = new TubeLight(new Color().setRGB(...radiance), 1, axis.length(), radius);
    tube.position.fromArray(a.add(b).multiplyScalar(0.5).toArray());
    tube.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), axis.normalize());
    return tube;
}

export function makeExample({ view, materials, polygons, tubes }: PbrtScene): Example {
    const scene = new Scene();
    scene.background = new Color(0x000000);
    const ours = materials.map(makeMaterial);
    for (const [index, material] of ours.entries()) {
        const own = polygons.filter(polygon => polygon.material === index && polygon.radiance === null);
        if (own.length > 0) scene.add(makeMesh(own, material));
    }
    const panels = polygons.filter(polygon => polygon.radiance !== null);
    const lamps: Object3D[] = [...panels.map(panel => makePanel(panel, ours[panel.material])), ...tubes.map(makeTube)];
    scene.add(...lamps);
    const camera = new PerspectiveCamera(view.fov, 16 / 9, 0.02, 200);
    camera.position.fromArray(view.eye);
    camera.lookAt(vectorOf(view.target));
    return { scene, camera, target: vectorOf(view.target), floor: ours[polygons[0].material], lamps };
}
