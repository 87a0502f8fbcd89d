"""Numbers that are large or close together, and strict conditions: what went wrong there."""

from __future__ import annotations

import json
import pickle
import random
from fractions import Fraction
from fractions import Fraction as F
from itertools import pairwise
from math import isqrt
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.certify.verify import verify_json
from qe.cli.app import main
from qe.errors import InputError, InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.balls import precision
from qe.exact.fibre_stack import isolate_over
from qe.exact.field import NumberField
from qe.exact.nearby import rational_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import FibreRoot, Point
from qe.formula.build import atom, exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Relation
from qe.kernel.arithmetic.sturm import count_roots_between
from tests.certificates.mutation import replaced
from tests.differential.generate import at_point
from tests.strategies import HUGE, close_roots
from tests.tables import each

LINE, PLANE = Ring.of(("x",)), Ring.of(("x", "y"))
REGIONS = {
    "(x-1000)^2 = 2/10^40 and y > x": 1,
    "(x-10^20)^2 = 2 and y > x": 1,
    "(x-10^20)^2 + (y-10^20)^2 <= 1": 2,
    "x = 10^25": 0,
    "x = 1/10^40 or x = 2/10^40": 0,
    "(x-1)*(x-1-1/10^30) <= 0": 1,
    "x = 3 and (y-1)*(10^12*(y-1)-1) = 0": 0,
    "x^3 = 10^41 or x^3 = 10^41 + 1": 0,
    "x^2 = 2 and (y-x)*(10^40*(y-x)-1) <= 0": 1,
}


@pytest.mark.parametrize("text", REGIONS)
def test_regions_at_large_or_close_numbers_crashed_and_their_verification_did_not_end(text: str) -> None:
    region = qe.region(text)
    assert region.dimension == REGIONS[text]
    assert str(qe.verify(region.certificate, timeout=120)) == "accepted"
    samples = region.sample_points()
    assert samples and all(region.contains(p) for p in samples)
    for name in region.order:
        interval = region.bounds(name)
        for point in samples:
            assert point[name] in interval
    assert str(region) and all(str(piece) for piece in region.cells)
    assert region.fibre()
    assert qe.Region.from_json(region.to_json()).dimension == region.dimension


def test_bounds_and_membership_tell_neighbours_apart() -> None:
    region = qe.region("(x-1)*(x-1-1/10^30) <= 0")
    one, small = Fraction(1), Fraction(1, 10**30)
    assert tuple(region.bounds("x")) == (one, one + small)
    assert region.contains({"x": one + small / 2}) and not region.contains({"x": one + 2 * small})
    assert not region.contains({"x": one - small / 10**30})
    low, high = qe.region("(x-10^20)^2 = 2").bounds("x")
    assert high - low == 2 * RealAlgebraic.from_root((-2, 0, 1), 1, 2)


@each(
    ("(x-1)*(x-1-1/10^30) <= 0", Fraction(1, 10**30), Fraction(1, 10**6)),
    ("x >= 10^25 and x <= 10^25 + 1", Fraction(1), Fraction(1, 10**6)),
    ("(x-10^20)^2 + (y-10^20)^2 <= 1", Fraction(314159265, 10**8), Fraction(1, 50)),
    ("(x-1)^2 + (y-1)^2 <= 1/10^60", Fraction(314159265, 10**68), Fraction(1, 50)),
)
def test_volumes_far_from_the_origin_were_lost_in_rounding(text: str, measure: Fraction, error: Fraction) -> None:
    low, high = qe.region(text).volume(float(error))
    assert low <= measure * (1 + Fraction(1, 10**8)) and measure * (1 - Fraction(1, 10**8)) <= high
    assert high - low <= error * high


def test_newton_stalled_in_the_checker_and_the_answer_was_lost() -> None:
    """A coordinate of 10^20 was enclosed with an absolute error; the sign at it was never decided."""
    text = (
        "ex y, x. 7*x + 2*a*y + (3/2)*a > 0 and -3*a*x - 3*a*y - 3 + 4*a /= 0"
        " and 7*a*x + 999999999996*a*y - a + 100000000000000000001 > 0"
    )
    answer = qe.eliminate(text, check=True, timeout=60)
    assert answer.truth is True and answer.guarantee is qe.Guarantee.CHECKED


def test_an_answer_was_lost_where_it_was_shortened_by_a_decomposition_with_large_numbers() -> None:
    """No rational number was found between two roots in a stack of the decomposition."""
    text = "-(10^40+3)*x - a*y + a + 999999999999 > 0 and a*x - 3*b*y + 4*b + 4 <= 0 and 2*x + 4*y + b <= 0"
    answer = qe.eliminate(f"ex y, x. {text}", timeout=60).formula
    assert answer is not None
    for a, b in ((0, -5), (0, 0), (3, -1), (-1, -2), (10**20, -(10**20)), (-(10**20), Fraction(1, 10**20))):
        point = {"a": Fraction(a), "b": Fraction(b)}
        expected = qe.decide(exists(("x", "y"), at_point(read_formula(text), point)))
        assert holds_at(answer, point) is expected


def test_sector_samples_between_roots_that_were_found_to_more_bits_than_asked() -> None:
    """The ends of their balls were rounded to fewer bits than the balls have: no rational number between them."""
    x, y = PLANE.gen(0), PLANE.gen(1)
    convergent = Fraction(1, 1)
    while abs(convergent**2 - 2) > Fraction(1, 10**39):  # x - p/q is tiny at sqrt(2): enclosing 1/(x - p/q) loses bits
        convergent = 1 + 1 / (1 + convergent)
    tiny = convergent.denominator * x - convergent.numerator
    point = Point.of(PLANE, [RealAlgebraic.from_root((-2, 0, 1), 1, 2)])
    for bits in range(40, 400, 7):
        first, second = tiny * y - 1, 2**bits * tiny * y - 2**bits - 1
        found = isolate_over(point, (first, second))
        assert sorted(s.members[0] for s in found.sections) == [0, 1]
        assert all(a < b for a, b in pairwise(found.samples))


def test_a_factor_of_a_norm_was_looked_for_at_the_precision_of_a_float() -> None:
    """Two factors were never told apart, so the precision of the balls grew for ever."""
    ring, x, y = PLANE, PLANE.gen(0), PLANE.gen(1)
    root = RealAlgebraic.from_root((-(10**40) - 3, 0, 0, 1), 0, 10**14)
    factors = ((y - x) * (10**30 * (y - x) - 1) * (y**2 - x), y**3 - 10**40 * x + 1)
    found = isolate_over(Point.of(ring, [root]), factors)
    values = [Point.of(ring, [root]).extend(s.value).number(1) for s in found.sections]
    assert len(values) == 5 and values == sorted(values)


def test_numbers_that_no_float_holds_were_a_crash_of_the_convex_methods() -> None:
    """They are proposed to a numerical method, which now declines; exact methods go on."""
    far = "x + y + z + u >= 10^400 and x^2 + y^2 + z^2 + u^2 <= 10^900"
    assert qe.decide(f"ex x, y, z, u. {far}") is True
    assert qe.minimize("x", "x >= 10^400").value == 10**400
    try:
        assert qe.minimize("x/10^400", "x >= 1 and x^2 <= 4").value == Fraction(1, 10**400)
    except qe.Unable as error:
        assert "numerical" in str(error) or "could" in str(error)


def test_a_minimum_inside_was_not_found_in_small_units() -> None:
    """Where a condition far from 1 sets the unit, the second derivatives of the objective counted as zero."""
    for unit in (Fraction(1, 10**9), Fraction(1, 10**20), Fraction(10**20)):
        u, v = f"(x - {3 * unit})^2", f"(y - {4 * unit})^2"
        least = qe.minimize(f"{u} + {v}", f"x^2 + y^2 <= {40 * unit**2} and x >= {-9 * unit}", method="convex")
        assert (least.value, least.certificate is not None) == (0, True)


def test_no_number_was_looked_for_between_ends_in_the_wrong_order_for_ever() -> None:
    root = RealAlgebraic.from_root((-2, 0, 1), 1, 2)
    for low, high in ((root, root), (Fraction(2), root), (Fraction(1), Fraction(1)), (root, Fraction(1))):
        with pytest.raises(InternalError):
            rational_between(low, high)
    assert Fraction(7, 5) < rational_between(Fraction(141421356, 10**8), root) < root


@given(st.integers(-3, 3), st.sampled_from(HUGE), st.integers(-1, 1))
def test_a_root_over_an_algebraic_point_is_compared_with_rationals_exactly(whole: int, big: int, side: int) -> None:
    """Also with itself: no precision tells a rational root from the rational number that it is."""
    x, y = PLANE.gen(0), PLANE.gen(1)
    point = Point.of(PLANE, [RealAlgebraic.from_root((-2, 0, 1), 1, 2)])
    f = (big * y - whole) * (y**2 - x - 20)
    found = isolate_over(point, (f,))
    values = [s.value for s in found.sections]
    assert len(values) == 3 and isinstance(values[1], FibreRoot)
    shifted = Fraction(whole, big) + Fraction(side, big**3)
    assert values[1].compare_rational(fmpq(shifted.numerator, shifted.denominator)) == -side
    assert values[0].compare_rational(fmpq(0)) == -1 and values[2].compare_rational(fmpq(0)) == 1


@settings(max_examples=40)
@given(close_roots(LINE), close_roots(LINE))
def test_stacks_of_close_roots_have_samples_between_them_and_pass_the_checker(f: Poly, g: Poly) -> None:
    found = isolate_over(Point(LINE), (f, g))
    numbers = [Point(LINE).extend(s.value).number(0) for s in found.sections]
    samples = list(found.samples)
    for low, number, high in zip(samples, numbers, samples[1:], strict=False):
        assert low < number < high
    for a, b in pairwise(numbers):
        assert a < rational_between(a, b) < b
    p, q = (h.to_univariate(0) for h in (f, g))
    ends = samples[0], samples[-1]
    assert count_roots_between(p, *ends) + count_roots_between(q, *ends) >= len(numbers)
    product = f * g if f != g else f
    region = qe.Region.of(atom(product, Relation.EQ))
    assert [p["x"] for p in region.sample_points()] == numbers
    assert qe.verify(region.certificate).accepted


@given(st.sampled_from(HUGE), st.integers(2, 9), st.integers(-3, 3), st.sampled_from((1, *HUGE)))
def test_numbers_are_compared_with_rationals_exactly_at_every_working_precision(
    big: int, d: int, near: int, scale: int
) -> None:
    square = d * scale
    root = RealAlgebraic.from_root((big * big - square, -2 * big, 1), big, big + square)  # big + sqrt(square)
    offset = isqrt(square) + near
    with precision(20):
        order = root.compare_rational(fmpq(big + offset))
    assert order == (1 if offset < 0 else (square > offset**2) - (square < offset**2))


@each("1e400", "9" * 5000, "1e-400")
def test_numbers_that_no_float_holds_are_printed(size: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Decimals for people overflowed, and Python writes no integer of more than 4300 digits unless it is asked to."""
    for command in (["minimize", "x", f"x >= {size}"], ["region", f"x = {size}"], ["solve", f"x > {size}"]):
        assert main(command) == 0
        told = capsys.readouterr()
        assert told.err == "" and "about 0 " not in told.out


@each(290, 400)
def test_dense_linear_conditions_with_numbers_that_no_float_holds(digits: int) -> None:
    """Multipliers of rows and the powers of two that these are divided by overflowed; the values of a solution with
    more than 4300 digits cannot be written in a certificate, and were no answer therefore."""
    rng, size = random.Random(5), 40
    names = [f"x{k}" for k in range(size)]

    def row(numbers: list[int], relation: str) -> str:
        return " + ".join(f"({c})*{x}" for c, x in zip(numbers, names, strict=True)) + relation

    rows = [[rng.randint(-9, 9) * 10**digits + rng.randint(-5, 5) for _ in names] for _ in names]
    bounds, weights = [rng.randint(-9, 9) for _ in rows], [rng.randint(1, 9) for _ in rows]
    total = [sum(w * c for w, c in zip(weights, column, strict=True)) for column in zip(*rows, strict=True)]
    limit = sum(w * b for w, b in zip(weights, bounds, strict=True))
    known = [row(numbers, f" <= {b}") for numbers, b in zip(rows, bounds, strict=True)]
    for relation, truth in ((">", False), (">=", True)):
        sentence = f"ex {', '.join(names)}. {' and '.join([*known, row(total, f' {relation} {limit}')])}"
        assert qe.eliminate(sentence, timeout=60).truth is truth


def test_a_picture_beyond_floating_point_is_refused() -> None:
    far = qe.region("x^2 + y^2 <= 1e800")
    with pytest.raises(qe.Unable, match="beyond floating point"):
        far.plot()
    assert far._repr_html_().startswith("<div><code>Region")


def test_the_name_of_a_file_that_cannot_be(capsys: pytest.CaptureFixture[str]) -> None:
    for option in ("--certificate", "--plot"):
        assert main(["region", "x > 0", option, "9" * 300]) == 2
        assert capsys.readouterr().err.count("\n") == 1


SQRT3 = RealAlgebraic.from_root((-3, 0, 1), 1, 2)


@each(
    # the strict conditions leave variables free that the objective does not have
    ("x", "x >= 0 and y > 0 and y < 1/4", "0", True),
    ("0*x", "x > 0 and x < 1/4", "0", True),
    ("x", "x >= 0 and y > 0 and y < 1/10^40", "0", True),
    ("x + y", "x + y >= 1 and x > 0 and y > 0", "1", True),
    ("x^2", "y > x and y < x + 1/1000 and z^2 <= y", "0", True),
    # on the rim of a strict condition
    ("x", "x > 0 and y > 0 and y < 1/4", "0", False),
    ("x", "x >= 0 and x >= y^2 and y > 0", "0", False),
    ("x + y", "x >= 0 and y >= 0 and x + y > 0", "0", False),
    ("x", "x >= y^2 and x >= z^2 and y > z", "0", False),
    ("y", "x^2 + y^2 <= 1 and (x - 1)^2 + y^2 <= 2 and x > 10^20*y + 10^20", "-1", False),
    # small sets, and sets far from the origin, ended in "unable"
    ("10^20*x", "(10^20*x - 1)^2 + y^2 <= 2 and y > x", "1 - sqrt(2)", True),
    ("x - 10^20", "(x - 10^20)^2 <= 2 and y > x", "-sqrt(2)", True),
    ("10^20*(x - 1000)", "(x - 1000)^2 <= 2/10^40 and y > x", "-sqrt(2)", True),
    ("10^20*(y - 1000)", "(x - 1000)^2 <= 2/10^40 and y > x", "-sqrt(2)", False),
)
def test_whether_an_infimum_is_attained(objective: str, constraints: str, value: str, attained: bool) -> None:
    found = qe.minimize(objective, constraints)
    assert (str(found.value), found.attained) == (value, attained) and qe.verify(found.certificate).accepted
    if attained and "sqrt" not in value:
        at = " and ".join(f"{name} = {number}" for name, number in found.point.items())
        assert qe.decide(f"ex {', '.join(found.point)}. {at} and {constraints}")


@each(
    "x >= 0 and x <= 0 and y > 0 and y < 0",
    "x < 0 and x >= 0",
    "x > 0 and x <= 0 and y^2 <= 2",
    "y >= x^2 and y <= 0 and x > 0",
    "x^2 + y^2 <= 3 and x + y <= z and z^2 <= w and w <= 0 and z > u and u > z",
    "x > 10^40 and x < 10^40",
)
def test_strict_conditions_that_leave_nothing_are_infeasible(constraints: str) -> None:
    found = qe.minimize("x", constraints)
    assert found.status.name == "INFEASIBLE" and qe.verify(found.certificate).accepted


def test_linear_problems_with_huge_numbers_do_not_end_in_unable() -> None:
    found = qe.maximize("x", "(10^40 + 1)*x + y <= 10^20 and y >= 1/10^40 and x > y")
    assert found.value == (10**20 - F(1, 10**40)) / (10**40 + 1) and found.attained
    with pytest.raises(Unable):  # and numbers beyond floats raise nothing else
        qe.minimize("x", f"10^400*x^2 + {10**399}*x*y + 10^400*y^2 <= 3 and 10^500*x >= y")


EVIDENCE, PLACE = ("payload", "steps", 0, "evidence"), "payload.steps[0].evidence"


def _claim(objective: str, constraints: str, **changes: Any) -> Any:
    whole = json.loads(qe.minimize(objective, constraints).certificate.to_json())
    return verify_json(replaced(whole, EVIDENCE, {**whole["payload"]["steps"][0]["evidence"], **changes}))


def test_a_certificate_that_says_not_attained_without_a_proof_is_rejected() -> None:
    """As written before such claims had to be proved: another optimal point than (0, 1/8), on the rim."""
    field = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
    inner = {"field": field, "point": [["1"], ["1/8"]]}
    rim = {"point": [["0"], ["0"]], "values": [["0"], ["0"], ["-1"]], "unique": False}
    verdict = _claim("x", "x >= 0 and y > 0 and 4*y < 1", **rim, attained=False, inner=inner)
    assert not verdict.accepted and verdict.step == f"{PLACE}.links" and "positive multiplier" in verdict.reason
    verdict = _claim("x", "x >= 0 and y > 0 and 4*y < 1", **rim)
    assert not verdict.accepted and verdict.step == f"{PLACE}.attained"


def test_closedness_and_membership_of_a_region_do_not_depend_on_what_was_read() -> None:
    region = qe.region("ex u. x^2 <= 3 and u > 0 and u < 1/1000")
    before = region.contains({"x": SQRT3}), region.bounds("x").upper_closed, region.fibre()[0].upper_closed
    assert str(region.formula) == "x^2 <= 3"
    after = region.contains({"x": SQRT3}), region.bounds("x").upper_closed, region.fibre()[0].upper_closed
    assert before == after == (True, True, True)


def test_a_fibre_over_many_digits_is_found_at_once() -> None:
    """Lattices of the schedule for short numbers took 11 s, then the decomposition had to answer."""
    region = qe.region("ex u. x^2 + y^2 + u^2 <= 2 and x + y >= u", process=False)
    over = F(-(7**85), 11**70)
    ((low, high),) = region.fibre([over])
    assert region._table is None  # no decomposition
    assert region.contains([over, rational_between(low, high)])


def test_a_fibre_of_one_point_is_closed() -> None:
    (fibre,) = qe.region("ex z. x >= 0 and x + y <= 0 and y >= 0 and z > 0 and z < 1/4").fibre([0])
    assert (fibre.lower, fibre.upper, fibre.lower_closed, fibre.upper_closed) == (0, 0, True, True)
    with pytest.raises(InputError, match="empty"):
        qe.region("ex z. x >= 0 and x + y <= 0 and y >= 0 and z > 0 and z < 0").bounds("x")


def test_several_irrational_coordinates_are_refused_before_and_after_reading_the_formula() -> None:
    region = qe.region("ex u. x^2 + y^2 + z^2 <= 9 and u >= x and u < x + 1")
    point = {"x": SQRT3, "y": SQRT3, "z": SQRT3}
    with pytest.raises(Unable, match="irrational"):
        region.contains(point)
    assert qe.region(region.formula).contains(point)
    with pytest.raises(Unable, match="irrational"):
        region.contains(point)


@each(("x + y", "x^2 + y^2 <= 3 and z > x"), ("x + y", "x^2 + y^2 < 3"), ("x", "x >= 1 and x <= 0"), ("x", "y > x"))
def test_an_optimum_is_the_same_after_pickling(objective: str, constraints: str) -> None:
    found = qe.minimize(objective, constraints)
    copy = pickle.loads(pickle.dumps(found))
    assert copy == found and str(copy.point) == str(found.point)
    assert qe.verify(copy.certificate).accepted
    assert len({id(v.field) for v in copy.point.values() if hasattr(v, "field")}) <= 1


def test_regions_fields_and_intervals_are_the_same_after_pickling() -> None:
    region = qe.region("ex u. x^2 + y^2 <= 3 and u > x and u < y + 4", timeout=60)
    copy = pickle.loads(pickle.dumps(region))
    assert copy.bounds("x") == region.bounds("x") == pickle.loads(pickle.dumps(region.bounds("x")))
    assert copy.formula == region.formula and pickle.loads(pickle.dumps(copy)).table == region.table
    field = NumberField(SQRT3)
    assert pickle.loads(pickle.dumps(field)) == field
