"""Variables that one comparison of degree 2 looks at: what stands in their place, and their values."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.io.text import read
from qe.rules.lift import holds_at
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.unit.rules.applied import steps_of

CYLINDER = "ex x, y, z. x^2 + y^2 <= 1 and (x - a)^2 + (y - b)^2 + (z - c)^2 {} r^2"


@pytest.mark.parametrize(
    ("text", "count"),
    [
        *((CYLINDER.format(relation), 1) for relation in ("<=", "<", "=")),
        *((CYLINDER.format(relation), 0) for relation in (">=", ">", "/=")),  # values that are taken
        (CYLINDER.format(">").replace("+ (z - c)^2", "- (z - c)^2"), 1),
        (CYLINDER.format("<") + " and z > a", 0),
        (CYLINDER.format("<").replace("(z - c)", "(z - x)"), 0),  # the degree would grow
        (CYLINDER.format("<").replace("(z - c)^2", "a*z^2"), 0),
        (CYLINDER.format("<").replace("(z - c)^2", "z^4"), 0),
        ("ex x, y. x^2 + a*x < b and y^3 > x", 0),
        ("ex x, y, u, v. x^2 + u^2 = a and y^2 + v^2 = b and x*y > 1", 2),
    ],
)
def test_where_it_applies(text: str, count: int) -> None:
    steps = steps_of(text, StepKind.SQUARE_ALONE)
    assert len(steps) == count and all(map(accepted, steps))


def test_a_ball_meets_a_cylinder() -> None:
    """It was 317 characters without the rule."""
    found = qe.eliminate(CYLINDER.format("<=") + " and r > 0").formula
    assert qe.decide(f"all a, b, r. ({found}) <-> r > 0 and a^2 + b^2 <= (1 + r)^2") and len(str(found)) < 80


@settings(max_examples=30, deadline=None)
@given(st.lists(st.integers(-3, 3), min_size=5, max_size=5), st.sampled_from(("=", "<", "<=")))
def test_values_come_back(k: list[int], relation: str) -> None:
    """A variable that is gone gets a value, in sentences with and without solutions."""
    body = f"{abs(k[0]) + 1}*z^2 + {k[1]}*z + x*y + {k[2]}*x {relation} {k[3]} and x^2 + y^2 <= 2 and y >= {k[4]}"
    (step,) = steps_of(f"ex x, y, z. {body}", StepKind.SQUARE_ALONE)
    assert accepted(step)
    answer = qe.eliminate(f"ex x, y, z. {body}", process=False)
    other = qe.eliminate(f"ex x, y, z. {body}", process=False, without="values")
    assert answer.truth is other.truth
    assert not answer.truth or (answer.witness is not None and holds_at(read(body), answer.witness))  # type: ignore[arg-type]
