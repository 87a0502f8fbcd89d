"""The choice of the next variable and of its elimination set."""

from qe.elimination.vs.plan import Plan, choose, occurring, split_equation
from qe.elimination.vs.points import Infinity, LinearRoot
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.io.text import read
from tests.tables import each

RING = Ring.of("abcxyz")


def over(text: str) -> Formula:
    return convert(read(text), RING)


def plan(text: str, block: str = "x", *, strict: bool = False) -> Plan | None:
    return choose(over(text), frozenset(RING.index[v] for v in block), strict=strict)


def test_which_variables_occur() -> None:
    names = {RING.names[i] for i in occurring(over("a*x > 0 and (b = 1 or x < root(1, x^2 - c))"))}
    assert names == {"a", "b", "c", "x"} and occurring(TRUE) == frozenset()
    assert occurring(over("a*b = 1")) == {0, 1}


def test_an_equation_gives_all_points() -> None:
    found = plan("2*x = a and x^2 < b")
    assert found is not None and len(found.candidates) == 1 and found.infinities == () and found.degenerate == FALSE


def test_an_equation_that_may_vanish_leaves_a_problem() -> None:
    found = plan("a*x = b and x^2 < c")
    assert found is not None and found.infinities == () and found.degenerate != FALSE
    assert str(found.degenerate) in ("a = 0 and b = 0 and c - x^2 > 0", "a = 0 and b = 0 and c > x^2")


@each(("x > a and x > b and x < c", 1, 1), ("x < a and x < b and x > c", -1, 1))
def test_the_side_with_fewer_bounds(text: str, side: int, count: int) -> None:
    found = plan(text)
    assert found is not None and len(found.candidates) == count and found.infinities == (Infinity(side),)
    assert isinstance(found.candidates[0].point, LinearRoot) and found.candidates[0].point.epsilon == -side


def test_degree_shift() -> None:
    found = plan("x^4 > a and x^4 < b")
    assert found is not None and found.exponent == 4 and "x >= 0" in str(found.formula)
    strict = plan("x^4 > a and x^4 < b", strict=True)
    assert strict is not None and "x > 0" in str(strict.formula)
    odd = plan("x^3 > a and x^3 < b")
    assert odd is not None and odd.exponent == 3 and str(odd.formula) == "a < x and b > x"
    assert (found := plan("x > a and x < b")) is not None and found.exponent == 1


def test_high_degrees_and_root_atoms_are_left() -> None:
    assert plan("x^5 + x > a") is None
    assert plan("x < root(1, x^2 - a) and x > b") is None
    found = plan("x^5 + x > y and y > a", "xy")
    assert found is not None and RING.names[found.x] == "y"


def test_the_cheapest_variable() -> None:
    found = plan("x^2 + y*x > a and y < b and x*y > c and z = x + y", "xyz")
    assert found is not None and RING.names[found.x] == "z"


def test_equations_that_factor() -> None:
    found = split_equation(over("x*(x - a) = 0 and b > 0"), frozenset({3}))
    assert found is not None and {str(f) for f in found} == {"x = 0 and b > 0", "a = x and b > 0"}
    assert split_equation(over("x*(x - a) = 0 and b > 0"), frozenset({4})) is None
    assert split_equation(over("x*(x - a) > 0 and x + a = 0"), frozenset({3})) is None
