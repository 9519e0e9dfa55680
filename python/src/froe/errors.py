"""Failures as exceptions. Each status of the C interface has a class, and each class is also the built-in exception
that programs expect: ValueError for bad input, MemoryError, OSError, KeyboardInterrupt.

>>> import froe
>>> try:
...     froe.segments([[0, 0, 1, float("nan")]])
... except ValueError as error:
...     print(type(error).__name__, error.object, error.corner, error.axis)
InputError 0 1 1
"""

from __future__ import annotations


class Error(Exception):
    """Any failure of froe. The message is a whole sentence, which names the object and the reason.

    :ivar status: the name of the C interface's status, for example ``"FROE_E_INPUT"``; "" where the package refused
    :ivar object: the object, or the position in the arrays given, that is to blame; None if there is none
    :ivar corner: its corner, or None
    :ivar axis: the axis of the coordinate, or None
    """

    status: str = ""
    object: int | None = None
    corner: int | None = None
    axis: int | None = None


class ArgumentError(Error, ValueError):
    """A count, dimension or other argument is out of range."""


class OptionError(Error, ValueError):
    """An option or method does not exist, or its value is out of range."""


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory. Nothing is changed."""


class InputError(Error, ValueError):
    """Data is wrong: NaN or infinity, a polygon that is not planar, a box whose upper corner is below its lower one."""


class LimitError(Error, OverflowError):
    """There are more than 2^31 - 2 objects, vertices, nodes or pieces."""


class BudgetError(Error):
    """More pieces would be made than ``max_pieces`` allows."""


class CancelledError(Error, KeyboardInterrupt):
    """The progress function returned False."""


class UnsupportedError(Error, NotImplementedError):
    """This method, tree or reader cannot serve the request."""


class FileError(Error, OSError):
    """A file cannot be opened, read or written."""


class FormatError(Error, ValueError):
    """A file or a pickle is not what it claims to be, truncated, corrupted, or of another version."""


class FrozenError(Error, RuntimeError):
    """The scene belongs to a tree and can no longer grow."""


class AuditError(Error, AssertionError):
    """A tree is not right."""


class ArrayError(Error, TypeError):
    """An array has a type, shape or layout that cannot be taken without loss."""


class ClosedError(Error, ValueError):
    """The tree has been closed."""


class BusyError(Error, RuntimeError):
    """Another call, on another thread or around this one, is using the same object."""


# In the order of froe_status, without FROE_OK.
_OF_STATUS: tuple[tuple[str, type[Error]], ...] = (
    ("FROE_E_ARG", ArgumentError),
    ("FROE_E_OPTIONS", OptionError),
    ("FROE_E_MEMORY", OutOfMemoryError),
    ("FROE_E_INPUT", InputError),
    ("FROE_E_LIMIT", LimitError),
    ("FROE_E_BUDGET", BudgetError),
    ("FROE_E_CANCELLED", CancelledError),
    ("FROE_E_UNSUPPORTED", UnsupportedError),
    ("FROE_E_IO", FileError),
    ("FROE_E_FORMAT", FormatError),
    ("FROE_E_FROZEN", FrozenError),
    ("FROE_E_AUDIT", AuditError),
)


def of_status(
    status: int, message: str, object: int | None = None, corner: int | None = None, axis: int | None = None
) -> Error:
    """The exception of a status, for the extension."""
    name, kind = _OF_STATUS[status - 1]
    error = kind(message)
    error.status, error.object, error.corner, error.axis = name, object, corner, axis
    return error


def of_name(name: str, message: str) -> Error:
    """An exception of a class of this module, for the extension."""
    kind: type[Error] = globals()[name]
    return kind(message)
