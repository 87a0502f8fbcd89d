"""Blocks that are instances of listed theorems: short answers, what is left alone, and what is not known.

The theorems themselves are tested in ``tests/unit/kernel/test_theorems.py``, all in the same ways.
"""

import pytest

import qe
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Relation
from qe.kernel.statements import theorem
from qe.rules import closed_forms
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each
from tests.unit.rules.applied import steps_of

BALLS, PLANE, QUADRICS, CUBIC = StepKind.BALLS, StepKind.HALF_PLANE, StepKind.QUADRICS, StepKind.CUBIC_INTERVAL

DISCS = "ex x, y. x^2 + y^2 <= r^2 and (x - a)^2 + (y - b)^2 <= s^2"
NEAR, FAR = "(r + s)^2 - a^2 - b^2", "(r - s)^2 - a^2 - b^2"
ELLIPSE = "b^2*(x - c)^2 + a^2*(y - d)^2 - a^2*b^2"
DISC = "(x - c)^2 + (y - d)^2 - r^2"
IN_DISC = f"a /= 0 and b /= 0 and (ex x, y. {ELLIPSE} = 0 and x^2 + y^2 > 1)"
QUADRATIC = "x^2 - y^2 + b*x + c = 0 and 2*x*y + b*y = 0"
PID = (
    "all u, v. (u^4 - 6*u^2*v^2 + v^4 + 3*(u^3 - 3*u*v^2) + (3 + d)*(u^2 - v^2) + (1 + p)*u + i = 0"
    " and 4*u^3*v - 4*u*v^3 + 3*(3*u^2*v - v^3) + (3 + d)*2*u*v + (1 + p)*v = 0) -> u < 0"
)
FORM = "a*(1 - x)^3 + b*x*(1 - x)^2 + c*x^2*(1 - x) + d*x^3"
UNIT = f"ex x. 0 <= x and x <= 1 and {FORM}"


@each(
    (f"r >= 0 and s > 0 and ({DISCS})", "r >= 0 and s > 0 and (r + s)^2 - a^2 - b^2 >= 0"),
    (f"r >= 0 and s <= 0 and ({DISCS})", "r >= 0 and s <= 0 and (r - s)^2 - a^2 - b^2 >= 0"),
    (DISCS, "(r + s)^2 - a^2 - b^2 >= 0 or (r - s)^2 - a^2 - b^2 >= 0"),
    ("ex x, y. x^2 + y^2 <= 0 and x^2 + y^2 < a", "a > 0"),
    ("ex x, y, z. x^2 + y^2 + z^2 < 1 and (x-a)^2 + y^2 + z^2 <= 1", "-2 < a < 2"),
    ("all x, y. x^2 + y^2 > 1 or (x-a)^2 + y^2 >= 4", "a <= -3 or a >= 3"),
    ("all x, y. (x-a)^2 + (y-b)^2 <= 4 -> x^2 + y^2 <= 9", "a^2 + b^2 <= 1"),
    (f"r > 0 and s > 0 and ({DISCS.replace('<', '')})", f"r > 0 and s > 0 and {NEAR} >= 0 and {FAR} <= 0"),
    (f"r > 0 and s > 0 and not ({DISCS.replace('<=', '>', 1)})", f"s > 0 and {FAR} >= 0 and r >= s"),
    (
        f"r > 0 and s > 0 and ({DISCS.replace('<=', '=', 1)})",
        f"r > 0 and s > 0 and {NEAR} >= 0 and ({FAR} <= 0 or r <= s)",
    ),
    ("ex x, y. x^2 + y^2 = a and x^2 + y^2 <= b", "0 <= a <= b"),
    ("ex x, y. x^2 + y^2 > a and x^2 + y^2 <= b", "b >= 0 and a < b"),
    (
        "a > 0 and ex t. t >= 0 and t <= a and u*t + p >= 0 and u*t + p <= 1",
        "a > 0 and (p >= 0 or a*u + p >= 0) and (p <= 1 or a*u + p <= 1)",
    ),
)
def test_the_condition_is_short(text: str, answer: str) -> None:
    assert str(qe.eliminate(text).formula) == answer


@each(
    (f"all x, y. {QUADRATIC} -> x < 0", "b > 0 and c > 0"),
    (f"all y, x. {QUADRATIC} -> x > 0", "b < 0 and c > 0"),
    (f"all x, y. {QUADRATIC} -> 2*x < a", "a + b > 0 and a^2 + 2*a*b + 4*c > 0"),
    ("all x, y. a*x + b = 0 and a*y = 0 -> x < 0", "a*b > 0 or a = 0 and b /= 0"),
    (PID, "i > 0 and p > -1 and 3*(3+d)*(1+p) - (1+p)^2 - 9*i > 0"),
    (f"ex b. all x, y. {QUADRATIC} -> x < 0", "c > 0"),
)
def test_the_condition_is_that_of_hurwitz(text: str, answer: str) -> None:
    assert qe.equivalent(qe.eliminate(text).formula, answer)


def test_a_cubic_by_its_bernstein_coefficients() -> None:
    """1981 characters by virtual substitution of roots."""
    assert len(str(qe.eliminate(f"all x. 0 <= x and x <= 1 -> {FORM} >= 0").formula)) < 200


TAKEN = [
    (QUADRICS, IN_DISC),
    (QUADRICS, f"a > 0 and b > 0 and (ex x, y. 0 >= {ELLIPSE} and 1 - x^2 - y^2 < 0)"),
    (QUADRICS, f"a > 0 and b > 0 and (ex x, y. {ELLIPSE.replace('y - d', 'y - d + x')} = 0 and x^2 + y^2 > 1)"),
    (QUADRICS, f"r /= 0 and (ex y, x. {DISC} = 0 and y - a*y^2 + 2 < x^2)"),
    (QUADRICS, f"(ex x, y. {DISC.replace('r^2', 'r')} <= 0 and a*x^2 + y^2 > 1)"),
    (QUADRICS, "ex x, y. x^2 + x*y + y^2 - a*x - r = 0 and x^2 + c*x + d*y > 1"),
    (CUBIC, f"{UNIT} < 0"),
    (CUBIC, f"{UNIT} <= 0"),
    (CUBIC, f"{UNIT.replace('<=', '<')} < 0"),
    (CUBIC, f"ex x. x > 0 and -x >= -1 and {FORM} > 0"),
    (CUBIC, f"ex x. 2*x >= -3 and {FORM} < 0"),
    (CUBIC, "ex x. 3*x < c and a*x^3 + b*x + d > 0"),
    (CUBIC, "c > b and (ex x. b <= x and 2*x <= 2*c and x^3 - a*x - d >= 0)"),
    (PLANE, "ex x, y. 2*x^3 - 6*x*y^2 + 4*x + 2*c = 0 and 3*x^2*y - y^3 + 2*y = 0 and -3*x <= b"),  # multiples
    (BALLS, "a > 0 and (ex x, y. a*x^2 + a*y^2 <= 1 and x^2 + y^2 <= b)"),
    (BALLS, "ex x, y, z, w. 2*(x^2 + y^2 + z^2 + w^2) = a and (x - b)^2 + (y - c)^2 + z^2 + w^2 < 3"),
]


@each(*TAKEN)
def test_the_step_is_taken_and_accepted(kind: StepKind, text: str) -> None:
    (step,) = steps_of(text, kind, StepKind.MINISCOPE)
    assert accepted(step)


UNKNOWN = [
    (QUADRICS, IN_DISC.replace("a /= 0 and ", "")),  # a line where a = 0: no point below, nothing convex
    (QUADRICS, IN_DISC.replace("> 1", "< 1")),  # meets the open disc: f is convex
    (QUADRICS, "ex x, y. (x - c)^2 + a*y^2 <= r and x^2 + (y - d)^2 > 1"),  # a line, a parabola or a hyperbola
    (BALLS, "ex x, y. a*x^2 + a*y^2 <= 1 and x^2 + y^2 <= b"),
    (PLANE, f"ex x, y. {QUADRATIC} and a*x >= 0"),
    (CUBIC, "ex x. b <= x and x <= c and x^3 - a*x - d < 0"),  # perhaps no interval
]
"""What is given in a theorem is not known there."""

OTHERS = [
    *UNKNOWN,
    (QUADRICS, IN_DISC.replace("> 1", ">= 1")),
    (QUADRICS, IN_DISC.replace("= 0 and x", "< 0 and x")),
    (QUADRICS, IN_DISC.replace("(x - c)", "(x - 1)").replace("(y - d)", "y")),  # two parameters
    (QUADRICS, IN_DISC.replace("x^2 + y^2", "x^3 + y^2")),
    (QUADRICS, f"r > 0 and (ex x, y. {DISC} <= 0 and a*x + b*y > 1)"),  # f is not concave
    (QUADRICS, "a > 0 and b > 0 and r > 0 and (ex x, y. a*x^2 - b*y^2 + c*x <= r and x*y + x^2 + d*y > 1)"),
    (BALLS, "ex x, y. x^2 + 2*y^2 <= a and x^2 + y^2 <= b"),
    (BALLS, "ex x, y. x^2 + y^2 + x*y <= a and x^2 + y^2 <= b"),
    (BALLS, "ex x, y. x^2 + y^2 >= a and x^2 + (y - c)^2 >= b"),
    (BALLS, "ex x, y. x^2 + y^2 /= a and x^2 + y^2 <= b"),
    (BALLS, "ex x. x^2 = a and (x - c)^2 <= b"),
    (BALLS, "ex x, y. x^2 + y^2 <= a and x^2 + y^2 <= b and x > c"),
    (BALLS, "ex x. x^2 <= a and (x - b)^2 <= 1"),
    (BALLS, "ex x, y. x^2 + y^2 <= 1 and (x - 1)^2 + y^2 < 2"),  # no parameters
    (PLANE, f"ex x, y. {QUADRATIC} and x > 0"),
    (PLANE, f"ex x, y. {QUADRATIC} and x + y >= 0"),
    (PLANE, f"ex x, y. {QUADRATIC} and y >= 0"),
    (PLANE, f"ex x, y. {QUADRATIC} and x^2 >= 1"),
    (PLANE, f"ex x, y. {QUADRATIC} and x >= 0 and y >= 0"),
    (PLANE, "ex x, y. x^2 - y^2 + b*x + c = 0 and 2*x*y - b*y = 0 and x >= 0"),
    (PLANE, "ex x, y. x^2 + y^2 + b*x + c = 0 and 2*x*y + b*y = 0 and x >= 0"),
    (PLANE, "ex x, y. x^2 - y^2 + b*x + a*y + c = 0 and 2*x*y + b*y = 0 and x >= 0"),
    (PLANE, "ex x, y. x^2 - y^2 + x + 1 = 0 and 2*x*y + y = 0 and x >= 0"),
    (CUBIC, f"{UNIT.replace('0 <=', '0 <')} <= 0"),  # a zero at an end that does not belong to the interval
    (CUBIC, f"ex x. 0 <= x and {FORM} <= 0"),
    (CUBIC, f"{UNIT} = 0"),
    (CUBIC, "ex x. 0 <= x and 1 <= 2*x and x^3 + a*x^2 + b*x + c < 0"),
    (CUBIC, "ex x. a*x >= 1 and x <= 1 and x^3 + b*x + c < 0"),
    (CUBIC, "ex x. 0 <= x and x <= 1 and x^4 + a*x^2 + b*x + c < 0"),
    (CUBIC, "ex x. 0 <= x and x <= 1 and x^3 + a*x + b < 0"),  # two parameters
    (CUBIC, "ex x. 0 <= x and x <= 1 and a*x^2 + b*x + c < 0"),  # substitution has shorter answers
    (CUBIC, "ex x. x > 0 and a*x^2 + b*x + c < 0"),
]


@each(*OTHERS)
def test_others_are_left_alone(kind: StepKind, text: str) -> None:
    assert not steps_of(text, kind, StepKind.MINISCOPE)


@each(*UNKNOWN)
def test_a_producer_that_takes_all_for_known_is_not_believed(
    kind: StepKind, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(closed_forms, "_holds", lambda given, context: True)
    steps = steps_of(text, kind, StepKind.MINISCOPE)
    assert steps and not any(map(accepted, steps))


def test_a_square_root_of_another_sign_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first root that there is counts as positive."""
    monkeypatch.setattr(closed_forms, "_holds", lambda given, context: True)
    steps = steps_of(DISCS, BALLS, StepKind.MINISCOPE)
    assert steps and not any(map(accepted, steps))


def test_determinants_out_of_reach_are_left_alone() -> None:
    """A sum of many terms in every coefficient: no answer of any use."""
    ring = Ring.of((*"abcdefgh", "x", "y"))
    large = sum((ring.gen(i) for i in range(8)), ring.constant(1)) ** 4
    used = theorem("a polynomial has a root in a half-plane", ("4",))
    assert used is not None
    letters = {**{f"c{k}": large + k for k in range(5)}, "k": ring.constant(1), "m": ring.constant(0)}
    assert not steps_of(used.formula("block", letters, {"x": "x", "y": "y"}, ring), PLANE, StepKind.MINISCOPE)
    body = conj((atom(ring.var("x"), Relation.GE), atom(ring.var("y"), Relation.EQ), atom(large, Relation.EQ)))
    assert not steps_of(exists(("x", "y"), body), PLANE, StepKind.MINISCOPE)


def test_the_ellipse_of_kahan() -> None:
    """Anywhere in the plane: no answer was known, and decomposition does not end."""
    answer = qe.eliminate(f"all x, y. (a*b /= 0 and ({ELLIPSE} = 0 -> x^2 + y^2 <= 1))").formula
    assert answer is not None
    inside = ["a = 1 and b = 1 and c = 0 and d = 0", "2*a = 1 and 4*b = -1 and 4*c = 1 and 4*d = 1"]
    outside = ["a = 1 and b = 1 and c = 0 and d = 1", "a = 1 and 2*b = 1 and c = 0 and 9*d = 1"]
    for expected, points in ((True, inside), (False, outside)):
        for point in points:
            assert qe.decide(f"ex a, b, c, d. {point} and ({answer})") is expected


def test_square_roots() -> None:
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")
    assert (4 * (x - y) ** 2 * (x + 1) ** 4).square_root() in (2 * (x - y) * (x + 1) ** 2, 2 * (y - x) * (x + 1) ** 2)
    assert ring.constant(0).square_root() == ring.constant(0)
    assert all(p.square_root() is None for p in (2 * x * x, -x * x, x * x * y, ring.constant(-4)))
