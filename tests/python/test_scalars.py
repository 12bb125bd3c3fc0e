"""Arrays have the bits of C++ in scalars (scalar_library.cpp): techniques in double, in groups of lights and with many samples
of few lights, and BRDFs, lobes, closed forms and frames in both types. Scalars have the bits of a lane of SSE 4.2, except
where they take the vertices of a polygon as lanes (docs/conventions.md)."""
import ctypes
import os

import numpy as np
import pytest

import nusselt
from conftest import SQUARE, arguments_of
from nusselt import bsdf, geometry, ltc
from nusselt.techniques import __all__ as TECHNIQUES

COUNT = 301  # no multiple of the lanes

if nusselt.instruction_set() != "sse42":
    pytest.fail("the bits are those of NUSSELT_ISA=sse42", pytrace=False)

LIBRARY = ctypes.CDLL(os.environ["NUSSELT_SCALARS"])


class Table(ctypes.Structure):
    """python::TableEntries."""

    _fields_ = [("entries", ctypes.c_void_p), ("roughnesses", ctypes.c_int), ("inclinations", ctypes.c_int),
                ("f0s", ctypes.c_int)]


def columns(arrays, shape, dtype):
    """The numbers of all elements of a shape, an element per column."""
    count = int(np.prod(shape))
    rows = []
    for array, core in arrays:
        rows.append(np.broadcast_to(array, shape + core).reshape(count, -1).T)
    return np.ascontiguousarray(np.concatenate(rows), dtype)


def call(function, name, count, width, inputs, outputs, *more):
    pointers = [(ctypes.c_void_p * len(arrays))(*(array.ctypes.data for array in arrays)) for arrays in (inputs, outputs)]
    function.restype = ctypes.c_bool
    assert function(name.encode(), count, width, pointers[0], len(inputs), pointers[1], len(outputs), *more), name


def differing(ours, theirs):
    """How many numbers have other bits. Any NaN is NaN."""
    ours = np.asarray(ours).reshape(theirs.shape[::-1])
    assert ours.dtype == theirs.dtype
    bits = [np.ascontiguousarray(array).view(f"u{array.itemsize}") for array in (ours, theirs.T)]
    return int(((bits[0] != bits[1]) & ~(np.isnan(ours) & np.isnan(theirs.T))).sum())


@pytest.mark.parametrize("lights_shape, samples", [((COUNT,), 1), ((), COUNT), ((3,), COUNT)],
                         ids=["groups", "one light", "few lights"])
@pytest.mark.parametrize("name", TECHNIQUES)
def test_techniques_in_double(name, lights_shape, samples, rng):
    ordinary = [np.asarray(part, np.float64) for part in arguments_of(name)]
    parts = [np.abs(part + 0.2 * rng.normal(size=lights_shape + (1,) * part.ndim)) if part.ndim == 0 else
             part + 0.2 * rng.normal(size=lights_shape + (1,) * part.ndim) for part in ordinary]
    lights = getattr(nusselt, name)(*parts)
    shape = (samples, *lights_shape)
    u = rng.random(shape + lights._random)
    sample = lights.sample(u)
    ours = [sample.wi, sample.pdf, sample.p, lights.pdf(sample.wi), lights.invert(sample.wi),
            np.broadcast_to(lights.measure(), shape)]
    numbers = columns([(part, core.shape) for part, core in zip(parts, ordinary)], shape, np.float64)
    inputs = [numbers, columns([(u, lights._random)], shape, np.float64)]
    count = numbers.shape[1]
    results = [np.empty((width, count)) for width in (3, 1, 3, 1, len(inputs[1]), 1)]
    call(LIBRARY.nusselt_scalar_technique, name, count, len(numbers), inputs, results)
    assert [differing(a, b) for a, b in zip(ours, results)] == [0] * 6
    inputs[1] *= 1 + 2.0**-40
    call(LIBRARY.nusselt_scalar_technique, name, count, len(numbers), inputs, results)
    assert differing(ours[0], results[0]) > 0, "last bits must be noticed"


def directions(rng):
    v = rng.normal(size=(COUNT, 3))
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def functions(rng, dtype):
    """(kernel, results, arguments with the length of their elements) of all functions of the package."""
    table = nusselt.LtcTable.frostbite()
    wo, wi, albedo, f0, roughness, u = (array.astype(dtype) for array in (
        directions(rng), directions(rng), rng.random((COUNT, 3)), rng.random((COUNT, 3)), rng.random(COUNT),
        rng.random((COUNT, 2)) * (1 - 2.0**-20)))
    wo[:, 2] = np.abs(wo[:, 2])
    one = rng.random(COUNT).astype(dtype)
    yield "lambert", [bsdf.lambert(wi, albedo)], [wi, albedo]
    yield "frostbite", bsdf.frostbite(wo, wi, albedo, f0, roughness), [wo, wi, albedo, f0, roughness]
    yield "phong", [bsdf.phong(wo, wi, albedo, 20 * one)], [wo, wi, albedo, 20 * one]
    for bounded, prefix in [(False, "ggx"), (True, "ggx_bounded")]:
        yield f"{prefix}_sample", bsdf.ggx_sample(wo, roughness, u, bounded=bounded), [wo, roughness, u]
        yield f"{prefix}_pdf", [bsdf.ggx_pdf(wo, roughness, wi, bounded=bounded)], [wo, roughness, wi]
        yield f"{prefix}_invert", [bsdf.ggx_invert(wo, roughness, wi, bounded=bounded)], [wo, roughness, wi]
    lobe = table.lobe(roughness, one, f0[:, 0])
    yield "table_lobe", lobe, [roughness, one, f0[:, 0]]
    yield "lobe_density", [ltc.density(lobe, wi)], [lobe.matrix, wi]
    line = (np.array([-1, 0.2, 1, 1, -0.3, 1.5]) + 0.5 * rng.normal(size=(COUNT, 6))).astype(dtype)
    yield "line_diffuse_integral", [ltc.line_diffuse_integral(line[:, :3], line[:, 3:])], [line]
    yield "line_lobe_integral", [ltc.line_lobe_integral(line[:, :3], line[:, 3:], lobe)], [line, lobe.matrix]
    for kernel, result, arguments in [("normal_frame", geometry.frame(wi), [wi]),
                                      ("shading_frame", geometry.shading_frame(wi, wo), [wi, wo])]:
        yield kernel, [result[:, i] for i in range(3)], arguments
    for slots in (4, 8):
        angles = 2 * np.pi * np.arange(slots) / slots
        polygon = SQUARE if slots == 4 else np.stack([np.cos(angles), np.sin(angles), np.ones(8)], axis=-1)
        polygons = (polygon + rng.normal(size=(COUNT, 1, 3))).astype(dtype)
        yield f"solid_angle_{slots}", [geometry.solid_angle(polygons)], [polygons]
        if dtype == np.float64:
            yield f"projected_solid_angle_{slots}", [geometry.projected_solid_angle(polygons)], [polygons]
            yield f"polygon_diffuse_integral_{slots}", [ltc.diffuse_integral(polygons)], [polygons]
            yield f"polygon_lobe_integral_{slots}", [ltc.lobe_integral(polygons, lobe)], [polygons, lobe.matrix]


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_functions(dtype, rng):
    entries = nusselt.LtcTable.frostbite().entries
    table = ctypes.byref(Table(entries.ctypes.data, *entries.shape[:3]))
    library = LIBRARY.nusselt_scalar_function_float if dtype == np.float32 else LIBRARY.nusselt_scalar_function_double
    different = {}
    for name, ours, arguments in functions(rng, dtype):
        inputs = [columns([(argument, argument.shape[1:])], (COUNT,), dtype) for argument in arguments]
        results = [np.empty((array.size // COUNT, COUNT), dtype) for array in ours]
        call(library, name, COUNT, len(inputs[0]), inputs, results, table)
        different[name] = sum(differing(a, b) for a, b in zip(ours, results))
        assert all((np.asarray(array) != 0).mean() > 0.1 for array in ours), f"{name}: too many zeros to compare"
    assert different == dict.fromkeys(different, 0)
    assert len(different) == (23 if dtype == np.float64 else 17)
