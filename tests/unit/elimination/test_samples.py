"""Points found by trials: they hold exactly, nothing is said where there is none, and bounds are implied ones."""

from fractions import Fraction
from itertools import combinations
from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.elimination.samples as samples
from experiments.suites.families import packing
from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.formula.block import Block
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Relation
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each

THREAD = (
    "ex p, P, q, Q, r, R, s, S. R*S - p*(1 - Q) <= -95000 and 0 < p and p < P and P < 1000000 and 0 < q and q < Q"
    " and Q < 1 and 1 < r and r < R and R < 1000 and 1 < s and s < S and S < 50 and (P-p)*(Q-q)*(R-r)*(S-s) > 50000"
)
"""After https://stackoverflow.com/questions/16487538."""
OPEN = "ex a, b, c, d. a*b > c^2 + 1 and c*d > 3 and a + b < 5 and (d^2 < a*b or a > 100)"
NONE = "ex a, b, c, d. a*b > 1 and a > 0 and b < 0 and c*d > a"


@each(THREAD, OPEN, packing(3, "0"), packing(5, "0"))
def test_a_point_of_an_open_set_is_found(text: str) -> None:
    answer = qe.eliminate(text, check=True, process=False)
    assert answer.truth and answer.witness is not None and not answer.unchecked_steps
    body = Block.of(read_formula(text)).positive  # type: ignore[union-attr]
    assert holds_at(body, {name: Fraction(str(value)) for name, value in answer.witness.items()})
    assert samples.find(body, Budget(work=2_000)) is not None


def test_where_there_is_none_nothing_is_said() -> None:
    assert samples.find(Block.of(read_formula(NONE)).positive, Budget()) is None  # type: ignore[union-attr]
    assert qe.decide(NONE, process=False) is False


def test_relaxation_beyond_floating_point_says_nothing() -> None:
    parts = [f"x^{9 + k}*y > z^{k} + 10^30*x" for k in range(4)]
    body = Block.of(read_formula(f"ex x, y, z. {' and '.join(parts)} and y < 0 and x > 10^40")).positive  # type: ignore[union-attr]
    assert samples.find(body, Budget()) is None


@each("ex x. x > a", "ex x. all y. x > y")
def test_other_problems_do_not_suit(text: str) -> None:
    problem = Block.of(read_formula(text))
    assert problem is not None and samples.SampledPoints().suits(problem, Options()) is None


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(-6, 6), min_size=4, max_size=4))
def test_nothing_is_amiss_where_all_holds_by_far(values: list[int]) -> None:
    """Conditions that count at a point are met there if the formula holds; near to being met, it may be otherwise."""
    body = Block.of(read_formula(OPEN)).positive  # type: ignore[union-attr]
    pulled, ring = samples.pulls(body), body.ring
    assert pulled is not None and ring is not None
    point = dict(zip("abcd", values, strict=True))
    at = [float(point.get(name, 0)) for name in ring.names]
    met = all(condition[0].relation is Relation.NE or not samples._amiss(condition, at)[0] for condition in pulled(at))
    assert met is holds_at(body, point)


HEXAGON = [f"x{k}^2 + y{k}^2 = 1" for k in range(6)]
APART = [f"(x{k} - x{m})^2 + (y{k} - y{m})^2 >= 1" for k, m in combinations(range(6), 2)]


def test_the_corners_of_a_hexagon() -> None:
    """Six points of the unit circle, two by two at a distance of 1 or more: all is tight, up to a turn."""
    found = qe.find_instance(" and ".join([*HEXAGON, *APART]), timeout=60)
    assert found is not None
    for k, m in combinations(range(6), 2):
        assert (found[f"x{k}"] - found[f"x{m}"]) ** 2 + (found[f"y{k}"] - found[f"y{m}"]) ** 2 >= 1


@each(
    "x*y + z*u = 3 and u*v = w + 1 and w*t > x and s^2 = t + z and x > 1 and y > 1 and v < 0",
    "x^3*y = 2 and (y*z > 40 and u + x = 1 or y < 0 and x > 5) and v*w*t = s + 1 and s > 3 and w < 0 and v != t",
)
def test_equations_are_solved_for_variables_of_their_own(text: str) -> None:
    answer = qe.eliminate("ex x, y, z, u, v, w, s, t. " + text, check=True, process=False)
    assert answer.truth and answer.witness is not None and not answer.unchecked_steps


@each("x^2 < {huge}", "{huge}*x + y > 1", "x^4000*y > 2")
def test_numbers_that_no_float_holds_were_a_crash(last: str) -> None:
    body = read_formula(f"x > 3 and y > x and x*y > {{huge}} and {last}".format(huge=10**400))
    assert samples.find(body, Budget()) is None


def test_bounds_follow_from_linear_conditions() -> None:
    body = read_formula("x > 0 and y > x and 2*y < 8 and z > 1 - y and x*z > 3 and (z < 0 or z > 5)")
    ring = body.ring
    assert ring is not None
    box = samples.bounds(body, len(ring.names))
    assert [box[ring.index[name]] for name in "xyz"] == [(0, 4), (0, 4), (-3, inf)]


def test_a_point_that_does_not_hold_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(samples, "holds_at", lambda body, point: True)
    monkeypatch.setattr(samples, "relaxed", lambda *args: True)
    log, problem = RunLog(), Block.of(read_formula(NONE))
    assert problem is not None
    samples.SampledPoints().run(problem, Context(Options(), Budget(), log))
    (step,) = log.steps()
    assert not accepted(step)


BEYOND = (
    ("ex a, b, c, d. a > 10^200 and b > 10^200 and a^2*b*c*d > 1 and a*b + c*d < 3", False),
    ("ex a, b, c, d. 10^400*a > b and a^2*b*c*d > 1 and a*b + c*d < 3", True),
    ("ex a, b, c, d. a > 1 and a^60*b^50*c*d > 1 and a*b + c*d < -3 and c^300 > 5", True),
)


@each(*BEYOND)
def test_numbers_beyond_floating_point_are_no_error(text: str, truth: bool) -> None:
    """They ended in an ``OverflowError``."""
    assert qe.decide(text, process=False) is truth
