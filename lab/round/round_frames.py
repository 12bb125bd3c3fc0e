#!/usr/bin/env python3
"""Compares frames that an emissive sphere and a disk light with those of a quad. Needs only the standard library of Python.

Usage: lab/round/round_frames.py [--program NUSSELT] [--repetitions N] [--spp N]

The light is 1 m wide and stands above a floor that is matte or glossy. Flat lights shine to both sides, so that all of
the floor has light of each. Prints the medians of processor time of whole runs on one thread, in which the floor takes
most of the time, and their ratios to the quad.
"""

import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

SCENE = """LookAt 0 -4 2  0 0 0.5  0 0 1
Camera "perspective" "float fov" [50]
Film "image" "integer xresolution" [480] "integer yresolution" [270]
WorldBegin
Material {material}
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-6 -6 0 6 -6 0 6 6 0 -6 6 0]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [5 5 5] "bool twosided" {sides}
Translate 0 0 1.2
{shape}
AttributeEnd
WorldEnd
"""
FLOORS = {
    "matte": '"matte" "rgb Kd" [0.6 0.6 0.6]',
    "glossy": '"uber" "rgb Kd" [0.5 0.5 0.5] "rgb Ks" [0.05 0.05 0.05] "float roughness" [0.2]',
}
SHAPES = {
    "quad": 'Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]'
            ' "point P" [-0.5 0 -0.5 0.5 0 -0.5 0.5 0 0.5 -0.5 0 0.5]',
    "sphere": 'Shape "sphere" "float radius" [0.5]',
    "disk": 'Rotate 90 1 0 0 Shape "disk" "float radius" [0.5]',
}


def seconds_of(command):
    """Processor time of a command, or the end of the program with its message."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0:
        sys.exit(run.stderr.strip())
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/apps/nusselt/nusselt", help="the command nusselt")
    parser.add_argument("--repetitions", type=int, default=5, help="runs of each scene, interleaved")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel")
    options = parser.parse_args()
    if not os.access(options.program, os.X_OK):
        sys.exit(f"round_frames.py: error: there is no program '{options.program}'; build it, or name it with --program")
    if options.repetitions < 1:
        sys.exit("round_frames.py: error: --repetitions must be at least 1")
    rows = [(floor, shape) for floor in FLOORS for shape in SHAPES]
    seconds = {row: [] for row in rows}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for floor, shape in rows:
            text = SCENE.format(material=FLOORS[floor], shape=SHAPES[shape],
                                sides="false" if shape == "sphere" else "true")
            (folder / f"{floor}-{shape}.pbrt").write_text(text, encoding="utf-8")
        for _ in range(options.repetitions):
            for floor, shape in rows:
                seconds[floor, shape].append(seconds_of(
                    [options.program, "render", folder / f"{floor}-{shape}.pbrt", "--threads", "1",
                     "--spp", str(options.spp), "-o", folder / "frame.exr"]))
    print(f"{'floor':<10}{'light':<10}{'CPU s':>8}{'ratio':>8}")
    for floor, shape in rows:
        median = statistics.median(seconds[floor, shape])
        ratio = median / statistics.median(seconds[floor, "quad"])
        print(f"{floor:<10}{shape:<10}{median:>8.2f}{ratio:>8.2f}")


if __name__ == "__main__":
    main()
