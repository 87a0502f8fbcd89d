"""Primitives broken once on purpose: each mutant accepts a false claim that the kernel as it stands refuses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from qe.formula.build import conj, disj, exists, forall
from qe.formula.syntax import And, Exists, ForAll, Formula, Not, Or
from qe.kernel import elimination_points, elimination_set, quantifiers, renaming
from qe.kernel.turning_cover import Cover
from qe.kernel.virtual_substitution import put
from tests.unit.certify.claims import objection, written

Patch = Callable[[pytest.MonkeyPatch], None]


def _parts_apart(m: pytest.MonkeyPatch) -> None:
    """Parts that share a variable are taken apart."""
    m.setattr(quantifiers, "connected", lambda parts, names: ((), [(names(p), (p,)) for p in parts]))


def _over_both(m: pytest.MonkeyPatch) -> None:
    """A universal quantifier goes over a disjunction."""
    whole = quantifiers._quantified

    def quantified(kind: Any, names: Any, body: Formula) -> Formula:
        if kind is ForAll and isinstance(body, Or):
            return disj(quantified(kind, names, part) for part in body.args)
        return whole(kind, names, body)

    m.setattr(quantifiers, "_quantified", quantified)


def _same_when_negated(m: pytest.MonkeyPatch) -> None:
    """A negation goes past a quantifier that stays what it is."""
    whole = quantifiers.normal

    def normal(formula: Formula) -> Formula:
        if isinstance(formula, Not) and isinstance(block := formula.arg, Exists | ForAll):
            return (exists if isinstance(block, Exists) else forall)(block.variables, whole(Not(block.body)))
        return whole(formula)

    m.setattr(quantifiers, "normal", normal)


def _any_bound_variable(m: pytest.MonkeyPatch) -> None:
    """Bound variables are all the same."""
    whole = renaming._comparison
    m.setattr(renaming, "_comparison", lambda p, relation, bound: whole(p, relation, dict.fromkeys(bound, 0)))


def _free_as_bound(m: pytest.MonkeyPatch) -> None:
    """A free variable is taken for the one that is bound."""
    whole = renaming._comparison
    m.setattr(renaming, "_comparison", lambda p, relation, _: whole(p, relation, dict.fromkeys(p.ring.names, 0)))


def _any_quantifier(m: pytest.MonkeyPatch) -> None:
    """Which of the two quantifiers it is does not matter."""

    def unordered(formula: Formula) -> object:
        match formula:
            case And(args) | Or(args):
                return type(formula).__name__, frozenset(map(unordered, args))
            case Exists(variables, body) | ForAll(variables, body):
                return frozenset(variables), unordered(body)
        return formula

    m.setattr(quantifiers, "unordered", unordered)


def _any_join(m: pytest.MonkeyPatch) -> None:
    """Conjunctions and disjunctions are the same."""
    m.setattr(quantifiers, "shape", lambda f: renaming.shape(conj(f.args) if isinstance(f, Or) else f))


QUANTIFIERS: list[tuple[Patch, str, str]] = [
    (_parts_apart, "ex x. x > a and x < b", "(ex x. x > a) and (ex x. x < b)"),
    (_over_both, "all x. x > a or x < b", "(all x. x > a) or (all x. x < b)"),
    (_same_when_negated, "not (ex x. x > a)", "ex x. x <= a"),
    (_any_bound_variable, "all x. ex y. x - y^2 >= 0", "all x. ex y. y - x^2 >= 0"),
    (_free_as_bound, "ex x. x^2 - a = 0", "ex x. a^2 - x = 0"),
    (_any_quantifier, "ex x. x > a", "all x. x > a"),
    (_any_join, "a > 0 or b > 0", "a > 0 and b > 0"),
]


def point(coefficients: list[str], shift: int = 0, branch: int = 0, **other: Any) -> dict[str, Any]:
    where = {"coefficients": coefficients, "branch": branch, "shift": shift}
    return {"point": where, "guard": True, "formula": None, "settled": [], **other}


FAR, NEXT = point([], -1), point(["-a", "1"], 1)
"""Minus infinity, and the places just above a."""


def tried(*points: dict[str, Any]) -> dict[str, Any]:
    return {"variable": "x", "side": 1, "quadratics": [], "points": [*points], "parts": [[] for _ in points]}


def _always_real(m: pytest.MonkeyPatch) -> None:
    """Points need not be real."""
    m.setattr(elimination_points, "is_real", lambda *_: True)


def _no_cover(m: pytest.MonkeyPatch) -> None:
    """Any points are an elimination set."""
    m.setattr(elimination_set, "require_cover", lambda *_: [])


def _nothing_far_out(m: pytest.MonkeyPatch) -> None:
    """Solutions that reach to infinity are forgotten."""
    m.setattr(Cover, "far", lambda *_: [])


def _no_ends(m: pytest.MonkeyPatch) -> None:
    """Components of the solutions have no ends."""
    m.setattr(Cover, "ends", lambda *_: [])


def _settled(m: pytest.MonkeyPatch) -> None:
    """Strict conditions may be looked at where they turn true."""
    m.setattr(Cover, "check_settled", lambda *_: None)


def _other_side(m: pytest.MonkeyPatch) -> None:
    """Next to a point is on its other side."""
    m.setattr(elimination_points, "put", lambda f, x, p, s: put(f, x, replace(p, shift=-p.shift), s))


def _implies(m: pytest.MonkeyPatch) -> None:
    """Whatever is tried at a point implies the formula."""
    m.setattr(elimination_points, "implies", lambda *_: True)


BETWEEN = "ex x. x > a and x < b"
ELIMINATION: list[tuple[Patch, str, str, dict[str, Any]]] = [
    (_always_real, "ex x. x^2 - a = 0", "true", tried(point(["-a", "0", "1"], branch=1))),
    (_no_cover, BETWEEN, "false", tried()),
    (_nothing_far_out, "ex x. x < a", "false", tried()),
    (_no_ends, "ex x. x > a", "false", tried(FAR)),
    (_settled, BETWEEN, "false", tried(FAR, {**NEXT, "settled": [written("x > a")]})),
    (_other_side, BETWEEN, "false", tried(FAR, NEXT)),
    (_implies, "ex x. x > a and x < a", "true", tried(point(["-a", "1"], formula=True))),
]

MUTANTS = [
    *(pytest.param("quantifiers", *claim, None, patch, id=patch.__name__) for patch, *claim in QUANTIFIERS),
    *(pytest.param("elimination set", *claim, patch, id=patch.__name__) for patch, *claim in ELIMINATION),
]


@pytest.mark.parametrize(("rule", "before", "after", "evidence", "patch"), MUTANTS)
def test_a_false_claim_is_refused_that_a_mutant_accepts(
    rule: str, before: str, after: str, evidence: Any, patch: Patch, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert objection(rule, before, after, evidence)
    patch(monkeypatch)
    assert objection(rule, before, after, evidence) == ""
