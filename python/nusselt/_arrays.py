"""Types, shapes and memory of arguments: the rules that all functions share."""
from __future__ import annotations

import math
import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from nusselt import _core

Array = npt.NDArray[Any]
Core = tuple[int, ...]
Threads = Union[int, None]


def path_of(path: str | bytes | os.PathLike[Any]) -> bytes:
    """The bytes of the name of a file, whatever its characters."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"the name of a file must not have zeros: {path!r}")
    return name


def whole_number(value: Any, name: str) -> int:
    """A whole number that the compiled module takes as such."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {value!r}") from None
    if not -2**31 <= number < 2**31:
        raise ValueError(f"{name} must be below 2^31, not {number}")
    return number


def finite(value: Any, name: str) -> float:
    """A number that is neither infinite nor NaN."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number, not {value!r}") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} must be finite, not {number}")
    return number


def text(value: Any, name: str) -> str:
    """A text."""
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a text, not {value!r}")
    return value


def real_array(value: npt.ArrayLike, name: str, dtype: npt.DTypeLike = None) -> Array:
    """An array of real numbers of any shape."""
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must be real numbers, not {array.dtype}")
    with np.errstate(over="ignore"):  # what is too large becomes infinite
        return np.asarray(array, dtype)


def real_type(arguments: Mapping[str, npt.ArrayLike], dtype: npt.DTypeLike = None) -> np.dtype[Any]:
    """float32 or float64: dtype, or what numpy gives the sum of the arguments, which have names."""
    if dtype is not None:
        chosen = np.dtype(dtype)
        if chosen not in (np.float32, np.float64):
            raise TypeError(f"dtype must be float32 or float64, not {chosen}")
        return chosen
    known = {name: argument if isinstance(argument, (np.ndarray, np.generic, int, float)) else np.asarray(argument)
             for name, argument in arguments.items()}
    for name, argument in known.items():
        _check_type(np.asarray(argument).dtype, name)
    common = np.result_type(*known.values())
    return np.dtype(np.float32 if common.newbyteorder("=") == np.float32 else np.float64)


def _check_type(dtype: np.dtype[Any], name: str) -> None:
    if dtype.kind not in "biuf" or dtype.itemsize > 8:
        raise TypeError(f"{name} must be real numbers of at most 64 bits, not {dtype}")


def operand(value: npt.ArrayLike, name: str, core: Core, dtype: np.dtype[Any]) -> Array:
    """An array of a type whose last axes have the lengths of core."""
    array = np.asarray(value)
    _check_type(array.dtype, name)
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


def results(outs: Sequence[Array | None], names: Sequence[str], shapes: Sequence[tuple[int, ...]],
            dtype: np.dtype[Any]) -> list[Array]:
    """The arrays of outs, if they fit, and new ones for None."""
    given: list[tuple[str, Array]] = []
    for out, name, shape in zip(outs, names, shapes):
        if out is None:
            continue
        _check_out(out, name, shape, dtype)
        for other_name, other in given:
            if np.shares_memory(out, other):
                raise ValueError(f"out: {other_name} and {name} must not share memory")
        given.append((name, out))
    return [np.empty(shape, dtype) if out is None else out for out, shape in zip(outs, shapes)]


def result(out: Array | None, name: str, shape: tuple[int, ...], dtype: np.dtype[Any]) -> Array:
    """The same for one array."""
    return results([out], [name], [shape], dtype)[0]


def _check_out(out: Array, name: str, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
    if not isinstance(out, np.ndarray) or out.dtype != dtype or out.shape != shape:
        found = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ValueError(f"out: {name} must be a {dtype} array of the shape {shape}, not {found}")
    if not out.flags.writeable or not out.flags.aligned:
        raise ValueError(f"out: {name} must be writeable and aligned")
    if _repeats(out):
        raise ValueError(f"out: {name} must have each of its numbers at a place of its own")


def _repeats(array: Array) -> bool:
    """Whether numbers of an array may be at the same address. False for all that indices and transposition make of a new
    array: there each axis steps over those with smaller strides."""
    extent = array.itemsize
    for stride, length in sorted((abs(stride), length) for stride, length in zip(array.strides, array.shape)):
        if length > 1 and stride < extent:
            return array.size > 0
        extent += stride * (length - 1)
    return False


def apart(array: Array, outputs: Sequence[Array]) -> Array:
    """The array, or a copy of it if an output may be in the same memory."""
    return array.copy() if any(np.may_share_memory(array, output) for output in outputs) else array


def thread_count(threads: Threads) -> int:
    """A number of threads; None stands for one per hardware thread."""
    if threads is None:
        return len(os.sched_getaffinity(0))
    try:
        count = operator.index(threads)
    except TypeError:
        raise TypeError(f"threads must be a whole number, or None for all, not {threads!r}") from None
    if not 1 <= count < 2**31:
        raise ValueError(f"threads must be at least 1 and below 2^31, or None for all, not {count}")
    return count


def call(kernel: str, arguments: Sequence[tuple[str, npt.ArrayLike, Core]],
         values: Sequence[tuple[str, Core]], outs: Sequence[Array | None], dtype: npt.DTypeLike = None,
         threads: Threads = 1, table: _core.LtcTable | None = None) -> list[Array]:
    """Calls a kernel of the compiled module with arguments (name, value, core). values: (name, core) of its results."""
    real = real_type({name: value for name, value, _ in arguments}, dtype)
    inputs = [random_operand(value, core, real) if name == "u" else operand(value, name, core, real)
              for name, value, core in arguments]
    cores = [core for _, _, core in arguments]
    shape = loop_shape(inputs, cores)
    outputs = results(outs, [name for name, _ in values], [shape + core for _, core in values], real)
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
