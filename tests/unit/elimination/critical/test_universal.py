"""Universal blocks with a convex truth set: the formula by critical values against direct decisions at points."""

import functools
from fractions import Fraction

import pytest
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.elimination.critical.block import Tabulated
from qe.elimination.critical.method import ConvexUniversal
from qe.elimination.critical.universal import eliminate_universal
from qe.elimination.protocol import Context
from qe.formula.block import Block
from qe.formula.build import forall, neg
from qe.formula.evaluate import holds_at, substituted
from qe.formula.normal import nnf
from qe.formula.syntax import ForAll, Formula
from qe.options import Budget, Method, Options
from qe.proof.run_log import RunLog
from tests.enough import enough
from tests.tables import each

ASKED = Options(method=Method.CRITICAL)


def block(text: str) -> ForAll:
    formula = read_formula(text)
    assert isinstance(formula, ForAll)
    return formula


@functools.cache
def by_critical_values(text: str) -> Formula | None:
    return tried(block(text), 60)


def tried(formula: ForAll, seconds: float) -> Formula | None:
    found = ConvexUniversal().run(
        Block(formula.variables, formula.body, True), Context(ASKED, Budget(seconds), RunLog())
    )
    return None if found is None else found.formula


def agree(text: str, answer: Formula, points: list[dict[str, Fraction]]) -> set[bool]:
    """The truth values met; every one decided anew with the numbers put in."""
    seen = set()
    formula = block(text)
    for point in points:
        direct = qe.decide(forall(formula.variables, substituted(formula.body, point)))
        assert holds_at(answer, point) is direct, point
        seen.add(direct)
    return seen


GRID = [{"x": Fraction(i, 4), "y": Fraction(j, 4)} for i in range(-9, 10, 4) for j in range(-9, 10, 4)]
DISCS = "all t. 0 <= t and t <= 1 -> (x - t)^2 + (y - t^2)^2 <= 2"


def test_a_family_of_discs() -> None:
    answer = by_critical_values(DISCS)
    assert answer is not None
    edge = [
        {"x": Fraction(0), "y": Fraction(0)},
        {"x": Fraction(1), "y": Fraction(0)},
        {"x": Fraction(1), "y": Fraction(1)},
    ]
    assert agree(DISCS, answer, GRID + edge) == {True, False}


def test_it_is_chosen_without_being_asked_for() -> None:
    answer = qe.eliminate(DISCS)
    assert answer.stats["critical"][0]["disjuncts"][0]["universal"] == 1
    assert qe.equivalent(answer.formula, by_critical_values(DISCS))


@each(
    "all t. 0 <= t and t <= 1 -> x + y*t <= t^3",  # half-planes: an unbounded set
    "all t. 0 <= t and t < 1 -> (1 - t)*(x^2 + y^2 - 1 - t) <= 0",  # a factor of the domain
    "all t. t^2 <= 1 -> t^4*x^2 + t*y <= 1 and y^2 <= 2 + t",  # semidefinite only
)
def test_other_convex_sets(text: str) -> None:
    answer = by_critical_values(text)
    assert answer is not None and agree(text, answer, GRID) == {True, False}


@each(
    "all t. 0 <= t and t <= 1 -> x^2 + t >= y",  # not convex
    "all t. 0 <= t and t <= 1 -> x*y + t <= 1",  # indefinite
    "all t. x^2 + y*t - t^4 <= 0",  # t is not bounded
    "all t. 0 <= t and t <= 1 -> t*x^2 + (t - 1/2)*y^2 <= 1",  # not convex for small t
    "all t. 0 <= t and t <= 1 and t <= x -> t^3 <= y",  # the domain depends on a parameter
)
def test_what_is_not_seen_to_be_convex_is_left_to_others(text: str) -> None:
    assert by_critical_values(text) is None


coefficients = st.integers(-2, 2)


@each(
    ("all t. 0 <= t and t <= 1 -> x^2 + y^2 + t^3 <= t - 1", "false"),
    ("all t. 0 <= t and t < 1 -> t^3*x <= 0 and -t^3*x <= 0 and y^2 <= 1 + t^3", "x = 0 and y^2 <= 1"),
    ("all t. 0 <= t and t <= 1 -> x^2 + (y - t^3)^2 <= 1/4", "x = 0 and y = 1/2"),
    ("all t. t^2 <= 1 -> x >= t^3 and y >= t and x + y <= 2", "x = 1 and y = 1"),
)
def test_sets_without_interior_points(text: str, expected: str) -> None:
    """Nothing, or part of a line; found only where conditions at a few t, or the bounds, already say so."""
    answer = qe.eliminate(text, timeout=60)
    assert qe.equivalent(answer.formula, expected)


family = st.tuples(st.lists(coefficients, min_size=8, max_size=8), st.integers(1, 6), st.integers(1, 2))


def examine(given_family: tuple[list[int], int, int], seconds: float) -> bool:
    """|a(t) + b(t) (x, y)|^2 <= s on [0, 1] is convex in (x, y) whatever a and b are. Whether that was decided."""
    (a, b, e, f, g, h, i, j), square, degree = given_family
    text = (
        f"all t. 0 <= t and t <= 1 -> ({a} + {b}*t + ({e} + {f}*t^{degree})*x)^2"
        f" + ({g} + {h}*t + ({i} + {j}*t)*y)^2 <= {square}"
    )
    if not isinstance(formula := read_formula(text), ForAll):
        return False
    try:
        answer = tried(formula, seconds)
    except qe.Unable:
        return False
    if answer is not None:
        agree(text, answer, GRID[::5])
    return answer is not None


@enough(1, 6, family)
def test_random_families_of_discs(chosen: tuple[list[int], int, int]) -> bool:
    return examine(chosen, 1)


@pytest.mark.deep
@enough(30, 150, family)
def test_many_random_families_of_discs(chosen: tuple[list[int], int, int]) -> bool:
    return examine(chosen, 20)


def test_curves_that_meet_once_over_a_point_of_high_degree() -> None:
    """The common root over a simple root of the resultant is known without arithmetic in its field."""
    from qe.exact.algebraic import real_roots
    from qe.exact.fibre_stack import isolate_over
    from qe.exact.ring import Ring
    from qe.exact.sample import Point

    ring = Ring.of(("x", "y"))
    x, y = ring.gen(0), ring.gen(1)
    f = y**4 - x * y + 3 * x**3 - 2
    g = y**3 + x**2 * y - 5 * x + 1
    resultant = f.resultant(g, 1)
    assert len(resultant.factors()[1]) == 1 and resultant.total_degree == 11
    for root in real_roots(resultant.to_univariate(0)):
        stack = isolate_over(Point(ring).extend(root), (f, g))
        meeting = [s for s in stack.sections if s.members == [0, 1]]
        assert len(meeting) == 1, "one common root over a simple root of the resultant"
        others = [s for s in stack.sections if s.members != [0, 1]]
        assert len(others) == len(stack.sections) - 1
    assert real_roots(resultant.to_univariate(0))


def asked(text: str, *parameters: str) -> tuple[tuple[str, ...], Formula, tuple[str, ...]]:
    """The variables, the negated body and the parameters, as the functions below take them."""
    given = block(text)
    return given.variables, nnf(neg(given.body)), parameters


def test_the_set_itself() -> None:
    budget = Budget(60)
    found = eliminate_universal(*asked(DISCS, "x", "y"), budget=budget)
    assert found is not None and isinstance(found.found, Tabulated) and found.stats["universal"] == 1
    assert not found.found.unsettled
    dents = "all t. 0 <= t and t <= 1 -> (x - t)^2 + (y - t^2)^2 >= 2"
    assert eliminate_universal(*asked(dents, "x", "y"), budget=budget) is None
