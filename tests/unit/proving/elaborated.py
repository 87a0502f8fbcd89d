"""Steps of rules that are no primitives: why they are none of the kernel's."""

from collections.abc import Mapping, Sequence
from typing import Any

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.step import Claim
from qe.kernel.verdict import CRASHES
from qe.proof.entry import Entry
from qe.proving.elaborators import ELABORATORS, FRESH
from tests.unit.certify.claims import RING, formula, limits


def refused(rule: str, before: str | Formula, after: str | Formula, evidence: Any = None, given: str = "true") -> str:
    """Why a step is not one of the kernel; nothing where it is."""
    sides = [formula(side) if isinstance(side, str) else side for side in (before, after)]
    names = [name for side in sides for name in (side.ring.names if side.ring is not None else ())]
    ring = Ring.of(dict.fromkeys((*RING.names, *names, *FRESH)))
    context = tuple(convert(f, ring) for f in conjuncts(formula(given))) if given != "true" else ()
    left, right = (convert(side, ring) for side in sides)
    claim = Claim(rule, left, right, ring, Entry(evidence or {}, "evidence"), "step")
    try:
        steps: Any = ELABORATORS[rule](claim, context, limits())
        made = Claim("steps", left, right, ring, Entry({"steps": steps}, "evidence"), "step")
        RULES["steps"](made, context, limits())
    except (CertificateRejected, *CRASHES) as error:
        return str(error) or type(error).__name__
    return ""


Row = tuple[str | Formula, str | Formula, Any]
"""Before, after, evidence."""


def rows(table: Mapping[str, Sequence[Row]]) -> list[tuple[object, ...]]:
    """The rows of all rules, each with the name of its rule."""
    return [(rule, *row) for rule, listed in table.items() for row in listed]


def is_a_step_and_no_other_is(rule: str, before: str | Formula, after: str | Formula, evidence: Any) -> bool:
    """Whether the step is one of the kernel, and none that leads elsewhere: to the negation, or to a constant."""
    right = formula(after) if isinstance(after, str) else after
    wrong = (nnf(neg(right)), *({TRUE, FALSE} - {right}))
    return refused(rule, before, after, evidence) == "" and all(refused(rule, before, f, evidence) for f in wrong)
