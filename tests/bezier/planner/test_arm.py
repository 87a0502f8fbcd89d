"""The true reachable set of an arm as the workspace of a plan."""

from __future__ import annotations

import pytest

from bezier.planner.arm import check_arm
from bezier.planner.planning import make_plan
from bezier.plans import Outcome
from bezier.problem import from_json, read_problem, to_json
from qe.errors import InputError
from tests.tables import each

TEXT = """method = "cubic"
workspace = "reachable"
arm = "ev3"
start = [-150, 60, 40]
via = [[-60, 200, 240], [60, 200, 240]]
goal = [150, 60, 300]
"""


def test_the_ball_that_holds_what_is_reached() -> None:
    """sqrt(a^2 + c^2) + R = 434.4 mm for the EV3."""
    found = check_arm(read_problem(TEXT))
    assert found.workspace.radius_squared == 435**2 and not found.radius_is_auto
    assert check_arm(read_problem(TEXT + "radius = 350\n")).workspace.radius_squared == 350**2
    again = from_json(to_json(found), "stored")
    assert (again.workspace, again.arm) == (found.workspace, found.arm)


def test_points_are_reached() -> None:
    """The hemisphere of the paper ends at 258 mm; above the arm there is more, and below its base less."""
    for point in ("[60, 200, 1000]", "[420, 200, 240]"):
        with pytest.raises(InputError, match=r"via\[1\]: a point that EV3, last link 120 mm reaches"):
            check_arm(read_problem(TEXT.replace("[60, 200, 240]", point)))


@each(
    (TEXT.replace('arm = "ev3"\n', ""), "an arm with the true reachable set"),
    (TEXT.replace('"ev3"', '"six-joints"'), "three joints"),
    (TEXT.replace('"ev3"', '"shoulder-3r"'), "reaches expected"),
    (TEXT.replace('"ev3"', '"planar-3r"'), "reaches expected"),
    (TEXT.replace('"ev3"', '"nobody"'), "arm: expected a file"),
)
def test_what_does_not_fit(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        check_arm(read_problem(text))
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.deep
def test_a_plan_beyond_the_hemisphere() -> None:
    found = make_plan(read_problem(TEXT))
    assert found.outcome is Outcome.SOLVED
    assert found.joints is not None and found.joints.path.is_reachable
