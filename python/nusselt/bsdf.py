"""BRDFs and the sampling of visible normals.

Directions are unit vectors (..., 3) in shading space and point away from the surface; z is the cosine. BRDFs do not contain
the cosine [1/sr] and are 0 below the surface. Arguments broadcast.
"""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy.typing as npt

from nusselt import _arrays
from nusselt._arrays import Array, Threads

__all__ = ["Components", "NormalSample", "frostbite", "ggx_invert", "ggx_pdf", "ggx_sample", "lambert", "phong"]


class Components(NamedTuple):
    """A BRDF by component [1/sr]."""

    diffuse: Array  #: (..., 3)
    specular: Array  #: (..., 3)


class NormalSample(NamedTuple):
    """Samples of directions in which visible normals reflect."""

    wi: Array  #: (..., 3) unit directions, perhaps below the surface
    pdf: Array  #: (...) densities [1/sr]


def lambert(wi: npt.ArrayLike, albedo: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Array:
    """The Lambertian BRDF (..., 3) for an albedo (..., 3) in [0, 1]."""
    return _arrays.call("lambert", [("wi", wi, (3,)), ("albedo", albedo, (3,))], [("value", (3,))], [out],
                        threads=threads)[0]


def frostbite(wo: npt.ArrayLike, wi: npt.ArrayLike, albedo: npt.ArrayLike, f0: npt.ArrayLike,
              roughness: npt.ArrayLike, *, threads: Threads = 1) -> Components:
    """Disney diffuse, renormalised, plus GGX (Lagarde and de Rousiers 2014).

    albedo, f0: (..., 3) in [0, 1]; roughness: (...) perceptual, in [0, 1].
    """
    arguments: list[tuple[str, npt.ArrayLike, tuple[int, ...]]] = [
        ("wo", wo, (3,)), ("wi", wi, (3,)), ("albedo", albedo, (3,)), ("f0", f0, (3,)),
        ("roughness", roughness, ())]
    diffuse, specular = _arrays.call("frostbite", arguments, [("diffuse", (3,)), ("specular", (3,))],
                                     [None, None], threads=threads)
    return Components(diffuse, specular)


def phong(wo: npt.ArrayLike, wi: npt.ArrayLike, albedo: npt.ArrayLike, exponent: npt.ArrayLike, *,
          out: Array | None = None, threads: Threads = 1) -> Array:
    """The Phong BRDF (..., 3), normalised at normal incidence. albedo: (..., 3); exponent: (...) at least 0."""
    return _arrays.call("phong", [("wo", wo, (3,)), ("wi", wi, (3,)), ("albedo", albedo, (3,)),
                                  ("exponent", exponent, ())], [("value", (3,))], [out], threads=threads)[0]


def ggx_sample(wo: npt.ArrayLike, roughness: npt.ArrayLike, u: npt.ArrayLike, *, bounded: bool = False,
               threads: Threads = 1) -> NormalSample:
    """Samples in proportion to visible GGX normals (Dupuy and Benyoub 2023).

    roughness: (...) perceptual; u: (..., 2) in [0, 1). bounded leaves out normals that are sure to reflect to below the
    surface (Eto and Tokuyoshi 2023).
    """
    wi, pdf = _arrays.call(_ggx("sample", bounded), [("wo", wo, (3,)), ("roughness", roughness, ()), ("u", u, (2,))],
                           [("wi", (3,)), ("pdf", ())], [None, None], threads=threads)
    return NormalSample(wi, _arrays.scalar_or_array(pdf))


def ggx_pdf(wo: npt.ArrayLike, roughness: npt.ArrayLike, wi: npt.ArrayLike, *, bounded: bool = False,
            threads: Threads = 1) -> Any:
    """The density (...) of ggx_sample() [1/sr]."""
    (pdf,) = _arrays.call(_ggx("pdf", bounded), [("wo", wo, (3,)), ("roughness", roughness, ()), ("wi", wi, (3,))],
                          [("pdf", ())], [None], threads=threads)
    return _arrays.scalar_or_array(pdf)


def ggx_invert(wo: npt.ArrayLike, roughness: npt.ArrayLike, wi: npt.ArrayLike, *, bounded: bool = False,
               threads: Threads = 1) -> Array:
    """The random numbers (..., 2) for which ggx_sample() returns wi."""
    return _arrays.call(_ggx("invert", bounded),
                        [("wo", wo, (3,)), ("roughness", roughness, ()), ("wi", wi, (3,))], [("u", (2,))], [None],
                        threads=threads)[0]


def _ggx(function: str, bounded: bool) -> str:
    return f"ggx_bounded_{function}" if bounded else f"ggx_{function}"
