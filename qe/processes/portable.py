"""Errors on their way from one process to another."""

from __future__ import annotations

import errno
import pickle
import re
import traceback

from qe.errors import BudgetExceeded, InternalError, QEError, Unable, restored
from qe.extras import lacking

Parts = tuple[type[QEError], tuple[object, ...], dict[str, object]]
"""Class, arguments and attributes of an error."""


def portable(error: BaseException) -> Parts:
    """An error as class, arguments and attributes; a foreign exception becomes an ``InternalError``.

    Pickling an exception calls its constructor again, which formats some of our messages twice.
    """
    if _out_of_memory(error):
        return BudgetExceeded, ("memory limit reached",), {"limit": "memory"}
    if isinstance(error, RecursionError):
        return Unable, ("the formula is nested too deeply",), {}
    if isinstance(error, ValueError) and "integer string conversion" in str(error):
        return Unable, ("a number has more digits than Python writes; sys.set_int_max_str_digits(0) lets it",), {}
    if isinstance(error, ImportError):
        error = lacking(error) or error
    if not isinstance(error, QEError):
        frames = traceback.extract_tb(error.__traceback__)
        place = f" at {'/'.join(frames[-1].filename.split('/')[-2:])}:{frames[-1].lineno}" if frames else ""
        text = f"{type(error).__name__}{place}: {error}".splitlines()[0]
        return InternalError, (text,), {"trace": "".join(traceback.format_exception(error))}
    return type(error), (str(error),), {k: v for k, v in vars(error).items() if packed(v) is not None}


def _out_of_memory(error: BaseException) -> bool:
    """Whether memory was short, also where the system said so: for a file, or a library that finds no room."""
    if isinstance(error, ImportError):
        return re.search(r"failed to map segment|annot allocate memory", str(error)) is not None
    return isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM)


def packed(value: object) -> bytes | None:
    """The value as it is sent; None where it cannot be. Raises ``Unable`` for what is nested too deeply."""
    try:
        return pickle.dumps(value)
    except RecursionError as error:
        raise restored(*portable(error)) from None
    except (TypeError, AttributeError, pickle.PicklingError):
        return None
