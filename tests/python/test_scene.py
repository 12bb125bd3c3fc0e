"""Scenes: what they contain, and edits of lights, materials and camera."""
import copy
import json
import os
import pickle
import shutil
import threading

import numpy as np
import pytest

import nusselt


@pytest.fixture
def room(scenes):
    return nusselt.load(scenes / "room.pbrt")


def test_a_scene_shows_its_content(room):
    assert room.positions.dtype == np.float32 and room.positions.shape[1] == 3
    assert room.triangles.max() < len(room.positions) and len(room.triangle_lights) == len(room.triangles)
    assert room.triangle_lights.max() < room.light_count > 0
    assert (room.triangle_materials < len(room.materials)).all()
    assert room.files[0].endswith("room.pbrt") and isinstance(room.warnings, list)
    low, high = room.bounds
    assert np.isclose(np.linalg.norm(np.subtract(high, low)) / 2, room.radius)
    assert set(room.materials[0]) >= {"name", "model", "diffuse", "f0", "roughness"}
    assert len(room.lights) >= 1 and "lights" in room.light_report()
    with pytest.raises(ValueError, match="read-only"):
        room.positions[0] = 0


def test_lights_round_trip(room):
    before = room.lights
    room.edit(before)
    assert room.lights == before


def test_edits_change_lights_and_nothing_else(room):
    name = room.lights[0]["name"]
    other = room.copy()
    positions = room.positions
    room.edit([{"light": name, "scale_radiance": 2}])
    before, after = other.lights[0], room.lights[0]
    (quantity,) = {"radiance", "intensity", "irradiance"} & set(before)
    assert np.allclose(np.array(after[quantity]), 2 * np.array(before[quantity]))
    assert room.fingerprint != other.fingerprint
    assert np.array_equal(positions, other.positions), "arrays outlive edits"
    room.edit([{"add": "panel", "panel": {"center": [0, 1, 0], "normal": [0, -1, 0], "width": 1, "height": 1},
                "radiance": 5}], [{"material": 0, "diffuse": 0.5}])
    assert room.lights[-1]["name"] == "panel" and len(room.lights) == len(other.lights) + 1
    assert room.materials[0]["diffuse"] == (0.5, 0.5, 0.5)


def test_wrong_edits_are_errors_and_change_nothing(room):
    before = room.fingerprint
    for entry, message in [({"light": "nobody", "move": [0, 1, 0]}, r"rig: lights\[0\].*nobody"),
                           ({"light": 0, "colour": [1, 1, 1]}, 'unknown field "colour"; did you mean "radiance"'),
                           ({"light": 0, "power": -1}, r"lights\[0\]\.power"),
                           ({"add": "lamp"}, "must have a shape")]:
        with pytest.raises(RuntimeError, match=message):
            room.edit([entry])
    for error, message, entries in [
            (ValueError, "entries must not have numbers that are infinite or NaN", [{"light": 0, "move": [np.nan, 0, 0]}]),
            (TypeError, "a set is nothing that light rigs", [{"light": 0, "move": {1, 2, 3}}]),
            (TypeError, "must be lists of entries", {"light": 0})]:
        with pytest.raises(error, match=message):
            room.edit(entries)
    for size in ((1.5, 2), ("64", 2), (2**31, 1), (None, 1)):
        with pytest.raises((TypeError, ValueError), match="width must be"):
            room.resize(*size)
    assert room.fingerprint == before


def test_edits_take_numbers_and_arrays_of_numpy(room):
    other = room.copy()
    room.edit([{"light": np.int64(0), "move": np.array([0, 0.5, 0]), "scale_radiance": np.float32(2)}])
    other.edit([{"light": 0, "move": [0, 0.5, 0], "scale_radiance": 2}])
    assert room.fingerprint == other.fingerprint
    view = room.camera
    view["camera"]["origin"] = np.array(view["camera"]["origin"]) + 1
    room.camera = view
    assert room.camera["camera"]["origin"] == view["camera"]["origin"].tolist()


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda scene: scene.copy()])
def test_copies_are_edited_alone(duplicate, room):
    before = room.fingerprint
    other = duplicate(room)
    assert other.fingerprint == before
    other.edit([{"light": 0, "scale_radiance": 2}])
    assert room.fingerprint == before != other.fingerprint


def test_scenes_say_why_they_are_not_pickled(room):
    with pytest.raises(TypeError, match="load it in each process"):
        pickle.dumps(room)


def test_names_of_files_need_not_be_unicode(scenes, tmp_path):
    shutil.copytree(scenes / "shapes", tmp_path / "shapes")
    name = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.pbrt")
    shutil.copy(scenes / "room.pbrt", name)
    room = nusselt.load(name)
    assert room.files[0] == name
    before = room.lights
    room.edit(before)
    assert room.lights == before
    assert isinstance(room.light_report(), str) and isinstance(repr(room), str)
    with pytest.raises(RuntimeError, match=r"xfe.pbrt': no such file"):
        nusselt.load(os.fsdecode(os.fsencode(tmp_path) + b"/\xfe.pbrt"))
    with pytest.raises(ValueError, match="must not have zeros"):
        nusselt.load("room\0.pbrt")


def test_edits_of_several_threads_all_count(room):
    before = len(room.lights)

    def edit(name):
        for i in range(20):
            room.edit([{"add": f"{name} {i}", "radiance": 5,
                        "panel": {"center": [0, 1, 0], "normal": [0, -1, 0], "width": 1, "height": 1}}])
    threads = [threading.Thread(target=edit, args=[name]) for name in "abc"]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert len(room.positions) == len(room.normals.copy()) > 0
    assert len(room.lights) == before + 60


def test_rigs_in_files_are_applied(room, scenes, tmp_path):
    rig = tmp_path / "rig.json"
    rig.write_text(json.dumps({"version": 1, "lights": [{"light": "*", "scale_radiance": 3}]}))
    by_dictionary = room.copy()
    room.apply_rig(rig)
    by_dictionary.edit([{"light": "*", "scale_radiance": 3}])
    assert room.fingerprint == by_dictionary.fingerprint


def test_cameras_can_be_changed(room):
    view = room.camera
    before = room.fingerprint
    room.camera = view
    moved = json.loads(json.dumps(view))
    moved["camera"]["origin"][0] += 0.1
    moved["film"] = [64, 32]
    room.camera = moved
    assert room.camera["film"] == [64, 32] and np.isclose(room.camera["camera"]["origin"][0], moved["camera"]["origin"][0])
    assert room.fingerprint != before
    room.resize(20, 10)
    assert room.camera["film"] == [20, 10]
    with pytest.raises(RuntimeError, match=r'camera: .*"zoom"'):
        room.camera = {**moved, "zoom": 2}


def test_files_that_are_no_scenes_are_errors(tmp_path):
    with pytest.raises(RuntimeError, match="missing.pbrt"):
        nusselt.load(tmp_path / "missing.pbrt")
    wrong = tmp_path / "wrong.pbrt"
    wrong.write_text("WorldBegin\nShape \"sphere\" \"float radius\" [\n")
    with pytest.raises(RuntimeError, match=r"wrong.pbrt:\d+"):
        nusselt.load(wrong)
