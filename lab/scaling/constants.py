#!/usr/bin/env python3
"""Measures the constants of docs/scaling.md with the program itself, in processor time, which other programs on the
machine hardly change. Usage: constants.py PROGRAM SCENE"""

import contextlib
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def used_seconds():
    """Processor time of all commands so far."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds_of(command, folder):
    """Processor time of a command that must succeed."""
    before = used_seconds()
    subprocess.run(command, cwd=folder, check=True)
    return used_seconds() - before


def with_checkpoints(command, folder):
    """The same for a command with a checkpoint every 50 ms, and their number."""
    before, times = used_seconds(), set()
    state = pathlib.Path(folder) / "state"
    process = subprocess.Popen([*command, "--checkpoint", state, "--checkpoint-interval", "0.05"], cwd=folder)
    while process.poll() is None:
        with contextlib.suppress(FileNotFoundError):
            times.add(state.stat().st_mtime_ns)
        time.sleep(0.002)
    if process.returncode != 0:
        sys.exit(process.returncode)
    return used_seconds() - before, len(times)


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
        saving, checkpoints = with_checkpoints([*render, *whole, "-o", "a.exr"], folder)
        tasks = [seconds_of([*render, *whole, "--part", f"{number}/32", "-o", "a.exr"], folder) for number in range(1, 33)]
        spread = statistics.stdev(map(math.log, tasks))
        print("| what | value |\n|---|---|")
        print(f"| start of a task: program, scene, hierarchy | {start:.2f} s |")
        print(f"| a tile of 16 x 16 pixels with 16 samples | {1000 * (rendering - start) / tiles:.2f} ms |")
        print(f"| 16 parts in place of a single run | {several / rendering:.3f} times the processor time |")
        print(f"| a sixteenth of the image, of {size['whole.exr'] / 1e6:.1f} MB | "
              f"{size_of_parts / 16e6:.2f} MB, {size_of_parts / size['whole.exr']:.3f} times its share |")
        print(f"| merging 16 parts | {size['whole.exr'] / 1e6 / merging:.0f} MB of the image per second |")
        print(f"| checkpoints of 0 to {size['whole.exr'] / 1e6:.1f} MB, on average | "
              f"{1000 * (saving - rendering) / checkpoints:.0f} ms of processor time |")
        print(f"| 32 parts: standard deviation of the logarithm of their times | {spread:.3f} |")
        print(f"| merged against a single run | RMSE {table.split()[1]} |")


if __name__ == "__main__":
    main()
