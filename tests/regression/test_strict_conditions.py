"""Wrong claims about strict conditions: attained or not, closed or open, empty or not; named by symptom."""

from __future__ import annotations

import json
import pickle
from fractions import Fraction as F
from typing import Any

import pytest

import qe
from qe.certify.verify import verify_json
from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import NumberField
from tests.certificates.mutation import replaced
from tests.tables import each

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
    assert not verdict.accepted and verdict.step == f"{PLACE}.attained" and "not proved" in verdict.reason
    verdict = _claim("x", "x >= 0 and y > 0 and 4*y < 1", **rim)
    assert not verdict.accepted and verdict.step == f"{PLACE}.attained"


def test_closedness_and_membership_of_a_region_do_not_depend_on_what_was_read() -> None:
    region = qe.region("ex u. x^2 <= 3 and u > 0 and u < 1/1000")
    before = region.contains({"x": SQRT3}), region.bounds("x").upper_closed, region.fibre()[0].upper_closed
    assert str(region.formula) == "x^2 - 3 <= 0"
    after = region.contains({"x": SQRT3}), region.bounds("x").upper_closed, region.fibre()[0].upper_closed
    assert before == after == (True, True, True)


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
