#!/usr/bin/env python3
"""Fills the generated regions of docs/line-samples.md with tables and copies its plots:

    <!-- generated: orders lines-large -->
    ...
    <!-- end -->

Usage: scripts/fill-line-samples.py REPORTS CPU [ROOT]
REPORTS is the folder that `nusselt-lab reproduce -o REPORTS` wrote, CPU the name of the processor that it ran on.
"""
import json
import math
import pathlib
import re
import shutil
import sys

REGION = re.compile(r"(<!-- generated: ([\w-]+) ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)
PLOT = re.compile(r"\]\((images/(lines-[a-z]+)-([a-z-]+\.svg))\)")


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def measured(report):
    """The scenes that were there."""
    scenes = [scene for scene in report["scenes"] if not scene["skipped"]]
    if len(scenes) < len(report["scenes"]):
        raise ValueError("a scene was skipped: set NUSSELT_SCENES to the folder that has it")
    return scenes


def by_series(scenes):
    return [(all_of_one[0]["series"], all_of_one) for all_of_one in zip(*(scene["series"] for scene in scenes))]


def orders(report):
    scenes = measured(report)
    rows = [[f"{label}, N = {curves[0]['fit'][0]} to {curves[0]['fit'][1]}", *(f"{c['order']:.2f}" for c in curves)]
            for label, curves in by_series(scenes)]
    return table(["", *(scene["scene"] for scene in scenes)], rows)


def errors(report, counts=(16, 256)):
    """RMSE over the mean and milliseconds, for some numbers of samples."""
    scenes = measured(report)

    def cell(scene, curve, count):
        point = next(p for p in curve["curve"] if p["count"] == count)
        return f"{math.sqrt(point['variance']) / scene['mean']:.2g} ({1000 * point['seconds']:.3g})"

    rows = [[label, *(cell(scene, curve, n) for scene, curve in zip(scenes, curves) for n in counts)]
            for label, curves in by_series(scenes)]
    return table(["", *(f"{scene['scene']}, N = {n}" for scene in scenes for n in counts)], rows)


def biases(report):
    scenes = measured(report)
    rows = [[label, *(f"{100 * c['bias']:+.3f} / {100 * c['pixel_bias']:.3f}" for c in curves)]
            for label, curves in by_series(scenes) if label.startswith("lines")]
    return table(["bias, of the mean / of pixels [%]", *(scene["scene"] for scene in scenes)], rows)


def work(report):
    def row(scene):
        seconds = scene["render_seconds"]
        boxes, triangles = scene["box_tests"], scene["triangle_tests"]
        share = scene["visibility_seconds"] / (seconds * scene["threads"])
        numbers = [f"{seconds:.2f} s", f"{100 * share:.0f} %"]
        numbers += [f"{1e-6 * n:.3g} M" for n in (boxes, triangles, boxes / seconds, triangles / seconds,
                                                   scene["lines"] / seconds)]
        return [scene["scene"], *numbers]

    return table(["", "render time", "of it visibility", "tests of boxes", "of triangles", "boxes / s", "triangles / s",
                  "lines / s"], map(row, measured(report)))


def parts(report):
    return table(["", "visible parts per line", "in the worst pixel"],
                 [[s["scene"], f"{s['parts_per_line']:.2f}", f"{s['most_parts']:.2f}"] for s in measured(report)])


def variants(report):
    insets = list(report["variants"][0]["insets"])
    rows = [[v["variant"], f"{v['rmse']:.3g}", *(f"{v['insets'][i]['rmse']:.3g}" for i in insets)]
            for v in report["variants"]]
    return table(["RMSE", "image", *insets], rows)


KINDS = {f.__name__: f for f in (orders, errors, biases, work, parts, variants)}


def main(reports, cpu, root="."):
    reports, page = pathlib.Path(reports), pathlib.Path(root, "docs/line-samples.md")

    def content(match):
        begin, kind, name, end = match.groups()
        report = json.loads((reports / name / "numbers.json").read_text())
        return begin + KINDS[kind](report) + f"\nOn {cpu}.\n" + end

    text = page.read_text()
    try:
        filled = REGION.sub(content, text)
    except (KeyError, OSError, ValueError) as error:
        sys.exit(f"{page}: {error}")
    for target, name, file in PLOT.findall(text):
        shutil.copyfile(reports / name / file, page.parent / target)
    page.write_text(filled)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
