"""Blocks that look at a variable by a linear form in it: the form becomes the variable, and the steps are checked."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.rules.shear as shear
from qe.api.input import read_formula
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.normal import without_clashes
from qe.formula.syntax import Formula, Relation
from qe.formula.traverse import atoms
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each
from tests.unit.rules.applied import steps_of

BY_FORM, SHEAR_CASES = shear.by_form, shear._cases
RING = Ring.of(("a", "b", "x", "y", "z"))
CHORDS = "ex x, y, z. y /= z and (x*(y - z) + y)^4 + a*(x*(y - z) + y)^2 + (x*(y - z) + y) + b = 0"


def test_a_line_by_two_points_and_a_parameter() -> None:
    """Three variables that stand in one form are one variable, and values come back."""
    assert StepKind.SHEAR.value in [step.rule for step in qe.eliminate(CHORDS, without="position").derivation.steps]
    body = "y /= z and x*(y - z) + y > 1 and (x*(y - z) + y)^4 - 5*(x*(y - z) + y)^2 + 4 = 0 and y^2 + z^2 < 3"
    point = qe.find_instance(body)
    assert point is not None
    assert qe.check_witness(f"ex x, y, z. {body}", point)


def random_question(rng: random.Random) -> Formula:
    """Polynomials in m*x + n, beside some that are not, quantified inside or not."""
    x, y, z, a, b = (RING.var(name) for name in "xyzab")
    slope = rng.choice((y, y - z, a * y, y**2 + 1, RING.constant(1), RING.constant(2), y * 2))
    form = x * slope + rng.choice((z, z - y, a, y**2, z * 2 - b))

    def polynomial() -> Poly:
        p = form ** rng.choice((2, 3, 4)) * rng.choice((RING.constant(1), z, a, y - z, slope))
        return p + form * rng.choice((a, b, z)) * rng.choice((0, 1)) + rng.choice((a, b, b * z))

    parts: list[Formula] = [atom(polynomial(), rng.choice(tuple(Relation))) for _ in range(rng.choice((2, 3)))]
    if rng.random() < 0.3:
        parts.append(forall(("z",), disj((parts.pop(), atom(z - b, Relation.GT)))))
    return without_clashes(exists(("x", "y"), (conj if rng.random() < 0.7 else disj)(parts)))


@settings(deadline=None, max_examples=25, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_what_the_rule_does_is_accepted(seed: int) -> None:
    for step in steps_of(random_question(random.Random(seed)), StepKind.SHEAR):
        assert accepted(step), (step.before, step.after)


def test_the_rule_finds_something_to_do() -> None:
    assert sum(len(steps_of(random_question(random.Random(seed)), StepKind.SHEAR)) for seed in range(40)) >= 8


def without_parity(p: Poly, x: int, m: Poly, n: Poly, *, even: bool, most_terms: int | None = None) -> Poly:
    return BY_FORM(p, x, m, n, even=False)


ODD = "ex x, y. (x*y + z)^3 + (x*y + z)^2 + a > 0 and (x*y + z)^4 + (x*y + z)^2 + x*y + z > b and x > a"


@each(
    ("by_form", without_parity),
    ("_cases", lambda *args: SHEAR_CASES(*args).children[1]),
    ("_cases", lambda *args: SHEAR_CASES(*args).children[0]),
)
def test_a_broken_producer_is_refused(name: str, value: object, monkeypatch: pytest.MonkeyPatch) -> None:
    assert steps_of(read_formula(ODD), StepKind.SHEAR)
    monkeypatch.setattr(shear, name, value)
    broken = steps_of(read_formula(ODD), StepKind.SHEAR)
    assert broken
    assert not accepted(broken[0])


def claimed(before: str, after: str, variable: str, form: str) -> bool:
    given_ = read_formula(before)
    ring = given_.ring
    assert ring is not None
    (condition,) = atoms(read_formula(f"{form} = 0"))
    proof = {"variable": variable, "form": condition.poly.convert(ring)}
    claim = moved(read_formula(after), ring)
    return accepted(Step(StepKind.SHEAR.value, given_, claim, evidence={"proof": proof}))


def test_altered_entries_are_refused() -> None:
    before, after = "ex x, y. x^2 + 2*x*y + y^2 > a and x + y < b", "ex x, y. x^2 > a and x < b"
    assert claimed(before, after, "x", "x + y")
    assert not claimed(before, after, "x", "x + y^2")
    assert not claimed(before, after, "x", "x - y")
    assert not claimed(before, after, "x", "y")
    assert not claimed(before, after, "a", "a + y")
    assert not claimed(before, "ex x, y. x^2 >= a and x < b", "x", "x + y")
    assert not claimed(before, "ex x. x^2 > a and x < b", "x", "x + y")


def test_a_factor_of_unknown_sign_is_not_divided_out() -> None:
    cases = "(ex x, y. y /= 0 and {} > a and x {} b*y) or (ex x, y. y = 0 and y > a and x {} b)"
    assert claimed("ex x, y. y > a and x = b", cases.format("y", "=", "="), "x", "x*y")
    assert not claimed("ex x, y. y > a and x > b", cases.format("y", ">", ">"), "x", "x*y")


def test_a_form_with_variables_that_are_bound_inside() -> None:
    assert not claimed("ex x. all y. x + y > a", "ex x. all y. x > a", "x", "x + y")
    assert not claimed("all x, y. x + y > a", "all x, y. x > a", "x", "x + y")


def test_a_negative_number_before_the_variable() -> None:
    assert claimed("ex x, y. y - x > a and x - y < 3", "ex x, y. -x > a and x < 3", "x", "y - x")
    assert not claimed("ex x, y. y - x > a and x - y < 3", "ex x, y. x > a and x < 3", "x", "y - x")
