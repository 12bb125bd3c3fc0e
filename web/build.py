#!/usr/bin/env python3
"""Builds the live page of web/page: one HTML file that opens from disk and from any server. Needs esbuild.

Usage: web/build.py OUTPUT.html
"""
import base64
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHADERS = ROOT / "shaders/nusselt"
SCENES = ["web/scenes/floor.pbrt", "scenes/room.pbrt"]


def licence(maker):
    """The version and the licence as comments, as at the beginning of flattened shaders."""
    version = re.search(r"project\(nusselt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    lines = (ROOT / "LICENSE").read_text().strip().splitlines()
    text = "".join(f"// {line}".rstrip() + "\n" for line in lines)
    return f"// Nusselt {version}, put together by {maker}.\n//\n{text}"


def sources():
    """All shaders of the page, and those of the library that techniques may need."""
    texts = {file.name: file.read_text() for file in sorted((ROOT / "web/shaders").iterdir())}
    for folder in ("bsdf", "core", "estimate", "geometry", "ltc", "random", "related", "sampling"):
        for file in sorted((SHADERS / folder).glob("*.glsl")):
            texts[f"nusselt/{file.relative_to(SHADERS)}"] = file.read_text()
    return texts


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
                           "--minify-whitespace", "--minify-syntax", str(ROOT / "web/page/main.ts")], check=True, stdout=subprocess.PIPE, text=True).stdout


def page():
    data = {"licence": licence("its live page"), "sources": sources(), "scenes": scenes(SCENES),
            "lobes": base64.b64encode((ROOT / "data/ltc-frostbite-engine.bin").read_bytes()).decode()}
    parts = {
        "@STYLE@": (ROOT / "lab/report/page/page.css").read_text() + (ROOT / "web/page/page.css").read_text(),
        # Without `<`, nothing in the text can end its element.
        "@DATA@": json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
        "@SCRIPT@": script(),
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
