#!/usr/bin/env python3
"""Builds the module for three.js and its example. Needs esbuild, tsc, Node.js and npm, which fetches three.js at the first time.

Usage: web/build_three.py FOLDER
  FOLDER/nusselt-three.js    the module, which imports three
  FOLDER/nusselt-three.d.ts  its types
  FOLDER/package.json        what makes the folder a package for npm
  FOLDER/index.html          the example in one file, which opens from disk
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import build
import three_types

ROOT = build.ROOT
THREE = ROOT / "web/three"
SCENE = "web/scenes/floor.pbrt"
# Where npm puts what package-lock.json names.
PACKAGES = ROOT / "build/three"


def install():
    """Fetches packages unless they are there. Its lock file says their versions and hashes, not where they come from."""
    if shutil.which("npm") is None:
        sys.exit("web/build_three.py: npm is missing; install it, for instance by scripts/setup.sh three")
    lock = (THREE / "package-lock.json").read_text()
    done = PACKAGES / "installed-lock.json"
    if done.exists() and done.read_text() == lock:
        return
    PACKAGES.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(THREE / name, PACKAGES)
    result = subprocess.run(["npm", "ci", "--prefer-offline", "--no-audit", "--no-fund"], cwd=PACKAGES, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"web/build_three.py: npm cannot fetch three.js, which needs a network once:\n{result.stdout.strip()}")
    done.write_text(lock)


def esbuild(file, *options):
    """The bundle of a script."""
    environment = {**os.environ, "NODE_PATH": f"{PACKAGES / 'node_modules'}:{PACKAGES}"}
    return subprocess.run(["esbuild", "--bundle", "--target=es2020", "--charset=utf8", "--minify-whitespace", "--minify-syntax",
                           "--loader:.glsl=text", "--loader:.bin=binary", *options, str(file)],
                          check=True, stdout=subprocess.PIPE, text=True, env=environment).stdout


def make_shader():
    """Writes what the fragment shaders of materials get, for scripts to import."""
    sources = build.sources() | {file.name: file.read_text() for file in sorted((THREE / "shaders").iterdir())}
    script = PACKAGES / "print_shader.js"
    script.write_text(esbuild(THREE / "print_shader.ts", "--platform=node"))
    done = subprocess.run(["node", script], check=True, input=json.dumps(sources), stdout=subprocess.PIPE, text=True)
    (PACKAGES / "generated").mkdir(exist_ok=True)
    (PACKAGES / "generated/area_lights.glsl").write_text(done.stdout)


def page(script, data):
    """A page around a script. \\param data what it reads from the element `data`"""
    parts = {
        "@STYLE@": (THREE / "example/example.css").read_text(),
        "@DATA@": json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
        # The text of a script must not end its element.
        "@SCRIPT@": script.replace("</script", "<\\/script"),
    }
    return re.sub("|".join(parts), lambda mark: parts[mark[0]], (THREE / "example/index.html").read_text())


def make_module(folder):
    folder.mkdir(parents=True, exist_ok=True)
    licence = build.licence("web/build_three.py")
    (folder / "nusselt-three.js").write_text(licence + esbuild(THREE / "index.ts", "--format=esm", "--external:three"))
    (folder / "nusselt-three.d.ts").write_text(licence + three_types.make_types())
    tested = json.loads((THREE / "package.json").read_text())["devDependencies"]["three"]
    package = {
        "name": "nusselt-three", "version": build.version(), "description": "Area lights with shadows for three.js", "license": "MIT",
        "type": "module", "sideEffects": False, "types": "./nusselt-three.d.ts",
        "exports": {".": {"types": "./nusselt-three.d.ts", "default": "./nusselt-three.js"}},
        "files": ["nusselt-three.js", "nusselt-three.d.ts"], "peerDependencies": {"three": f">={tested}"},
    }
    (folder / "package.json").write_text(json.dumps(package, indent=4) + "\n")
    shutil.copy(ROOT / "LICENSE", folder)


def make_example(folder):
    script = esbuild(THREE / "example/main.ts", "--format=iife")
    (folder / "index.html").write_text(page(script, {"scenes": build.scenes([SCENE]), "scene": SCENE}))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    install()
    make_shader()
    make_module(folder)
    make_example(folder)


if __name__ == "__main__":
    main()
