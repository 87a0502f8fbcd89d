"""Single steps of derivations, written by hand, and what their checkers say."""

from typing import Any

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, convert
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.kernel.derivation import limits_of
from qe.kernel.step import Check, Claim, Limits
from qe.options import Budget
from qe.proof.entry import Entry, formula_to_json, poly_to_text

RING = Ring.of(("a", "b", "c", "x", "y", "z"))
NO_LEMMAS: dict[str, Any] = {"polynomials": [], "lemmas": [], "cases": []}


def formula(text: str | Formula) -> Formula:
    """A formula over ``RING``; names that it binds belong to ``RING``, too."""
    return convert(read(text) if isinstance(text, str) else text, RING)


def poly(text: str) -> Poly:
    found = formula(f"{text} = 0")
    return found.poly  # type: ignore[attr-defined,no-any-return]


def line(text: str) -> str:
    """A polynomial as certificates hold it."""
    return poly_to_text(poly(text))


def written(text: str | Formula) -> Any:
    """A formula as certificates hold it."""
    return formula_to_json(formula(text), quantified=True)


def step(rule: str, before: str, after: str, evidence: Any = None, given: str = "true") -> dict[str, Any]:
    """A step at the root of a formula, as certificates hold it."""
    known = formula(given)
    return {
        "rule": rule,
        "at": [],
        "before": written(before),
        "after": written(after),
        "context": [written(f) for f in conjuncts(known)] if given != "true" else [],
        "evidence": evidence or {},
    }


def limits(seconds: float = 60) -> Limits:
    return limits_of(Budget(seconds), RULES)


def objection(
    rule: str | Check, before: str | Formula, after: str | Formula, evidence: Any = None, given: str = "true"
) -> str:
    """Why the checker of a rule rejects a step, with the place in its evidence; nothing where it accepts it."""
    left, right = formula(before), formula(after)
    name = rule if isinstance(rule, str) else "rule"
    claim = Claim(name, left, right, RING, Entry(evidence or {}, "evidence"), "step")
    known = formula(given)
    check = RULES[rule] if isinstance(rule, str) else rule
    try:
        check(claim, conjuncts(known) if given != "true" else (), limits())
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


def both(*parts: str) -> Formula:
    """The conjunction, nothing simplified."""
    return conj(map(formula, parts))
