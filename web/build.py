#!/usr/bin/env python3
"""Builds the live page of web/page: one HTML file that opens from disk and from any server. Needs esbuild.

Usage: web/build.py OUTPUT.html
"""
import base64
import hashlib
import json
import pathlib
import posixpath
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHADERS = ROOT / "shaders/nusselt"
SCENES = [row["file"] for row in json.loads((ROOT / "web/scenes.json").read_text())]
# Files of the library that shaders of web/ include themselves.
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def version():
    return re.search(r"project\(nusselt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def licence(maker):
    """The version and the licence as comments, as at the beginning of flattened shaders."""
    lines = (ROOT / "LICENSE").read_text().strip().splitlines()
    text = "".join(f"// {line}".rstrip() + "\n" for line in lines)
    return f"// Nusselt {version()}, put together by {maker}.\n//\n{text}"


def registry():
    """How GLSL names the techniques that the page has, by their names in C++."""
    named = set(re.findall(r'"(\w+)"', (ROOT / "web/library/techniques.ts").read_text()))
    rows = json.loads((ROOT / "include/nusselt/techniques.json").read_text())
    names = {row["name"]: row["glsl"] for row in rows if "glsl" in row}
    for published in (row["published"] for row in rows if "published" in row):
        file = re.sub(r"(?<!^)([A-Z])", r"_\1", published).lower()
        names[published] = {"file": f"related/{file}", "struct": published}
    return {name: glsl for name, glsl in names.items() if name in named}


def sources():
    """All shaders of the page, and the files of the library that they and its techniques include."""
    texts = {file.name: file.read_text() for file in sorted((ROOT / "web/shaders").iterdir())}
    names = registry()
    waiting = [f"nusselt/{row['file']}.glsl" for row in names.values()]
    waiting += [name for text in texts.values() for name in INCLUDE.findall(text) if name.startswith("nusselt/")]
    while waiting:
        path = waiting.pop()
        if path in texts:
            continue
        texts[path] = (ROOT / "shaders" / path).read_text()
        folder = posixpath.dirname(path)
        waiting += [posixpath.normpath(posixpath.join(folder, name)) for name in INCLUDE.findall(texts[path])]
    return {**texts, "techniques.json": json.dumps(names, separators=(",", ":"))}


def scenes(paths):
    """Scenes and the files that they include, by paths."""
    texts = {}

    def add(path):
        name = str(path.relative_to(ROOT))
        if name in texts:
            return
        texts[name] = path.read_text()
        for included in re.findall(r'^\s*Include "([^"]+)"', texts[name], re.MULTILINE):
            add((path.parent / included).resolve())

    for scene in paths:
        add(ROOT / scene)
    return texts


def script():
    return subprocess.run(["esbuild", "--bundle", "--format=iife", "--target=es2020", "--charset=utf8",
                           "--minify-whitespace", "--minify-syntax", str(ROOT / "web/page/main.ts")],
                          check=True, stdout=subprocess.PIPE, text=True).stdout


def style():
    text = (ROOT / "lab/report/page/page.css").read_text() + (ROOT / "web/page/page.css").read_text()
    return subprocess.run(["esbuild", "--loader=css", "--charset=utf8", "--minify-whitespace"],
                          input=text, check=True, stdout=subprocess.PIPE, text=True).stdout


def hash_of(text):
    """The name of a script or style in a policy of content security."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def page():
    data = {"licence": licence("its live page"), "sources": sources(), "scenes": scenes(SCENES),
            "lobes": base64.b64encode((ROOT / "data/ltc-frostbite-engine.bin").read_bytes()).decode()}
    css, code = "\n" + style(), "\n" + script()
    parts = {
        "@STYLE@": css,
        "@STYLE_HASH@": hash_of(css),
        # Without `<`, nothing in the text can end its element.
        "@DATA@": json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
        "@SCRIPT@": code,
        "@SCRIPT_HASH@": hash_of(code),
    }
    return re.sub("|".join(parts), lambda mark: parts[mark[0]], (ROOT / "web/page/index.html").read_text())


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    output = pathlib.Path(sys.argv[1])
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(page())


if __name__ == "__main__":
    main()
