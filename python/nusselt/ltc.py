"""Linearly transformed cosines: tables of lobes, their densities and the shading integrals in closed form."""
from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from nusselt import _arrays, _core
from nusselt._arrays import Array, Threads
from nusselt._lights import Lobe, matrix_of, vertex_core

__all__ = ["Lobe", "LtcTable", "density", "diffuse_integral", "lobe_integral", "line_diffuse_integral",
           "line_lobe_integral"]


class LtcTable:
    """A table of lobes over perceptual roughness, inclination of wo and reflectance at normal incidence."""

    def __init__(self, table: _core.LtcTable) -> None:
        if not isinstance(table, _core.LtcTable):
            raise TypeError(f"use LtcTable.frostbite(), LtcTable.phong() or LtcTable.load(file), not LtcTable({table!r})")
        self._table = table

    @staticmethod
    def frostbite() -> LtcTable:
        """The table of the specular part of bsdf.frostbite()."""
        return LtcTable(_core.frostbite_table())

    @staticmethod
    def phong() -> LtcTable:
        """The table of Phong lobes."""
        return LtcTable(_core.phong_table())

    @staticmethod
    def load(path: str | os.PathLike[str]) -> LtcTable:
        """Reads a file as `nusselt-lab fit` writes it. Raises RuntimeError if it is none."""
        return LtcTable(_core.load_table(_arrays.path_of(path)))

    @property
    def entries(self) -> Array:
        """The float32 numbers m00, m02, 1 / m11, -m20, m22 and albedo: (roughnesses, inclinations, f0s, 6), read-only."""
        return self._table.entries

    def lobe(self, roughness: npt.ArrayLike, cos_o: npt.ArrayLike, f0: npt.ArrayLike, *,
             dtype: npt.DTypeLike = None, threads: Threads = 1) -> Lobe:
        """Interpolates. roughness: (...) perceptual, in [0, 1]; cos_o: (...) cosine of the angle between wo and the normal;
        f0: (...) in [0, 1]. Arguments out of range are clamped."""
        matrix, albedo = _arrays.call(
            "table_lobe", [("roughness", roughness, ()), ("cos_o", cos_o, ()), ("f0", f0, ())],
            [("matrix", (5,)), ("albedo", ())], [None, None], dtype, threads, self._table)
        return Lobe(matrix, _arrays.scalar_or_array(albedo))


def density(lobe: Lobe | npt.ArrayLike, wi: npt.ArrayLike, *, out: Array | None = None,
            threads: Threads = 1) -> Any:
    """Densities (...) of unit directions wi (..., 3) in shading space [1/sr]; they integrate to 1 over the sphere."""
    (value,) = _arrays.call("lobe_density", [("lobe", matrix_of(lobe), (5,)), ("wi", wi, (3,))],
                            [("density", ())], [out], threads=threads)
    return _arrays.scalar_or_array(value, out)


def diffuse_integral(vertices: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Any:
    """Integral (...) of the Lambertian lobe over polygons (..., n, 3) above the surface, in [0, 1]: without shadows,
    radiance times albedo times this is what a Lambertian surface reflects."""
    core = vertex_core(vertices, 3, 8)
    (value,) = _arrays.call(f"polygon_diffuse_integral_{slots(core)}", [("vertices", vertices, core)],
                            [("integral", ())], [out], threads=threads)
    return _arrays.scalar_or_array(value, out)


def lobe_integral(vertices: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *, out: Array | None = None,
                  threads: Threads = 1) -> Any:
    """Integral (...) of lobes over polygons (..., n, 3), in [0, 1] (Heitz et al. 2016, with exact clipping)."""
    core = vertex_core(vertices, 3, 8)
    (value,) = _arrays.call(f"polygon_lobe_integral_{slots(core)}",
                            [("vertices", vertices, core), ("lobe", matrix_of(lobe), (5,))],
                            [("integral", ())], [out], threads=threads)
    return _arrays.scalar_or_array(value, out)


def line_diffuse_integral(begin: npt.ArrayLike, end: npt.ArrayLike, *, out: Array | None = None,
                          threads: Threads = 1) -> Any:
    """Integral (...) of the Lambertian lobe over linear lights from begin to end, both (..., 3), per radius [1/m]."""
    (value,) = _arrays.call("line_diffuse_integral", [("line", ends(begin, end), (6,))],
                            [("integral", ())], [out], threads=threads)
    return _arrays.scalar_or_array(value, out)


def line_lobe_integral(begin: npt.ArrayLike, end: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                       out: Array | None = None, threads: Threads = 1) -> Any:
    """Integral (...) of lobes over linear lights from begin to end, both (..., 3), per radius [1/m]
    (Heitz and Hill 2017)."""
    (value,) = _arrays.call("line_lobe_integral",
                            [("line", ends(begin, end), (6,)), ("lobe", matrix_of(lobe), (5,))],
                            [("integral", ())], [out], threads=threads)
    return _arrays.scalar_or_array(value, out)


def slots(core: tuple[int, ...]) -> int:
    """The number of vertices for which a kernel is compiled."""
    return 4 if core[0] <= 4 else 8


def ends(begin: npt.ArrayLike, end: npt.ArrayLike) -> Array:
    """Both ends of lines in one array."""
    dtype = _arrays.real_type({"begin": begin, "end": end})
    both = [_arrays.operand(begin, "begin", (3,), dtype), _arrays.operand(end, "end", (3,), dtype)]
    return np.concatenate(np.broadcast_arrays(*both), axis=-1)
