"""All results have the bits of C++: of the program that also judges the package for JavaScript, which is compiled for SSE 4.2
and calls each technique in packs, for hostile and for ordinary lights."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import nusselt
from nusselt.techniques import __all__ as TECHNIQUES

LIGHTS, ROUNDS = 301, 2  # no multiple of the lanes

if nusselt.instruction_set() != "sse42":
    pytest.fail("the bits are those of NUSSELT_ISA=sse42", pytrace=False)


def cases(path):
    """(technique, light columns, u, directions, results) as the program wrote them, rounds first."""
    data = path.read_bytes()
    offset = 0
    while offset < len(data):
        technique, columns, count, rounds, random = np.frombuffer(data, np.int32, 5, offset)
        offset += 20

        def take(width, length=rounds):
            nonlocal offset
            numbers = np.frombuffer(data, np.float32, length * width * count, offset)
            offset += numbers.nbytes
            return np.moveaxis(numbers.reshape(length, width, count), 1, -1)
        lights = take(columns, 1)[0]
        u, directions = take(random), take(3)
        sizes = [3, 1, 3, None, 1, random, 1, random]
        results = [take(size) if size else take(1, 1)[0] for size in sizes]
        yield TECHNIQUES[technique], lights, u, directions, results


def prepared(name, lights):
    lobe = [lights[:, -5:]] if "Ltc" in name else []
    numbers = lights[:, :-5] if lobe else lights
    if name.startswith("Line"):
        parts = [numbers[:, :3], numbers[:, 3:6]]
    elif name.startswith("Cylinder"):
        parts = [numbers[:, :3], numbers[:, 3:6], numbers[:, 6]]
    elif name.startswith("Sphere"):
        parts = [numbers[:, :3], numbers[:, 3]]
    elif name.startswith("Disk"):
        parts = [numbers[:, :3], numbers[:, 3:6], numbers[:, 6]]
    elif name.startswith("Ellipsoid"):
        parts = [numbers[:, :3], numbers[:, 3:].reshape(-1, 3, 3)]
    elif name.startswith("Ellipse"):
        parts = [numbers[:, :3], numbers[:, 3:6], numbers[:, 6:9]]
    else:
        parts = [numbers.reshape(len(numbers), -1, 3)]
    return getattr(nusselt, name)(*parts, *lobe)


def results_of(technique, u, directions):
    column = (lambda x: x[..., None]) if not technique._random else (lambda x: x)
    sample = technique.sample(u if technique._random else u[..., 0])
    return [sample.wi, sample.pdf[..., None], sample.p, technique.measure()[..., None],
            technique.pdf(sample.wi)[..., None], column(technique.invert(sample.wi)),
            technique.pdf(directions)[..., None], column(technique.invert(directions))]


def differing(ours, theirs):
    """How many numbers have other bits. Any NaN is NaN."""
    count = 0
    for a, b in zip(ours, theirs):
        assert a.shape == b.shape and a.dtype == b.dtype == np.float32
        bits = [np.ascontiguousarray(x).view(np.uint32) for x in (a, b)]
        count += int(((bits[0] != bits[1]) & ~(np.isnan(a) & np.isnan(b))).sum())
    return count


def test_results_have_the_bits_of_the_library(tmp_path: pathlib.Path):
    file = tmp_path / "results"
    subprocess.run([os.environ["NUSSELT_NATIVE"], "results", str(LIGHTS), str(ROUNDS), str(file)], check=True)
    compared = set()
    for name, lights, u, directions, results in cases(file):
        technique = prepared(name, lights)
        assert differing(results_of(technique, u, directions), results) == 0, (name, lights.shape)
        changed = (u.view(np.uint32) ^ 1).view(np.float32)
        assert differing(results_of(technique, changed, directions), results) > 0, "last bits must be noticed"
        compared.add(name)
    assert compared == set(TECHNIQUES)
