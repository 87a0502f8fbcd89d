"""The error tree: bad input, inability and rejection are three different things, by type."""

from __future__ import annotations

from qe.spelling import on_one_line


class QEError(Exception):
    """Base class of every error this package raises on purpose."""

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        """Pickled without its constructor, which makes a message of other arguments."""
        return restored, (type(self), self.args, vars(self))


class InputError(QEError):
    """The caller's input cannot be understood; the message is one line saying what was expected."""

    def __init__(self, message: str = "") -> None:
        super().__init__(on_one_line(message))


class ParseError(InputError):
    """A formula text cannot be read.

    ``line`` and ``column`` count from 1; ``expected`` says what would have been accepted there.
    """

    message: str
    source: str
    line: int
    column: int
    expected: str

    def __init__(
        self, message: str, *, source: str = "<text>", line: int = 1, column: int = 1, expected: str = ""
    ) -> None:
        message = on_one_line(message)
        self.message, self.source, self.line, self.column, self.expected = message, source, line, column, expected
        tail = f" (expected {expected})" if expected else ""
        super().__init__(f"{source}:{line}:{column}: {message}{tail}")


class DoubtfulInput(UserWarning):
    """A formula can be read, but it may not say what was meant: see ``qe.formula.doubts``. Nothing but a warning."""


class NoTruthValue(InputError, TypeError):
    """Python asked whether something is true that is not a statement, or not one decided yet."""


class Unable(QEError):
    """No answer could be given; never raised to hide a wrong one. Carries what is known so far."""


class DegreeTooHigh(Unable):
    """Virtual substitution met a degree in the quantified variable that it has no test points for."""


class NotWellOriented(Unable):
    """A projection factor vanishes identically over a cell of positive dimension (McCallum 1998)."""


class BudgetExceeded(Unable):
    """A limit on time, memory or cells was reached; ``limit`` names it."""

    def __init__(self, message: str, *, limit: str = "time") -> None:
        self.limit = limit
        super().__init__(message)


class CertificateRejected(QEError):
    """A certificate does not prove what it claims; ``step`` names the failing entry."""

    step: str
    reason: str

    def __init__(self, step: str, reason: str) -> None:
        self.step, self.reason = step, reason
        super().__init__(f"{step}: {reason}")


class InternalError(QEError):
    """A broken invariant: a bug in this package."""


class Contradiction(InternalError):
    """Two ways to an answer disagree: one of them is wrong, and nobody may be given either."""


def restored(kind: type[QEError], arguments: tuple[object, ...], attributes: dict[str, object]) -> QEError:
    """An error of this class with these arguments and attributes; no message is made once more."""
    error = kind.__new__(kind, *arguments)
    vars(error).update(attributes)
    return error
