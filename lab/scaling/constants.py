#!/usr/bin/env python3
"""Measures the constants of docs/scaling.md with the program itself, in processor time, which other programs on the
machine hardly change. Usage: constants.py PROGRAM SCENE"""

import pathlib
import resource
import subprocess
import sys
import tempfile


def seconds_of(command, folder):
    """Processor time of a command that must succeed."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before = used()
    subprocess.run(command, cwd=folder, check=True)
    return used() - before


def median(values):
    return sorted(values)[len(values) // 2]


def main():
    program, scene = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        render = [program, "render", scene, "--threads", "1", "-q"]
        tiny = ["--resolution", "1x1", "--spp", "1", "-o", "a.exr"]
        start = median([seconds_of([*render, *tiny], folder) for _ in range(5)])
        whole = ["--resolution", "1920x1080", "--spp", "16"]
        rendering = seconds_of([*render, *whole, "-o", "whole.exr"], folder)
        parts = [f"{number}.exr" for number in range(1, 17)]
        several = sum(seconds_of([*render, *whole, "--part", f"{number}/16", "-o", name], folder)
                      for number, name in enumerate(parts, 1))
        merging = median([seconds_of([program, "merge", "-o", "merged.exr", *parts], folder) for _ in range(3)])
        size = {name: (pathlib.Path(folder) / name).stat().st_size for name in (*parts, "whole.exr")}
        tiles = 120 * 68
        compare = [program, "compare", "merged.exr", "whole.exr", "--metrics", "rmse"]
        table = subprocess.run(compare, cwd=folder, check=True, capture_output=True, text=True).stdout
        size_of_parts = sum(size[name] for name in parts)
        print("| what | value |\n|---|---|")
        print(f"| start of a task: program, scene, hierarchy | {start:.2f} s |")
        print(f"| a tile of 16 x 16 pixels with 16 samples | {1000 * (rendering - start) / tiles:.2f} ms |")
        print(f"| 16 parts in place of a single run | {several / rendering:.3f} times the processor time |")
        print(f"| a sixteenth of the image, of {size['whole.exr'] / 1e6:.1f} MB | "
              f"{size_of_parts / 16e6:.2f} MB, {size_of_parts / size['whole.exr']:.3f} times its share |")
        print(f"| merging 16 parts | {size['whole.exr'] / 1e6 / merging:.0f} MB of the image per second |")
        print(f"| merged against a single run | RMSE {table.split()[1]} |")


if __name__ == "__main__":
    main()
