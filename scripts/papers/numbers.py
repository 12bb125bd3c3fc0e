#!/usr/bin/env python3
"""Prints the numbers of docs/papers/elliptic-cones.md that no table has: errors of the iteration for cones above the horizon, and of
the polynomial for the inverse of the cycloid.

Usage: scripts/papers/numbers.py [CASES]     CASES of the random search: default 700000, which take half a minute
It computes in double, independently of the library; the coefficients of the polynomial are read from cycloid.h.
"""
import math
import pathlib
import random
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def series():
    """The coefficients of phi(y) in y^2."""
    arcsine, root, terms = 1.0, 1.0, []
    for k in range(1, 31):
        arcsine *= (2 * k - 1) / (2 * k)
        root *= (2 * k - 3) / (2 * k)
        terms.append(arcsine / (2 * k + 1) - root)
    return terms[::-1]


SERIES = series()


def phi(y):
    """(asin(y) - y sqrt(1 - y^2)) / y^3"""
    if y > 0.5:
        return (math.asin(min(y, 1)) - y * math.sqrt(max(1 - y * y, 0))) / y ** 3
    total = 0.0
    for coefficient in SERIES:
        total = total * y * y + coefficient
    return total


def radii(m, zeta, goal):
    """The start and the results of three steps for r^2 (1 + zeta r phi(m r)) = goal."""
    z = zeta * phi(m)
    total = max(1 + z, 1e-16)
    r = min(math.sqrt(goal / max(1 + z * min(math.sqrt(goal / total), 1), 1e-16)), 1)
    yield r
    for _ in range(3):
        w = max(math.sqrt(max(1 - (m * r) ** 2, 0)), 2 ** -30)
        f = r * r * (1 + zeta * r * phi(m * r)) - goal
        slope = 2 * r * max(1 + zeta * r / w, 0)
        curve = 2 + 2 * zeta * r * (1 + w * w) / w ** 3
        bottom = slope + math.sqrt(max(slope * slope - 2 * f * curve, 0))
        r = min(max(r - (2 * f / bottom if bottom > 0 else 0), 0), 1)
        yield r


def iteration(cases):
    """The largest backward error in units of the random number after 0 to 3 steps."""
    source, largest = random.Random(1), [0.0] * 4
    for _ in range(cases):
        near_one = source.choice((source.random(), 1 - 10 ** source.uniform(-12, 0)))
        m = min(max(near_one, 1e-6), 1 - 1e-12)
        bound = math.sqrt((1 - m) * (1 + m))
        zeta = bound * source.choice((source.uniform(-1, 1), -1, 1, 10 ** source.uniform(-6, 0) - 1))
        goal = max(1 + zeta * phi(m), 0) * source.choice((source.random(), 10 ** source.uniform(-8, 0)))
        for step, r in enumerate(radii(m, zeta, goal)):
            error = abs(r * r * (1 + zeta * r * phi(m * r)) - goal) / 2
            largest[step] = max(largest[step], error)
    return largest


def cycloid():
    """The largest relative error of the angle x with x - sin(x) = y for y <= pi, by a polynomial in cbrt(6 y)."""
    text = (ROOT / "include/nusselt/cones/cycloid.h").read_text(encoding="utf-8")
    fitted = re.search(r"kFitted\[\] = \{(.*?)\}", text, re.DOTALL)[1]
    coefficients = [float(number) for number in re.findall(r"[-\d.e]+(?=f)", fitted)]
    largest = 0.0
    for i in range(1, 20001):
        x = math.pi * i / 20000
        y = x - math.sin(x) if x > 0.01 else x ** 3 / 6 * (1 - x * x / 20 * (1 - x * x / 42))
        z = (6 * y) ** (1 / 3)
        found = z * sum(c * z ** (2 * k) for k, c in enumerate(coefficients))
        largest = max(largest, abs(found / x - 1))
    return len(coefficients), largest


def main():
    cases = int(sys.argv[1]) if len(sys.argv) > 1 else 700000
    errors = iteration(cases)
    print(f"Largest backward error of {cases} cases above the horizon: start {errors[0]:.1e}, one step {errors[1]:.1e}, "
          f"two {errors[2]:.1e}, three {errors[3]:.1e}")
    terms, error = cycloid()
    print(f"Inverse cycloid, {terms} terms: largest relative error {error:.1e}")


main()
