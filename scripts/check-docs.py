#!/usr/bin/env python3
"""Checks of the documentation. Usage: scripts/check-docs.py code|links|checks ROOT, or pictures ROOT PROGRAM
  code      each paragraph of C++ in the pages is part of a file in examples/, which the tests compile;
            comments and white space do not count
  links     files and headings that the pages link to exist
  checks    the table of checks in docs/testing.md names those of tests/checks/CMakeLists.txt, but no self-tests
  pictures  docs/techniques/images/NAME.svg is what `PROGRAM map NAME` draws
The pages are the Markdown files of the root, docs/ and shaders/.
scripts/fill-docs.py checks tables.
"""
import fnmatch
import pathlib
import re
import subprocess
import sys
import tempfile


def pages(root):
    return [page for pattern in ("*.md", "docs/**/*.md", "shaders/**/*.md") for page in sorted(root.glob(pattern))]


def bare(code):
    return re.sub(r"\s+", "", re.sub(r"//[^\n]*", "", code))


def code(root):
    examples = [bare(f.read_text()) for f in sorted((root / "examples").rglob("*.cpp"))]
    for page in pages(root):
        for block in re.findall(r"^```cpp\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
            for paragraph in block.split("\n\n"):
                if not any(bare(paragraph) in example for example in examples):
                    yield f"{page}: missing in the files of examples/:\n{paragraph}"


def prose(page):
    return re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """The anchors that readers of Markdown make from headings."""
    for heading in re.findall(r"^#+ +(.*)$", prose(page), re.MULTILINE):
        yield re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def links(root):
    for page in pages(root):
        for target, anchor in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", prose(page)):
            if "://" in target:
                continue
            file = page.parent / target if target else page
            if not file.exists():
                yield f"{page}: the file {target} is missing"
            elif anchor and file.suffix == ".md" and anchor not in anchors(file):
                yield f"{page}: {target} has no heading #{anchor}"


def checks(root):
    page = root / "docs/testing.md"
    rows = re.findall(r"^\| `checks\.([^`]+)` \|", page.read_text(), re.MULTILINE)
    names = re.findall(r"nusselt_add_check\((\S+)", (root / "tests/checks/CMakeLists.txt").read_text())
    names = [name for name in names if not name.endswith("_self_test")]
    for name in names:
        if not any(fnmatch.fnmatchcase(name, row) for row in rows):
            yield f"{page}: no row for checks.{name}"
    for row in rows:
        if not fnmatch.filter(names, row):
            yield f"{page}: tests/checks/CMakeLists.txt has no checks.{row}"


def pictures(root, program):
    for picture in sorted((root / "docs/techniques/images").glob("*.svg")):
        with tempfile.TemporaryDirectory() as folder:
            drawn = pathlib.Path(folder, "map.svg")
            subprocess.run([program, "map", picture.stem, drawn], check=True)
            if drawn.read_bytes() != picture.read_bytes():
                yield f"{picture}: outdated; run scripts/update-docs.sh pictures"


CHECKS = {"code": code, "links": links, "checks": checks, "pictures": pictures}

if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in CHECKS:
        sys.exit(__doc__)
    complaints = list(CHECKS[sys.argv[1]](pathlib.Path(sys.argv[2]), *sys.argv[3:]))
    for complaint in complaints:
        print(complaint)
    sys.exit(1 if complaints else 0)
