#!/usr/bin/env python3
"""Checks the registry of techniques, include/nusselt/techniques.json, and all that has to agree with it.

Usage: scripts/check-techniques.py registry [--root FOLDER]   the fields of each row, and the files that they name
       scripts/check-techniques.py texts [--root FOLDER]      tables and lists in the repository that follow from it
       scripts/check-techniques.py texts --update             writes these tables and lists
       scripts/check-techniques.py suites [--root FOLDER] SUITE=FILE...
            each technique is in each suite or exempt for a reason. FILE names the techniques of the suite: the list of
            a program of GoogleTest (--gtest_list_tests), a source that the build made, or a report in JSON
"""
import argparse
import json
import pathlib
import re
import sys

LIGHTS = {"polygon", "rectangle", "polygon_on_lobe", "polygon_on_brdf", "textured_polygon", "textured_polygon_on_lobe",
          "textured_line", "textured_line_on_lobe", "textured_tube", "textured_tube_on_lobe",
          "windowed_polygon", "windowed_polygon_on_lobe", "environment", "environment_on_lobe", "line", "line_on_lobe", "cylinder", "cylinder_on_lobe",
          "sphere", "sphere_on_lobe", "disk", "disk_on_lobe", "ellipse", "ellipse_on_lobe", "ellipsoid", "ellipsoid_on_lobe"}
MEASURES = {"area", "solid_angle", "projected_solid_angle", "lobe", "brdf", "radiance"}
REQUIRED = {"name": str, "light": str, "measure": str, "horizon": str, "header": str, "density": str, "source": str,
            "page": str}
OPTIONAL = {"glsl": dict, "published": str, "approximates": str, "iterates": bool, "cyclic": bool, "clips_twice": bool,
            "renders": str, "tests": str, "exempt": dict}
# How the techniques are named in each suite; {} stands for the name of the class. A bound on the number of vertices may
# follow it.
SUITES = {
    "contract": r"\bHostileTest/{}\d*_",
    "inversion": r"\bInversionTest/{}\d*_",
    "density": r"\bDensityTest/{}\d*_",
    "packs": r"\bPacksTest/{}\d*_",
    "statistics": r"\w+SamplesTest/{}\d*_",
    "parity": r"\b(?:technique|published_method)_{}\d*\b",
    "accuracy": r'"{}"',
    "fuzz": r"(?m)^\s*{}\b",
    "timing": r'"{}"',
    "gpu_timing": r'"{}"',
    "cuda": r"<nusselt::{}<",
    "wasm": r'"{}"',
    "page": r'"{}"',
}
# Suites without published methods, which are there to compare with: what programs use.
FOR_PROGRAMS = {"wasm"}
# Suites of shaders. A published method that is exempt from all of them needs no twin in GLSL.
OF_SHADERS = {"parity", "gpu_timing", "page"}
REASON = 20  # letters that a reason has at least


def snake_case(name):
    return re.sub(r"(?<!^)([A-Z])", r"_\1", name).lower()


def rows_of(root):
    return json.loads((root / "include/nusselt/techniques.json").read_text())


def exemptions(row):
    """The suites that leave a technique out, with the reason of each."""
    return {suite: reason for suites, reason in row.get("exempt", {}).items() for suite in suites.split()}


def missing_word(path, word):
    """What is wrong with a file that has to contain a word, or None."""
    if not path.is_file():
        return f"{path} does not exist"
    return None if re.search(rf"\b{word}\b", path.read_text()) else f"{path} does not contain {word}"


def check_fields(row, names):
    name = row.get("name", "a row without a name")
    fields = REQUIRED | OPTIONAL
    for field, kind in REQUIRED.items():
        if field not in row:
            yield f"{name}: the field {field} is missing"
    for field, value in row.items():
        if field not in fields:
            yield f"{name}: unknown field {field}"
        elif not isinstance(value, fields[field]):
            yield f"{name}: {field} must be of type {fields[field].__name__}"
    for field, values in (("light", LIGHTS), ("measure", MEASURES), ("horizon", {"ignored", "clipped"})):
        if row.get(field) not in values:
            yield f"{name}: {field} must be one of {', '.join(sorted(values))}"
    if "approximates" in row and row["approximates"] not in names:
        yield f"{name}: approximates {row['approximates']}, which is not in the registry"
    for suite, reason in exemptions(row).items():
        if suite not in SUITES:
            yield f"{name}: exempt from {suite}, which is not a suite"
        if len(re.findall(r"[A-Za-z]", reason)) < REASON:
            yield f"{name}: the reason to exempt it from {suite} is missing"


def check_registry(root):
    rows = rows_of(root)
    names = [row.get("name") for row in rows]
    for name in {name for name in names if names.count(name) > 1}:
        yield f"{name}: is in the registry twice"
    for row in rows:
        problems = list(check_fields(row, names))
        yield from problems
        if problems:
            continue
        include, shaders = root / "include/nusselt", root / "shaders/nusselt"
        files = [(include / row["header"], row["name"]), (root / "docs/techniques" / row["page"], row["name"])]
        if "glsl" in row:
            files.append((shaders / (row["glsl"]["file"] + ".glsl"), row["glsl"]["struct"]))
        elif not (row["header"].startswith("related/") and OF_SHADERS <= exemptions(row).keys()):
            yield f"{row['name']}: the field glsl is missing; only published methods that are exempt from the suites " \
                  f"{', '.join(sorted(OF_SHADERS))} go without"
        if "published" in row:
            file = "related/" + snake_case(row["published"])
            files += [(include / (file + ".h"), row["published"]), (shaders / (file + ".glsl"), row["published"])]
        yield from filter(None, (f"{row['name']}: {problem}" if (problem := missing_word(*file)) else None
                                 for file in files))
    # Headers of techniques are those with a class that samples lights and names its measure.
    for header in sorted((root / "include/nusselt/sampling").glob("*.h")):
        text = header.read_text()
        for name in re.findall(r"^class (\w+)[^;]*?\{", text, re.MULTILINE):
            if re.search(r"LightSample<Real> sample\(", text) and name not in names:
                yield f"{header}: {name} is not in the registry"


def links(row, folder):
    return f"[{row['header'].split('/')[-1]}]({folder}include/nusselt/{row['header']})"


def table_of_techniques(rows):
    lines = ["| technique | density proportional to | source | header | page | tests of its own in `tests/` |",
             "|---|---|---|---|---|---|"]
    for row in rows:
        page = f"[{row['page'][:-3]}]({row['page']})"
        tests = ", ".join(f"`{test}`" for test in re.split(r", (?![^{]*\})", row["tests"])) if "tests" in row else ""
        lines.append(f"| `{row['name']}` | {row['density']} | {row['source']} | {links(row, '../../')} | {page} | "
                     f"{tests} |")
    return "\n".join(lines) + "\n"


def includes(rows):
    """Without published methods: they are there to compare with, not to use."""
    headers = sorted({row["header"] for row in rows if not row["header"].startswith("related/")})
    return "".join(f"#include <nusselt/{header}>\n" for header in headers)


# The texts that follow from the registry: a file, what stands before and after the text, and the text.
TEXTS = [
    ("docs/techniques/README.md", "<!-- techniques -->\n", "<!-- /techniques -->\n", table_of_techniques),
    ("include/nusselt/nusselt.h", "// All techniques, by scripts/check-techniques.py.\n", "// End of techniques.\n",
     includes),
]


def check_families(root, rows):
    """The table of pages, which people write, names the techniques of each page."""
    path = root / "docs/techniques/README.md"
    names = {row["name"] for row in rows}
    families = {page: names.intersection(re.findall(r"`(\w+)`", classes)) for page, classes in
                re.findall(r"^\| \[[^]]*\]\((\w+\.md)\) \| ([^|]*) \|", path.read_text(), re.MULTILINE)}
    for page in sorted(families.keys() | {row["page"] for row in rows}):
        listed = families.get(page, set())
        expected = {row["name"] for row in rows if row["page"] == page}
        for name in sorted(expected - listed):
            yield f"{path}: the row of {page} does not name {name}"
        for name in sorted(listed - expected):
            yield f"{path}: the row of {page} names {name}, which has another page"


def check_texts(root, update):
    rows = rows_of(root)
    yield from check_families(root, rows)
    for file, begin, end, make in TEXTS:
        path = root / file
        text = path.read_text()
        parts = re.fullmatch(f"(.*{re.escape(begin)})(.*)({re.escape(end)}.*)", text, re.DOTALL)
        if parts is None:
            yield f"{path}: the lines '{begin.strip()}' and '{end.strip()}' are missing"
        elif parts[2] != make(rows):
            if update:
                path.write_text(parts[1] + make(rows) + parts[3])
            else:
                yield f"{path}: does not follow from techniques.json; run scripts/check-techniques.py texts --update"


def test_names(text):
    """The full names in a list of GoogleTest; other texts stay as they are."""
    names, suite = [], ""
    for line in text.splitlines():
        if not line.startswith(" "):
            suite = line.split()[0] if line.split() else ""
        elif suite.endswith("."):
            names.append(suite + line.split()[0])
    return "\n".join(names) if names else text


def check_suites(root, files):
    rows = rows_of(root)
    texts = {}
    for suite, file in files:
        texts.setdefault(suite, []).append(test_names(pathlib.Path(file).read_text()))
    for suite in SUITES.keys() - texts.keys():
        yield f"the suite {suite} is missing on the command line"
    for suite in texts.keys() & SUITES.keys():
        for row in rows:
            if suite in FOR_PROGRAMS and row["header"].startswith("related/"):
                continue
            pattern = SUITES[suite].replace("{}", re.escape(row["name"]))
            found = any(re.search(pattern, text) for text in texts[suite])
            is_exempt = suite in exemptions(row)
            if found and is_exempt:
                yield f"{row['name']}: is in the suite {suite}, although techniques.json exempts it"
            if not found and not is_exempt:
                yield f"{row['name']}: is not in the suite {suite}, and techniques.json has no reason"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("check", choices=("registry", "texts", "suites"))
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("files", nargs="*", metavar="SUITE=FILE")
    arguments = parser.parse_intermixed_args()
    if arguments.check == "registry":
        problems = check_registry(arguments.root)
    elif arguments.check == "texts":
        problems = check_texts(arguments.root, arguments.update)
    else:
        problems = check_suites(arguments.root, [file.split("=", 1) for file in arguments.files])
    problems = list(problems)
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
