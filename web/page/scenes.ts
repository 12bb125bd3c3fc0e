/// The scenes of the page: web/scenes.json.

import rows from "../scenes.json";

export interface SceneRow {
    readonly name: string;
    readonly label: string;
    /// From the root of the repository.
    readonly file: string;
    /// The material whose roughness the slider sets.
    readonly floor: string;
}

export const scenes: readonly SceneRow[] = rows;

export function sceneOf(name: string): SceneRow {
    return scenes.find(row => row.name === name) ?? scenes[0];
}
