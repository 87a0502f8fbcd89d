"""Bounded fibres, disjuncts, convexity: what critical-value elimination checks before it works."""

import pytest

import qe
from qe.elimination.critical.boundary import critical_hypersurfaces
from qe.elimination.critical.bounded import has_bounded_fibres
from qe.elimination.critical.system import System, systems
from qe.errors import Unable
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.normal import nnf
from qe.io import formats
from qe.options import Budget
from tests.tables import each


def parts(text: str, free: tuple[str, ...], bound: tuple[str, ...]) -> list[System]:
    ring = Ring.of((*free, *bound))
    return systems(convert(nnf(formats.read(text, "text")), ring), ring, len(free))


def only(text: str, free: tuple[str, ...], bound: tuple[str, ...]) -> System:
    (part,) = parts(text, free, bound)
    return part


@each(
    "y^2 + z^2 <= p",
    "(y - p)^2 + y*z + z^2 < p^4",
    "y >= p and y <= 2*p + 1 and z^2 <= 3",
    "y^2 <= 1 and z^3 = y + p",
    "y^4 + p*y <= 1 and z >= y and 2*z <= y^2",
    "y^2 + p*y <= 1 and z^2 <= p",
    "y + z = p and y^2 <= p",
    "y^2 + z <= p and z >= p",
    "y^4 - 2*z + p*y <= 1 and z <= 3",
)
def test_bounded(text: str) -> None:
    assert has_bounded_fibres(only(text, ("p",), ("y", "z")))


@each(
    "y^2 - z^2 <= p",
    "y^2 <= 1 and z >= p",
    "y^2 <= 1 and p*z^2 <= 1",
    "y*z = 1 and y^2 <= 1",
    "y^2 + 2*y*z + z^2 <= 1",
    "y^2 <= p and z = z^2 + y - z^2 + z",
    "y^3 <= p and z^2 <= 1",
    "y^2 + z <= p and z <= p",
    "y^2 + p*z <= 1 and z >= p",
    "y >= 0 and z >= 0 and z <= y^2 and y <= z + 1",  # z = y^2: a lower bound of y is none of -y^2
    "y >= 0 and z >= 0 and z + p*y <= 0 and y <= z + 1",  # p may be negative
)
def test_not_seen_to_be_bounded(text: str) -> None:
    assert not has_bounded_fibres(only(text, ("p",), ("y", "z")))


def test_disjuncts_and_disequations() -> None:
    found = parts("(y /= 0 or y = p) and y^2 <= 1 and p /= 2", ("p",), ("y",))
    assert len(found) == 3
    assert all(len(part.guards) == 1 for part in found)
    with pytest.raises(Unable, match="disjuncts"):
        parts(" and ".join(f"(y = {k} or y = p + {k})" for k in range(6)), ("p",), ("y",))


def test_shapes_of_truth_sets() -> None:
    closed = only("y^2 + (p - y)^2 <= 1 and p <= y", ("p",), ("y",))
    assert closed.is_convex and closed.is_closed and not closed.is_open
    opened = only("y^2 < 1 and p*y > 2", ("p",), ("y",))
    assert opened.is_open and not opened.is_convex and not opened.is_closed
    assert not only("y^2 <= 1 and p^2 >= 1", ("p",), ("y",)).is_convex
    assert only("y^2 <= 1 and p + y = 1", ("p",), ("y",)).is_convex
    assert not only("y^2 <= 1 and p /= 0", ("p",), ("y",)).is_convex


def surfaces(text: str, free: tuple[str, ...], bound: tuple[str, ...]) -> set[str]:
    found = critical_hypersurfaces(only(text, free, bound), thin_parts=False, budget=Budget())
    return {str(f)[5:-1] for f in found}


@each(
    ("y^2 + p*y + q <= 0", {"-p^2 + 4*q"}),  # one condition: its discriminant
    ("y^2 <= p and y >= q", {"p", "q^2 - p"}),  # and where both are equations: their resultant
    ("p*y + q <= 0 and y^2 <= 1", {"p", "p + q", "-p + q"}),  # a slope that vanishes
)
def test_one_variable(text: str, expected: set[str]) -> None:
    assert surfaces(text, ("p", "q"), ("y",)) == expected


def test_two_circles_touch_at_sum_and_difference_of_radii() -> None:
    found = surfaces("y^2 + z^2 <= 1 and (y - p)^2 + (z - q)^2 <= 4", ("p", "q"), ("y", "z"))
    assert found == {"p^2 + q^2 - 9", "p^2 + q^2 - 1"}


def test_circle_and_line() -> None:
    assert surfaces("y^2 + z^2 <= 1 and y + z >= p", ("p",), ("y", "z")) == {"p^2 - 2"}


def test_guards_are_boundaries() -> None:
    assert "p^2 + q - 3" in surfaces("p^2 + q <= 3 and y^2 <= p", ("p", "q"), ("y",))


def test_constant_critical_points_are_refused() -> None:
    with pytest.raises(qe.Unable, match="over all of parameter space"):
        surfaces("y <= 1 and z <= 1 and y + z >= 2 and y >= p and z >= p", ("p",), ("y", "z"))
    with pytest.raises(qe.Unable, match="over all of parameter space"):
        surfaces("y^2 + z^2 <= 1 and (y - 2)^2 + z^2 <= 1 and y >= p", ("p",), ("y", "z"))


def test_constant_conditions_that_cannot_balance() -> None:
    # a circle inside another one, touching it, and a tangent: gradients on one side
    found = surfaces("y^2 + z^2 <= 4 and (y - 1)^2 + z^2 <= 1 and y <= 2 and y + z >= p", ("p",), ("y", "z"))
    assert "p^2 - 8" in found and "p^2 - 2*p - 1" in found
