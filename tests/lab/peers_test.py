#!/usr/bin/env python3
"""Tests of lab/peers without any peer: scenes as peers get them, statistics, results, and the skip without Blender."""
import contextlib
import io
import json
import math
import pathlib
import random
import struct
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # nothing new in the folders of the sources
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "lab/peers"))

import compare  # noqa: E402
import cycles_geometry as geometry  # noqa: E402
import image_statistics as statistics  # noqa: E402
import pbrt_scene  # noqa: E402
import renderers  # noqa: E402
import results  # noqa: E402


def area(mesh):
    """Of the triangles of a mesh."""
    total = 0
    for a, b, c in mesh["triangles"]:
        p, q, r = (mesh["positions"][i] for i in (a, b, c))
        total += math.hypot(*pbrt_scene.cross(geometry.add(q, p, -1), geometry.add(r, p, -1))) / 2
    return total


def area_vector(positions, polygons):
    """The sum of the normals of polygons, times their areas, and the volume that they enclose if it vanishes."""
    total, volume = [0.0] * 3, 0.0
    for polygon in polygons:
        p, *others = (positions[i] for i in polygon)
        for q, r in zip(others, others[1:]):
            normal = pbrt_scene.cross(geometry.add(q, p, -1), geometry.add(r, p, -1))
            total = geometry.add(total, normal, 0.5)
            volume += geometry.dot(p, normal) / 6
    return total, volume


class Case(unittest.TestCase):
    def assertClose(self, a, b, tolerance=1e-9):
        """Rounding of a few operations on numbers of about one."""
        self.assertEqual(len(a), len(b))
        self.assertLessEqual(math.dist(a, b), tolerance, f"{a} and {b}")


class Scenes(Case):
    def test_panel_has_the_surfaces_of_the_file(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/cornell-panel.pbrt")
        self.assertEqual(scene["film"], [512, 512])
        self.assertEqual([len(mesh["triangles"]) for mesh in scene["meshes"]], [2] * 5 + [12] * 2)
        areas = [area(mesh) for mesh in scene["meshes"]]
        self.assertClose(areas, [4] * 5 + [2 * 0.36 + 4 * 0.72, 6 * 0.58**2])
        names = [scene["materials"][mesh["material"]]["name"] for mesh in scene["meshes"]]
        self.assertEqual(names, ["white"] * 3 + ["red", "green"] + ["white"] * 2)
        self.assertEqual(scene["materials"][1],
                         {"name": "red", "diffuse": [0.63, 0.065, 0.05], "f0": [0.04] * 3, "roughness": 1})
        light, = scene["lights"]
        self.assertEqual(light["radiance"], [7, 6.6, 6])
        self.assertTrue(light["two_sided"])
        self.assertEqual(light["polygon"][2], [0.9, 1.62, 0.7])

    def test_transforms_apply_in_the_order_of_pbrt(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/cornell-panel.pbrt")
        # The corner (0.5, 1, 0.5) of the unit box, scaled, turned by 18 degrees about y, and moved.
        c, s = math.cos(math.radians(18)), math.sin(math.radians(18))
        expected = [0.3 * c + 0.3 * s - 0.36, 1.2, -0.3 * s + 0.3 * c - 0.36]
        self.assertClose(scene["meshes"][5]["positions"][6], expected)

    def test_camera_of_the_box_looks_along_minus_z(self):
        camera = pbrt_scene.read_scene(ROOT / "scenes/cornell-panel.pbrt")["camera"]
        t = math.tan(math.radians(16.5))
        self.assertClose(camera["origin"], [0, 1, 4.6])
        self.assertClose(camera["corner"], [-t, t, -1])
        self.assertClose(camera["right"], [2 * t, 0, 0])
        self.assertClose(camera["down"], [0, -2 * t, 0])

    def test_camera_of_the_room_looks_at_its_target(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/room.pbrt")
        camera = scene["camera"]
        self.assertClose(camera["origin"], [0.9, 1.45, 3.4])
        forward = geometry.add(geometry.add(camera["corner"], camera["right"], 0.5), camera["down"], 0.5)
        self.assertClose(pbrt_scene.unit(forward), pbrt_scene.unit([-0.25 - 0.9, 0.95 - 1.45, -1 - 3.4]))
        t = 2 * math.tan(math.radians(22))
        lengths = [math.hypot(*camera[name]) for name in ("right", "down")]
        self.assertClose(lengths, [t * 16 / 9, t])
        self.assertAlmostEqual(camera["right"][1], 0)
        self.assertGreater(camera["right"][0], 0)  # not mirrored
        self.assertLess(camera["down"][1], 0)
        axes, angle = geometry.camera_axes(scene["film"], camera)
        self.assertClose(pbrt_scene.cross(axes[0], axes[1]), axes[2])
        self.assertAlmostEqual(math.degrees(angle), 71.38, delta=0.01)  # the field of view that `nusselt info` prints

    def test_room_has_all_materials_and_lights(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/room.pbrt")
        # nusselt info counts 396, with two for each of the two polygons that emit.
        self.assertEqual(sum(len(mesh["triangles"]) for mesh in scene["meshes"]), 392)
        materials = {m["name"]: m for m in scene["materials"]}
        self.assertEqual(len(materials), 12)
        self.assertAlmostEqual(materials["parquet"]["roughness"], 0.015**0.25)
        self.assertIsNone(materials["wall"]["f0"])
        self.assertEqual(materials["brass"]["diffuse"], [0, 0, 0])
        self.assertAlmostEqual(materials["brass"]["f0"][1], (0.473**2 + 2.765**2) / (1.527**2 + 2.765**2))
        tube, down, up = scene["lights"]
        self.assertEqual((tube["tube"]["radius"], tube["finite"]), (0.013, True))
        self.assertEqual([down["two_sided"], up["two_sided"]], [False, False])

    def test_tube_is_a_light_without_caps(self):
        light, = pbrt_scene.read_scene(ROOT / "scenes/cornell-tube.pbrt")["lights"]
        self.assertEqual(light, {"radiance": [120, 112, 100], "finite": False,
                                 "tube": {"begin": [0.1, 1.96, -0.98], "end": [0.1, 1.96, 0.9], "radius": 0.01}})

    def test_a_camera_beside_the_axis_keeps_its_direction(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/cornell-panel.pbrt")
        camera = pbrt_scene.aside(scene)["camera"]
        self.assertEqual(camera["corner"], scene["camera"]["corner"])
        # Less than a pixel of 256 even at the distance of the front edge, and no edge of the room stays on the axis.
        x, y, z = geometry.add(camera["origin"], scene["camera"]["origin"], -1)
        self.assertTrue(0 < x < 0.6 * 3.6 / 256 and 0 < y < x and z == 0)

    def test_changes_of_scenes(self):
        scene = pbrt_scene.read_scene(ROOT / "scenes/cornell-panel.pbrt")
        dull = pbrt_scene.matte(scene)
        self.assertEqual([m["f0"] for m in dull["materials"]], [None] * 3)
        self.assertEqual(dull["materials"][0]["diffuse"], [0.73] * 3)
        self.assertFalse(pbrt_scene.one_sided(scene)["lights"][0]["two_sided"])
        self.assertTrue(scene["lights"][0]["two_sided"])
        self.assertEqual(pbrt_scene.resized(scene, 64, 64)["film"], [64, 64])
        with self.assertRaises(ValueError):
            pbrt_scene.resized(scene, 64, 65)

    def test_anything_beyond_the_subset_is_an_error(self):
        head = ('Film "rgb" "integer xresolution" 8 "integer yresolution" 8\n'
                'Camera "perspective" "float fov" 40\nWorldBegin\n')
        matte = 'MakeNamedMaterial "a" "string type" "diffuse" "rgb reflectance" [ 1 1 1 ]'
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "scene.pbrt")
            for text, message in [('Shape "sphere" "float radius" 1', "P"),
                                  ('LightSource "infinite"', "LightSource"),
                                  ('MakeNamedMaterial "a" "string type" "hair"', "hair"),
                                  (matte + ' "float sigma" 1', "sigma"),
                                  ('NamedMaterial "b"', "b"),
                                  ('Shape "polygon" "point3 P" [ 0 0 0 1 1 ]', "three numbers")]:
                file.write_text(head + text)
                with self.assertRaisesRegex(ValueError, message, msg=text):
                    pbrt_scene.read_scene(file)
            file.write_text(head)
            self.assertEqual(pbrt_scene.read_scene(file)["lights"], [])


class Lights(Case):
    def test_lamps_have_the_power_of_the_radiance_and_shine_to_the_right_side(self):
        lamp = geometry.lamp_of([[0, 2, 0], [3, 2, 0], [3, 2, 0.5], [0, 2, 0.5]], [4, 2, 1])
        self.assertClose(lamp["center"], [1.5, 2, 0.25])
        self.assertAlmostEqual(lamp["power"], 4 * 1.5 * 4)
        self.assertEqual(lamp["color"], [1, 0.5, 0.25])
        self.assertClose(lamp["axes"][2], [0, 1, 0])  # shines along -z, downwards
        self.assertClose(pbrt_scene.cross(lamp["axes"][0], lamp["axes"][1]), lamp["axes"][2])
        with self.assertRaises(ValueError):
            geometry.lamp_of([[0, 0, 0], [1, 0, 0], [1.1, 1, 0], [0, 1, 0]], [1, 1, 1])

    def test_other_side(self):
        polygon = [[0, 2, 0], [3, 2, 0], [3, 2, 0.5], [0, 2, 0.5]]
        lamp = geometry.lamp_of(geometry.reversed_side(polygon), [1, 1, 1])
        self.assertClose(lamp["axes"][2], [0, -1, 0])
        self.assertAlmostEqual(geometry.occluder_of(polygon)[0][1], 2 + geometry.OCCLUDER_OFFSET)

    def test_tubes_as_meshes_have_the_area_of_the_cylinder(self):
        tube = {"begin": [1, 2, 3], "end": [1.5, 2.25, 2], "radius": 0.01}
        length = math.dist(tube["begin"], tube["end"])
        positions, sides = geometry.tube_mesh(tube, False)
        self.assertEqual((len(positions), len(sides)), (2 * geometry.TUBE_SIDES, geometry.TUBE_SIDES))
        lateral = sum(area({"positions": positions, "triangles": [[a, b, c], [a, c, d]]}) for a, b, c, d in sides)
        self.assertAlmostEqual(lateral, 2 * math.pi * 0.01 * length)
        positions, closed = geometry.tube_mesh(tube, True)
        total, volume = area_vector(positions, closed)
        self.assertClose(total, [0, 0, 0])
        # All sides face outwards. Of equal perimeters, the regular polygon encloses less than the circle.
        half_angle = math.pi / geometry.TUBE_SIDES
        self.assertAlmostEqual(volume / (math.pi * 1e-4 * length), half_angle / math.tan(half_angle))


class Statistics(Case):
    def image(self, *values):
        return statistics.Image(len(values) // 3, 1, values)

    def test_errors_leave_masked_pixels_out(self):
        reference, image = self.image(1, 1, 1, 2, 2, 2, 90, 90, 90), self.image(1, 1, 2, 2, 4, 2, 0, 0, 0)
        errors = statistics.mean_squared_errors(image, reference, bytes([1, 1, 0]))
        self.assertClose(errors, [5 / 6, (1 / 1.01 + 4 / 4.01) / 6])
        self.assertClose(statistics.mean_squared_errors(image, reference, bytes([0, 1, 0])), [4 / 3, 4 / 4.01 / 3])
        self.assertGreater(statistics.mean_squared_errors(image, reference, bytes([1, 1, 1]))[0], 2000)
        self.assertAlmostEqual(statistics.mean(image, bytes([1, 1, 0])), 2)
        self.assertEqual(statistics.all_of(bytes([1, 1, 0]), [True, False, True]), bytes([1, 0, 0]))

    def test_useless_images_are_errors(self):
        image = self.image(1, 1, 1, math.nan, 1, 1)
        self.assertEqual(statistics.mean(image, bytes([1, 0])), 1)
        for call in [lambda: statistics.mean(image, bytes([1, 1])),
                     lambda: statistics.mean_squared_errors(image, image, bytes([1, 1])),
                     lambda: statistics.mean(image, bytes([0, 0])),
                     lambda: statistics.mean_squared_errors(image, image, bytes([0, 0])),
                     lambda: statistics.mean(image, bytes([1])),
                     lambda: statistics.mean_squared_errors(image, self.image(1, 1, 1), bytes([1])),
                     lambda: statistics.all_of(bytes([1]), bytes([1, 1])),
                     lambda: statistics.Image(2, 2, [1, 2, 3])]:
            self.assertRaises(ValueError, call)

    def test_medians_ignore_one_slow_repetition(self):
        self.assertEqual(statistics.median_and_spread([1, 2, 3, 4, 100])[0], 3)
        self.assertAlmostEqual(statistics.median_and_spread([1, 2, 3, 4, 100])[1], 2 / 3)
        self.assertEqual(statistics.median_and_spread([7]), (7, None))

    def test_times_are_those_of_samples_alone(self):
        # 3 s for anything else, and 0.25 s for each sample.
        self.assertAlmostEqual(statistics.time_per_samples(3 + 16 * 0.25, 16, 3 + 0.25), 16 * 0.25)
        self.assertRaises(ValueError, statistics.time_per_samples, 3, 16, 3)
        self.assertRaises(ValueError, statistics.time_per_samples, 4, 1, 3)

    def test_noise_of_references_does_not_count(self):
        source = random.Random(5)
        samples, reference_samples, pixels = 4, 16, 4000

        def image(count):
            return [sum(source.gauss(0, 1) for _ in range(count)) / count for _ in range(pixels)]

        reference, few = image(reference_samples), image(samples)
        error = sum((a - b) ** 2 for a, b in zip(few, reference)) / pixels
        corrected, = compare.without_noise_of(reference_samples, samples, [error])
        self.assertAlmostEqual(corrected * samples, 1, delta=0.08)
        self.assertGreater(error * samples, 1.12, "uncorrected")

    def test_efficiency_does_not_depend_on_the_number_of_independent_samples(self):
        self.assertEqual(statistics.efficiency(0.5, 2), statistics.efficiency(0.125, 8))
        self.assertRaises(ValueError, statistics.efficiency, 0, 1)
        self.assertEqual(statistics.samples_of_equal_time(16, 1, 7.9), 64)
        self.assertEqual(statistics.samples_of_equal_time(16, 1, 8.1), 128)

    def test_pfm_of_either_byte_order(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "image.pfm")
            for scale, order in (("-1.0", "<"), ("1.0", ">")):
                file.write_bytes(f"PF\n2 1\n{scale}\n".encode() + struct.pack(f"{order}6f", 1, 2, 3, 10, 0.5, 6))
                image = statistics.read_pfm(file)
                self.assertEqual([*image.pixels()], [(1, 2, 3), (10, 0.5, 6)])
            file.write_bytes(b"P6\n2 1\n255\n......")
            self.assertRaises(ValueError, statistics.read_pfm, file)


class ConstructedRenderer:
    """Renders a constant image with a constant error, in a time in proportion to the samples."""

    def __init__(self, value, error, time):
        self.value, self.error, self.time, self.seeds = value, error, time, []

    def image(self, value):
        return statistics.Image(2, 1, [value] * 3 + [99.0 + value] * 3)  # the second pixel is an emitter

    def result(self, samples, seed):
        self.seeds.append(seed)
        return self.image(self.value + self.error), {"cpu": self.time * samples, "wall": 1, "isa": "none"}


    def version(self):
        return "constructed"


class ConstructedNusselt(ConstructedRenderer):
    def render(self, case, samples, seed):
        return self.result(samples, seed)

    def reference(self, case, samples, seed):
        return self.image(self.value), bytes([1, 0])


class ConstructedCycles(ConstructedRenderer):
    def renders(self, case, several, samples, seed):
        return [self.one(settings, samples, seed) for settings in several]

    def one(self, settings, samples, seed):
        image, times = self.result(samples, seed)
        slowdown = 1 if settings["lamps"] == "mesh" and settings["roulette"] == 0 else 3
        return image, {**times, "cpu": slowdown * times["cpu"]}

    def reference(self, case, settings, samples, seed):
        return self.image(self.value), bytes([1, 1])


class Driver(Case):
    def measured(self, cycles_mean):
        case = next(case for case in compare.cases() if case.slug == "panel")
        options = compare.options_of(["--repetitions", "3", "--reference-samples", str(10**12)])
        nusselt, cycles = ConstructedNusselt(1.0, 0.125, 0.5), ConstructedCycles(cycles_mean, 0.5, 2)
        with contextlib.redirect_stderr(io.StringIO()):
            found = compare.measure(case, nusselt, cycles, options)
        self.assertEqual(nusselt.seeds, [1, 1, 2, 2, 3, 3])
        tables = {}
        for name, columns in (compare.RENDERINGS, compare.RATIOS, compare.REFERENCES):
            names = [column if isinstance(column, str) else column[0] for column in columns]
            tables[name] = [dict(zip(names, row, strict=True)) for row in found[name]]
        return tables

    def test_ratios_of_constructed_renderers(self):
        found = self.measured(1.0)
        ratios, = found["ratios"]
        for name, expected in [("time_ratio", 4), ("error_ratio", 16), ("efficiency_ratio", 64), ("lowest_ratio", 64),
                               ("highest_ratio", 64), ("equal_time_samples", 64), ("equal_time_time_ratio", 1),
                               ("equal_time_error_ratio", 16)]:
            self.assertAlmostEqual(ratios[name], expected, msg=name)
        self.assertTrue(ratios["meets_target"])
        reference, = found["references"]
        self.assertEqual((reference["lamps"], reference["roulette"], reference["pixels"]), ("mesh", 0, 1))
        self.assertTrue(reference["means_agree"])
        self.assertEqual([row["renderer"] for row in found["renderings"]], ["nusselt", "cycles", "nusselt, equal time"])
        self.assertAlmostEqual(found["renderings"][1]["mse"], 0.25)

    def test_means_that_differ_are_reported(self):
        self.assertFalse(self.measured(1.02)["references"][0]["means_agree"])
        self.assertTrue(self.measured(1.009)["references"][0]["means_agree"])

    def test_files_keep_rows_of_other_scenes_and_say_what_was_not_run(self):
        known = {case.slug: case for case in compare.cases()}
        good, broken = ConstructedCycles(1.0, 0.5, 2), ConstructedCycles(math.nan, 0.5, 2)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "peers.json")

            def tables(cycles, *more):
                options = compare.options_of(["--json", str(file), *more])
                names = options.scenes.split(",") if options.scenes else [*known]
                with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                    status = compare.compare(options, known, names, ConstructedNusselt(1.0, 0.125, 0.5), cycles)
                found = {table["name"]: table["rows"] for table in json.loads(file.read_text())["tables"]}
                return status, [row[0] for row in found["ratios"]], dict(found["not_run"])

            rest = dict.fromkeys(["panel", "panel-below", "metal-planes", "room-matte"], "not selected")
            self.assertEqual(tables(good, "--scenes", "room,tube"), (0, ["tube", "room"], rest))
            failed = {**rest, "panel": "the mean of an image is not finite"}
            self.assertEqual(tables(broken, "--scenes", "panel"), (1, ["tube", "room"], failed))
            del failed["panel"]
            self.assertEqual(tables(good, "--scenes", "panel"), (0, ["panel", "tube", "room"], failed))
            with self.assertRaisesRegex(ValueError, "repetitions"):
                tables(good, "--scenes", "tube", "--repetitions", "2")
            self.assertEqual(tables(good), (0, [*known], {}))

    def test_files_without_results_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "other.json")
            for text in ("{", "{}", "[]", '{"settings": {}, "tables": [1]}'):
                file.write_text(text)
                with self.assertRaisesRegex(ValueError, "other.json has no results"):
                    results.rows_of_other_scenes(file, [], {})

    def test_missed_targets_are_reported(self):
        case = next(case for case in compare.cases() if case.slug == "panel")
        ours, theirs = compare.Series(16), compare.Series(16)
        for _ in range(2):
            ours.add((1, 1), {"cpu": 1, "wall": 1})
            theirs.add((2, 3), {"cpu": 3.9, "wall": 1})
        columns = compare.RATIOS[1]
        relative = compare.ratios_of(case, ours, theirs, ours)[columns.index("rel_mse_efficiency_ratio")]
        self.assertAlmostEqual(relative, 3 * 3.9)
        self.assertIs(compare.ratios_of(case, ours, theirs, ours)[columns.index("meets_target")], False)
        theirs.errors = [2.1, 2.1]
        self.assertIs(compare.ratios_of(case, ours, theirs, ours)[columns.index("meets_target")], True)

    def test_options_are_checked_before_anything_is_rendered(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "file")
            file.write_text("")
            for wrong, message in [(["--repetitions", "0"], "repetitions"), (["--samples", "1"], "at least 2"),
                                   (["--samples", "many"], "samples"), (["--reference-samples", "-1"], "at least 1"),
                                   (["--shrink", "3"], "shrink"), (["--scenes", "panel,no-such"], "no scene 'no-such'"),
                                   (["--scenes", ""], "no scene ''"), (["--scenes", "tube,tube"], "twice"),
                                   (["--work", str(file)], "no folder"),
                                   (["--json", f"{folder}/missing/peers.json"], "cannot write")]:
                errors = io.StringIO()
                with self.assertRaises(SystemExit) as caught, contextlib.redirect_stderr(errors):
                    compare.main([*wrong, "--blender", "no-such-blender"])
                self.assertEqual(caught.exception.code, 2, wrong)
                self.assertIn(message, errors.getvalue())

    def test_files_of_a_scene(self):
        files = pbrt_scene.files_of(ROOT / "scenes/cornell-panel.pbrt")
        self.assertEqual([file.relative_to(ROOT).as_posix() for file in files],
                         ["scenes/cornell-panel.pbrt", "scenes/shapes/cornell-box.pbrt", "scenes/shapes/box.pbrt"])

    def test_without_blender_there_is_a_visible_skip(self):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = compare.main(["--blender", "no-such-blender"])
        self.assertEqual(status, 77)
        self.assertIn("skipped: no program no-such-blender", output.getvalue())

    def test_times_from_the_output_of_blender(self):
        output = ('x] Render time (without synchronization): 0.5\nrendering: {"cpu": 2}\n'
                  'rendering: {"cpu": 3}\n')
        expected = [{"cpu": 2, "render_wall": 0.5}, {"cpu": 3, "render_wall": None}]
        self.assertEqual(renderers.times_of(output, 2), expected)
        self.assertRaises(renderers.Failure, renderers.times_of, output, 3)

    def test_renderers_that_fail_are_an_error(self):
        with self.assertRaisesRegex(renderers.Failure, "ends with 3"):
            renderers.run(["sh", "-c", "exit 3"])
        output, time = renderers.run(["sh", "-c", "echo done"])
        self.assertEqual(output, "done\n")
        self.assertGreaterEqual(time, 0)


class Results(Case):
    def test_format_is_that_of_the_laboratory(self):
        text = results.to_json("peers", "compare.py", "1.0", {"isa": "avx2"}, [
            ("t", ["scene", ("time", "s")], [["a", 0.123456789], ["b", math.inf], ["c", None]]), ("none", ["x"], [])])
        document = json.loads(text)
        self.assertEqual([*document], ["bench", "command", "version", "machine", "settings", "tables"])
        self.assertEqual(document["tables"][0]["columns"], [{"name": "scene"}, {"name": "time", "unit": "s"}])
        self.assertEqual(document["tables"][0]["rows"], [["a", 0.123457], ["b", None], ["c", None]])
        self.assertEqual(document["tables"][1]["rows"], [])
        self.assertIn('\n["a", 0.123457],\n', text)
        with self.assertRaises(ValueError):
            results.to_json("peers", "", "", {}, [("t", ["a", "b"], [[1]])])


if __name__ == "__main__":
    unittest.main()
