"""Scenes: loading, looking at them, and changes of their lights, materials and camera."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nusselt import _arrays, _core
from nusselt._arrays import Array

__all__ = ["Scene", "load"]


def _json_text(value: Any, name: str) -> str:
    """JSON of dictionaries and lists, which may hold numbers and arrays of numpy."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except ValueError as error:
        if "JSON compliant" not in str(error):
            raise
        raise ValueError(f"{name} must not have numbers that are infinite or NaN") from None


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"a {type(value).__name__} is nothing that light rigs and cameras have: {value!r}")


class Scene:
    """A scene. Edits replace what it holds: arrays that were taken from it before, and renderings that run, keep theirs.

    Errors in files and edits are RuntimeErrors whose message names the file or field, the value and the remedy.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Loads a scene file in pbrt syntax, version 3 or 4, with its meshes and textures."""
        self._scene = _core.Scene(_arrays.path_of(path))

    def copy(self) -> Scene:
        """Another scene with the same content; edits of one do not change the other. Takes no memory until then."""
        other = Scene.__new__(Scene)
        other._scene = _core.Scene(self._scene)
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self.copy()

    def __reduce__(self) -> Any:
        raise TypeError("scenes cannot be pickled; pass the name of the file, and load it in each process")

    @property
    def lights(self) -> list[dict[str, Any]]:
        """The lights, each as the entry of a light rig that selects it and changes nothing (docs/lights.md)."""
        lights: list[dict[str, Any]] = json.loads(self._scene.rig_text())["lights"]
        return lights

    def edit(self, lights: Sequence[Mapping[str, Any]] = (), materials: Sequence[Mapping[str, Any]] = (), *,
             folder: str | os.PathLike[str] = "") -> None:
        """Changes lights and materials by the entries of a light rig (docs/lights.md), such as
        `scene.edit([{"light": "lamp", "move": [0, 1, 0]}, {"light": "window*", "scale_radiance": 2}])`.

        folder: where files that entries name are. If an entry is wrong, nothing changes.
        """
        if isinstance(lights, Mapping) or isinstance(materials, Mapping):
            raise TypeError("lights and materials must be lists of entries, not a single entry")
        rig = {"version": 1, "lights": list(lights), "materials": list(materials)}
        self._scene.apply_rig_text(_json_text(rig, "entries"), os.path.join(_arrays.path_of(folder), b"rig"))

    def apply_rig(self, path: str | os.PathLike[str]) -> None:
        """Applies the file of a light rig, as `nusselt render --lights` does."""
        self._scene.apply_rig_file(_arrays.path_of(path))

    @property
    def camera(self) -> dict[str, Any]:
        """The camera and the size of its images, as `nusselt camera` prints them: {"version", "film", "camera"}. Assigning
        such a dictionary, or the path of a file with one, replaces the camera."""
        camera: dict[str, Any] = json.loads(self._scene.camera_text())
        return camera

    @camera.setter
    def camera(self, view: Mapping[str, Any] | str | os.PathLike[str]) -> None:
        if isinstance(view, Mapping):
            self._scene.apply_camera_text(_json_text(view, "a camera"))
        else:
            self._scene.apply_camera_file(_arrays.path_of(view))

    def resize(self, width: int, height: int) -> None:
        """Gives images another size in pixels; the field of view along the shorter axis stays."""
        self._scene.resize(_arrays.whole_number(width, "width"), _arrays.whole_number(height, "height"))

    @property
    def warnings(self) -> list[str]:
        """What the importer skipped or changed: "file:line: message"."""
        return self._scene.warnings

    @property
    def files(self) -> list[str]:
        """The files that the scene was read from, the scene file first."""
        return self._scene.files

    @property
    def materials(self) -> list[dict[str, Any]]:
        """The materials: name, model, diffuse, f0, roughness, exponent, alpha and the index of the diffuse texture."""
        return self._scene.materials

    @property
    def textures(self) -> list[dict[str, Any]]:
        """The textures: name, width, height, channels and path."""
        return self._scene.textures

    @property
    def positions(self) -> Array:
        """The vertices: (vertices, 3) float32 [m], read-only."""
        return self._scene.positions

    @property
    def normals(self) -> Array:
        """Normals of the vertices: (vertices, 3) float32; zero stands for that of the triangle. Read-only."""
        return self._scene.normals

    @property
    def uvs(self) -> Array:
        """Texture coordinates of the vertices: (vertices, 2) float32, read-only."""
        return self._scene.uvs

    @property
    def triangles(self) -> Array:
        """Indices of vertices: (triangles, 3) uint32, read-only. Those of instances are in their own coordinates."""
        return self._scene.triangles

    @property
    def triangle_materials(self) -> Array:
        """The index of the material of each triangle: uint32, read-only."""
        return self._scene.triangle_materials

    @property
    def triangle_lights(self) -> Array:
        """The number of the light of each triangle, -1 for surfaces that do not emit: int32, read-only."""
        return self._scene.triangle_lights

    @property
    def instances(self) -> list[tuple[str, list[float]]]:
        """Copies of objects: the name of the object, and three rows of four numbers from its coordinates to the world."""
        return self._scene.instances

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """The corners of the box around surfaces and lights [m]; low above high if there are none."""
        return self._scene.bounds

    @property
    def radius(self) -> float:
        """Half the diagonal of the bounds [m]."""
        return self._scene.radius

    @property
    def light_count(self) -> int:
        """The number of lights of the renderer, of which one light of a rig may have many."""
        return self._scene.light_count

    @property
    def pixel_samples(self) -> int | None:
        """The samples per pixel that the scene file asks for."""
        return self._scene.pixel_samples

    @property
    def fingerprint(self) -> str:
        """A hash of everything that images depend on."""
        return self._scene.fingerprint()

    def light_report(self) -> str:
        """The lights with their shape and power, as `nusselt info` prints them."""
        return self._scene.light_report()

    def __repr__(self) -> str:
        return f"<nusselt.Scene {self.files[0]}: {len(self.triangles)} triangles, {self.light_count} lights>"


def load(path: str | os.PathLike[str]) -> Scene:
    """The scene of a file."""
    return Scene(path)
