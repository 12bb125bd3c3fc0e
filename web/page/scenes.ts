/// The scenes of the page: files in the data of the page, and their names.

export interface SceneRow {
    readonly name: string;
    readonly label: string;
    readonly file: string;
}

export const scenes: readonly SceneRow[] = [
    { name: "floor", label: "Floor", file: "web/scenes/floor.pbrt" },
    { name: "room", label: "Room", file: "scenes/room.pbrt" },
];

export function sceneOf(name: string): SceneRow {
    return scenes.find(row => row.name === name) ?? scenes[0];
}
