"""Errors of samples."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from nusselt._lights import Sample, Technique

__all__ = ["backward_error", "density_error"]


def backward_error(exact: Technique, u: npt.ArrayLike, sample: Sample) -> Any:
    """The change (...) of the first random number that would explain the rounding errors of samples, NaN where there is no
    sample (Peters 2021, polygonal lights, Sec. 3.6).

    exact: the same lights in float64. u: what the technique was given. Where the zenith is in a polygon, 0 and 1 are the
    same number.
    """
    inverse = np.asarray(exact.invert(sample.wi), np.float64)
    given = np.asarray(u, np.float64)
    error = np.abs(inverse - given)
    error = error[..., 0] if exact._random else error
    return np.where(np.asarray(sample.pdf) > 0, error, np.nan)[()]


def density_error(exact: Technique, sample: Sample) -> Any:
    """Relative errors (...) of the densities of samples, NaN where there is none. exact: the same lights in float64."""
    true = np.asarray(exact.pdf(sample.wi), np.float64)
    pdf = np.asarray(sample.pdf, np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where((pdf > 0) & (true > 0), np.abs(pdf / true - 1), np.nan)[()]
