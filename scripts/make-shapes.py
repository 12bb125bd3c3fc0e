#!/usr/bin/env python3
"""Writes the meshes of scenes/shapes that are too long to write by hand: soup.ply and torus.ply.

Usage: scripts/make-shapes.py [FOLDER]     FOLDER: default scenes/shapes
The same bytes on every machine: all random numbers come from a generator of its own.
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing new in the folder of the sources
from portable_random import Random


def ply(comment, properties, vertices, triangles):
    lines = ["ply", "format ascii 1.0", f"comment {comment}", f"element vertex {len(vertices)}"]
    lines += [f"property float {name}" for name in properties.split()]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(f"{value:.4f}".rstrip("0").rstrip(".") for value in vertex) for vertex in vertices]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in triangles]
    return "\n".join(lines) + "\n"


def soup(count, radius, low, high):
    """Triangles in a box. Each has corners on a sphere of its own, and no two spheres meet: the triangles are disjoint."""
    random = Random(1)

    def direction():
        z, angle = random.uniform(-1, 1), random.uniform(0, 2 * math.pi)
        return (math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle), z)

    centers, vertices = [], []
    while len(centers) < count:
        center = [random.uniform(a + radius, b - radius) for a, b in zip(low, high)]
        if all(math.dist(center, other) > 2 * radius for other in centers):
            centers.append(center)
            vertices += [[c + radius * d for c, d in zip(center, direction())] for _ in range(3)]
    return ply(f"{count} disjoint triangles by scripts/make-shapes.py", "x y z", vertices,
               [(i, i + 1, i + 2) for i in range(0, 3 * count, 3)])


def torus(around, across, thickness):
    """Lies on the plane y = 0 around the y axis; the circle in the middle of the tube has radius 1."""
    vertices, triangles = [], []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            normal = (math.cos(v) * math.cos(u), math.sin(v), math.cos(v) * math.sin(u))
            center = (math.cos(u), thickness, math.sin(u))
            vertices.append([c + thickness * n for c, n in zip(center, normal)] + list(normal))
            a, b = across * i, across * ((i + 1) % around)
            k = (j + 1) % across
            triangles += [(a + j, a + k, b + k), (a + j, b + k, b + j)]
    return ply("torus by scripts/make-shapes.py", "x y z nx ny nz", vertices, triangles)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "scenes/shapes")
    (folder / "soup.ply").write_text(soup(1000, 0.06, (-0.9, 0.45, -0.9), (0.9, 1.75, 0.9)))
    (folder / "torus.ply").write_text(torus(48, 24, 0.35))
