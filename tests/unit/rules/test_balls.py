"""Two balls, spheres or outsides of balls that meet: the closed form against other methods, its side conditions, its
checker against forgeries."""

from __future__ import annotations

import dataclasses
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.balls import balls_goals, check_balls
from qe.certify.step import Claim
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.evaluate import holds_at, substituted
from qe.formula.syntax import Exists, Relation
from qe.io.text import read
from qe.proof.derivation import moved
from qe.proof.entry import Entry
from qe.proof.run_log import RunLog
from qe.rules.balls import square_root
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.unit.certify.claims import NO_LEMMAS, line, objection

ALONE = frozenset({StepKind.BALLS, StepKind.MINISCOPE})
DISCS = "ex x, y. x^2 + y^2 <= r^2 and (x - a)^2 + (y - b)^2 <= s^2"
NEAR, FAR = "r^2 + 2*r*s + s^2 - a^2 - b^2", "r^2 - 2*r*s + s^2 - a^2 - b^2"


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (f"r >= 0 and s > 0 and ({DISCS})", "r >= 0 and s > 0 and r^2 + 2*r*s + s^2 - a^2 - b^2 >= 0"),
        (f"r >= 0 and s <= 0 and ({DISCS})", "r >= 0 and s <= 0 and r^2 - 2*r*s + s^2 - a^2 - b^2 >= 0"),
        (DISCS, "r^2 + 2*r*s - a^2 - b^2 + s^2 >= 0 or r^2 - 2*r*s - a^2 - b^2 + s^2 >= 0"),
        ("ex x, y. x^2 + y^2 <= 0 and x^2 + y^2 < a", "a > 0"),
        ("ex x, y, z. x^2 + y^2 + z^2 < 1 and (x-a)^2 + y^2 + z^2 <= 1", "a - 2 < 0 and a + 2 > 0"),
        ("all x, y. x^2 + y^2 > 1 or (x-a)^2 + y^2 >= 4", "a^2 - 9 >= 0"),
        ("all x, y. (x-a)^2 + (y-b)^2 <= 4 -> x^2 + y^2 <= 9", "a^2 + b^2 - 1 <= 0"),
        (f"r > 0 and s > 0 and ({DISCS.replace('<', '')})", f"r > 0 and s > 0 and {NEAR} >= 0 and {FAR} <= 0"),
        (f"r > 0 and s > 0 and not ({DISCS.replace('<=', '>', 1)})", f"r > 0 and s > 0 and {FAR} >= 0 and r - s >= 0"),
        (
            f"r > 0 and s > 0 and ({DISCS.replace('<=', '=', 1)})",
            f"r > 0 and s > 0 and {NEAR} >= 0 and ({FAR} <= 0 or r - s <= 0)",
        ),
        ("ex x, y. x^2 + y^2 = a and x^2 + y^2 <= b", "a - b <= 0 and a >= 0"),
        ("ex x, y. x^2 + y^2 > a and x^2 + y^2 <= b", "b >= 0 and a - b < 0"),
    ],
)
def test_the_condition_is_short(text: str, answer: str) -> None:
    assert str(qe.eliminate(text).formula) == answer


@pytest.mark.parametrize(
    "text",
    [
        "ex x, y. x^2 + 2*y^2 <= a and x^2 + y^2 <= b",
        "ex x, y. x^2 + y^2 + x*y <= a and x^2 + y^2 <= b",
        "ex x, y. x^2 + y^2 >= a and x^2 + (y - c)^2 >= b",
        "ex x, y. x^2 + y^2 /= a and x^2 + y^2 <= b",
        "ex x. x^2 = a and (x - c)^2 <= b",
        "ex x, y. a*x^2 + a*y^2 <= 1 and x^2 + y^2 <= b",
        "ex x, y. x^2 + y^2 <= a and x^2 + y^2 <= b and x > c",
        "ex x. x^2 <= a and (x - b)^2 <= 1",
    ],
)
def test_others_are_left_alone(text: str) -> None:
    assert prepare(read(text), enabled=ALONE).formula == prepare(read(text), enabled=set()).formula


SMALL = st.integers(-3, 3)
RELATIONS = ("<", "<=", "=", ">=", ">")


@settings(max_examples=60, deadline=None)
@given(
    st.lists(SMALL, min_size=5, max_size=5),
    st.tuples(st.integers(1, 2), st.integers(1, 3)),
    st.sampled_from([(p, q) for p in RELATIONS for q in RELATIONS if not (">" in p and ">" in q)]),
    st.booleans(),
)
def test_numbers_put_in_before_or_after(
    at: list[int], leads: tuple[int, int], signs: tuple[str, str], square: bool
) -> None:
    c, k = leads
    first = f"{c}*x^2 + {c}*y^2 + a*x - b*y {signs[0]} {'d^2' if square else 'd'}"
    second = f"{k}*(x - u)^2 + {k}*y^2 {signs[1]} {'f^2' if square else 'f - 1'}"
    found = prepare(read(f"ex x, y. {first} and {second}"), enabled=ALONE).formula
    assert found.is_quantifier_free
    point = dict(zip("abduf", map(Fraction, at), strict=True))
    closed = read(f"ex x, y. {first} and {second}")
    assert isinstance(closed, Exists)
    asked = Exists(closed.variables, substituted(closed.body, point))
    assert holds_at(found, point) == qe.decide(asked, timeout=60, without="balls")


def test_square_roots() -> None:
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")
    assert square_root(4 * (x - y) ** 2 * (x + 1) ** 4) in (2 * (x - y) * (x + 1) ** 2, 2 * (y - x) * (x + 1) ** 2)
    assert square_root(ring.constant(0)) == ring.constant(0)
    assert all(square_root(p) is None for p in (2 * x * x, -x * x, x * x * y, ring.constant(-4)))


@pytest.fixture
def right() -> Claim:
    """Two discs with r, s >= 0 known, the sign of r*s used."""
    before = read(DISCS)
    ring = before.ring
    assert ring is not None
    r, s, a, b = (ring.var(name) for name in "rsab")
    after = atom(a * a + b * b - r * r - s * s - 2 * r * s, Relation.LE)
    after = conj((atom(16 * r * r, Relation.GE), atom(16 * s * s, Relation.GE), after))
    return Claim("two balls", before, after, ring, Entry({"root": ["T", "r*s", 1], "theory": None}, "step"), "step")


def test_forged_steps_are_refused(right: Claim) -> None:
    known = (read("r >= 0"), read("s >= 0"))
    goals = balls_goals(right, known)
    assert len(goals) == 1 and len(goals[0]) == 3
    ring = right.ring
    r, s, a, b = (ring.var(name) for name in "rsab")
    gap, radii = a * a + b * b - r * r - s * s, (atom(r * r, Relation.GE), atom(s * s, Relation.GE))
    for root in (["T", "r*s", -1], ["T", "r*s", 0], ["T", "r", 1], ["T", "2", 1], ["T", "r*s"], ["U", "r*s", 1], None):
        with pytest.raises(CertificateRejected):
            balls_goals(dataclasses.replace(right, evidence=Entry({"root": root, "theory": None}, "step")), known)
    for after in (
        conj((*radii, atom(gap - 2 * r * s, Relation.LT))),
        conj((*radii, atom(gap - 3 * r * s, Relation.LE))),
        conj((*radii, atom(gap + 2 * r * s, Relation.LE))),
        conj((*radii, disj((atom(gap, Relation.LE), atom(gap**2 - 4 * r**2 * s**2, Relation.LE))))),
        atom(gap, Relation.LE),
    ):
        with pytest.raises(CertificateRejected):
            balls_goals(dataclasses.replace(right, after=after), known)


@pytest.mark.parametrize("pair", [("=", "<="), ("=", "="), ("<=", ">="), ("<=", "<=")])
def test_each_kind_of_pair_has_its_own_condition(pair: tuple[str, str]) -> None:
    """It is refused for the others, but that the outside of a ball meets a sphere as it meets the ball inside."""
    log = RunLog()
    text = "ex u, v. u^2 + v^2 {} 1 and (u - x)^2 + (v - y)^2 {} a"
    prepare(read(text.format(*pair)), enabled=ALONE, log=log)
    (step,) = [step for step in log.steps() if step.rule == "two balls"]
    ring = step.before.ring
    assert ring is not None
    for first in RELATIONS:
        for second in RELATIONS:
            before = moved(read(text.format(first, second)), ring)
            claim = Claim("two balls", before, step.after, ring, Entry({"root": None, "theory": None}, "step"), "step")
            if (first, second) == pair or (pair == ("<=", ">=") and (first, second) == ("=", ">=")):
                assert balls_goals(claim, ()) == []
                continue
            with pytest.raises(CertificateRejected):
                balls_goals(claim, ())


TWO_BALLS = "4*a >= 0 and (4*b^2 - 4*a - 4 <= 0 or (4*b^2 - 4*a - 4)^2 - 64*a <= 0)"


@pytest.mark.parametrize(
    ("before", "is_right"),
    [
        ("ex x, y. x^2 + y^2 <= a and (x - b)^2 + y^2 <= 1", True),
        ("ex x. x^2 <= a and (x - b)^2 <= 1", True),
        ("ex x, y. x^2 + y^2 <= a or (x - b)^2 + y^2 <= 1", False),
        ("ex x, y. x^2 + 2*y^2 <= a and (x - b)^2 + y^2 <= 1", False),  # ellipses
        ("ex x, y. x^2 + y^2 <= a and (x - b)^2 + 2*y^2 <= 1", False),
        ("ex x, y. x^2 + y^2 <= a and ((x - b)^2 + y^2 <= 1 or x > 5)", False),
        ("ex x, y. x^2 + y^2 < a and (x - b)^2 + y^2 <= 1", False),
        ("ex x, y. c*x^2 + c*y^2 <= a and (x - b)^2 + y^2 <= 1", False),
    ],
)
def test_the_condition_for_two_balls_is_that_of_nothing_else(before: str, is_right: bool) -> None:
    """D = 4*b^2, R = 4*a and S = 4 where both are balls."""
    found = objection(check_balls, before, TWO_BALLS, {"root": None, "theory": NO_LEMMAS})
    assert bool(found) is not is_right


def test_of_a_root_without_a_sign_both_are_meant() -> None:
    """4*R*S = (8*b*c)^2, and 2*sqrt(R*S) is 8*b*c or -8*b*c: one of them alone is not the condition."""
    before = "ex x, y. x^2 + y^2 <= b^2 and (x - a)^2 + y^2 <= c^2"
    gap = "4*a^2 - 4*b^2 - 4*c^2"
    either = (f"{gap} - 8*b*c <= 0", f"{gap} + 8*b*c <= 0")
    evidence = {"root": ["T", line("b*c"), 0], "theory": NO_LEMMAS}
    radii = "4*b^2 >= 0 and 4*c^2 >= 0"
    assert not objection(check_balls, before, f"{radii} and ({either[0]} or {either[1]})", evidence)
    for wrong in (either[0], either[1], "1 < 0"):
        assert objection(check_balls, before, f"{radii} and {wrong}", evidence)


def test_spheres_in_one_variable_are_refused() -> None:
    """On a line a sphere is two points: no closed form of this kind."""
    before = read("ex u. u^2 = 1 and (u - x)^2 = a")
    ring = before.ring
    assert ring is not None
    x, a = ring.var("x"), ring.var("a")
    after = conj((atom(a, Relation.GE), atom((x * x - 1 - a) ** 2 - 4 * a, Relation.LE)))
    with pytest.raises(CertificateRejected):
        balls_goals(Claim("two balls", before, after, ring, Entry({"root": None, "theory": None}, "step"), "step"), ())
