"""Polynomials without negative coefficients in linear forms: found where they are, proved, and nothing else claimed."""

import random
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.positivity.cone as cone
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.positivity.cone import Bound, bounds_of, positive_on_cone
from qe.proof.answer import Guarantee
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
CHAIN = "1 >= x and x >= y and y >= z and z >= 0"
SIMPLEX = "x >= 1 and y > 0 and z >= y and x + 2*y + z <= 7"
BOUNDED = "x > y and y > z and z > 0"


def bounds(text: str) -> tuple[Bound, ...]:
    found = bounds_of(conjuncts(read(f"{text} and x + y + z = 3")))
    return tuple((form.convert(RING), sign, strict) for form, sign, strict in found)


@each(CHAIN, SIMPLEX, BOUNDED)
@settings(deadline=None, max_examples=20, derandomize=True)
@given(st.integers(0, 10**9))
def test_sums_of_products_are_found_and_proved(where: str, seed: int) -> None:
    rng, forms = random.Random(seed), [form * sign for form, sign, _ in bounds(where)]
    poly = RING.constant(0)
    for _ in range(rng.randint(2, 5)):
        term = RING.constant(rng.randint(1, 3))
        for form in rng.choices(forms, k=rng.randint(1, 3)):
            term = term * form
        poly = poly + term
    if len(poly.variables) < 3:
        return
    found = positive_on_cone(poly, bounds(where))
    assert found is not None
    (identity,) = found.identities
    signs = {form * sign: strict for form, sign, strict in bounds(where)}
    total, certain = RING.constant(0), False
    for c, powers in identity.terms:
        term = RING.constant(c)
        for base, exponent in powers:
            term = term * base**exponent
        total = total + term
        if powers is identity.terms[0][1]:
            ((base, exponent),) = powers
            assert exponent == 1 and base.normal()[1] == poly.normal()[1]
        else:
            assert c > 0
            certain = certain or all(signs[base] for base, _ in powers if not base.is_constant)
    assert not total and identity.terms[0][0] < 0 and found.strict is certain


@settings(deadline=None, max_examples=60, derandomize=True)
@given(st.integers(0, 10**9))
def test_nothing_is_said_of_what_is_negative_somewhere(seed: int) -> None:
    """Polynomials that are negative at a point of the chain."""
    rng = random.Random(seed)
    point = sorted((Fraction(rng.randint(0, 8), 8) for _ in range(3)), reverse=True)
    poly = RING.from_terms(
        {(rng.randint(0, 2), rng.randint(0, 2), rng.randint(0, 2)): rng.randint(-4, 9) for _ in range(5)}
    )
    value = poly.evaluate(point)
    found = positive_on_cone(poly, bounds(CHAIN)) if len(poly.variables) == 3 else None
    assert found is None or value > 0 or (value == 0 and not found.strict)


@each(
    (f"all x, y, z. {CHAIN} -> x + y*z*(1 - x) >= x*y*z", True),
    (f"ex x, y, z. {CHAIN} and x + y*z*(1 - x) < x*y*z", False),
    ("all x, y, z. 0 < x and x < y and y < z and z < 1 -> x*y*z < x + y^2 + z^3", True),
    ("all x, y, z. x >= 1 and y >= 2 and z >= 3 -> (x - 1)*(y - 2)*(z - 3) + (y - 2)^5 + x*y*z >= 6", True),
)
def test_signs_on_simplices_and_chains(text: str, truth: bool) -> None:
    answer = qe.eliminate(text, check=True, without="position")
    assert answer.truth is truth and answer.guarantee is Guarantee.CHECKED
    assert "signs by sums of squares" in [step.rule for step in answer.derivation.steps]
    assert qe.eliminate(text, without="squares").truth is truth


def steps_of(text: str) -> list[Step]:
    log = RunLog()
    prepare(read(text), enabled={StepKind.SQUARES}, log=log)
    return list(log.steps())


def careless(parts: list[Formula]) -> tuple[Bound, ...]:
    """Bounds are taken for strict ones."""
    return tuple((form, sign, True) for form, sign, _ in bounds_of(parts))


def turned(parts: list[Formula]) -> tuple[Bound, ...]:
    """Bounds are taken for their opposites."""
    return tuple((form, -sign, strict) for form, sign, strict in bounds_of(parts))


@each(
    (careless, f"ex x, y, z. {CHAIN} and x^2 <= y*z"),
    (turned, "ex x, y, z. x <= 0 and y <= 0 and z <= 0 and x*y*z + x < 0"),
)
def test_a_broken_producer_is_refused(broken: object, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found = steps_of(text)
    assert all(accepted(step) for step in found)
    monkeypatch.setattr(cone, "bounds_of", broken)
    (step,) = [step for step in steps_of(text) if step not in found]
    assert not accepted(step)


def test_many_bounds_and_variables_are_not_gone_through() -> None:
    ring = Ring.of(tuple("abcdef"))
    poly: Poly = sum((ring.gen(i) * ring.gen(j) for i in range(6) for j in range(i)), ring.constant(1))
    assert positive_on_cone(poly, tuple((ring.gen(i), 1, False) for i in range(6))) is None
