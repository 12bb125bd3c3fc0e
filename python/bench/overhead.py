#!/usr/bin/env python3
"""Compares sample() of one decentral quadrilateral with a loop over packs in C++ on the same arrays, on one thread.

Usage: PYTHONPATH=build/release/python python/bench/overhead.py [LIBRARY] [--limit RATIO]
Prints the CPU time per sample of both, and their ratio. Both run in turn, and the fastest run of each counts: other work on
the machine only adds time. Fails if results differ in a bit, or if the ratio is above the limit.
"""
import argparse
import ctypes
import pathlib
import sys
import time

import numpy as np

import nusselt

COUNT = 10**6
RUNS = 60


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(nusselt.__file__).parents[1] / "libnusselt_python_pack_loop.so")
    parser.add_argument("--limit", type=float, default=float("inf"))
    arguments = parser.parse_args()
    if not arguments.library.exists():
        sys.exit(f"there is no {arguments.library}; scripts/build.sh nusselt_python_pack_loop builds it in build/release/python")
    loop = ctypes.CDLL(str(arguments.library.resolve())).nusselt_pack_loop
    isa = ["sse42", "avx2", "avx512"].index(nusselt.instruction_set())

    corners = np.array([[1, 1, 1], [2, 1, 1], [2, 2, 1.5], [1, 2, 1.5]], np.float32)
    u = np.random.default_rng(1).random((COUNT, 2), np.float32)
    outputs = [[np.empty((COUNT, 3), np.float32), np.empty(COUNT, np.float32), np.empty((COUNT, 3), np.float32)]
               for _ in range(2)]
    light = nusselt.PolygonProjectedSolidAngle(corners)

    def address(array):
        return array.ctypes.data_as(ctypes.c_void_p)

    def in_python():
        light.sample(u, out=outputs[0])

    def in_cpp():
        loop(isa, address(corners), ctypes.c_size_t(COUNT), address(u), *map(address, outputs[1]))

    times = {in_python: [], in_cpp: []}
    for _ in range(RUNS):
        for run, taken in times.items():
            begin = time.thread_time()
            run()
            taken.append(time.thread_time() - begin)
    if not all(np.array_equal(a, b) for a, b in zip(*outputs)):
        sys.exit("overhead: Python and C++ give other bits")
    python, cpp = (1e9 * min(taken) / COUNT for taken in times.values())
    print(f"{nusselt.instruction_set()}: Python {python:.2f} ns, C++ {cpp:.2f} ns per sample, ratio {python / cpp:.3f}")
    if python / cpp > arguments.limit:
        sys.exit(f"overhead: the ratio is above {arguments.limit}")


if __name__ == "__main__":
    main()
