#!/usr/bin/env python3
"""Fills the generated regions of docs/techniques/*.md with tables:

    <!-- generated: accuracy PolygonSolidAngle -->
    ...
    <!-- end -->

Usage: scripts/fill-docs.py ACCURACY.json SAMPLERS.json CPU [ROOT]
ACCURACY.json is from `nusselt-lab bench accuracy --json`, SAMPLERS.json from `nusselt-lab bench samplers --json`, CPU the name of
the processor that the latter ran on. Members and rows that are not known here are ignored.
"""
import json
import pathlib
import re
import sys

REGION = re.compile(r"(<!-- generated: (\w+) (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
METHODS = {"plain": "formulas as printed", "ours": "this library", "floor": "exact, rounded"}


def rows_of(document):
    """The rows of a report: a list, or a member of an object."""
    return document if isinstance(document, list) else document["rows"]


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def quantiles(error):
    values = [error[k] for k in ("median", "p99", "p999", "max")] if isinstance(error, dict) else error
    return ["inf" if v is None else f"{v:.1e}" for v in values]


def accuracy_table(report, technique):
    rows, last = [], None
    for row in report:
        if row["technique"] != technique or row["method"] not in METHODS or row.get("scalar", "float") != "float":
            continue
        if row.get("dark"):
            continue
        name = "" if row["lights"] == last else row["lights"]
        last = row["lights"]
        rows.append([name, METHODS[row["method"]], *quantiles(row["backward"])])
    if not rows:
        raise ValueError(f"no accuracy of {technique}")
    return table(["lights", "float", "median", "99 %", "99.9 %", "max"], rows)


def cost_table(report, technique, cpu):
    cells, columns = {}, {}
    for row in report:
        if row["technique"] != technique:
            continue
        lanes = row["lanes"]
        columns[lanes] = "scalar" if lanes == 1 else f"packs of {lanes}, per lane"
        lights = row.get("lights") or row["configuration"]
        cells.setdefault(lights, {})[lanes] = f"{row['prepare_ns']:.3g} / {row['sample_ns']:.3g}"
    if not cells:
        raise ValueError(f"no cost of {technique}")
    lanes = sorted(columns)
    isa = next(row["isa"] for row in report if row["technique"] == technique)
    rows = [[lights, *(c.get(n, "") for n in lanes)] for lights, c in cells.items()]
    where = f"One thread of {cpu}, {isa}" if len(lanes) > 1 else f"One thread of {cpu}"
    return (table(["lights", *(columns[n] for n in lanes)], rows) +
            f"\n{where}; ns per light for preparing / per sample.\n")


def fill(text, accuracy, samplers, cpu):
    """The text with all regions filled. Raises ValueError where there is nothing to fill one with."""
    def content(match):
        begin, kind, technique, end = match.groups()
        if kind == "accuracy":
            return begin + accuracy_table(accuracy, technique) + end
        if kind == "cost":
            return begin + cost_table(samplers, technique, cpu) + end
        raise ValueError(f"unknown kind of region: {kind}")

    return REGION.sub(content, text)


def main(accuracy_file, samplers_file, cpu, root="."):
    accuracy = rows_of(json.loads(pathlib.Path(accuracy_file).read_text()))
    samplers = rows_of(json.loads(pathlib.Path(samplers_file).read_text()))
    for page in sorted(pathlib.Path(root, "docs/techniques").glob("*.md")):
        try:
            filled = fill(page.read_text(), accuracy, samplers, cpu)
        except ValueError as error:
            sys.exit(f"{page}: {error}")
        page.write_text(filled)


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
