"""Spheres and balls that are seen along a form: short conditions, side conditions, numbers put in, forged steps."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.rules.sphere as sphere_rule
from qe.formula.evaluate import substituted
from qe.formula.syntax import Exists
from qe.formula.traverse import polynomials
from qe.io.text import read
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each
from tests.unit.rules.applied import steps_of

ALONE = frozenset({StepKind.SPHERE})
LINKS = "ex a, b, c, d. a^2 + b^2 = 4 and (a - c)^2 + (b - d)^2 = 9 and (c - x)^2 + (d - y)^2 = 1"
SQUARE = "ex a, b, c, d, u, v, w, z. a^2 + b^2 = 1 and c^2 + d^2 = 1 and u^2 + v^2 = 1 and w^2 + z^2 = 1"


@each(
    (LINKS, "x^2 + y^2 <= 36"),
    (f"{SQUARE} and a*d - b*c + c*v - d*u + u*z - v*w + w*b - z*a = s", "-4 <= s <= 4"),
    ("ex x, y. x^2 + y^2 = 4 and a*x + b*y > 1", "a^2 + b^2 > 1/4"),
    ("ex x, y, z. x^2 + y^2 + z^2 < 1 and x + 2*y > a and z > -2", "a <= 0 or a^2 < 5"),
    ("all x, y. x^2 + y^2 /= 1 or (x - a)^2 + y^2 > 1", "a < -2 or a > 2"),
)
def test_the_condition_is_short(text: str, answer: str) -> None:
    assert str(qe.eliminate(text).formula) == answer


@each(
    "ex x, y. x^2 + 2*y^2 = a and x + y = b",
    "ex x, y. x^2 + y^2 = a and x + y > b and x - y > b",
    "ex x, y. x^2 + y^2 < a and b*x + c*y > 1",
    "ex x, y. x^2 + y^2 <= a and x^2 + y^2 + x > b",
    "ex x, y. x^2 + y^2 >= a and x + y = b",
    "ex x, y. x^2 + y^2 = a",
    "ex x. x^2 = a and x > b",
)
def test_others_are_left_alone(text: str) -> None:
    assert prepare(read(text), enabled=ALONE).formula == prepare(read(text), enabled=set()).formula


SMALL = st.integers(-2, 2)
RELATIONS = st.sampled_from(["<", "<=", "=", ">", "/="])


@settings(max_examples=15, derandomize=True, deadline=None)
@given(st.lists(SMALL, min_size=4, max_size=4), st.sampled_from(["<", "<=", "="]), RELATIONS, RELATIONS, SMALL, SMALL)
def test_numbers_put_in_before_or_after(at: list[int], kind: str, one: str, two: str, m: int, n: int) -> None:
    """The same truth at points of the parameters, and every step is accepted."""
    slopes = ("2*x - y", "a*x + b*y")[kind != "<"]
    second = f"(x^2 + y^2 + {m}*({slopes}) - 1)*(d - ({slopes}))" if kind == "=" else f"d*({slopes}) + {m}"
    centre = f"3*({slopes})" if kind == "=" else "x - a*y"
    text = f"ex x, y. 2*x^2 + 2*y^2 + {centre} {kind} c and {slopes} {one} b + {n} and ({second} {two} 0 or d > a)"
    asked, found = read(text), prepare(read(text), enabled=ALONE).formula
    steps = steps_of(text, StepKind.SPHERE)
    assert (steps or one == "=") and all(map(accepted, steps))
    point = dict(zip("abcd", map(Fraction, at), strict=True))
    assert isinstance(asked, Exists) and isinstance(found, Exists)
    truths = [qe.decide(Exists(f.variables, substituted(f.body, point)), without="balls") for f in (asked, found)]
    assert truths[0] == truths[1]


BEFORE = "ex x, y. x^2 + y^2 = a and b*x + c*y > 1"


def test_spheres_are_left_out_with_balls() -> None:
    assert StepKind.SPHERE.value not in {s.rule for s in qe.eliminate(BEFORE, without="balls").derivation.steps}


def claimed(before: str, after: str, sphere: str, form: str, names: str = "xy") -> bool:
    """Whether a step made by hand is accepted."""
    whole = read(f"({before}) and ({after}) and ({sphere}) and {form} = 0")
    assert whole.ring is not None
    given, then, ball, line = (moved(read(t), whole.ring) for t in (before, after, sphere, f"{form} = 0"))
    proof = {"sphere": ball, "variables": list(names), "form": next(iter(polynomials(line)))}
    return accepted(Step(StepKind.SPHERE.value, given, then, evidence={"proof": proof}))


def test_forged_steps_are_refused() -> None:
    """A radius that may be imaginary, a smaller segment, another form, a ball in the place of a sphere."""
    sphere, form = "x^2 + y^2 = a", "b*x + c*y"
    right = "ex x. a >= 0 and x^2 <= (b^2 + c^2)*a and x > 1"
    assert claimed(BEFORE, right, sphere, form)
    for after in (
        "ex x. x^2 <= (b^2 + c^2)*a and x > 1",
        "ex x. a >= 0 and x^2 < (b^2 + c^2)*a and x > 1",
        "ex x. a >= 0 and x^2 <= (b^2 + 2*c^2)*a and x > 1",
        "ex x. a >= 0 and x^2 <= (b^2 + c^2)*a and x < 1",
        "ex x. a >= 0 and x^2 <= (b^2 + c^2)*a",
    ):
        assert not claimed(BEFORE, after, sphere, form)
    assert not claimed(BEFORE, right, sphere, "b*x")
    assert not claimed(BEFORE, right, "x^2 + y^2 = 2*a", form)
    two = "ex x, y. x^2 + y^2 = a and x > 1"
    assert not claimed(two, "ex x. x^2 <= a and x > 1", "x^2 + y^2 = a", "x", names="x")
    seen = "ex x, y. x^2 + y^2 {} a and x^2 + y^2 + x > 1"
    assert claimed(seen.format("="), "ex x. x^2 <= a and a + x > 1", sphere, "x")
    assert not claimed(seen.format("<="), "ex x. x^2 <= a and a + x > 1", "x^2 + y^2 <= a", "x")
    open_ball = "ex x, y. x^2 + y^2 < a and b*x + c*y > -1"
    assert not claimed(open_ball, "ex x. a > 0 and x^2 < (b^2 + c^2)*a and x > -1", "x^2 + y^2 < a", form)


def test_a_producer_that_forgets_the_radius(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the form vanishes, nothing else says that the sphere is not empty."""
    assert all(map(accepted, steps_of(BEFORE, StepKind.SPHERE)))
    real = sphere_rule.conj
    monkeypatch.setattr(sphere_rule, "conj", lambda parts: real(list(parts)[1:]))
    broken = steps_of(BEFORE, StepKind.SPHERE)
    assert broken and not any(map(accepted, broken))
