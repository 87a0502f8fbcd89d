"""Bugs of this project's own engine that were found by comparison with the oracles; named by symptom."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest

from qe import Guarantee, eliminate, equivalent
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.options import Budget, Projection
from tests.differential.methods import by_cad
from tests.tables import each


@pytest.mark.parametrize("projection", list(Projection), ids=lambda p: p.value)
def test_root_isolation_over_a_quintic_point_ends(projection: Projection) -> None:
    """The tolerance asked of the root balls was out of reach at every precision, so the precision grew for ever."""
    formula = read("all x. not (3*a*x^2 + 2*a*x + 3*b - 3 > 0 and b*x - 2*x^2 <= 0 and a*b^2 - a*b*x - 1 = 0)")
    answer = by_cad(projection)(formula, Budget(30))
    ring = Ring.of(("a", "b"))
    for a, b, expected in ((0, 0, True), (1, 1, True), (1, 2, False), (2, -1, True), (-1, -1, True), (1, -1, True)):
        assert holds_at(convert(answer, ring), {"a": a, "b": b}) is expected, (a, b)


def test_answer_has_one_ring() -> None:
    """A conjunct that did not need elimination kept its large ring beside the decomposed part."""
    found = eliminate("ex b, c. m > 0 and 1 + b > c and b + c > 1 and c + 1 > b and b*c + c + b = m*(1 + b + c)^2")
    assert found.formula is not None
    assert len({a.poly.ring for a in atoms(found.formula)}) == 1


def test_a_simplified_answer_is_never_certified_with_polynomials_that_the_table_does_not_list() -> None:
    """The answer a2^2 + a1^2 <= 0 is written a1 = 0 and a2 = 0: no factors of the table, so the checker refused it."""
    text = (
        "ex e, x. e < 0 and 2*a^2*b^2*x^2 + 2*a^4*x^2 + 2*a^2*x^2 - 4*e*a*b^2*x - 4*e*a^3*x + 2*e^2*b^4"
        " + 4*e^2*a^2*b^2 - a^2*b^2 + 2*e^2*b^2 + 2*e^2*a^4 - a^4 + 2*e^2*a^2 - a^2 = 0"
    )
    answer = eliminate(text, check=True)
    assert answer.guarantee is Guarantee.CHECKED
    assert equivalent(answer.formula, "a /= 0 or b = 0")


@each("auto", "cad")
@each(
    "all x. not (3*a*b - x^2 - 1 > 0 or a^2 + x > 0 and a*b + 3*a - 3 /= 0)",
    "all x. x^3 + a^2 /= 0 or 2*a*b*x + a*x^2 - a^2 - a*b - b*x <= 0",
    "ex x. (all y. y^4 + x*y + a >= 0) and x > 1",
)
def test_long_answers_with_root_atoms_were_decomposed_once_more_to_shorten_them(text: str, method: str) -> None:
    """That asked a decomposition for root atoms, which it does not read: the caller got an InternalError."""
    plain, extended = eliminate(text), eliminate(text, root_atoms=True, method=method)
    assert plain.formula is not None and extended.formula is not None
    values = [Fraction(n, 4) for n in range(-9, 10, 3)]
    for a, b in product(values, values):
        point = {"a": a, "b": b}
        assert holds_at(plain.formula, point) is holds_at(extended.formula, point), point


def test_open_sets_that_barely_exist_have_a_witness() -> None:
    """The convex decision only offered points of the closed problem, and later methods found none at all."""
    text = "x^2 + y^2 + z^2 + u^2 + 2*x + 2*y - 2*z - 2*u < 0 and 12000000*x + 5000000*u + 32999987 < 0"
    answer = eliminate(f"ex x, y, z, u. {text}")
    assert answer.witness is not None and answer.guarantee is Guarantee.CHECKED


@each(("+ 1", False), ("- 9", True))
def test_a_negated_disjunction_of_inequations_was_true_whatever_they_say(first: str, expected: bool) -> None:
    """Gröbner systems passed over what was no atom: "not (p /= 0 or q /= 0)" lost its equations, all of them."""
    system = f"x^2 + y^2 + z^2 + w^2 {first} /= 0 or x*y - z /= 0 or x^2*w - 1 /= 0 or y*z*w /= 1"
    assert eliminate(f"ex x, y, z, w. not ({system})").truth is expected
    assert eliminate(f"all x, y, z, w. {system}").truth is not expected
    parametric = eliminate("ex x. not (x /= 0 and x^2 + 2*a + 1 /= 0 or a^2*x + a*x^2 + 2 /= 0)", method="cgs")
    assert equivalent(parametric.formula, "a + 1 = 0")


def test_a_block_that_comes_back_beside_a_condition_ran_for_ever() -> None:
    """Critical values left "p = 0 and the same block": the answer was that the formula is nested too deeply."""
    answer = eliminate("all u. u < 0 or (2*a^2 + a*b - b + 1)^2 <= u", method="critical")
    assert "critical values alone" in (answer.reason or "")
