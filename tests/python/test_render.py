"""Renderings have the bits of the command, and can be watched and stopped."""
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import nusselt

SIZE = (64, 36)
WHEN = {"render_seconds", "scene", "light_rigs"}  # metadata that settings do not decide


@pytest.fixture
def room(scenes):
    return nusselt.load(scenes / "room.pbrt")


def command(program, path, scene, *options):
    program("render", scene, "-o", path, "-q", "--resolution", "{}x{}".format(*SIZE), *options)
    return nusselt.Image.load(path)


def assert_same_pixels(image, other):
    assert list(image.layers) and set(image.layers) == set(other.layers)
    for name, data in image.layers.items():
        assert image.channels[name] == other.channels[name], name
        assert np.array_equal(data.view(np.uint32), other.layers[name].view(np.uint32)), name


def assert_same(image, other):
    assert_same_pixels(image, other)
    settings = [{key: text for key, text in i.metadata.items() if key not in WHEN} for i in (image, other)]
    assert settings[0] == settings[1]


@pytest.mark.parametrize("options, settings", [
    ([], {}),
    (["--spp", "4", "--layers", "all", "--light-samples", "lines", "--lines", "4"],
     {"samples": 4, "layers": "all", "light_samples": "lines", "lines": 4}),
    (["--spp", "2", "--technique", "solid_angle", "--strategies", "diffuse+ggx", "--mis", "power", "--sampler",
      "blue_noise", "--seed", "5", "--camera-rays", "1", "--layers", "albedo,diffuse"],
     {"samples": 2, "technique": "solid_angle", "strategies": "diffuse+ggx", "mis": "power", "sampler": "blue_noise",
      "seed": 5, "camera_rays": 1, "layers": "albedo,diffuse"}),
    (["--spp", "2", "--brdf", "lambert", "--pixel-center", "--part", "2/3", "--layers", "normal,depth"],
     {"samples": 2, "brdf": "lambert", "pixel_position": "center", "part": (2, 3), "layers": ["normal", "depth"]}),
    (["--spp", "2", "--visibility-estimate", "0.25", "--emission-sampling", "measure", "--isa", "sse42"],
     {"samples": 2, "visibility_estimate": 0.25, "emission_sampling": "measure", "isa": "sse42"})])
def test_the_room_has_the_bits_of_the_command(options, settings, room, scenes, program, tmp_path):
    expected = command(program, tmp_path / "room.exr", scenes / "room.pbrt", *options)
    image = nusselt.render(room, resolution=SIZE, threads=2, **settings)
    assert_same(image, expected)
    assert image.finished == 1 and image.statistics["primary_rays"] > 0
    assert image.rgb.shape == (SIZE[1], SIZE[0], 3) and image.rgb.max() > 0


def test_edited_lights_have_the_bits_of_rigs(room, scenes, program, tmp_path):
    rig = scenes / "rigs/room-tube.json"
    expected = command(program, tmp_path / "rig.exr", scenes / "room.pbrt", "--spp", "2", "--lights", rig)
    room.apply_rig(rig)
    assert_same(nusselt.render(room, 2, resolution=SIZE), expected)
    room.edit([{"light": 0, "scale_radiance": 1.5}])
    brighter = nusselt.render(room, 2, resolution=SIZE)
    assert nusselt.rmse(brighter, expected) > 0


def test_files_keep_all_that_an_image_has(room, tmp_path):
    image = nusselt.render(room, 2, resolution=SIZE, layers="all")
    image.save(tmp_path / "image.exr")
    assert_same(nusselt.Image.load(tmp_path / "image.exr"), image)
    image.save(tmp_path / "image.png", exposure=1)
    assert nusselt.images.read(tmp_path / "image.png").shape == image.rgb.shape


def test_parts_join_to_the_whole_image(room):
    parts = {f"part {i}": nusselt.render(room, 2, resolution=SIZE, part=(i, 3)) for i in (1, 2, 3)}
    whole = nusselt.render(room, 2, resolution=SIZE)
    assert np.array_equal(nusselt.images.merge(parts).rgb, whole.rgb)
    with pytest.raises(RuntimeError, match="part 1"):
        nusselt.images.merge({"part 1": parts["part 1"], "again": parts["part 1"]})


def test_parts_that_are_missing_are_named(room):
    parts = {str(i): nusselt.render(room, resolution=SIZE, part=(i, 3)) for i in (1, 2)}
    with pytest.raises(RuntimeError, match="some pixels have no samples: part 3/3 is missing"):
        nusselt.images.merge(parts)
    image = nusselt.images.merge(parts, partial=True)
    assert (image.layers["samples"] == 0).any() and image.rgb.any()


def test_files_of_parts_are_those_of_the_command(room, scenes, program, tmp_path):
    paths = [tmp_path / f"{i}.exr" for i in (1, 2)]
    for i, path in enumerate(paths, 1):
        nusselt.render(room, 2, resolution=SIZE, layers="all", part=(i, 2)).save(path)
    part = command(program, tmp_path / "command.exr", scenes / "room.pbrt", "--spp", "2", "--layers", "all", "--part", "2/2")
    whole = nusselt.render(room, 2, resolution=SIZE, layers="all")
    assert 0 < (part.rgb == 0).all(axis=2).mean() < 1 and "tiles" not in part.metadata
    assert paths[1].stat().st_size < 1.05 * (tmp_path / "command.exr").stat().st_size, "both hold their tiles only"
    for path in paths:
        nusselt.Image.load(path).save(path)
    program("merge", *paths, "-o", tmp_path / "whole.exr")
    assert_same_pixels(nusselt.Image.load(tmp_path / "whole.exr"), whole)
    loaded = {path.name: nusselt.Image.load(path) for path in paths}
    assert_same_pixels(nusselt.images.merge(loaded), whole)
    loaded["2.exr"].rgb[part.rgb > 0] += 1
    with pytest.raises(RuntimeError, match="2.exr.*not those that were written"):
        nusselt.images.merge(loaded)
    part.data_window = (1, 0, *SIZE)
    with pytest.raises(ValueError, match="a part of a rendering, whose data window must stay"):
        part.save(paths[1])


def test_the_command_has_the_settings_of_python(program):
    help_text = subprocess.run([os.environ["NUSSELT_PROGRAM"], "render", "--help"], check=True, capture_output=True,
                               text=True).stdout
    for setting, names in nusselt.setting_names().items():
        assert all(name in help_text for name in names), setting


@pytest.mark.parametrize("settings, message", [
    ({"technique": "best"}, "technique: unknown setting 'best'; use one of area"),
    ({"strategies": "diffuse+ltc", "technique": "area"}, "not supported with technique area"),
    ({"samples": 0}, "must lie between 1 and"),
    ({"samples": "many"}, "samples must be a whole number below 2.31, not 'many'"),
    ({"samples": 2**31}, "samples must be a whole number below 2.31, not 2147483648"),
    ({"seed": -1}, "seed must be a whole number from 0 to 2.32 - 1, not -1"),
    ({"visibility_estimate": "high"}, "visibility_estimate must be a number, not 'high'"),
    ({"lines": 4}, "lines needs light_samples=\"lines\""),
    ({"layers": "depths"}, "layers: unknown setting 'depths'"),
    ({"layers": "all,depths"}, "layers: unknown setting 'depths'"),
    ({"layers": ["all", "depths"]}, "layers: unknown setting 'depths'"),
    ({"resolution": 64}, r"resolution must be the pair \(width, height\), not 64"),
    ({"isa": "mmx"}, "isa: unknown instruction set 'mmx'"),
    ({"threads": 0}, "threads must be at least 1"),
    ({"part": (3, 2)}, "found 3 of 2"),
    ({"part": "1/2"}, "part must be a pair of whole numbers, not '1/2'"),
    ({"layers": 3}, "layers must be a name or a list of names, not 3"),
    ({"backend": "cuda"}, "backend: unknown renderer 'cuda'; use cpu, vulkan or auto"),
    ({"backend": "vulkan", "isa": "sse42"}, "isa is not supported with backend=\"vulkan\""),
    ({"shadow_rays": "none"}, "shadow_rays is not supported with backend=\"cpu\"")])
def test_wrong_settings_are_errors(settings, message, room):
    with pytest.raises(ValueError, match=message):
        nusselt.render(room, **{"resolution": (8, 8), **settings})


def test_settings_of_wrong_types_are_errors(room, scenes):
    for settings, message in [({"isa": 5}, "isa must be a text, not 5"), ({"backend": None}, "backend must be a text"),
                              ({"resolution": (8.5, 8)}, "width must be a whole number, not 8.5"),
                              ({"backend": "vulkan", "device": 0.5}, "device must be a whole number")]:
        with pytest.raises(TypeError, match=message):
            nusselt.render(room, **settings)
    with pytest.raises(TypeError, match=r"scene must be a Scene, which nusselt.load\(\) makes of a file, not '.*room.pbrt'"):
        nusselt.render(str(scenes / "room.pbrt"))


def test_the_renderer_is_chosen_by_what_is_there(room):
    """The bits of the processor, unless there is a GPU that is no software."""
    image = nusselt.render(room, resolution=SIZE, backend="auto", layers="albedo")  # which GPUs do not support
    assert_same(image, nusselt.render(room, resolution=SIZE, layers="albedo"))
    image = nusselt.render(room, resolution=SIZE, backend="auto", isa="sse42")
    assert_same(image, nusselt.render(room, resolution=SIZE, isa="sse42"))


@pytest.mark.parametrize("name", ["television", "neon", "street"])
def test_lights_whose_radiance_varies_have_the_bits_of_the_command(name, scenes, program, tmp_path):
    path = scenes / f"{name}.pbrt"
    expected = command(program, tmp_path / "image.exr", path, "--spp", "2", "--layers", "lights")
    assert_same(nusselt.render(nusselt.load(path), 2, resolution=SIZE, layers="lights"), expected)


def test_gpus_are_chosen_as_by_the_command(room, scenes, program, tmp_path):
    settings = {"technique": "area", "brdf": "lambert", "pixel_position": "center"}  # of which drivers compile the least
    try:
        image = nusselt.render(room, resolution=SIZE, backend="vulkan", shadow_rays="bvh", **settings)
    except RuntimeError as error:
        pytest.skip(str(error))
    expected = command(program, tmp_path / "gpu.exr", scenes / "room.pbrt", "--backend", "vulkan", "--shadow-rays", "bvh",
                       "--technique", "area", "--brdf", "lambert", "--pixel-center")
    assert_same(image, expected)
    on_processor = nusselt.render(room, resolution=SIZE, **settings)
    assert nusselt.images.compare(image, on_processor)["relative_rmse"] < 0.05


def test_progress_grows_and_can_stop_a_rendering(room):
    seen = []
    nusselt.render(room, 64, resolution=SIZE, progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == 1
    for answer in (False, np.False_, 0):
        image = nusselt.render(room, 1 << 16, progress=lambda fraction: answer)
        assert 0 <= image.finished < 1 and image.metadata["finished_fraction"] != "1"


@pytest.mark.parametrize("work", [
    "nusselt.render(scene, 1 << 18)", "nusselt.render(scene, 1 << 18, progress=lambda _: None)",
    "while True: light.sample(u)", "while True: nusselt.render(scene, 1, resolution=(64, 36))"])
def test_daemons_do_not_stop_python_from_ending(work, scenes):
    script = f"""
import nusselt, numpy, threading, time
scene = nusselt.load({str(scenes / "room.pbrt")!r})
light = nusselt.PolygonArea([[-1, -1, 1], [1, -1, 1], [1, 1, 1]])
u = numpy.full((100000, 2), 0.5)
def work():
    {work}
threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
print("ended")
"""
    child = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert (child.returncode, child.stdout) == (0, "ended\n"), child.stderr


def test_exceptions_of_progress_end_the_rendering(room):
    def fail(fraction):
        raise KeyError("stop")
    with pytest.raises(KeyError):
        nusselt.render(room, 1 << 16, progress=fail)


def test_ctrl_c_ends_the_rendering(scenes):
    script = f"import nusselt; s = nusselt.load({str(scenes / 'room.pbrt')!r}); tell = iter(['begun']); " \
             "nusselt.render(s, 1 << 18, progress=lambda _: [print(word, flush=True) for word in tell] or None)"
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begun\n"
    child.send_signal(signal.SIGINT)
    _, errors = child.communicate(timeout=60)
    assert child.returncode != 0 and "KeyboardInterrupt" in errors


def test_other_threads_run_meanwhile(room):
    ticks = 0
    stop = threading.Event()

    def tick():
        nonlocal ticks
        while not stop.wait(0.01):
            ticks += 1
    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    nusselt.render(room, 256, resolution=(128, 72))
    seconds = time.perf_counter() - begin
    stop.set()
    thread.join()
    # A hundred in a second, of which a machine that is busy with other tests may lose most.
    assert ticks > 10 * seconds
