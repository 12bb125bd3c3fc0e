#!/usr/bin/env python3
"""Draws the figures of docs/papers: docs/papers/*.svg.

Usage: scripts/papers/figures.py [FOLDER]     FOLDER: default docs/papers
The maps are computed here by bisection and sums, independently of the library; the chart shows docs/data/round-*.json.
"""
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing new in the folder of the sources
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LINES = 12  # of the grid in the unit square
BLUE, ORANGE, GREY, INK = "#1f5fa8", "#c8641e", "#999999", "#222222"


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def scaled(s, a):
    return tuple(s * x for x in a)


def added(*vectors):
    return tuple(map(sum, zip(*vectors)))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(1 / math.sqrt(dot(a, a)), a)


def root(f, low, high):
    """Where an increasing function becomes positive."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if f(middle) > 0 else (middle, high)
    return (low + high) / 2


class Cone:
    """The directions a s e1 + b t e2 + c e3 with s^2 + t^2 <= 1."""

    def __init__(self, axis, roll, a, b, c):
        self.e3 = unit(axis)
        across = unit(cross((0, 0, 1), self.e3))
        up = cross(self.e3, across)
        self.e1 = added(scaled(math.cos(roll), across), scaled(math.sin(roll), up))
        self.e2 = cross(self.e3, self.e1)
        self.a, self.b, self.c = a, b, c

    def contains(self, w):
        z = dot(w, self.e3) / self.c
        return z > 0 and (dot(w, self.e1) / self.a) ** 2 + (dot(w, self.e2) / self.b) ** 2 <= z * z

    def whole(self, u, v):
        """The map for cones above the horizon: the angle is uniform, the signed radius has a distribution function."""
        alpha, beta = (x / math.hypot(x, self.c) for x in (self.a, self.b))
        x, y = alpha * math.cos(math.pi * u), beta * math.sin(math.pi * u)
        m = math.hypot(x, y)
        slant = (self.e1[2] * x + self.e2[2] * y) / self.e3[2]

        def odd(r):  # the integral of 2 r^2 / sqrt(1 - m^2 r^2)
            s = min(1.0, m * r)
            return (math.asin(s) - s * math.sqrt(1 - s * s)) / m ** 3

        def below(r):
            return (r * abs(r) + 1 + slant * (odd(abs(r)) - odd(1))) / 2

        r = root(lambda r: below(r) - v, -1, 1)
        height = math.sqrt(1 - (m * r) ** 2)
        return added(scaled(r * x, self.e1), scaled(r * y, self.e2), scaled(height, self.e3))

    def prepare_sweep(self, steps=1500):
        """The map for cones that the horizon cuts: a ray sweeps around the middle of the horizon's arc."""
        inside = [i for i in range(3600) if self.contains((math.cos(i * math.pi / 1800), math.sin(i * math.pi / 1800), 0))]
        start = max(range(len(inside)), key=lambda k: (inside[k] - inside[k - 1]) % 3600)
        ordered = inside[start:] + inside[:start]
        middle = (ordered[0] + ((ordered[-1] - ordered[0]) % 3600) / 2) * math.pi / 1800
        self.pole = (math.cos(middle), math.sin(middle), 0)
        self.side = (-math.sin(middle), math.cos(middle), 0)
        self.below = [0.0]
        for i in range(steps):
            turn = math.pi * (i + 0.5) / steps
            angle = self.reach(turn)
            self.below.append(self.below[-1] + (2 * angle - math.sin(2 * angle)) / 4 * math.sin(turn) * math.pi / steps)

    def towards(self, turn, angle):
        away = added(scaled(math.cos(turn), self.side), scaled(math.sin(turn), (0, 0, 1)))
        return added(scaled(math.cos(angle), self.pole), scaled(math.sin(angle), away))

    def reach(self, turn):
        return root(lambda angle: -1 if self.contains(self.towards(turn, angle)) else 1, 0, math.pi)

    def cut(self, u, v):
        goal = u * self.below[-1]
        i = max(k for k in range(len(self.below) - 1) if self.below[k] <= goal)
        share = (goal - self.below[i]) / (self.below[i + 1] - self.below[i])
        turn = math.pi * (i + share) / (len(self.below) - 1)
        largest = self.reach(turn)
        volume = v * (2 * largest - math.sin(2 * largest))
        return self.towards(turn, root(lambda angle: 2 * angle - math.sin(2 * angle) - volume, 0, largest))


class Drawing:
    def __init__(self, width, height):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
                      f'font-size="13" fill="{INK}">', f'<rect width="{width}" height="{height}" fill="#ffffff"/>']

    def line(self, points, colour, width=1.0, fill="none"):
        path = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
        self.parts.append(f'<polyline points="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}"/>')

    def circle(self, x, y, radius, colour, fill="none"):
        self.parts.append(f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:.2f}" fill="{fill}" stroke="{colour}"/>')

    def text(self, x, y, words, anchor="middle"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>')

    def write(self, path):
        path.write_text("\n".join(self.parts + ["</svg>"]) + "\n", encoding="utf-8")


def draw_maps(path):
    """The unit square on Nusselt's disk: equal areas there are equal contributions to diffuse surfaces."""
    drawing = Drawing(760, 400)
    whole = Cone((0.75, 0.2, 0.8), 0.5, 0.62, 0.3, 1)
    cut = Cone((0.8, 0.25, 0.12), 0.9, 0.95, 0.4, 0.7)
    cut.prepare_sweep()
    for centre, sample, words in ((190, whole.whole, "above the horizon"), (570, cut.cut, "cut by the horizon")):
        drawing.circle(centre, 190, 170, GREY)

        def at(u, v):
            x, y, _ = sample(u, v)
            return centre + 170 * x, 190 - 170 * y

        steps = [i / 48 for i in range(49)]
        for i in range(LINES + 1):
            fixed = min(max(i / LINES, 1e-6), 1 - 1e-6)
            drawing.line([at(min(max(t, 1e-6), 1 - 1e-6), fixed) for t in steps], ORANGE)
            drawing.line([at(fixed, t) for t in steps], BLUE)
        drawing.text(centre, 388, words)
    drawing.write(path)


def draw_noise(path):
    """Noise at equal time, on a scale of logarithms: spheres on the left, disks on the right."""
    low, high, names, bars, width = 1e-8, 10.0, 225, 215, 455
    drawing, lowest = None, 0
    for column, shape in enumerate(("spheres", "disks")):
        data = json.loads((ROOT / f"docs/data/round-{shape}.json").read_text(encoding="utf-8"))
        table = next(t for t in data["tables"] if t["name"] == "techniques")
        rows = [dict(zip([c["name"] for c in table["columns"]], row)) for row in table["rows"]]
        classes = list(dict.fromkeys(row["lights"] for row in rows))
        height = 20 * len(rows) + 28 * len(classes) + 36
        if drawing is None:
            drawing, lowest = Drawing(2 * width, height), height
        left = column * width + names

        def place(noise):
            return left + bars * math.log(max(noise, low) / low) / math.log(high / low)

        for exponent in range(-8, 2):
            x = place(10.0 ** exponent)
            drawing.line([(x, 24), (x, lowest - 24)], "#dddddd")
            if exponent % 2 == 0:
                drawing.text(x, lowest - 8, f"10<tspan dy='-5' font-size='9'>{exponent}</tspan>")
        y = 8
        for lights in classes:
            y += 26
            drawing.text(column * width + 8, y, f"<tspan font-weight='bold'>{shape} {lights}</tspan>", "start")
            for row in (row for row in rows if row["lights"] == lights):
                y += 20
                colour = BLUE if row["technique"].endswith("nodes") else ORANGE
                drawing.text(left - 8, y, row["technique"], "end")
                drawing.line([(left, y - 4), (place(row["noise_at_equal_time"]), y - 4)], colour, 9)
    drawing.write(path)


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/papers"
    draw_maps(folder / "elliptic-cones-maps.svg")
    draw_noise(folder / "elliptic-cones-noise.svg")


main()
