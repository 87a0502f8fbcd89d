"""Errors from one process to another: they come out as they went in."""

import errno
import pickle

import pytest

from qe.errors import BudgetExceeded, InputError, InternalError, ParseError, QEError, Unable, restored
from qe.processes.portable import portable
from tests.tables import each


def sent(error: BaseException) -> QEError:
    return restored(*pickle.loads(pickle.dumps(portable(error))))


def raised(error: BaseException) -> BaseException:
    try:
        raise error
    except (QEError, ZeroDivisionError) as found:
        return found


@each(InputError("x: expected a number"), Unable("too hard"), QEError("so"))
def test_our_errors_keep_class_and_message(error: QEError) -> None:
    found = sent(raised(error))
    assert type(found) is type(error) and str(found) == str(error)


def test_attributes_come_along_and_messages_are_formatted_once() -> None:
    import qe

    with pytest.raises(ParseError) as caught:
        qe.eliminate("ex x. x + > 1")
    found = sent(caught.value)
    assert type(found) is ParseError and str(found) == str(caught.value)
    assert vars(found) == vars(caught.value)


@each(
    MemoryError(),
    OSError(errno.ENOMEM, "Cannot allocate memory"),
    ImportError("libflint.so: failed to map segment from shared object"),
    ImportError("cannot allocate memory in static TLS block"),
)
def test_little_memory_is_a_limit_whoever_notices(error: BaseException) -> None:
    found = sent(error)
    assert isinstance(found, BudgetExceeded) and found.limit == "memory"


@each(OSError(errno.ENOENT, "no such file"), ImportError("no module named x"))
def test_other_errors_of_the_system_are_no_limit(error: BaseException) -> None:
    assert isinstance(sent(error), InternalError)


def test_what_cannot_be_pickled_is_left_behind() -> None:
    error = Unable("so")
    error.kept, error.left = 7, lambda: None  # type: ignore[attr-defined]
    found = sent(error)
    assert found.kept == 7 and not hasattr(found, "left")  # type: ignore[attr-defined]


def test_limits_of_the_machine() -> None:
    memory = sent(MemoryError())
    assert type(memory) is BudgetExceeded and memory.limit == "memory"  # type: ignore[attr-defined]
    assert type(sent(RecursionError("deep"))) is Unable


def test_a_foreign_exception_is_a_bug_with_its_place() -> None:
    found = sent(raised(ZeroDivisionError("two\nlines")))
    assert type(found) is InternalError
    assert "ZeroDivisionError at processes/test_portable.py:" in str(found) and "\n" not in str(found)
    assert "Traceback" in found.trace  # type: ignore[attr-defined]
