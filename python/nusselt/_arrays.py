"""Types, shapes and memory of arguments: the rules that all functions share."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from nusselt import _core

Array = npt.NDArray[Any]
Core = tuple[int, ...]
Threads = Union[int, None]


def real_type(arguments: Sequence[npt.ArrayLike], dtype: npt.DTypeLike = None) -> np.dtype[Any]:
    """float32 or float64: dtype, or what numpy gives the sum of the arguments."""
    if dtype is not None:
        chosen = np.dtype(dtype)
        if chosen not in (np.float32, np.float64):
            raise TypeError(f"dtype must be float32 or float64, not {chosen}")
        return chosen
    known = [argument if isinstance(argument, (np.ndarray, np.generic, int, float)) else np.asarray(argument)
             for argument in arguments]
    common = np.result_type(*known)
    if common.kind not in "biuf":
        raise TypeError(f"numbers are expected, not {common}")
    return np.dtype(np.float32 if common == np.float32 else np.float64)


def operand(value: npt.ArrayLike, name: str, core: Core, dtype: np.dtype[Any]) -> Array:
    """An array of a type whose last axes have the lengths of core."""
    array = np.asarray(value)
    if array.shape[array.ndim - len(core):] != core or array.ndim < len(core):
        wanted = "".join(f", {length}" for length in core)
        raise ValueError(f"{name} must have the shape (...{wanted}), not {array.shape}")
    return np.require(array, dtype, "A")


def random_operand(value: npt.ArrayLike, core: Core, dtype: np.dtype[Any]) -> Array:
    """Random numbers. Rounding to float32 leaves them below 1."""
    array = np.asarray(value)
    if array.dtype == dtype or array.dtype.kind != "f":
        return operand(array, "u", core, dtype)
    below_one = np.nextafter(np.float32(1), np.float32(0))
    return operand(np.minimum(array, below_one) if dtype == np.float32 else array, "u", core, dtype)


def loop_shape(arrays: Sequence[Array], cores: Sequence[Core], *others: tuple[int, ...]) -> tuple[int, ...]:
    """The shape to which the arguments broadcast, without the axes of single elements."""
    shapes = [array.shape[:array.ndim - len(core)] for array, core in zip(arrays, cores)]
    return np.broadcast_shapes(*shapes, *others)


def result(out: Array | None, name: str, shape: tuple[int, ...], dtype: np.dtype[Any]) -> Array:
    """A new array, or out if that fits."""
    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray) or out.dtype != dtype or out.shape != shape:
        found = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ValueError(f"out: {name} must be a {dtype} array of the shape {shape}, not {found}")
    if not out.flags.writeable or not out.flags.aligned:
        raise ValueError(f"out: {name} must be writeable and aligned")
    return out


def apart(array: Array, outputs: Sequence[Array]) -> Array:
    """The array, or a copy of it if an output may be in the same memory."""
    return array.copy() if any(np.may_share_memory(array, output) for output in outputs) else array


def thread_count(threads: Threads) -> int:
    """A number of threads; None stands for one per hardware thread."""
    if threads is None:
        return len(os.sched_getaffinity(0))
    if threads < 1:
        raise ValueError(f"threads must be at least 1, or None for all, not {threads}")
    return int(threads)


def call(kernel: str, arguments: Sequence[tuple[str, npt.ArrayLike, Core]],
         results: Sequence[tuple[str, Core]], outs: Sequence[Array | None], dtype: npt.DTypeLike = None,
         threads: Threads = 1, table: _core.LtcTable | None = None) -> list[Array]:
    """Calls a kernel of the compiled module with arguments (name, value, core) and results (name, core)."""
    real = real_type([value for _, value, _ in arguments], dtype)
    inputs = [random_operand(value, core, real) if name == "u" else operand(value, name, core, real)
              for name, value, core in arguments]
    cores = [core for _, _, core in arguments]
    shape = loop_shape(inputs, cores)
    outputs = [result(out, name, shape + core, real) for (name, core), out in zip(results, outs)]
    inputs = [np.broadcast_to(flat(apart(array, outputs), core), shape + flat_core(core))
              for array, core in zip(inputs, cores)]
    run = _core.call_float if real == np.float32 else _core.call_double
    run(kernel, shape, inputs, outputs, thread_count(threads), table)
    return outputs


def flat_core(core: Core) -> Core:
    """One axis for all numbers of an element."""
    return core if len(core) < 2 else (int(np.prod(core)),)


def flat(array: Array, core: Core) -> Array:
    """The array with one axis for all numbers of an element."""
    return array if len(core) < 2 else array.reshape(array.shape[:array.ndim - len(core)] + flat_core(core))


def scalar_or_array(array: Array, out: Array | None = None) -> Any:
    """As numpy's functions: a number where an array without axes would be new."""
    return array[()] if out is None else array
