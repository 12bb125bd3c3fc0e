"""Runs our renderer and Cycles on one scene, and measures the processor time that they take.

Processor time, and not the time on the clock, because other programs may share the machine: a renderer with one thread
takes as much of either on an idle machine.
"""
import json
import os
import pathlib
import re
import subprocess

from image_statistics import all_of, read_pfm, time_per_samples

HERE = pathlib.Path(__file__).resolve().parent
RENDERED = re.compile(r"Render time \(without synchronization\): ([0-9.e+-]+)|^rendering: (.*)$", re.MULTILINE)
TINY = "16x16"
FARTHEST = 1e9  # [m]; Cycles has a larger depth where rays hit nothing


class Failure(Exception):
    """A renderer that ends with an error."""


def run(arguments):
    """The standard output and the processor time [s] of a process and its children."""
    process = subprocess.Popen([str(a) for a in arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    with process.stdout:
        output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise Failure(f"{pathlib.Path(arguments[0]).name} ends with {process.returncode}:\n{output[-2000:]}")
    return output, usage.ru_utime + usage.ru_stime


class Nusselt:
    def __init__(self, program, work):
        self.program, self.work = program, work

    def version(self):
        return run([self.program, "--version"])[0].split()[-1]

    def layer(self, image, name, layer=None):
        file = self.work / f"{image.stem}-{name}.pfm"
        run([self.program, "convert", image, file, *(["--layer", layer] if layer else [])])
        return read_pfm(file)

    def command(self, case, samples, seed, more):
        """All camera rays go through pixel centres, so that light sampling is the only source of noise."""
        view = self.work / f"{case.slug}-camera.json"
        view.write_text(json.dumps({"version": 1, "film": case.scene["film"], "camera": case.scene["camera"]}))
        return [self.program, "render", case.file, *case.options, "--spp", samples, "--seed", seed, "--pixel-center",
                "--camera", view, "-q", *more]

    def render(self, case, samples, seed):
        """The image, and its times: "cpu" without what a tiny image takes, "wall" without reading and writing."""
        image, report = self.work / f"{case.slug}-nusselt-{samples}.exr", self.work / "nusselt.json"
        more = ["--threads", 1, "--json", report, "-o", image]
        _, tiny = run(self.command(case, 1, seed, ["--resolution", TINY, *more]))
        _, cpu = run(self.command(case, samples, seed, more))
        numbers = json.loads(report.read_text())
        return self.layer(image, "picture"), {"cpu": cpu - tiny, "wall": numbers["seconds"]["render"],
                                              "isa": numbers["isa"]}

    def reference(self, case, samples, seed):
        """An image and the mask of the pixels in which it shows surfaces that do not emit."""
        image = self.work / f"{case.slug}-nusselt-reference.exr"
        run(self.command(case, samples, seed, ["-o", image, "--layers", "emission,depth"]))
        covered = (pixel[0] == 1 for pixel in self.layer(image, "coverage", "coverage").pixels())
        dark = (not any(pixel) for pixel in self.layer(image, "emission", "emission").pixels())
        return self.layer(image, "picture"), all_of(covered, dark)


class Cycles:
    """Blender's Cycles. Its settings are a dictionary with lamps, mis and roulette, as cycles_render.py takes them."""

    def __init__(self, program, work, nusselt):
        self.program, self.work, self.nusselt = program, work, nusselt

    def version(self):
        return run([self.program, "--version"])[0].split("\n")[0].removeprefix("Blender").strip()

    def run(self, case, threads, variants):
        """The times that the script reports for each rendering. Variants are pairs of settings and renderings."""
        job = self.work / f"{case.slug}-cycles.json"
        described = [{**settings, "renderings": renderings} for settings, renderings in variants]
        job.write_text(json.dumps({"scene": case.scene, "threads": threads, "variants": described}))
        output, _ = run([self.program, "--background", "--factory-startup", "--debug-cycles", "--python",
                         HERE / "cycles_render.py", "--", job])
        return times_of(output, sum(len(renderings) for _, renderings in variants))

    def renders(self, case, several, samples, seed):
        """The image for each of several settings, all by one process, and its times: "cpu" and "wall" without
        synchronisation, which a rendering of one sample shows."""
        one = {"samples": 1, "seed": seed, "output": None, "passes": False}
        images = [self.work / f"{case.slug}-cycles-{i}.exr" for i in range(len(several))]
        # The first rendering of a scene also loads what all others share.
        times = iter(self.run(case, 1, [(settings, [one, one, {**one, "samples": samples, "output": str(image)}])
                                        for settings, image in zip(several, images)]))
        return [(self.nusselt.layer(image, "picture"), {
            "cpu": time_per_samples(whole["cpu"], samples, single["cpu"]), "wall": whole["render_wall"]})
                for image, (_, single, whole) in zip(images, zip(times, times, times), strict=True)]

    def reference(self, case, settings, samples, seed):
        image = self.work / f"{case.slug}-cycles-reference.exr"
        self.run(case, os.cpu_count(),
                 [(settings, [{"samples": samples, "seed": seed, "output": str(image), "passes": True}])])
        covered = (pixel[0] < FARTHEST for pixel in self.nusselt.layer(image, "depth", "ViewLayer.Depth").pixels())
        dark = (not any(pixel) for pixel in self.nusselt.layer(image, "emission", "ViewLayer.Emit").pixels())
        return self.nusselt.layer(image, "picture", "ViewLayer.Combined"), all_of(covered, dark)


def times_of(output, count):
    """The times of each rendering from the output of Blender, in which its own time precedes those of the script."""
    found, render_wall = [], None
    for match in RENDERED.finditer(output):
        if match.group(1):
            render_wall = float(match.group(1))
        else:
            found.append({**json.loads(match.group(2)), "render_wall": render_wall})
            render_wall = None
    if len(found) != count:
        raise Failure(f"Blender reports {len(found)} of {count} renderings:\n{output[-2000:]}")
    return found
