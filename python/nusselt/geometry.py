"""Frames of surfaces, and measures of lights in closed form."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from nusselt import _arrays
from nusselt._arrays import Array, Threads
from nusselt._lights import vertex_core
from nusselt.ltc import slots

__all__ = ["frame", "projected_solid_angle", "shading_frame", "solid_angle", "to_shading", "to_world"]


def solid_angle(vertices: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Any:
    """Solid angles (...) of convex polygons (..., n, 3) as seen from the origin [sr]; n from 3 to 8."""
    return _measure("solid_angle", vertices, out, threads)


def projected_solid_angle(vertices: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Any:
    """Projected solid angles (...) of the parts of convex polygons (..., n, 3) with z > 0 [sr]; n from 3 to 8."""
    return _measure("projected_solid_angle", vertices, out, threads)


def frame(normal: npt.ArrayLike, *, threads: Threads = 1) -> Array:
    """Right-handed frames (..., 3, 3) of unit normals (..., 3): their rows are the axes x, y and z (the normal) of shading
    space in the world (Duff et al. 2017)."""
    return _frame("normal_frame", [("normal", normal, (3,))], threads)


def shading_frame(normal: npt.ArrayLike, wo: npt.ArrayLike, *, threads: Threads = 1) -> Array:
    """The same with wo in the half-plane y = 0, x >= 0, as lobes need it. normal, wo: (..., 3), unit, in the world."""
    return _frame("shading_frame", [("normal", normal, (3,)), ("wo", wo, (3,))], threads)


def to_shading(frames: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    """Vectors v (..., 3) of the world in shading spaces (..., 3, 3). Subtract the shading point from points first."""
    return _rotated("...ij,...j->...i", frames, v)


def to_world(frames: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    """Vectors v (..., 3) of shading spaces (..., 3, 3) in the world."""
    return _rotated("...ji,...j->...i", frames, v)


def _rotated(sum_of_products: str, frames: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    dtype = _arrays.real_type({"frames": frames, "v": v})
    rotated: Array = np.einsum(sum_of_products, _arrays.operand(frames, "frames", (3, 3), dtype),
                               _arrays.operand(v, "v", (3,), dtype))
    return rotated


def _measure(name: str, vertices: npt.ArrayLike, out: Array | None, threads: Threads) -> Any:
    core = vertex_core(vertices, 3, 8)
    (value,) = _arrays.call(f"{name}_{slots(core)}", [("vertices", vertices, core)], [("measure", ())], [out],
                            threads=threads)
    return _arrays.scalar_or_array(value, out)


def _frame(kernel: str, arguments: list[tuple[str, npt.ArrayLike, tuple[int, ...]]], threads: Threads) -> Array:
    axes = _arrays.call(kernel, arguments, [("x", (3,)), ("y", (3,)), ("z", (3,))], [None, None, None],
                        threads=threads)
    return np.stack(axes, axis=-2)
