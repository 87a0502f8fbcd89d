"""Answers by roots of cubics: proved by a decomposition where one is small enough; not if a producer is broken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import qe
from qe.elimination.vs import candidates, clusters, cubic, points, roots
from qe.formula.syntax import Relation
from tests.certificates.elimination_claims import unchecked

EXAMPLES = [
    "ex x. a*x^3 + b*x^2 + c*x + d = 0 and x > 0",
    "ex x. x^3 + a*x + b = 0 and c*x + d > 0",
    "ex x. x^3 + a*x + b < 0 and x > c and x < d",
    "ex x. x^3 + a*x^2 + b*x + c <= 0 and x >= 0 and x <= 1",
    "ex x. a*x^3 + b*x + c > 0 and x^2 < d",
    "all x. x^3 + a*x + b > 0 or x < c",
]


@pytest.mark.parametrize("text", EXAMPLES)
def test_every_step_is_checked(text: str) -> None:
    answer = qe.eliminate(text, check=True, process=False)
    assert answer.unchecked_steps == () and answer.certificate is not None
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json())).accepted


Break = Callable[[pytest.MonkeyPatch], None]


def _no_lower_degree(patch: pytest.MonkeyPatch) -> None:
    whole = candidates._roots

    def found(given: Any, coefficients: Any, *others: Any) -> Any:
        return [c for c in whole(given, coefficients, *others) if isinstance(c.point, points.CubicRoot)]

    patch.setattr(candidates, "_roots", found)


def _rows(patch: pytest.MonkeyPatch, rows: Any) -> None:
    patch.setattr(roots, "CUBIC", rows)


def _simple_roots_only(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((k, Relation.GT if r is Relation.GE else r, s) for k, r, s in roots.CUBIC))


def _no_single_root(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, roots.CUBIC[1:])


def _other_root(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((4 - k if k else 0, r, s) for k, r, s in roots.CUBIC[:2]) + roots.CUBIC[2:])


def _wrong_direction(patch: pytest.MonkeyPatch) -> None:
    _rows(patch, tuple((k, r, -s) for k, r, s in roots.CUBIC))


def _no_epsilon(patch: pytest.MonkeyPatch) -> None:
    rows = candidates.ROWS[3]
    patch.setitem(candidates.ROWS, 3, lambda coefficients, epsilon: rows(coefficients, 0))


def _always_one_thing(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(clusters, "asks_one", lambda formula, x, e: True)


def _wrong_rank(patch: pytest.MonkeyPatch) -> None:
    ranked = cubic._ranked
    patch.setattr(cubic, "_ranked", lambda e, rank, *others: ranked(e, cubic.Rank.LEAST, *others))


def _leading_sign_forgotten(patch: pytest.MonkeyPatch) -> None:
    remainder = cubic.remainder
    patch.setattr(cubic, "remainder", lambda f, x, e: (remainder(f, x, e)[0], False))


def _complex_zeros_forgotten(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(cubic, "_at_only", lambda e, u, v, w, r, atom: atom(cubic.symmetric(e, u, v, w)[2], r))


def _double_roots_forgotten(patch: pytest.MonkeyPatch) -> None:
    rule = cubic._at_critical
    patch.setattr(
        cubic, "_at_critical", lambda e, u, r, atom: rule(replace(e, index=2 if e.index != 2 else 1), u, r, atom)
    )


BROKEN = [
    (_no_lower_degree, "ex x. a*x^3 + b*x < 1 and x > b"),
    (_no_lower_degree, "ex x. a*x^3 + b*x = 1 and x > b"),
    (_simple_roots_only, "ex x. x^3 + a*x + b = 0 and x > a and x < 1"),
    (_simple_roots_only, "ex x. x^3 + a*x + b <= 0 and x > a"),
    (_no_single_root, "ex x. x^3 + a*x + b = 0 and x > a"),
    (_other_root, "ex x. x^3 + a*x + b = 0 and x > a and x < 1"),
    (_wrong_direction, "ex x. x^3 + a*x + b < 0 and x > a"),
    (_no_epsilon, "ex x. x^3 + a*x + b < 0 and x > a"),
    (_always_one_thing, "ex x. x^3 + a*x + b = 0 and x > a and x < b"),
    (_wrong_rank, "ex x. x^3 + a*x + b = 0 and x > a and x < b"),
    (_leading_sign_forgotten, "ex x. b*x^3 + a*x + 1 = 0 and x^3 < a"),
    (_complex_zeros_forgotten, "ex x. x^3 + a*x + b = 0 and x^2 + a*x > b"),
    (_double_roots_forgotten, "ex x. x^3 + a*x + b = 0 and 3*x^2 + a > 0 and x > 1"),
]


@pytest.mark.parametrize(("breaking", "text"), BROKEN, ids=[f"{b.__name__} {k}" for k, (b, _) in enumerate(BROKEN)])
def test_a_broken_producer_is_caught(breaking: Break, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each side condition switched off: no decomposition proves what comes out."""
    assert unchecked(text, 3) == ()
    breaking(monkeypatch)
    assert unchecked(text, 3) != ()
