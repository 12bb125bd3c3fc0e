"""The random numbers of the renderer: functions of seed, pixel, sample, light and pair of dimensions, without state."""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

from nusselt import _arrays, _core
from nusselt._arrays import Array

__all__ = ["points", "light_random"]


def light_random(sampler: str, x: npt.ArrayLike, y: npt.ArrayLike, sample: npt.ArrayLike, sample_count: int, *,
                 seed: int = 0, light: int = 0, pair: int = 0, dtype: npt.DTypeLike = np.float32) -> Array:
    """Two numbers in [0, 1) for each sample (..., 2), as the renderer takes them.

    sampler: independent, sobol, jittered (best for linear lights), stratified (best for line samples), z_sobol or blue_noise.
    x, y: (...) pixels; sample: (...) numbers from 0 to sample_count - 1, which is at most 2^22, or 2^31 for z_sobol.
    light, pair: streams that are independent. All are whole numbers below 2^32.
    """
    if dtype is None:
        raise TypeError("dtype must be float32 or float64, not None")
    real = _arrays.real_type({}, dtype)
    _arrays.text(sampler, "sampler")
    pixels_and_samples = np.broadcast_arrays(*(_whole(value, name) for value, name in
                                               ((x, "x"), (y, "y"), (sample, "sample"))))
    stream = [_whole_number(value, name) for value, name in ((seed, "seed"), (light, "light"), (pair, "pair"))]
    count = _whole_number(sample_count, "sample_count")
    bits = 31 if sampler == "z_sobol" else 22
    if not 1 <= count <= 2**bits:
        raise ValueError(f"sample_count must lie between 1 and 2^{bits} for sampler {sampler!r}, not {count}")
    if (pixels_and_samples[2] >= count).any():
        raise ValueError(f"sample must be below sample_count, which is {count}")
    shape = pixels_and_samples[0].shape
    u = np.empty(shape + (2,), real)
    fill = _core.random_float if real == np.float32 else _core.random_double
    columns = [np.ascontiguousarray(array) for array in pixels_and_samples]
    fill(sampler, stream[0], columns[0], columns[1], columns[2], count, stream[1], stream[2], u)
    return u


def points(sampler: str, count: int, *, pixel: tuple[int, int] = (0, 0), seed: int = 0, light: int = 0,
           pair: int = 0, dtype: npt.DTypeLike = np.float32) -> Array:
    """The points (count, 2) of one pixel and light: light_random() for all samples."""
    try:
        x, y = pixel
    except (TypeError, ValueError):
        raise ValueError(f"pixel must be the pair (x, y), not {pixel!r}") from None
    return light_random(sampler, x, y, np.arange(_whole_number(count, "count")), count, seed=seed, light=light, pair=pair,
                        dtype=dtype)


def _whole(value: npt.ArrayLike, name: str) -> Array:
    array = np.asarray(value)
    if array.dtype.kind not in "iu" or (array.size and (array.min() < 0 or array.max() >= 2**32)):
        raise ValueError(f"{name} must be whole numbers from 0 to 2^32 - 1")
    return array.astype(np.uint32)


def _whole_number(value: int, name: str) -> int:
    array = _whole(value, name)
    if array.ndim > 0:
        raise ValueError(f"{name} must be one whole number, not an array {array.shape}")
    return int(array)
