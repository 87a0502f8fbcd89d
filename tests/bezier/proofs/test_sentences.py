"""Sentences about arms, their branches and the limits of their joints: what certificates claim, when it holds."""

from __future__ import annotations

import json
import random
from copy import deepcopy
from fractions import Fraction
from itertools import product
from math import cos, isclose, pi, sin
from typing import Any

import pytest

import qe
from bezier.arm.evidence import certificates
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.reader import load_arm, read_arm
from bezier.curves.curve import Bezier
from bezier.proofs.arm_rows import ArmChain, read_chain
from bezier.proofs.arm_sentences import ArmEquations, constant, ring_of, variable, with_roots
from bezier.proofs.branch import check_branch
from bezier.proofs.square_roots import Motion, Surd
from qe.certify.verify import verify
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE
from qe.proof.entry import Entry
from tests.certificates.restated import evidence_of, verdict_by
from tests.tables import each
from tests.unit.certify.claims import limits

Matrix = list[list[float]]


def chain_of(rng: random.Random, joints: int) -> ArmChain:
    """An arm with angles of twelfths of pi, and others."""
    rows: list[Any] = [
        {
            "a": str(rng.choice((0, 1, 2, "1/2"))),
            "alpha": rng.choice((0, 3, 6, -6, 4, ["3/5", "4/5"])),
            "d": str(rng.choice((0, 1, "1/3"))),
            "theta": rng.choice((0, 2, 6, ["3/5", "-4/5"])),
            "joint": rng.choice(("revolute", "revolute", "prismatic")),
        }
        for _ in range(joints)
    ]
    arm = {"convention": rng.choice(("modified", "standard")), "rows": [*rows, {**rows[0], "joint": None}]}
    return read_chain(Entry(arm, "arm"))


def as_float(value: Surd) -> float:
    return sum(float(q) * d**0.5 for d, q in value.terms)


def times(a: Matrix, b: Matrix) -> Matrix:
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def matrix(motion: Motion) -> Matrix:
    rows, shift = motion
    return [[*(as_float(c) for c in row), as_float(o)] for row, o in zip(rows, shift)] + [[0.0, 0.0, 0.0, 1.0]]


def moved(turns: bool, q: float) -> Matrix:
    if not turns:
        return [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, q], [0, 0, 0, 1]]
    return [[cos(q), -sin(q), 0, 0], [sin(q), cos(q), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def whole(chain: ArmChain, joints: list[float]) -> Matrix:
    result = matrix(chain.constants[0])
    for turns, q, constant_part in zip(chain.turns, joints, chain.constants[1:]):
        result = times(times(result, moved(turns, q)), matrix(constant_part))
    return result


def values(equations: ArmEquations, chain: ArmChain, joints: list[float]) -> list[float]:
    """Of the expressions at joint values."""
    named: dict[str, float] = {}
    for names, turns, q in zip(equations.names, chain.turns, joints):
        named |= dict(zip(names, (cos(q), sin(q)) if turns else (q,)))
    found = []
    for expression in equations.expressions:
        total = 0.0
        for variables, c in expression.terms.items():
            term = as_float(c)
            for name in variables:
                term *= named[name]
            total += term
        found.append(total)
    return found


@pytest.mark.parametrize("seed", range(12))
def test_the_end_point_is_where_the_equations_say(seed: int) -> None:
    rng = random.Random(seed)
    chain = chain_of(rng, 3)
    joints = [rng.uniform(-3, 3) for _ in range(3)]
    place = [row[3] for row in whole(chain, joints)[:3]]
    at_origin = ArmEquations.at_point(chain, [constant(Surd.rational(0))] * 3)
    assert all(isclose(a, b, abs_tol=1e-9) for a, b in zip(values(at_origin, chain, joints), place))
    somewhere = ArmEquations.at_point(chain, [constant(Surd.rational(k)) for k in (1, 2, 3)])
    found = values(somewhere, chain, joints)
    assert all(isclose(a + k, b, abs_tol=1e-9) for k, a, b in zip((1, 2, 3), found, place))


QUARTERS = (0, pi / 2, pi, -pi / 2)


@pytest.mark.parametrize("size", [3, 5, 6])
def test_a_pose_holds_for_its_joints_and_not_for_others(size: int) -> None:
    """The pose is that of an arm at quarter turns, whose numbers are exact."""
    rng = random.Random(size)
    for _ in range(4):
        chain = chain_of(rng, size)
        quarters = [rng.randrange(4) for _ in range(size)]
        joints = [QUARTERS[k] if turns else float(k) for k, turns in zip(quarters, chain.turns)]
        equations = ArmEquations.at_pose(chain, exact_pose(chain, quarters))
        assert all(abs(v) < 1e-9 for v in values(equations, chain, joints))
        for i in range(size):
            other = [q + (0.3 if k == i else 0.0) for k, q in enumerate(joints)]
            assert any(abs(v) > 1e-3 for v in values(equations, chain, other)), (quarters, i)


def exact_pose(chain: ArmChain, quarters: list[int]) -> Motion:
    from bezier.proofs.square_roots import ZERO, together, turn

    pose = chain.constants[0]
    for turns, k, constant_part in zip(chain.turns, quarters, chain.constants[1:], strict=False):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[k]
        angle = (Surd.rational(c), Surd.rational(s)) if turns else (Surd.rational(1), ZERO)
        joint = turn((0, 1), angle, (ZERO, ZERO, ZERO if turns else Surd.rational(k)))
        pose = together(together(pose, joint), constant_part)
    return pose


QUARTER = 'alpha = "pi/2"'
SLIDES = 'convention = "modified"\n' + "\n".join(
    f'[[row]]\njoint = "q{k}"\nkind = "prismatic"\n{body}'
    for k, body in enumerate(("", f'{QUARTER}\ntheta = "pi/2"', QUARTER))
)


def test_the_sentence_of_three_slides_is_true_by_elimination_too() -> None:
    """Nothing turns: the engine decides what the checker says, and that there is no second position."""
    certificate = inverse_certificate(solve(read_arm(SLIDES), (1, 2, 3)))
    claim = qe.certify.claims.claim_of(certificate)
    assert claim.equivalence is not None and claim.words[1:] == ("is true", "by joint positions")
    assert qe.decide(claim.equivalence[0], timeout=20) is True


CORNER = ArmEquations((("c1", "s1"),), (variable("c1"),))
"""One joint whose cosine is 0."""


@pytest.mark.parametrize("count", range(4))
def test_exactly_so_many(count: int) -> None:
    ring = ring_of([CORNER], count)
    sentence = with_roots(ring, [CORNER], CORNER.exactly(ring, count))
    assert qe.decide(sentence, timeout=60) is (count == 2)


HALF, ONE = Fraction(1, 2), Fraction(1)
EVERY = ArmEquations((("c1", "s1"),), ())
"""One joint, and nothing that is asked of it."""


@pytest.mark.parametrize("low", [(1, 0), (0, 1), (-1, 0), (0, -1), (3, 4)])
@pytest.mark.parametrize("high", [(1, 0), (0, 1), (-1, 0), (0, -1), (3, 4)])
def test_arcs_are_the_way_round_from_one_end_to_the_other(low: Any, high: Any) -> None:
    """With ends at quarter turns: which of the angles between belong to the arc."""
    from bezier.proofs.arm_sentences import _in_arc

    if low == high:
        return
    names = ("c", "s", "a", "b", "e", "f")
    ring = Ring.of(names)
    formula = _in_arc(ring, names[:2], names[2:4], names[4:])
    points = [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-5, 0), (-3, -4), (0, -5), (3, -4)]
    scale = {(3, 4): 1}
    a, b = (tuple(Fraction(x) for x in (p if p in scale else (5 * p[0], 5 * p[1]))) for p in (low, high))
    order = points.index(a)  # type: ignore[arg-type]
    until = (points.index(b) - order) % len(points)  # type: ignore[arg-type]
    for k, place in enumerate(points):
        at = dict(zip(names, (*map(Fraction, place), *a, *b), strict=True))
        assert substituted(formula, at) == (TRUE if (k - order) % len(points) <= until else FALSE), place


def test_boxes_of_free_joints_say_nothing() -> None:
    ring = ring_of([EVERY])
    assert EVERY.within(ring, [None]) == TRUE
    box = EVERY.within(ring, [((HALF, ONE), (Fraction(0), HALF))])
    inside = [
        (c, s)
        for c, s in product((Fraction(0), HALF, ONE), repeat=2)
        if substituted(conj((box,)), {"c1": c, "s1": s}) == TRUE
    ]
    assert inside == [(HALF, Fraction(0)), (HALF, HALF), (ONE, Fraction(0)), (ONE, HALF)]


def row(theta: Any, alpha: Any, joint: str | None = "prismatic") -> dict[str, Any]:
    return {"a": "0", "alpha": alpha, "d": "0", "theta": theta, "joint": joint}


ROWS = [row(0, 6), row(6, 6), row(0, 0)]
"""Three slides: the end point is (q3, -q2, q1)."""
LINE = [["0", "0", "0"], ["1", "2", "3"]]
NEXT = [["1", "2", "3"], ["1", "4", "3"]]


def piece(curve: int, low: str, high: str, centre: str, slope: str, radius: str = "1/10 1/10 1/10") -> dict[str, Any]:
    found: dict[str, Any] = {"curve": curve, "low": low, "high": high}
    return {**found, "centre": centre.split(), "slope": slope.split(), "radius": radius.split()}


WHOLE = piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1")
FIRST = piece(0, "0", "1/2", "3/4 -1/2 1/4", "3 -2 1")
SECOND = piece(0, "1/2", "1", "9/4 -3/2 3/4", "3 -2 1")
THIRD = piece(1, "0", "1", "3 -3 1", "0 -2 0")


def payload(*pieces: dict[str, Any], **changed: Any) -> Any:
    arm = {"convention": "standard", "rows": ROWS, **changed}
    return {"arm": arm, "curves": [LINE, NEXT], "limits": [None, None, None], "pieces": list(pieces)}


def objection(given: Any) -> str:
    try:
        check_branch(Entry(deepcopy(given), "payload"), limits())
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


@each(
    payload(WHOLE),
    payload(FIRST, SECOND),
    payload(FIRST, SECOND, THIRD),
    payload(SECOND, THIRD),
    payload(WHOLE, rows=[row(["1", "0"], ["0", "1"]), row(["0", "1"], 6), row(0, 0)]),  # the same angles as numbers
    payload(WHOLE, rows=[*ROWS[:2], row(12, 0, None), row(12, 0, None), row(0, 0)]),  # half a turn, and back
)
def test_a_slide_follows_lines(given: Any) -> None:
    assert objection(given) == ""


def test_the_modified_convention_turns_before_it_slides() -> None:
    """Links come first there: row i carries the alpha of the row before in the other convention."""
    rows = [row(0, 0), row(6, 6), row(0, 6)]
    assert objection(payload(WHOLE, rows=rows, convention="modified")) == ""
    assert objection(payload(WHOLE, rows=rows)) != ""
    assert objection(payload(WHOLE, convention="modified")) != ""


@each(
    (payload(piece(0, "0", "1", "8/5 -1 1/2", "3 -2 1")), "exactly one solution"),  # on the rim of the box
    (payload(piece(0, "0", "1", "2 -1 1/2", "3 -2 1")), "exactly one solution"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 2")), "exactly one solution"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1", "1/10 0 1/10")), "radii above 0"),
    (payload(piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1", "1/10 1/10")), "each of three joints"),
    (payload(piece(2, "0", "1", "3/2 -1 1/2", "3 -2 1")), "one of 2 curves"),
    (payload(piece(0, "1", "0", "3/2 -1 1/2", "3 -2 1")), "0 <= low < high <= 1"),
    (payload(piece(0, "0", "2", "3 -2 1", "3 -2 1")), "0 <= low < high <= 1"),
    (payload(FIRST, piece(0, "3/4", "1", "21/8 -7/4 7/8", "3 -2 1")), "where the one before ends"),
    (payload(SECOND, FIRST), "where the one before ends"),
    (payload(FIRST, THIRD), "where the one before ends"),
    (payload(THIRD, WHOLE), "where the one before ends"),
    (payload(), "at least one piece"),
    (payload(WHOLE, rows=ROWS[:2]), "three of them with a joint"),
    (payload(WHOLE, rows=[*ROWS, row(0, 0)]), "three of them with a joint"),
    (payload(WHOLE, rows=[*ROWS, *[row(0, 0, None)] * 40]), "at most 40 rows"),
    (payload(WHOLE, rows=[row(0, 6, "spherical"), *ROWS[1:]]), "null, revolute or prismatic"),
    (payload(WHOLE, convention="classic"), "modified or standard"),
    (payload(WHOLE, rows=[row(["1", "1"], 6), *ROWS[1:]]), "cosine and sine"),
    (payload(WHOLE, rows=[row(25, 6), *ROWS[1:]]), "twelfths of pi"),
    (payload(WHOLE, rows=[row(0, 0), row(0, 0), row(0, 0)]), "exactly one solution"),  # all slides along z
)
def test_what_is_no_branch(given: Any, reason: str) -> None:
    assert reason in objection(given)


def test_curves_that_do_not_meet_are_not_joined() -> None:
    given = payload(WHOLE, THIRD)
    assert objection(given) == ""
    given["curves"] = [LINE, [["1", "2", "4"], ["1", "4", "4"]]]
    assert objection(given)
    for curve in ([], [["0", "0"]], [["0", "0", "0"]] * 61):
        given["curves"] = [curve, NEXT]
        assert "points of three coordinates" in objection(given)


def test_a_turning_arm_has_two_solutions_and_a_piece_holds_one() -> None:
    """Two links of length 1 in a plane, and a slide: at distance sqrt 2 the elbow is at 90 degrees, on either side."""
    rows = [
        {"a": "1", "alpha": 0, "d": "0", "theta": 0, "joint": "revolute"},
        {"a": "1", "alpha": 0, "d": "0", "theta": 0, "joint": "revolute"},
        row(0, 0),
    ]
    still = [["1", "1", "0"], ["1", "1", "1"]]

    def given(*pieces: dict[str, Any]) -> Any:
        arm = {"convention": "standard", "rows": rows}
        return {"arm": arm, "curves": [still], "limits": [None] * 3, "pieces": list(pieces)}

    quarter = "15707963/10000000"
    down, up = f"0 {quarter} 1/2", f"{quarter} -{quarter} 1/2"
    for centre in (down, up):
        assert objection(given(piece(0, "0", "1", centre, "0 0 1"))) == ""
    assert objection(given(piece(0, "0", "1", down, "0 0 1", "2 2 1/10")))  # a box with both
    halves = [piece(0, "0", "1/2", f"0 {quarter} 1/4", "0 0 1"), piece(0, "1/2", "1", f"0 {quarter} 3/4", "0 0 1")]
    assert objection(given(*halves)) == ""
    other = piece(0, "1/2", "1", f"{quarter} -{quarter} 3/4", "0 0 1")
    assert "that of the piece before" in objection(given(halves[0], other))


TINY = Fraction(1, 10**12)


def slides(limits: list[Any], curve: list[list[str]], *pieces: dict[str, Any]) -> str:
    arm = {"convention": "standard", "rows": ROWS}
    return objection({"arm": arm, "curves": [curve], "limits": limits, "pieces": list(pieces)})


def test_limits_at_both_ends_are_kept() -> None:
    """The joints go from 0 to 3, -2 and 1: exactly the limits, and then a little less than they need."""
    whole = piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1")
    exact = [["0", "3"], ["-2", "0"], ["0", "1"]]
    assert slides(exact, LINE, whole) == ""
    for j in range(3):
        for k, less in ((0, TINY), (1, -TINY)):
            limits = json.loads(json.dumps(exact))
            limits[j][k] = str(Fraction(limits[j][k]) + less)
            assert f"joint {j + 1} is not proved" in slides(limits, LINE, whole)


def test_a_limit_that_is_touched_is_kept() -> None:
    """q3 = 2 s (1 - s) goes from 0 to 1/2 and back."""
    arch = [["0", "0", "0"], ["1", "0", "0"], ["0", "0", "0"]]
    halves = [
        piece(0, "0", "1/2", "0 0 3/8", "0 0 1", "1/10 1/10 3/10"),
        piece(0, "1/2", "1", "0 0 3/8", "0 0 -1", "1/10 1/10 3/10"),
    ]
    assert slides([None, None, ["0", "1/2"]], arch, *halves) == ""
    assert "joint 3" in slides([None, None, ["0", str(Fraction(1, 2) - TINY)]], arch, *halves)
    assert "joint 3" in slides([None, None, [str(TINY), "1/2"]], arch, *halves)
    whole = piece(0, "0", "1", "0 0 1/2", "0 0 0", "1/10 1/10 6/5")
    assert slides([None, None, ["-1", "1/2"]], arch, whole) == ""
    assert "joint 3" in slides([None, None, ["-1", "499/1000"]], arch, whole)


def test_a_joint_that_stands_at_its_limit_keeps_it() -> None:
    level, whole = [["0", "1", "0"], ["1", "1", "3"]], piece(0, "0", "1", "3/2 -1 1/2", "3 0 1")
    assert slides([None, ["-1", "0"], None], level, whole) == ""
    assert slides([None, ["-2", "-1"], None], level, whole) == ""
    assert "joint 2" in slides([None, [str(TINY - 1), "0"], None], level, whole)
    assert "joint 2" in slides([None, ["-2", str(-1 - TINY)], None], level, whole)


@each(
    ([None, None], "limits of 3 joints"),
    ([None] * 4, "limits of 3 joints"),
    ([None, None, ["1", "0"]], "a least value below"),
    ([None, None, ["0"]], "a least value below"),
    ([None, None, ["0", 1.5]], "limits[2][1]"),
    ([None, None, "01"], "expected a list"),
    ({}, "expected a list"),
    (None, "expected a list"),
)
def test_what_are_no_limits(limits: Any, reason: str) -> None:
    assert reason in slides(limits, LINE, piece(0, "0", "1", "3/2 -1 1/2", "3 -2 1"))


def test_altered_limits_are_rejected() -> None:
    """The lift touches 250 mm halfway; the angle, close to its limit, has boxes only."""
    arm = load_arm("cylindrical")
    found = joint_path(arm, {"c": Bezier.of([(20, -300, 100), (20, -200, 600), (21, -300, 100)])})
    (_, certificate), _ = certificates(found)
    assert verify(certificate).accepted

    def verdict(change: Any) -> Any:
        payload = evidence_of(certificate)
        change(payload)
        return verdict_by("joints along curves", payload)

    changes = [
        lambda p: p.pop("limits"),
        lambda p: p["limits"].pop(),
        lambda p: p["limits"][1].__setitem__(1, "249999999999/1000000000"),
        lambda p: p["limits"][1].__setitem__(0, "1/1000000000"),
        lambda p: p["limits"][2].__setitem__(1, "264"),
        lambda p: p["limits"][0].__setitem__(1, "0"),
        lambda p: p["limits"].reverse(),
        lambda p: p["arm"]["rows"][0].update(d="99"),
    ]
    for change in changes:
        given = verdict(change)
        assert not given.accepted and given.decided and given.step.startswith("payload"), given
