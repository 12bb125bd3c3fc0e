"""What all techniques have in common, and the kinds of lights that they take."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from nusselt import _arrays, _core
from nusselt._arrays import Array, Core, Threads


class Sample(NamedTuple):
    """Samples of lights. Where pdf is 0 there is no sample: do not use wi and p."""

    wi: Array  #: (..., 3) unit directions from the shading point to the light
    pdf: Array  #: (...) densities of wi [1/sr]; for lines per radius [m/sr]
    p: Array  #: (..., 3) points on the light relative to the shading point [m]; shadow rays lead there


class Technique:
    """Lights that are prepared for a technique.

    Lights are in shading space: the shading point is the origin, the shading normal is +z. One object holds an array of
    lights; its `shape` broadcasts with that of random numbers and directions. To take many samples of many lights, give
    random numbers one more axis in front.

    All numbers of an object have one type, float32 or float64: `dtype`, or what numpy gives the sum of the arguments. Other
    arguments are converted to it. No value of a number is an error: techniques never fail, and `pdf == 0` says that there
    is no sample.

    Functions release the GIL. They use `threads` threads, None for one per hardware thread; bits do not depend on it.
    """

    _random: ClassVar[Core] = (2,)

    def __init__(self, parts: Sequence[tuple[str, npt.ArrayLike, Core]], dtype: npt.DTypeLike) -> None:
        self._dtype = _arrays.real_type({name: value for name, value, _ in parts}, dtype)
        arrays = [_arrays.operand(value, name, core, self.dtype) for name, value, core in parts]
        cores = [core for _, _, core in parts]
        self._shape = _arrays.loop_shape(arrays, cores)
        columns = [np.broadcast_to(_arrays.flat(array, core) if core else array[..., None],
                                   self.shape + (_arrays.flat_core(core) or (1,)))
                   for array, core in zip(arrays, cores)]
        numbers = np.concatenate(columns, axis=-1).reshape(-1, sum(column.shape[-1] for column in columns))
        if len(numbers) == 0:
            raise ValueError("there are no lights: an axis has the length 0")
        self._prepare(np.ascontiguousarray(numbers))

    def _prepare(self, numbers: Array) -> None:
        self._numbers = numbers
        self._lights = _core.Lights(type(self).__name__, numbers, self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the array of lights."""
        return self._shape

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of all numbers."""
        return self._dtype

    def __getstate__(self) -> tuple[Array, tuple[int, ...]]:
        return self._numbers, self._shape

    def __setstate__(self, state: tuple[Array, tuple[int, ...]]) -> None:
        numbers, self._shape = state
        self._dtype = numbers.dtype
        self._prepare(numbers)

    def sample(self, u: npt.ArrayLike, *, out: Sequence[Array | None] | None = None,
               threads: Threads = 1) -> Sample:
        """Samples for random numbers.

        u: (..., 2) in [0, 1); for lines (...), one number of a sample.
        out: arrays for wi, pdf and p of the resulting shapes and the type of the technique, or None for a new one.
        """
        numbers = _arrays.random_operand(u, self._random, self.dtype)
        shape = _arrays.loop_shape([numbers], [self._random], self.shape)
        if out is not None and not isinstance(out, Sequence):
            raise TypeError(f"out must be a list of arrays for wi, pdf and p, not {type(out).__name__}")
        given = list(out) if out is not None else [None, None, None]
        if len(given) != 3:
            raise ValueError(f"out must have arrays for wi, pdf and p, not {len(given)}")
        wi, pdf, p = _arrays.results(given, ["wi", "pdf", "p"], [shape + (3,), shape, shape + (3,)], self.dtype)
        numbers = np.broadcast_to(_arrays.apart(numbers, (wi, pdf, p)), shape + self._random)
        self._lights.sample(shape, numbers, wi, pdf, p, _arrays.thread_count(threads))
        return Sample(wi, _arrays.scalar_or_array(pdf, given[1]), p)

    def pdf(self, wi: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Any:
        """Densities (...) of unit directions wi (..., 3) [1/sr]; 0 beside the light. For lines, directions that sample()
        returns; densities are per radius [m/sr]."""
        directions, shape = self._directions(wi)
        pdf = _arrays.result(out, "pdf", shape, self.dtype)
        directions = np.broadcast_to(_arrays.apart(directions, (pdf,)), shape + (3,))
        self._lights.pdf(shape, directions, pdf, _arrays.thread_count(threads))
        return _arrays.scalar_or_array(pdf, out)

    def invert(self, wi: npt.ArrayLike, *, out: Array | None = None, threads: Threads = 1) -> Any:
        """Random numbers for which sample() returns the unit directions wi (..., 3): (..., 2), for lines (...)."""
        directions, shape = self._directions(wi)
        u = _arrays.result(out, "u", shape + self._random, self.dtype)
        directions = np.broadcast_to(_arrays.apart(directions, (u,)), shape + (3,))
        self._lights.invert(shape, directions, u, _arrays.thread_count(threads))
        return u if self._random else _arrays.scalar_or_array(u, out)

    def measure(self, *, out: Array | None = None, threads: Threads = 1) -> Any:
        """The normalisation of each light, of `shape`: what the density of the technique integrates before it is divided
        by it. The class says which one."""
        measure = _arrays.result(out, "measure", self.shape, self.dtype)
        self._lights.measure(measure, _arrays.thread_count(threads))
        return _arrays.scalar_or_array(measure, out)

    def _directions(self, wi: npt.ArrayLike) -> tuple[Array, tuple[int, ...]]:
        directions = _arrays.operand(wi, "wi", (3,), self.dtype)
        return directions, _arrays.loop_shape([directions], [(3,)], self.shape)

    def __repr__(self) -> str:
        return f"<nusselt.{type(self).__name__} of {self.dtype} lights {self.shape}>"


class Lobe(NamedTuple):
    """Lobes of glossy surfaces: linearly transformed cosines. wo lies in the half-plane y = 0, x >= 0."""

    matrix: Array  #: (..., 5) the entries m00, m02, m11, m20, m22 of cosine_from_shading
    albedo: Array  #: (...) the fraction of light from everywhere that the lobe reflects


def matrix_of(lobe: Lobe | npt.ArrayLike) -> npt.ArrayLike:
    """The matrices of lobes."""
    return lobe.matrix if isinstance(lobe, Lobe) else lobe


_Parts = list[tuple[str, npt.ArrayLike, Core]]


def vertex_core(vertices: npt.ArrayLike, fewest: int, most: int) -> Core:
    """The axes of one polygon, whose number of vertices must be in a range."""
    shape = np.shape(vertices)
    if len(shape) < 2 or shape[-1] != 3 or not fewest <= shape[-2] <= most:
        count = str(fewest) if fewest == most else f"{fewest} to {most}"
        raise ValueError(f"vertices must have the shape (..., n, 3) with n = {count}, not {shape}")
    return shape[-2:]


def _polygon(vertices: npt.ArrayLike, fewest: int, most: int) -> _Parts:
    return [("vertices", vertices, vertex_core(vertices, fewest, most))]


def _line(begin: npt.ArrayLike, end: npt.ArrayLike) -> _Parts:
    return [("begin", begin, (3,)), ("end", end, (3,))]


def _lobe(lobe: Lobe | npt.ArrayLike) -> _Parts:
    return [("lobe", matrix_of(lobe), (5,))]


class Polygon(Technique):
    """A technique for polygons."""

    def __init__(self, vertices: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """vertices: (..., n, 3) with n from 3 to 8 [m]; convex and planar, in either winding."""
        super().__init__(_polygon(vertices, 3, 8), dtype)


class Rectangle(Technique):
    """A technique for rectangles."""

    def __init__(self, vertices: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """vertices: (..., 4, 3) [m], in either winding."""
        super().__init__(_polygon(vertices, 4, 4), dtype)


class PolygonOnLobe(Technique):
    """A technique for polygons that light a glossy surface."""

    _most_vertices: ClassVar[int] = 8

    def __init__(self, vertices: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """vertices: (..., n, 3) with n from 3 to 8, 7 for PolygonClippedLtc [m]; convex and planar, in either winding.

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__(_polygon(vertices, 3, self._most_vertices) + _lobe(lobe), dtype)


class Line(Technique):
    """A technique for linear lights: tubes of vanishing radius."""

    _random = ()

    def __init__(self, begin: npt.ArrayLike, end: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """begin, end: (..., 3) the ends of the lines [m]."""
        super().__init__(_line(begin, end), dtype)


class LineOnLobe(Technique):
    """A technique for linear lights that light a glossy surface."""

    _random = ()

    def __init__(self, begin: npt.ArrayLike, end: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """begin, end: (..., 3) the ends of the lines [m].

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__(_line(begin, end) + _lobe(lobe), dtype)


class Cylinder(Technique):
    """A technique for cylinders without caps."""

    def __init__(self, begin: npt.ArrayLike, end: npt.ArrayLike, radius: npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """begin, end: (..., 3) the ends of the axes [m]; radius: (...) [m]."""
        super().__init__(_line(begin, end) + [("radius", radius, ())], dtype)


class CylinderOnLobe(Technique):
    """A technique for cylinders without caps that light a glossy surface."""

    def __init__(self, begin: npt.ArrayLike, end: npt.ArrayLike, radius: npt.ArrayLike,
                 lobe: Lobe | npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """begin, end: (..., 3) the ends of the axes [m]; radius: (...) [m].

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__(_line(begin, end) + [("radius", radius, ())] + _lobe(lobe), dtype)


class Sphere(Technique):
    """A technique for spheres."""

    def __init__(self, center: npt.ArrayLike, radius: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; radius: (...) [m]. From inside, all directions lead to the light."""
        super().__init__([("center", center, (3,)), ("radius", radius, ())], dtype)


class SphereOnLobe(Technique):
    """A technique for spheres that light a glossy surface."""

    def __init__(self, center: npt.ArrayLike, radius: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; radius: (...) [m]. From inside, all directions lead to the light.

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__([("center", center, (3,)), ("radius", radius, ())] + _lobe(lobe), dtype)


class Disk(Technique):
    """A technique for disks."""

    def __init__(self, center: npt.ArrayLike, normal: npt.ArrayLike, radius: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; normal: (..., 3) of unit length, to either side; radius: (...) [m]."""
        super().__init__([("center", center, (3,)), ("normal", normal, (3,)), ("radius", radius, ())], dtype)


class DiskOnLobe(Technique):
    """A technique for disks that light a glossy surface."""

    def __init__(self, center: npt.ArrayLike, normal: npt.ArrayLike, radius: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; normal: (..., 3) of unit length, to either side; radius: (...) [m].

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__([("center", center, (3,)), ("normal", normal, (3,)), ("radius", radius, ())] + _lobe(lobe), dtype)


class Ellipse(Technique):
    """A technique for ellipses."""

    def __init__(self, center: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; u, v: (..., 3) conjugate semi-diameters [m], which need not be perpendicular."""
        super().__init__([("center", center, (3,)), ("u", u, (3,)), ("v", v, (3,))], dtype)


class EllipseOnLobe(Technique):
    """A technique for ellipses that light a glossy surface."""

    def __init__(self, center: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; u, v: (..., 3) conjugate semi-diameters [m], which need not be perpendicular.

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__([("center", center, (3,)), ("u", u, (3,)), ("v", v, (3,))] + _lobe(lobe), dtype)


class Ellipsoid(Technique):
    """A technique for ellipsoids."""

    def __init__(self, center: npt.ArrayLike, axes: npt.ArrayLike, *, dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; axes: (..., 3, 3) three conjugate semi-diameters in rows [m]."""
        super().__init__([("center", center, (3,)), ("axes", axes, (3, 3))], dtype)


class EllipsoidOnLobe(Technique):
    """A technique for ellipsoids that light a glossy surface."""

    def __init__(self, center: npt.ArrayLike, axes: npt.ArrayLike, lobe: Lobe | npt.ArrayLike, *,
                 dtype: npt.DTypeLike = None) -> None:
        """center: (..., 3) [m]; axes: (..., 3, 3) three conjugate semi-diameters in rows [m].

        lobe: a Lobe or its matrices (..., 5), from LtcTable.lobe().
        """
        super().__init__([("center", center, (3,)), ("axes", axes, (3, 3))] + _lobe(lobe), dtype)
