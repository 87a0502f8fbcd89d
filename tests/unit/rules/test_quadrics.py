"""One quadric in another: the multiplier against decisions at numbers, the rule's side conditions, its checker."""

from __future__ import annotations

import random
from collections.abc import Mapping
from fractions import Fraction

import pytest

import qe
import qe.rules.quadrics as quadrics
from qe.api.input import read_formula
from qe.certify.quadrics import check_quadrics
from qe.exact.ring import Poly
from qe.formula.syntax import Formula
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_broken_producers import accepted
from tests.unit.certify.claims import NO_LEMMAS, objection

ELLIPSE = "b^2*(x - c)^2 + a^2*(y - d)^2 - a^2*b^2"
DISC = "(x - c)^2 + (y - d)^2 - r^2"
IN_DISC = f"a /= 0 and b /= 0 and (ex x, y. {ELLIPSE} = 0 and x^2 + y^2 > 1)"
SOLID = f"a > 0 and b > 0 and (ex x, y. 0 >= {ELLIPSE} and 1 - x^2 - y^2 < 0)"
TURNED = f"a > 0 and b > 0 and (ex x, y. {ELLIPSE.replace('y - d', 'y - d + x')} = 0 and x^2 + y^2 > 1)"
IN_PARABOLA = f"r /= 0 and (ex y, x. {DISC} = 0 and y - a*y^2 + 2 < x^2)"
PERHAPS_A_POINT = f"(ex x, y. {DISC.replace('r^2', 'r')} <= 0 and a*x^2 + y^2 > 1)"
PERHAPS_EMPTY = "ex x, y. x^2 + x*y + y^2 - a*x - r = 0 and x^2 + c*x + d*y > 1"
TAKEN = [IN_DISC, SOLID, TURNED, IN_PARABOLA, PERHAPS_A_POINT, PERHAPS_EMPTY]


def steps_of(text: str | Formula) -> list[Step]:
    """The steps of this rule alone."""
    log = RunLog()
    prepare(read_formula(text), enabled={StepKind.QUADRICS}, log=log)
    return list(log.steps())


@pytest.mark.parametrize("text", TAKEN)
def test_the_multiplier_tells_what_the_block_does(text: str) -> None:
    """Parameters at random, often those of discs about the axes, where the minors vanish."""
    (step,) = steps_of(text)
    assert accepted(step)
    rng, seen = random.Random(5), set()
    names = [name for name in step.before.free if name not in ("x", "y")]
    for _ in range(8):
        values = {name: Fraction(rng.choice((1, 2, 3, 4, 5)), rng.choice((5, 5, 6))) for name in names}
        values |= {name: Fraction(rng.choice((0, 0, 1, -2)), 5) for name in ("c", "d")}
        sides = [qe.decide(side.substitute(values), process=False) for side in (step.before, step.after)]
        assert sides[0] is sides[1], values
        seen.add(sides[0])
    assert seen == {True, False}


@pytest.mark.parametrize(
    "text",
    [
        IN_DISC.replace("a /= 0 and ", ""),  # a line where a = 0: no point below, nothing convex
        IN_DISC.replace("> 1", ">= 1"),
        IN_DISC.replace("= 0 and x", "< 0 and x"),
        IN_DISC.replace("(x - c)", "(x - 1)").replace("(y - d)", "y"),  # two parameters
        IN_DISC.replace("> 1", "< 1"),  # meets the open disc: f is convex
        IN_DISC.replace("x^2 + y^2", "x^3 + y^2"),
        "ex x, y. (x - c)^2 + a*y^2 <= r and x^2 + (y - d)^2 > 1",  # a line, a parabola or a hyperbola
        f"r > 0 and (ex x, y. {DISC} <= 0 and a*x + b*y > 1)",  # f is not concave
        "a > 0 and b > 0 and r > 0 and (ex x, y. a*x^2 - b*y^2 + c*x <= r and x*y + x^2 + d*y > 1)",
    ],
)
def test_others_are_left_alone(text: str) -> None:
    assert not steps_of(text)


SHAPES = [
    "(x - {a})^2 + (y - {b})^2 - {c}",
    "{a}*x^2 + {b}*x*y + 2*y^2 - {c}",
    "(x + y)^2 + {b}*x - {c}",
    "x^2 - {c}*y^2 + {a}*x*y + {b}",
    "(x - y)*(x + {c}*y + {b})",
    "(x - {c}*y - {a})^2",
    "{b}*x^2 + {a}*y^2 + {c}*x + y",
]


def test_without_parameters_the_multiplier_tells_it_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Circles (points among them), ellipses, parabolas, hyperbolas, lines, double lines; often the same one twice."""
    monkeypatch.setattr(quadrics, "PARAMETERS_FROM", 0)
    rng, found = random.Random(2), []
    while len(found) < 12:
        shapes = [rng.choice(SHAPES).format(**{k: rng.choice((0, 0, 1, -1, 2)) for k in "abc"}) for _ in range(2)]
        inner, outer = shapes[0], shapes[rng.randrange(4) > 0]
        weak, shift = rng.choice(("<=", "=")), rng.choice((0, 0, 1, -1))
        found += steps_of(f"ex x, y. {inner} {weak} 0 and {outer} > {shift}")
    monkeypatch.undo()
    truths = [[qe.decide(side, process=False) for side in (step.before, step.after)] for step in found]
    assert all(before is after for before, after in truths)
    assert len({before for before, _ in truths}) == 2


def test_the_ellipse_of_kahan() -> None:
    """Anywhere in the plane: no answer was known, and decomposition does not end."""
    answer = qe.eliminate(f"all x, y. (a*b /= 0 and ({ELLIPSE} = 0 -> x^2 + y^2 <= 1))").formula
    inside = [
        (1, 1, 0, 0),
        (1, Fraction(1, 2), 0, 0),
        (Fraction(1, 2), Fraction(-1, 4), Fraction(1, 4), Fraction(1, 4)),
    ]
    outside = [
        (1, 1, 0, 1),
        (1, Fraction(1, 2), 0, Fraction(1, 9)),
        (Fraction(1, 2), 1, Fraction(1, 9), 0),
        (0, 1, 0, 0),
    ]
    for expected, points in ((True, inside), (False, outside)):
        for point in points:
            values = dict(zip("abcd", map(Fraction, point), strict=True))
            assert qe.decide(answer.substitute(values), process=False) is expected


@pytest.mark.parametrize("radius", [-1, 0, Fraction(1, 9), 1, 4])
@pytest.mark.parametrize("weak", ["<=", "="])
def test_discs_that_are_a_point_or_empty(radius: int | Fraction, weak: str) -> None:
    """A disc may be empty or a point: the case that the multiplier says nothing about."""
    (step,) = steps_of(f"ex x, y. (x - c)^2 + (y - d)^2 - r {weak} 0 and x^2 + a*y^2 > 1")
    truths = set()
    for c, d, a in ((0, 0, 1), (1, 0, 1), (Fraction(3, 2), 0, 4), (0, 1, 4), (Fraction(2, 3), 0, 3)):
        values = dict(zip("cdar", map(Fraction, (c, d, a, radius)), strict=True))
        before, after = (qe.decide(side.substitute(values), process=False) for side in (step.before, step.after))
        assert before is after
        truths.add(before)
    assert truths == ({False} if radius < 0 else {True} if radius > 1 else {False, True})


# --- the checker -----------------------------------------------------------------------------------------------------
BALL = "ex x, y. x^2 + y^2 - 1 <= 0 and x^2 + 2*y^2 > 3"
NONE = "all x. not (x > 0 and 2 - 2*x >= 0 and 2 - 4*x >= 0 and 6*x - 2 >= 0)"
POINT = "ex x, y. x^2 + y^2 <= 0 and x^2 + 2*y^2 > 3"
BY = {"along": "x", "turned": 0, "below": 1, "theory": NO_LEMMAS}


@pytest.mark.parametrize(
    ("before", "after", "change", "reason"),
    [
        (BALL, NONE, {}, ""),
        (BALL, NONE, {"along": "y"}, ""),
        (BALL.replace("<=", "="), NONE, {}, ""),
        (BALL.replace("x^2 + y^2 - 1 <= 0", "1 - x^2 - y^2 >= 0"), NONE, {}, ""),
        (BALL.replace("<=", ">="), NONE, {}, "do not exclude"),  # all points but those of a disc
        (BALL.replace("<=", "="), NONE, {"turned": 1}, "do not exclude"),
        (BALL, NONE, {"turned": 1}, "for an equation"),
        (BALL, NONE, {"turned": 2}, "for an equation"),
        (BALL, NONE, {"along": "z"}, "one of them named"),
        (BALL, NONE.replace("6*x - 2", "6*x - 1"), {}, "do not exclude"),
        (BALL, NONE.replace(" and 2 - 4*x >= 0", ""), {}, "do not exclude"),
        (BALL, f"{NONE} or 1 = 0", {"below": 0}, ""),
        (BALL, NONE, {"below": 2}, "0 or 1"),
        (BALL, NONE, {"below": None}, ""),  # an older certificate
        (POINT, NONE, {"below": None}, "do not exclude"),
        (POINT, "-1 > 0", {"below": 0}, ""),
        (POINT.replace("> 3", "> -3"), "0 = 0", {"below": 0}, ""),
        (POINT.replace("> 3", "> -3"), "-1 > 0", {"below": 0}, "do not exclude"),
        (POINT, NONE, {"below": 1}, "do not exclude"),
        (POINT.replace("y^2 <", "2*x*y + y^2 <"), "-1 > 0", {"below": 0}, "do not exclude"),
        (BALL.replace("x^2 + y^2 - 1", "x^2 + y^2"), NONE.replace("6*x - 2", "6*x"), {}, "do not exclude"),
        (BALL.replace("> 3", ">= 3"), NONE, {}, "a strict inequality and a weak one"),
        (BALL.replace("<= 0", "< 0"), NONE, {}, "a strict inequality and a weak one"),
        (BALL.replace("2*y^2", "2*y^3"), NONE, {}, "degree 2"),
        (BALL.replace("<=", "/="), NONE, {}, "a strict inequality and a weak one"),
        (BALL.replace("x^2 + 2*y^2 > 3", "(x^2 + 2*y^2 > 3 or x > 1)"), NONE, {}, "a strict inequality and a weak one"),
        (BALL.replace("and", "or"), NONE, {}, "two conditions"),
        (BALL + " and x > 0", NONE, {}, "two conditions"),
        (BALL.replace("ex x, y", "ex x, y, z"), NONE, {}, "two variables"),
    ],
)
def test_what_the_checker_says(before: str, after: str, change: Mapping[str, object], reason: str) -> None:
    found = objection(check_quadrics, before, after, {**BY, **change})
    assert reason in found and bool(found) is bool(reason)


def every_sign(m: pytest.MonkeyPatch) -> None:
    """Every polynomial counts as positive."""
    m.setattr(quadrics, "_is_positive", lambda p, context: True)


def rows_alone(m: pytest.MonkeyPatch) -> None:
    """The entries of the diagonal are taken for enough."""
    m.setattr(quadrics, "_connected", lambda matrix: [(0,), (1,), (2,)])


def no_point(m: pytest.MonkeyPatch) -> None:
    """What is one point counts as empty."""
    m.setattr(quadrics, "either_sign", lambda outer, inner, apart: apart)


def no_sign(m: pytest.MonkeyPatch) -> None:
    """Determinants without the signs of their terms."""

    def permanent(matrix: quadrics.Matrix, rows: tuple[int, ...], columns: tuple[int, ...]) -> Poly:
        if not rows:
            return matrix[0, 0].ring.constant(1)
        others = ((c, tuple(d for d in columns if d != c)) for c in columns)
        terms = (matrix[rows[0], c] * permanent(matrix, rows[1:], rest) for c, rest in others)
        return sum(terms, matrix[0, 0].ring.constant(0))

    m.setattr(quadrics, "_minor", permanent)


@pytest.mark.parametrize(
    ("broken", "text"),
    [
        (every_sign, IN_DISC.replace("a /= 0 and ", "")),
        (every_sign, IN_DISC.replace("> 1", "< 1")),
        (rows_alone, IN_DISC),
        (no_point, PERHAPS_A_POINT),
        (no_sign, "r > 0 and (ex x, y. x^2 + y^2 <= r^2 and 2*(x - c)^2 + a*(y - d)^2 > b)"),
    ],
)
def test_a_broken_producer_is_not_believed(broken: object, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    broken(monkeypatch)  # type: ignore[operator]
    steps = steps_of(text)
    assert steps and not any(accepted(step) for step in steps)
