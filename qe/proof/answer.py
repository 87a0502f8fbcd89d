"""The answer to a quantifier elimination problem: what the public functions return."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Any

from qe import arguments
from qe.errors import InputError, NoTruthValue, Unable
from qe.exact.number import Assignment, point_text
from qe.formula.assumed import claimed
from qe.formula.syntax import TRUE, Constant, Formula
from qe.proof.certificate import Certificate
from qe.proof.derivation import Derivation, put_together
from qe.proof.partial import Partial
from qe.proof.run_log import RunLog
from qe.services import Service, service

UNPROVED = "a limit ended the search for a proof"
"""Why an answer is no better than derived that was known before its proof."""


class Status(Enum):
    """Whether the problem was answered. UNABLE always carries a reason."""

    SOLVED = "solved"
    UNABLE = "unable"


class Guarantee(Enum):
    """CHECKED: separate code accepted the certificate. DERIVED: it follows from the algorithms' theorems only. NONE:
    there is no answer."""

    CHECKED = "checked"
    DERIVED = "derived"
    NONE = "none"


@dataclass(frozen=True, slots=True, repr=False)
class Answer:
    """``formula``: quantifier-free and equivalent to the input over R (None if unable).

    ``truth``: True or False for sentences. ``witness``: exact values for the outermost block of a true existential
    sentence, or a counterexample to a false universal one. ``certificate``: what ``qe.verify`` accepts, when the
    method produces one. ``reason``: why there is no answer, or no certificate that was verified.
    ``unchecked_steps``: with ``check``, the rules of the steps of the derivation that no checker has accepted; the
    answer can be ``CHECKED`` all the same, by a decomposition. ``question`` and ``log``: what was asked, and how it was
    answered. ``assuming``: where the formula is right, and what it does not repeat; ``generic``: the inequations in it
    that were assumed on the way (``generic=True``). ``partial``: what is known where there is no answer, if that was
    asked for (``anytime``).
    """

    status: Status
    formula: Formula | None
    witness: Assignment | None = None
    certificate: Certificate | None = None
    guarantee: Guarantee = Guarantee.DERIVED
    reason: str = ""
    unchecked_steps: tuple[str, ...] = ()
    question: Formula | None = field(default=None, repr=False)
    log: RunLog = field(default_factory=RunLog, repr=False)
    partial: Partial | None = None
    assuming: Formula = TRUE
    generic: tuple[Formula, ...] = ()

    def __post_init__(self) -> None:
        if self.status is Status.UNABLE:
            object.__setattr__(self, "guarantee", Guarantee.NONE)

    @property
    def truth(self) -> bool | None:
        """The truth value of a sentence, None for a formula with free variables."""
        return self.formula.value if isinstance(self.formula, Constant) else None

    @property
    def why_unchecked(self) -> str:
        """Why the guarantee is no better; empty for ``CHECKED``."""
        return "" if self.guarantee is Guarantee.CHECKED else self.reason or "no check was asked for"

    @property
    def trusts(self) -> tuple[str, ...]:
        """The theorems without proof, by name, on which the certificate rests (``qe.theorems``)."""
        return () if self.certificate is None else self.certificate.trusts

    @property
    def stats(self) -> Mapping[str, Any]:
        """What was done: figures by method, choices, switches, seconds."""
        return self.log.stats()

    @property
    def derivation(self) -> Derivation:
        """The steps from the question to the formula. Raises ``Unable`` where there is no answer."""
        before, after = self.sides
        return put_together(before, self.log.steps(), after)

    @property
    def sides(self) -> tuple[Formula, Formula]:
        """The two equivalent formulas of which a certificate speaks: the question and the answer, or what both say
        where the assumptions hold (``qe.formula.assumed``)."""
        if self.formula is None or self.question is None:
            raise Unable(f"there is no derivation: {self.reason or 'nothing was asked'}")
        ask = self.question
        return claimed(self.assuming, ask, ask), claimed(self.assuming, ask, self.formula)

    @property
    def explanation(self) -> str:
        """The steps in words and formulas, numbered, with the choices and figures between them."""
        from qe.proof.explanation import explained

        return explained(self.log)

    def _written(self, format: str) -> str:
        """Raises ``Unable`` where there is no answer."""
        from qe.io import formats

        if self.formula is None:
            raise Unable(f"there is no formula to write: {self.reason}")
        return formats.write(self.formula, format)

    def to_smtlib(self) -> str:
        """An SMT-LIB 2 script that asserts the formula."""
        return self._written("smtlib")

    def to_qepcad(self) -> str:
        """QEPCAD's notation."""
        return self._written("qepcad")

    def to_redlog(self) -> str:
        """Redlog's notation."""
        return self._written("redlog")

    def to_latex(self) -> str:
        """LaTeX."""
        return self._written("latex")

    def to_sympy(self) -> Any:
        """A SymPy Boolean."""
        from qe.io.sympy import to_sympy

        if self.formula is None:
            raise Unable(f"there is no formula to convert: {self.reason}")
        return to_sympy(self.formula)

    def _sympy_(self) -> Any:
        """What SymPy takes an answer for: the Boolean of its formula."""
        return self.to_sympy()

    def __bool__(self) -> bool:
        """Raises ``NoTruthValue``: a false sentence has an answer, too."""
        raise NoTruthValue("an answer has no truth value of its own; ask for answer.truth, or call qe.decide")

    def plot(
        self, path: str | Path | None = None, *, ax: Any = None, order: Any = None, timeout: float | None = None
    ) -> Any:
        """A picture of the values of one to three free variables for which the formula holds; see ``Region.plot``.

        ``order``: which variable goes where. Raises ``InputError`` for other numbers of variables, ``Unable`` where
        there is no answer, ``BudgetExceeded`` at the limit. Where there are parts only (``partial``), one or two
        variables from -5 to 5, in three colours.
        """
        if self.formula is None and self.partial is not None and self.question is not None:
            names = arguments.names(order) or self.question.free
            if sorted(names) != sorted(self.question.free):
                raise InputError(f"order: the free variables expected, {', '.join(names)} found")
            return service(Service.PARTIAL_PICTURE)(self.partial, names, path, ax, timeout)
        if self.formula is None:
            raise Unable(f"there is no formula to draw: {self.reason}")
        return service(Service.REGION)(self.formula, order, timeout=timeout).plot(path, ax=ax, timeout=timeout)

    def __repr__(self) -> str:
        found = f"unable: {self.reason}" if self.formula is None else self.formula.brief()
        known = f", {point_text(self.witness)}" if self.witness else ""
        return f"Answer({found}{known}; {self.guarantee.value})"

    def _repr_latex_(self) -> str | None:
        return None if self.formula is None else self.formula._repr_latex_()

    def _repr_html_(self) -> str:
        """The formula with its guarantee and time, for notebooks."""
        from html import escape  # which is seldom needed

        seconds = self.log.seconds
        notes = [self.guarantee.value, *([] if seconds is None else [f"{seconds:.3f} s"])]
        if self.witness:
            notes.append(f"{'counterexample' if self.truth is False else 'witness'}: {point_text(self.witness)}")
        shown = "unable" if self.formula is None else service(Service.WRITTEN)(self.formula, "mathml")
        reason = [self.reason] if self.reason else []
        return f"<div>{shown}<br><small>{escape('; '.join((*notes, *reason)))}</small></div>"

    def __str__(self) -> str:
        return str(self.formula) if self.formula is not None else f"unable: {self.reason}"
