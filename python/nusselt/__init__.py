"""Importance sampling of area lights, and a renderer: the library Nusselt for numpy.

    import nusselt, numpy
    light = nusselt.PolygonProjectedSolidAngle([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
    wi, pdf, p = light.sample(numpy.random.random((1000, 2)))

    scene = nusselt.load("scene.pbrt")                  # pbrt text, version 3 or 4
    scene.edit([{"light": "*", "scale_radiance": 2}])   # all lights
    nusselt.render(scene, samples=16).save("image.exr")

Lengths are in metres, angles in radians, radiance in W/(sr m^2). Directions point away from the surface; shading space has
the shading point as its origin and the normal as +z.
"""
import sys as _sys

try:
    from nusselt import _core
except ImportError as error:
    if "cannot import name '_core'" not in str(error):
        raise  # a shared library, for example
    raise ImportError(f"{__path__[0]} has no compiled module for Python {_sys.version_info[0]}.{_sys.version_info[1]}; "
                      "docs/python.md says how to build and install it") from None
from nusselt import accuracy, bsdf, geometry, images, ltc, random
from nusselt._lights import Lobe, Sample, Technique
from nusselt.images import Image, flip, rmse
from nusselt.ltc import LtcTable
from nusselt.rendering import Rendering, render, setting_names
from nusselt.scene import Scene, load
from nusselt.techniques import *
from nusselt.techniques import __all__ as _techniques


def instruction_set() -> str:
    """The instruction set of all functions over arrays: sse42, avx2 or avx512. The environment variable NUSSELT_ISA chooses
    another one before the first call."""
    return _core.isa()


__all__ = ["Image", "Lobe", "LtcTable", "Rendering", "Sample", "Scene", "Technique", "accuracy", "bsdf", "flip", "geometry",
           "images", "instruction_set", "load", "ltc", "random", "render", "rmse", "setting_names", *_techniques]
