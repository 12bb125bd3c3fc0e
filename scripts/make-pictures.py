#!/usr/bin/env python3
"""Writes the pictures that lights of the scenes emit: television.png and window.png, and rainbow.png, blade.png and
beads.png, which have a row for each part of a tube, the lowest one for its start.

Usage: scripts/make-pictures.py [FOLDER]     FOLDER: default scenes/pictures
The same pixels on every machine: all random numbers come from a generator of its own.
"""
import math
import pathlib
import struct
import sys
import zlib

sys.dont_write_bytecode = True  # nothing new in the folder of the sources
from portable_random import Random


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def smoothstep(low, high, x):
    t = min(max((x - low) / (high - low), 0), 1)
    return t * t * (3 - 2 * t)


def code(x):
    """The code of a linear intensity in sRGB."""
    x = min(max(x, 0), 1)
    return round(255 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055))


def png(width, height, colour):
    """\\param colour of the pixel in column i and row j, linear"""
    rows = b""
    for j in range(height):
        rows += b"\0" + bytes(code(c) for i in range(width) for c in colour(i, j))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def television():
    """The sun sets over the sea, behind hills and a sailing boat."""
    width, height = 320, 180
    random = Random(3)
    ripples = [(random.uniform(20, 90), random.uniform(0, 6.3), random.uniform(0.2, 1)) for _ in range(24)]
    sun = (0.63, 0.55)

    def colour(i, j):
        x, y = (i + 0.5) / height, 1 - (j + 0.5) / height
        sea = y < 0.42
        mirrored = 0.84 - y if sea else y
        height_above = (mirrored - 0.42) / 0.58
        sky = mix((0.75, 0.2, 0.05), (0.02, 0.035, 0.12), smoothstep(0, 0.75, height_above))
        distance = math.hypot(x - sun[0] * width / height, mirrored - sun[1])
        sky = tuple(s + g * math.exp(-distance * distance / 0.02) for s, g in zip(sky, (0.55, 0.2, 0.03)))
        if distance < 0.065 and not sea:
            sky = (1, 0.72, 0.25)
        if sea:
            depth = 0.42 - y
            wave = sum(a * math.sin(f * (2 * depth + 0.02 / (depth + 0.02)) + p + 5 * x) for f, p, a in ripples)
            glitter = math.exp(-((x - sun[0] * width / height) / (0.05 + 0.5 * depth)) ** 2)
            sky = tuple(0.35 * s + max(wave, 0) * 0.05 * glitter * c for s, c in zip(sky, (1, 0.55, 0.2)))
        hills = 0.42 + 0.06 * math.sin(3.1 * x + 1) + 0.03 * math.sin(9 * x)
        if not sea and mirrored < hills and x < 0.95:
            sky = (0.008, 0.008, 0.015)
        u, v = x - 1.45, y - 0.36
        if (0 < v < 0.3 and 0.004 < u < 0.11 * (1 - v / 0.3)) or (0 < v < 0.25 and -0.07 * (1 - v / 0.25) < u < -0.004):
            sky = (0.5, 0.16, 0.06)
        if -0.025 < v < 0 and -0.09 - v < u < 0.11 + v:
            sky = (0.01, 0.006, 0.005)
        return sky

    return png(width, height, colour)


def window():
    """Stained glass: a rose above lozenges, with leads between the panes."""
    width, height = 160, 320
    random = Random(7)
    glass = [(0.75, 0.03, 0.02), (0.02, 0.08, 0.6), (0.9, 0.5, 0.04), (0.02, 0.35, 0.09), (0.35, 0.02, 0.4),
             (0.05, 0.35, 0.6), (0.95, 0.85, 0.55)]
    shade = {}

    def pane(key, colours):
        if key not in shade:
            shade[key] = (random.uniform(0.55, 1), colours[int(random.uniform(0, len(colours)))])
        brightness, pigment = shade[key]
        return tuple(brightness * c for c in pigment)

    def colour(i, j):
        x, y = (i + 0.5) / width - 0.5, 1.5 - (j + 0.5) / width
        radius, angle = math.hypot(x, y - 1), math.atan2(y - 1, x)
        if radius < 0.42:
            sectors, ring = (8, 1) if radius < 0.18 else (16, 2)
            if radius < 0.07:
                return pane("rose", [glass[6]]) if radius < 0.06 else (0, 0, 0)
            turn = angle * sectors / (2 * math.pi) + (0.5 if ring == 1 else 0)
            lead = abs(turn - round(turn)) * 2 * math.pi / sectors * radius < 0.006
            if lead or abs(radius - 0.18) < 0.008 or radius > 0.405:
                return (0, 0, 0)
            return pane((ring, math.floor(turn) % sectors), [glass[0], glass[2]] if ring == 1 else glass[1:6])
        a, b = 6 * (x + 0.6 * y), 6 * (x - 0.6 * y)
        if min(abs(a - round(a)), abs(b - round(b))) < 0.045 or abs(x) > 0.47:
            return (0, 0, 0)
        return pane(("lozenge", math.floor(a), math.floor(b)), glass[:6])

    return png(width, height, colour)


def tube(colour):
    """\\param colour function of the place along the tube, from 0 to 1"""
    rows = 64
    return png(1, rows, lambda i, j: colour(1 - (j + 0.5) / rows))


def rainbow():
    """From violet to red."""
    stops = [(0.3, 0, 1), (0.02, 0.12, 1), (0, 0.65, 0.6), (0.1, 0.8, 0.05), (0.9, 0.55, 0), (1, 0.15, 0), (1, 0, 0.12)]

    def colour(x):
        place = x * (len(stops) - 1)
        k = min(int(place), len(stops) - 2)
        return mix(stops[k], stops[k + 1], smoothstep(0, 1, place - k))

    return tube(colour)


def blade():
    """Bright at its start, dark red at its end."""
    return tube(lambda x: mix((1, 0.22, 0.015), (0.25, 0, 0.04), smoothstep(0, 0.75, x)))


def beads():
    """Seven beads of light, each in its own mixture of blue and green."""

    def colour(x):
        k = min(int(7 * x), 6)
        inside = smoothstep(0.36, 0.2, abs(7 * x - k - 0.5))
        return mix((0, 0.002, 0.01), mix((0, 0.12, 1), (0.02, 0.9, 0.4), k / 6), inside)

    return tube(colour)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "scenes/pictures")
    (folder / "television.png").write_bytes(television())
    (folder / "window.png").write_bytes(window())
    (folder / "rainbow.png").write_bytes(rainbow())
    (folder / "blade.png").write_bytes(blade())
    (folder / "beads.png").write_bytes(beads())


if __name__ == "__main__":
    main()
