"""Arguments as the extension takes them: C-contiguous float64, uint32 and uint64, without any loss."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from .errors import ArrayError

Doubles = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int32]
Progress = Callable[[float], object]  # of the share done; False ends the call

EXACT = 2**53  # whole numbers up to this are doubles


def plain(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    """An array of anything. Rows of different lengths make none, and masks are not passed over."""
    parts: list[Any] = list(values) if isinstance(values, (list, tuple)) else [values]
    _refuse_masked(parts, name)
    try:
        found: npt.NDArray[Any] = np.asanyarray(values)
    except ValueError as error:
        raise ArrayError(f"{name} cannot become an array: {error}.") from None
    _refuse_masked([found], name)  # an object may make one of itself
    for _ in range(found.ndim - 2):  # lists of lists; in the innermost ones are numbers
        parts = [inner for part in parts if isinstance(part, (list, tuple)) for inner in part]
        _refuse_masked(parts, name)
    array: npt.NDArray[Any] = np.asarray(found)
    return _of_columns(values, array, name) if array.dtype.kind == "O" and hasattr(values, "isna") else array


def _refuse_masked(parts: list[Any], name: str) -> None:
    if any(isinstance(part, np.ma.MaskedArray) and np.asarray(part.mask).any() for part in parts):
        raise ArrayError(f"{name} has masked items, which have no value.")


def _of_columns(values: Any, array: npt.NDArray[Any], name: str) -> npt.NDArray[Any]:
    """The numbers of a column of pandas or of several, whose items may be missing, as in ``Int64`` and ``Float64``:
    numpy makes objects of them."""
    columns = [values] if array.ndim == 1 else [values.iloc[:, i] for i in range(array.shape[1])]
    types = [getattr(column.dtype, "numpy_dtype", column.dtype) for column in columns]
    if any(kind.kind not in "fiu" for kind in types):
        return array
    missing = np.argwhere(np.asarray(values.isna()))
    if len(missing):
        raise ArrayError(f"{name} has no value at {tuple(int(i) for i in missing[0])}.")
    numbers = [column.to_numpy(kind) for column, kind in zip(columns, types, strict=True)]
    made: npt.NDArray[Any] = np.stack(numbers, axis=-1) if array.ndim > 1 else numbers[0]
    return made


def doubles(values: npt.ArrayLike, name: str) -> Doubles:
    """An array of float64. One that already is is used as it is; others are copied if every number stays the same. The
    extension copies what may be written to, and uses the rest where it lies: so views that are read-only, of memory
    that need not be, are copied here.

    >>> doubles([1, 2], "values")
    array([1., 2.])
    >>> doubles([2**53 + 1], "values")
    Traceback (most recent call last):
        ...
    froe.errors.ArrayError: values has the number 9007199254740993 at (0,), which float64 cannot hold.
    """
    array = plain(values, name)
    if array.dtype != np.float64:
        array = _converted(array, name)
    elif not isinstance(values, np.ndarray) and (np.abs(array) >= EXACT).any():
        given = np.asarray(values, object)
        _refuse(given, _rounded(given, array), name)
    if array.size == 0:
        return np.empty(array.shape)  # one at an odd address counts as aligned
    return _settled(np.require(array, np.float64, ["C", "A"]))


def _settled(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """An array that nothing else writes to while it is read-only."""
    if array.flags.writeable or array.base is None:
        return array
    array = array.copy()
    array.flags.writeable = False
    return array


def _converted(array: npt.NDArray[Any], name: str) -> Doubles:
    if array.size == 0 and array.dtype.kind in "fiu":
        return array.astype(np.float64)
    if array.dtype.kind not in "fiu":
        raise ArrayError(f"{name} must be an array of float64, and its type is {array.dtype}.")
    with np.errstate(over="ignore"):  # infinity is refused below
        converted = array.astype(np.float64)
    if array.dtype.kind in "iu":
        lost = _rounded(array, converted)
    else:
        lost = (converted.astype(array.dtype) != array) & (array == array)
    _refuse(array, lost, name)
    converted.flags.writeable = False
    return converted


def _rounded(array: npt.NDArray[Any], converted: Doubles) -> npt.NDArray[np.bool_]:
    """Where whole numbers are not the doubles that were made of them. Of a list with whole numbers and others numpy
    makes doubles by itself."""
    rounded: npt.NDArray[np.bool_] = np.asarray(np.abs(converted) >= EXACT)
    for found in np.argwhere(rounded):
        where = tuple(int(i) for i in found)
        number = array[where]
        rounded[where] = isinstance(number, (int, np.integer)) and int(number) != float(converted[where])
    return rounded


def _refuse(array: npt.NDArray[Any], lost: npt.NDArray[np.bool_], name: str) -> None:
    if lost.any():
        where = tuple(int(i) for i in np.argwhere(lost)[0])
        raise ArrayError(f"{name} has the number {array[where]} at {where}, which float64 cannot hold.")


def rows(values: npt.ArrayLike, name: str, width: int, inner: int) -> Doubles:
    """An array of rows of `width` numbers: of the shape (n, width), or (n, width / inner, inner).

    >>> rows([[[0, 0], [1, 1]]], "segments", 4, 2).shape
    (1, 4)
    """
    array = doubles(values, name)
    if array.ndim in (1, 2) and len(array) == 0:
        return array.reshape(0, width)
    if array.shape[1:] not in ((width,), (width // inner, inner)):
        shapes = f"(n, {width})" + (f" or (n, {width // inner}, {inner})" if width != inner else "")
        raise ArrayError(f"{name} must have the shape {shapes}, and has {array.shape}.")
    return array.reshape(-1, width)


def whole(values: npt.ArrayLike, name: str, kind: type[np.unsignedinteger[Any]]) -> npt.NDArray[Any]:
    """An array of whole numbers that are not negative, of the type `kind`.

    >>> whole([1, 2], "groups", np.uint32)
    array([1, 2], dtype=uint32)
    >>> whole([1, -2], "groups", np.uint32)
    Traceback (most recent call last):
        ...
    froe.errors.ArrayError: groups has the number -2 at (1,), which is not between 0 and 4294967295.
    """
    array = plain(values, name)
    if array.size == 0:
        return np.empty(array.shape, kind)
    if array.dtype.kind not in "iu":
        array = _listed(values, array.dtype, name)
    most = np.iinfo(kind).max
    bad = (array < 0) | (array > most)
    if bad.any():
        where = tuple(int(i) for i in np.argwhere(bad)[0])
        raise ArrayError(f"{name} has the number {array[where]} at {where}, which is not between 0 and {most}.")
    return _settled(np.require(array, kind, ["C", "A"]))


def _listed(values: npt.ArrayLike, made: np.dtype[Any], name: str) -> npt.NDArray[Any]:
    """The whole numbers of a list that has large ones, of which numpy makes doubles or objects."""
    given = np.asarray(values, object)
    are_whole = all(type(item) is int or isinstance(item, np.integer) for item in given.flat)
    if isinstance(values, np.ndarray) or not are_whole:
        raise ArrayError(f"{name} must be an array of whole numbers, and its type is {made}.")
    return given


def flat(array: npt.NDArray[Any], name: str) -> npt.NDArray[Any]:
    """The array, which has one number for each of something.

    >>> flat(np.zeros((2, 2)), "radii")
    Traceback (most recent call last):
        ...
    froe.errors.ArrayError: radii must have the shape (n,), and has (2, 2).
    """
    if array.ndim != 1:
        raise ArrayError(f"{name} must have the shape (n,), and has {array.shape}.")
    return array


def point(values: npt.ArrayLike, name: str, dim: int) -> Doubles:
    """One point of `dim` numbers."""
    array = doubles(values, name)
    if array.shape != (dim,):
        raise ArrayError(f"{name} must have the shape ({dim},), and has {array.shape}.")
    return array


def part(values: npt.NDArray[Any], starts: npt.NDArray[Any], number: SupportsIndex, name: str) -> npt.NDArray[Any]:
    """One row of a ragged array; those below 0 are counted from the end."""
    count, row = len(starts) - 1, operator.index(number)
    if not -count <= row < count:
        raise IndexError(f"There is no {name} {row}: there are {count}.")
    row %= count
    return values[starts[row] : starts[row + 1]]
