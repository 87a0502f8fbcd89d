"""Roots in a half-plane: the determinants against roots that are known, the rule's side conditions, its checker."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.rules.half_plane as half_plane
from qe.api.input import read_formula
from qe.certify.half_plane import check_half_plane, half_plane_goals
from qe.certify.step import Claim
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, Formula, Relation
from qe.proof.entry import Entry
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.half_plane import _parts as parts_of
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_broken_producers import accepted
from tests.unit.certify.claims import NO_LEMMAS, objection

QUADRATIC = "x^2 - y^2 + b*x + c = 0 and 2*x*y + b*y = 0"
CUBIC = "a*(x^3 - 3*x*y^2) + x^2 - y^2 + b*x + c = 0 and a*(3*x^2*y - y^3) + 2*x*y + b*y = 0"
PID = (
    "all u, v. (u^4 - 6*u^2*v^2 + v^4 + 3*(u^3 - 3*u*v^2) + (3 + d)*(u^2 - v^2) + (1 + p)*u + i = 0"
    " and 4*u^3*v - 4*u*v^3 + 3*(3*u^2*v - v^3) + (3 + d)*2*u*v + (1 + p)*v = 0) -> u < 0"
)


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (f"all x, y. {QUADRATIC} -> x < 0", "b > 0 and c > 0"),
        (f"all y, x. {QUADRATIC} -> x > 0", "b < 0 and c > 0"),
        (f"all x, y. {QUADRATIC} -> 2*x < a", "a + b > 0 and a^2 + 2*a*b + 4*c > 0"),
        ("all x, y. a*x + b = 0 and a*y = 0 -> x < 0", "a*b > 0 or a = 0 and b /= 0"),
        (PID, "i > 0 and p + 1 > 0 and 3*(3+d)*(1+p) - (1+p)^2 - 9*i > 0"),
        (f"ex b. all x, y. {QUADRATIC} -> x < 0", "c > 0"),
    ],
)
def test_the_condition_is_that_of_hurwitz(text: str, answer: str) -> None:
    assert qe.equivalent(qe.eliminate(text).formula, answer)


@pytest.mark.parametrize(
    "text",
    [
        f"ex x, y. {QUADRATIC} and x > 0",
        f"ex x, y. {QUADRATIC} and x + y >= 0",
        f"ex x, y. {QUADRATIC} and y >= 0",
        f"ex x, y. {QUADRATIC} and a*x >= 0",
        f"ex x, y. {QUADRATIC} and x^2 >= 1",
        f"ex x, y. {QUADRATIC} and x >= 0 and y >= 0",
        "ex x, y. x^2 - y^2 + b*x + c = 0 and 2*x*y - b*y = 0 and x >= 0",
        "ex x, y. x^2 + y^2 + b*x + c = 0 and 2*x*y + b*y = 0 and x >= 0",
        "ex x, y. x^2 - y^2 + b*x + a*y + c = 0 and 2*x*y + b*y = 0 and x >= 0",
        "ex x, y. x^2 - y^2 + x + 1 = 0 and 2*x*y + y = 0 and x >= 0",
    ],
)
def test_others_are_left_alone(text: str) -> None:
    assert not steps_of(text)


def steps_of(text: str | Formula) -> list[Step]:
    """The steps of this rule alone."""
    log = RunLog()
    prepare(read_formula(text), enabled={StepKind.HALF_PLANE}, log=log)
    return list(log.steps())


# --- against roots that are known ------------------------------------------------------------------------------------
@cache
def generic(degree: int) -> Formula:
    """The rule's answer where all coefficients and the bound are parameters; true where there is a root."""
    ring = Ring.of((*(f"c{k}" for k in range(degree + 1)), "m", "x", "y"))
    real, imaginary = parts_of([ring.gen(k) for k in range(degree + 1)], degree + 2, degree + 3)
    bound = ring.var("m") - 2 * ring.var("x")
    body = conj((atom(real, Relation.EQ), atom(imaginary, Relation.EQ), atom(bound, Relation.GE)))
    (step,) = steps_of(exists(("x", "y"), body))
    assert step.after.is_quantifier_free and accepted(step)
    return step.after


FACTORS = st.lists(st.tuples(st.integers(-2, 3), st.integers(-1, 4)), max_size=3)


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
@settings(deadline=None, max_examples=60, derandomize=True)
@given(FACTORS, st.sampled_from([-2, 0, 1]), st.integers(-3, 3))
def test_roots_that_are_known(degree: int, factors: list[tuple[int, int]], scale: int, m: int) -> None:
    """Products of z + e (where f < 0) and (z + e)^2 + f, times a number; leading coefficients may be zero."""
    product, least = [scale], []
    for e, f in factors:
        factor = [e, 1] if f < 0 else [e * e + f, 2 * e, 1]
        if len(product) + len(factor) - 2 <= degree:
            product = [
                sum(product[i] * factor[k - i] for i in range(len(product)) if 0 <= k - i < len(factor))
                for k in range(len(product) + len(factor) - 1)
            ]
            least.append(-e)
    product += [0] * (degree + 1 - len(product))
    point = {**{f"c{k}": Fraction(c) for k, c in enumerate(product)}, "m": Fraction(m)}
    expected = scale == 0 or any(m - 2 * x >= 0 for x in least)
    assert holds_at(generic(degree), point) is expected


# --- the checker -----------------------------------------------------------------------------------------------------
BY = {"real": "x", "imaginary": "y", "theory": NO_LEMMAS}


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        (f"ex x, y. {QUADRATIC} and x >= 0", "b <= 0 or c <= 0", ""),
        (f"all x, y. not ({QUADRATIC}) or x < 0", "b > 0 and c > 0", ""),
        (f"ex x, y. {QUADRATIC} and x <= 0", "b >= 0 or c <= 0", ""),
        ("ex x, y. x^3 - 3*x*y^2 + b*x + c = 0 and 3*x^2*y - y^3 + b*y = 0 and x >= 0", "true", ""),
        (f"ex x, y. {QUADRATIC} and x >= 0", "b <= 0 or c < 0", "do not exclude"),
        (f"ex x, y. {QUADRATIC} and x >= 0", "c <= 0", "do not exclude"),
        (f"ex x, y. {QUADRATIC} and x <= 0", "b <= 0 or c <= 0", "do not exclude"),
        (f"ex x, y. {CUBIC} and x >= 0", "b <= 0 or c <= 0 or a <= 0 or b - a*c <= 0", "do not exclude"),
        (f"ex x, y. {QUADRATIC} and x > 0", "b < 0 or c < 0", "weak bound"),
        (f"ex x, y. {QUADRATIC} and y >= 0", "b <= 0 or c <= 0", "a bound of the real part"),
        (f"ex x, y. {QUADRATIC} and a*x >= 0", "b <= 0 or c <= 0", "a bound of the real part"),
        (f"ex x, y, z. {QUADRATIC} and x >= 0", "b <= 0 or c <= 0", "real and imaginary part"),
        (f"ex x, y. {QUADRATIC} and x >= 0 and x >= 1", "b <= 0 or c <= 0", "three conditions"),
        (f"ex x, y. {QUADRATIC} and x = 0", "b <= 0 or c <= 0", "two equations"),
        ("ex x, y. x^2 - y^2 + b*x + c = 0 and 2*x*y - b*y = 0 and x >= 0", "b <= 0 or c <= 0", "not the real"),
        ("ex x, y. x^2 + y^2 + b*x + c = 0 and 2*x*y + b*y = 0 and x >= 0", "b <= 0 or c <= 0", "not the real"),
        ("ex x, y. b + c = 0 and y = 0 and x >= 0", "b + c = 0", "not the real"),
    ],
)
def test_what_the_checker_says(before: str, after: str, reason: str) -> None:
    found = objection(check_half_plane, before, after, BY)
    assert reason in found and bool(found) is bool(reason)


def test_determinants_out_of_reach_are_not_accepted() -> None:
    """A sum of many terms in every coefficient: the checker stops, and says so."""
    ring = Ring.of((*"abcdefgh", "x", "y"))
    large = sum((ring.gen(i) for i in range(8)), ring.constant(1)) ** 4
    real, imaginary = parts_of([large + k for k in range(5)], 8, 9)
    body = conj((atom(real, Relation.EQ), atom(imaginary, Relation.EQ), atom(ring.var("x"), Relation.GE)))
    assert steps_of(exists(("x", "y"), body)) == []
    claim = Claim("", exists(("x", "y"), body), FALSE, ring, Entry(BY, "step"), "step")
    with pytest.raises(Unable, match="too many terms"):
        half_plane_goals(claim, ())


@pytest.mark.parametrize("change", [{"real": "y", "imaginary": "x"}, {"imaginary": "x"}, {"imaginary": "z"}])
def test_altered_evidence_is_rejected(change: dict[str, str]) -> None:
    assert objection(check_half_plane, f"ex x, y. {QUADRATIC} and x >= 0", "b <= 0 or c <= 0", {**BY, **change})


def no_lower_degree(m: pytest.MonkeyPatch) -> None:
    """The leading coefficient is taken for nonzero."""
    m.setattr(half_plane, "without_roots", lambda a: half_plane.disj(map(half_plane.hurwitz, (a, [-c for c in a]))))


def one_sign(m: pytest.MonkeyPatch) -> None:
    """Determinants of the negative polynomial are taken for those of the polynomial."""
    m.setattr(half_plane, "without_roots", lambda a: half_plane.hurwitz(a))


def coefficients_only(m: pytest.MonkeyPatch) -> None:
    """Positive coefficients are taken for enough, as in degree 2."""
    m.setattr(half_plane, "determinants", lambda a: [])


def not_moved(m: pytest.MonkeyPatch) -> None:
    """The half-plane is always that of Re >= 0."""
    m.setattr(half_plane, "_moved", lambda coefficients, k, m: [*coefficients])


def any_parts(m: pytest.MonkeyPatch) -> None:
    """Whatever the second equation is, it is taken for the imaginary part."""

    def careless(equations: list[Poly], real: int, imaginary: int) -> tuple[Poly, ...]:
        return equations[0].coefficients(imaginary)[0].coefficients(real)

    m.setattr(half_plane, "complex_polynomial", careless)


@pytest.mark.parametrize(
    ("broken", "text"),
    [
        (no_lower_degree, f"ex x, y. {CUBIC} and x >= 0"),
        (one_sign, f"ex x, y. {CUBIC} and x >= 0"),
        (coefficients_only, f"ex x, y. {CUBIC} and x >= 0"),
        (not_moved, f"ex x, y. {CUBIC} and x >= b"),
        (any_parts, "ex x, y. x^2 - y^2 + b*x + c = 0 and x*y = b and x >= 0"),
    ],
)
def test_a_broken_producer_is_refused(broken: object, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert all(accepted(step) for step in steps_of(text))
    broken(monkeypatch)  # type: ignore[operator]
    (step,) = steps_of(text)
    assert not accepted(step)
