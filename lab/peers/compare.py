#!/usr/bin/env python3
"""Compares our renderer with Blender's Cycles: error and time of direct light, with one thread each.

Usage: lab/peers/compare.py [--json FILE] [--scenes NAME,...] [--repetitions N] [--samples N] [--reference-samples N]
                            [--shrink N] [--nusselt PROGRAM] [--blender PROGRAM] [--work FOLDER]

The file has ratios, single numbers and what was not run. With --scenes, rows of other scenes in it remain.
Exits with 77 if there is no Blender (Debian: apt-get install --no-install-recommends blender).

Each renderer is compared with a converged image of its own, because tubes are a mesh in Cycles and because the BRDFs of
some materials differ; `mean_ratio` says by how much these images differ in the mean. Pixels that show emitters or no
surface are left out. Cycles gets those of its settings with which it is most efficient in a trial.
"""
import argparse
import dataclasses
import os
import pathlib
import shlex
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True  # nothing new in the folder of the sources

from image_statistics import (all_of, efficiency, mean, mean_squared_errors, median_and_spread,  # noqa: E402
                              samples_of_equal_time)
from pbrt_scene import aside, files_of, matte, one_sided, read_scene, resized  # noqa: E402
from renderers import Cycles, Failure, Nusselt  # noqa: E402
from results import rows_of_other_scenes, to_json  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SKIPPED = 77
REFERENCE_SEED, TRIAL_SEED, FIRST_SEED = 1000, 999, 1
MEANS_AGREE = 0.01
LAMBERT = ("--technique", "projected_solid_angle", "--strategies", "diffuse", "--brdf", "lambert")
BOTH = ("--technique", "projected_solid_angle", "--strategies", "diffuse+ltc", "--mis", "clamped_optimal")
ROULETTE = 0.01  # Blender's default: shadow rays that carry less light are traced only now and then


@dataclasses.dataclass
class Case:
    """A scene with the options of our renderer that somebody who knows it would use."""
    slug: str
    path: str  # in the repository
    size: tuple
    changes: tuple  # functions that change the scene, in this order
    options: tuple  # of our renderer, with the same changes
    target: float = None  # how many times as efficient as Cycles we want to be

    def __post_init__(self):
        self.file = ROOT / self.path
        self.scene = resized(read_scene(self.file), *self.size)
        for change in self.changes:
            self.scene = change(self.scene)

    def shapes_of_lights(self):
        """What is worth a try in Cycles: area lights or emissive meshes, light hit by reflected rays or not."""
        polygons = any("polygon" in light for light in self.scene["lights"])
        return [("area", True), ("area", False), ("mesh", True)] if polygons else [("mesh", True)]


def cases(shrink=1):
    """All scenes, with width and height divided by a number."""
    def case(slug, path, width, height, *others):
        return Case(slug, path, (width // shrink, height // shrink), *others)

    return [case("panel", "scenes/cornell-panel.pbrt", 256, 256, (aside, matte), LAMBERT, 8),
            case("panel-below", "scenes/cornell-panel.pbrt", 256, 256, (aside, matte, one_sided),
                 (*LAMBERT, "--lights", HERE / "one-sided.json"), 8),
            case("tube", "scenes/cornell-tube.pbrt", 256, 256, (aside, matte), LAMBERT, 300),
            case("metal-planes", "lab/peers/metal-planes.pbrt", 320, 240, (), BOTH),
            case("room-matte", "scenes/room.pbrt", 320, 180, (matte,), LAMBERT),
            case("room", "scenes/room.pbrt", 320, 180, (), BOTH)]


class Series:
    """Errors and times of the repetitions of one renderer with one number of samples."""

    def __init__(self, samples):
        self.samples, self.errors, self.relative_errors, self.times, self.walls = samples, [], [], [], []

    def add(self, errors, times):
        self.errors.append(errors[0])
        self.relative_errors.append(errors[1])
        self.times.append(times["cpu"])
        self.walls.append(times["wall"])

    def row(self, scene, renderer, reference_mean):
        (time, time_spread), (error, error_spread) = map(median_and_spread, (self.times, self.errors))
        return [scene, renderer, self.samples, time, time_spread, middle(self.walls), error, error_spread,
                error**0.5 / reference_mean, efficiency(error, time), middle(self.relative_errors)]


def without_noise_of(reference_samples, samples, errors):
    """Errors as they would be without the noise of a reference by the same renderer, which adds to them in proportion to
    samples / reference_samples. References that converge faster than independent samples add less: then this favours the
    renderer."""
    return [error / (1 + samples / reference_samples) for error in errors]


def middle(values):
    return median_and_spread(values)[0]


RENDERINGS = ("renderings", ["scene", "renderer", "samples", ("cpu_seconds", "s"), "cpu_spread", ("wall_seconds", "s"),
                             "mse", "mse_spread", "relative_rmse", "efficiency", "rel_mse"])
RATIOS = ("ratios", ["scene", "samples", "time_ratio", "error_ratio", "efficiency_ratio", "lowest_ratio",
                     "highest_ratio", "target", "meets_target", "equal_time_samples", "equal_time_error_ratio",
                     "equal_time_time_ratio", "rel_mse_ratio", "rel_mse_efficiency_ratio",
                     "equal_time_rel_mse_ratio"])
REFERENCES = ("references", ["scene", "reference_samples", "pixels", "nusselt_mean", "cycles_mean", "mean_ratio",
                             "means_agree", "relative_difference", "lamps", "mis", "roulette"])
FILES = ("files", ["scene", "file"])  # that scenes were read from
NOT_RUN = ("not_run", ["scene", "reason"])
TABLES = (RENDERINGS, RATIOS, REFERENCES, FILES, NOT_RUN)


def log(*words):
    print(*words, file=sys.stderr, flush=True)


def best_settings(case, cycles, reference, mask, samples):
    """The shape of the lights with which Cycles is most efficient, with roulette or without."""
    several = [{"lamps": lamps, "mis": mis, "roulette": roulette}
               for lamps, mis in case.shapes_of_lights() for roulette in (0, ROULETTE)]
    found = [efficiency(mean_squared_errors(image, reference, mask)[0], times["cpu"])
             for image, times in cycles.renders(case, several, samples, TRIAL_SEED)]
    for settings, value in zip(several, found):
        log(f"  trial {settings}: efficiency {value:.4g}")
    return several[found.index(max(found))]


def measure(case, nusselt, cycles, options):
    """The rows of a scene for each table."""
    log(f"{case.slug}: references")
    converged = {"lamps": "area", "mis": True, "roulette": 0}
    ours, our_mask = nusselt.reference(case, options.reference_samples, REFERENCE_SEED)
    theirs, their_mask = cycles.reference(case, converged, options.reference_samples, REFERENCE_SEED)
    mask = all_of(our_mask, their_mask)
    means = mean(ours, mask), mean(theirs, mask)
    difference = mean_squared_errors(theirs, ours, mask)[0]**0.5 / means[0]
    log(f"  means {means[0]:.6g} and {means[1]:.6g}, difference {difference:.3g}")
    settings = best_settings(case, cycles, theirs, mask, options.samples)

    series = Series(options.samples), Series(options.samples)
    longer = None  # ours in the time of Cycles
    isa = None
    for repetition in range(options.repetitions):
        seed = FIRST_SEED + repetition
        (image, times), = cycles.renders(case, [settings], options.samples, seed)
        errors = mean_squared_errors(image, theirs, mask)
        series[1].add(without_noise_of(options.reference_samples, options.samples, errors), times)
        image, times = nusselt.render(case, options.samples, seed)
        series[0].add(mean_squared_errors(image, ours, mask), times)
        isa = times["isa"]
        longer = longer or Series(samples_of_equal_time(options.samples, series[0].times[0], series[1].times[0]))
        image, times = nusselt.render(case, longer.samples, seed)
        longer.add(mean_squared_errors(image, ours, mask), times)
        log(f"  repetition {repetition + 1}: {series[0].times[-1]:.3g} s and {series[1].times[-1]:.3g} s")

    rows = [series[0].row(case.slug, "nusselt", means[0]), series[1].row(case.slug, "cycles", means[1]),
            longer.row(case.slug, "nusselt, equal time", means[0])]
    return {"renderings": rows, "isa": isa,
            "files": [[case.slug, os.path.relpath(file, ROOT)] for file in files_of(case.file)],
            "ratios": [ratios_of(case, *series, longer)],
            "references": [[case.slug, options.reference_samples, sum(mask), *means, means[1] / means[0],
                            abs(means[1] / means[0] - 1) <= MEANS_AGREE, difference, *settings.values()]]}


def ratios_of(case, ours, theirs, longer):
    """How many times more time and squared error Cycles has. The range is that of single repetitions."""
    time = middle(theirs.times) / middle(ours.times)
    error = middle(theirs.errors) / middle(ours.errors)
    relative = middle(theirs.relative_errors) / middle(ours.relative_errors)
    single = [t[0] * t[1] / (o[0] * o[1]) for t, o in zip(zip(theirs.times, theirs.errors),
                                                         zip(ours.times, ours.errors), strict=True)]
    return [case.slug, ours.samples, time, error, time * error, min(single), max(single), case.target,
            None if case.target is None else time * error >= case.target, longer.samples,
            middle(theirs.errors) / middle(longer.errors), middle(theirs.times) / middle(longer.times), relative,
            time * relative, middle(theirs.relative_errors) / middle(longer.relative_errors)]


def text_of(tables):
    """Ratios in short, for the terminal."""
    lines = [f"{'scene':<14}{'time':>9}{'error':>9}{'efficiency':>12}   range            target  means"]
    agreement = {row[0]: row[5] for row in tables["references"]}
    for row in tables["ratios"]:
        target = "-" if row[7] is None else f"{row[7]:g} {'met' if row[8] else 'missed'}"
        lines.append(f"{row[0]:<14}{row[2]:>9.3g}{row[3]:>9.3g}{row[4]:>12.4g}   {row[5]:.3g} to {row[6]:<8.3g} "
                     f"{target:>10}  {agreement[row[0]]:.4f}")
    lines += [f"not run: {scene}: {reason}" for scene, reason in tables["not_run"]]
    return "\n".join(lines)


def whole_number(smallest):
    def convert(text):
        value = int(text)
        if value < smallest:
            raise ValueError
        return value

    convert.__name__ = f"number (at least {smallest})"  # argparse names it in its message
    return convert


def options_of(arguments):
    """Checks all options before anything is rendered."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--scenes", help=f"default: all of {', '.join(case.slug for case in cases())}")
    parser.add_argument("--repetitions", type=whole_number(1), default=5)
    parser.add_argument("--samples", type=whole_number(2), default=16)
    parser.add_argument("--reference-samples", type=whole_number(1), default=1024)
    parser.add_argument("--shrink", type=int, choices=(1, 2, 4), default=1, help="divides the size of images")
    parser.add_argument("--nusselt", default=str(ROOT / "build/release/apps/nusselt/nusselt"))
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--work", type=pathlib.Path, help="keeps all images in this folder")
    options = parser.parse_args(arguments)
    names = [] if options.scenes is None else options.scenes.split(",")
    if unknown := set(names) - {case.slug for case in cases()}:
        parser.error(f"no scene {', '.join(map(repr, sorted(unknown)))}")
    if len(set(names)) < len(names):
        parser.error("a scene is named twice")
    if options.json and not os.access(options.json if options.json.exists() else options.json.parent, os.W_OK):
        parser.error(f"cannot write {options.json}")
    if options.work and options.work.exists() and not options.work.is_dir():
        parser.error(f"{options.work} is no folder")
    return options


def main(arguments):
    options = options_of(arguments)
    known = {case.slug: case for case in cases(options.shrink)}
    names = options.scenes.split(",") if options.scenes else [*known]
    if not shutil.which(options.blender):
        print(f"skipped: no program {options.blender}; nothing was compared")
        return SKIPPED
    if not shutil.which(options.nusselt):
        sys.exit(f"no program {options.nusselt}; build it first (make demo)")

    with tempfile.TemporaryDirectory() as temporary:
        work = options.work or pathlib.Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        nusselt = Nusselt(options.nusselt, work)
        return compare(options, known, names, nusselt, Cycles(options.blender, work, nusselt))


def compare(options, known, names, nusselt, cycles):
    """Measures the named scenes, and writes the file after each of them, because all of them take long."""
    settings = {"repetitions": options.repetitions, "shrink": options.shrink, "cycles": cycles.version(), "threads_of_renderers": 1}
    tables = {name: [] for name, _ in TABLES}
    if options.json and options.scenes and options.json.exists():
        tables.update(rows_of_other_scenes(options.json, names, settings))
    measured = {row[0] for row in tables["ratios"]}
    not_run = {name: "not reached" if name in names else "not selected" for name in known if name not in measured}
    version, failed = nusselt.version(), False
    for name in names:
        try:
            found = measure(known[name], nusselt, cycles, options)
            settings["isa"] = found.pop("isa")
            for table, rows in found.items():
                tables[table] += rows
            del not_run[name]
        except (Failure, OSError, ValueError) as error:
            log(f"{name}: {error}")
            not_run[name] = str(error).split("\n")[0]
            failed = True
        tables["not_run"] = [*not_run.items()]
        if options.json:
            options.json.write_text(to_json("peers", command_of(options), version, settings, [
                (table, columns, in_order(tables[table], known)) for table, columns in TABLES]))
    print(text_of(tables))
    return 1 if failed else 0


def in_order(rows, scenes):
    """The order of the list of scenes, whichever ran last. Sorting keeps that of the rows of a scene."""
    order = [*scenes]
    return sorted(rows, key=lambda row: order.index(row[0]))


def command_of(options):
    chosen = [f"--{name.replace('_', '-')}={getattr(options, name)}"
              for name in ("samples", "reference_samples", "repetitions", "shrink")]
    return shlex.join([os.path.relpath(__file__, ROOT), *chosen])


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except ValueError as error:
        sys.exit(str(error))
