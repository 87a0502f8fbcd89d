"""Comparisons with roots, in numbers of roots: exactly one formula for each relation and side."""

from __future__ import annotations

from qe.expert.roots_counted import MOST_ROOTS, check_roots_counted
from tests.tables import each
from tests.unit.certify.claims import objection

ENOUGH = "(ex y, z. y^2 = a and z^2 = a and y < z)"


def before(*sides: str) -> str:
    """That so many ascending roots stand on these sides of x."""
    return f"(ex y, z. y^2 = a and z^2 = a and y < z and y {sides[0]} x and z {sides[1]} x)"


def meanings(past: str, reached: str) -> dict[str, str]:
    """``past``: two roots beyond x on the side that is counted from, ``reached``: there or on x."""
    return {
        "far": past,
        "far=": reached,
        "=": f"{reached} and not {past}",
        "near": f"{ENOUGH} and not {reached}",
        "near=": f"{ENOUGH} and not {past}",
        "/=": f"{past} or ({ENOUGH} and not {reached})",
    }


FROM_BELOW = {"far": ">", "far=": ">=", "near": "<", "near=": "<="}
FROM_ABOVE = {"far": "<", "far=": "<=", "near": ">", "near=": ">="}


@each(
    (2, FROM_BELOW, meanings(before("<", "<"), before("<=", "<="))),
    (-2, FROM_ABOVE, meanings(before(">", ">"), before(">=", ">="))),
)
def test_each_relation_has_its_own_formula(k: int, names: dict[str, str], said: dict[str, str]) -> None:
    for place in said:
        atom = f"x {names.get(place, place)} root({k}, x^2 - a, x)"
        for other, meaning in said.items():
            assert (objection(check_roots_counted, atom, meaning) == "") is (other == place), (place, other)


def test_a_polynomial_that_may_vanish_has_no_roots_then() -> None:
    atom, root = "x > root(1, b*x - a, x)", "(ex y. b*y - a = 0 and y < x)"
    assert objection(check_roots_counted, atom, f"{root} and (a /= 0 or b /= 0)") == ""
    assert objection(check_roots_counted, atom, root) != ""
    assert objection(check_roots_counted, atom, f"{root} and b /= 0") != ""


def test_everything_else_stays() -> None:
    root = "(ex y. y - a = 0 and y < x)"
    linear = "x > root(1, x - a, x)"
    assert objection(check_roots_counted, f"c > 0 and not {linear}", f"c > 0 and not {root}") == ""
    assert objection(check_roots_counted, "c > 0", "c > 0") == ""
    assert objection(check_roots_counted, "c > 0", "c >= 0") != ""
    assert objection(check_roots_counted, "c > 0", "c > 0", {"theory": 1}) != ""


def test_the_number_of_roots_is_limited() -> None:
    many = f"x > root({MOST_ROOTS + 1}, (x + a)^30 - b, x)"
    assert f"more than {MOST_ROOTS} roots" in objection(check_roots_counted, many, "true")
    assert "more than" not in objection(check_roots_counted, f"x > root({-MOST_ROOTS}, (x + a)^30 - b, x)", "true")
