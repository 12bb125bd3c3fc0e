/// Lamps: lights that move together.

import { Polygon, Scene, Tube } from "../library/pbrt";
import { Vector, add, rotate, subtract, times } from "../library/vectors";
import { LampState, untouchedLamp } from "./state";

export interface Lamp {
    readonly label: string;
    readonly block: number;
    readonly center: Vector;
}

function centerOf(points: readonly Vector[]): Vector {
    return times(1 / points.length, points.reduce(add, [0, 0, 0]));
}

/// Lamps in the order of the file, polygons first.
export function lampsOf(scene: Scene): Lamp[] {
    const panels = scene.polygons.filter(polygon => polygon.radiance !== null);
    const blocks = [...new Set([...panels, ...scene.tubes].map(light => light.block))];
    return blocks.map(block => {
        const points = panels.filter(panel => panel.block === block).flatMap(panel => panel.vertices);
        const ends = scene.tubes.filter(tube => tube.block === block).flatMap(tube => [tube.begin, tube.end]);
        return { label: points.length > 0 ? "Panel" : "Tube", block, center: centerOf([...points, ...ends]) };
    });
}

const radians = Math.PI / 180;

function moved(p: Vector, lamp: Lamp, state: LampState): Vector {
    const turned = rotate(subtract(p, lamp.center), [0, 1, 0], state.turn * radians);
    return add(add(lamp.center, state.move), rotate(turned, [1, 0, 0], state.tilt * radians));
}

/// The scene with changed lamps and another roughness of its floor.
/// \param floor the name of its material
export function changedScene(scene: Scene, lamps: readonly Lamp[], states: readonly LampState[], floor: string,
                             roughness: number | null): Scene {
    const changeOf = (block: number) => {
        const index = lamps.findIndex(lamp => lamp.block === block);
        return { lamp: lamps[index], state: states[index] ?? untouchedLamp };
    };
    const polygons = scene.polygons.map((polygon): Polygon => {
        if (polygon.radiance === null) return polygon;
        const { lamp, state } = changeOf(polygon.block);
        return { ...polygon, radiance: times(state.brightness, polygon.radiance),
            vertices: polygon.vertices.map(v => moved(v, lamp, state)) };
    });
    const tubes = scene.tubes.map((tube): Tube => {
        const { lamp, state } = changeOf(tube.block);
        return { ...tube, radiance: times(state.brightness, tube.radiance), begin: moved(tube.begin, lamp, state),
            end: moved(tube.end, lamp, state) };
    });
    const materials = scene.materials.map(material =>
        material.name === floor && roughness !== null ? { ...material, roughness } : material);
    return { ...scene, polygons, tubes, materials };
}

/// The scene with lines in place of cylinders.
export function withLines(scene: Scene): Scene {
    return { ...scene, tubes: scene.tubes.map(tube => ({ ...tube, isCylinder: false })) };
}
