"""Systems of equations over points: remainders, zeros, and what is watched meanwhile."""

import pickle
from collections.abc import Callable
from fractions import Fraction
from fractions import Fraction as F

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.decomposition.decompose import decompose
from qe.decomposition.lifting import Lifter
from qe.errors import BudgetExceeded
from qe.exact import watch
from qe.exact.algebraic import real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.field import NumberField
from qe.exact.kkt_system import Flat, HighDegree, critical_point, cut_linear_combinations
from qe.exact.lattice_recognition import FieldLattice, algebraic_candidate, element_candidate
from qe.exact.quadratic_form import Quadratic, quadratic
from qe.exact.remainder import common_coefficients, squarefree_coefficients
from qe.exact.ring import Poly, Ring
from qe.exact.sample import FibreRoot, Point
from qe.exact.watch import Watch, watched_product
from qe.io.text import read
from qe.options import Budget
from tests.strategies import polynomials
from tests.tables import each

# Critical points on intersections of quadrics, and recognition of algebraic numbers from digits.

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))


def _form(poly) -> Quadratic:
    form = quadratic(poly, range(3))
    assert form is not None
    return form


@settings(max_examples=30)
@given(st.lists(st.integers(-30, 30), min_size=2, max_size=7).filter(lambda c: c[-1]))
def test_roots_are_recognised_from_their_digits(coefficients) -> None:
    ring = Ring.of(("t",))
    p = ring.from_terms({(i,): c for i, c in enumerate(coefficients)}).to_univariate(0)
    for root in real_roots(p):
        found = algebraic_candidate(lambda bits, r=root: r.ball(bits + 64), 8, 800)
        assert found == root


@settings(max_examples=20)
@given(st.lists(st.fractions(-9, 9, max_denominator=9), min_size=5, max_size=5))
def test_elements_are_recognised_from_their_digits(coefficients) -> None:
    field = NumberField.from_root([-1, -1, 0, 0, 0, 1], 1, 2)
    element = field.element(coefficients)
    assert element_candidate(FieldLattice(field), lambda bits: element.ball(bits + 64)) == element


def test_two_spheres_and_their_radical_plane() -> None:
    spheres = [_form(X * X + Y * Y + Z * Z - 4), _form((X - 1) * (X - 1) + Y * Y + Z * Z - 4)]
    reduced = cut_linear_combinations(Flat.whole(3), spheres)
    assert reduced is not None
    flat, rest = reduced
    assert len(flat.basis) == 2 and len(rest) == 1 and flat.origin[0] == F(1, 2)
    assert cut_linear_combinations(Flat.whole(3), [spheres[0], _form(X * X + Y * Y + Z * Z - 5)]) is None
    doubled = _form(2 * X * X + 2 * Y * Y + 2 * Z * Z - 8)
    assert cut_linear_combinations(Flat.whole(3), [spheres[0], doubled]) is not None


def _on_a_circle(**options: int):
    sphere, plane = _form(X * X + Y * Y + Z * Z - 4), _form(2 * X - 1)
    return critical_point(_form(Y + 2 * Z), [sphere, plane], [0.5, -0.87, -1.73], **options)


def test_critical_point_is_exact() -> None:
    found = _on_a_circle()
    assert found is not None
    field, point = found
    assert field.degree == 2 and point[0] == F(1, 2)
    assert point[1] * point[1] + point[2] * point[2] == F(15, 4) and 2 * point[1] == point[2] and point[1] < 0


def test_no_candidate() -> None:
    ball = _form(X * X + Y * Y + Z * Z - 4)
    assert critical_point(_form(X), [ball, _form(X - 3)], [3.0, 0.0, 0.0]) is None  # does not meet: no real point
    assert critical_point(_form(X), [_form(X), _form(X - 1)], [0.0, 0.0, 0.0]) is None  # contradictory
    assert critical_point(_form(X), [ball], [-2.0, 0.0, 0.0], accept=lambda point: False) is None
    assert critical_point(_form(X * X), [], [0.0, 0.0, 0.0]) is None  # not isolated


def test_limit_on_the_degree() -> None:
    with pytest.raises(HighDegree):
        _on_a_circle(max_degree=1)


# Remainder sequences over algebraic points: the same zeros, common divisors and roots as the tower of fields.


def _points() -> list[Point]:
    """Points over (x, y) with x^2 = 2 and y a root of a cubic or quartic over it, and x of degree 5."""
    found = []
    for f, g in [(X**2 - 2, Y**3 - X * Y - 1), (X**5 - X - 1, Y**2 - X), (X**2 - 3, (Y**2 - X) * (Y - 1))]:
        for root in real_roots(f.to_univariate(0)):
            below = Point(RING).extend(root)
            found += [below.extend(s.value) for s in isolate_over(below, (g,)).sections]
    return [p for p in found if isinstance(p.value, FibreRoot)]


POINTS = _points()


def test_there_are_points_to_test_with() -> None:
    assert len(POINTS) >= 5


@given(st.sampled_from(POINTS), polynomials(Ring.of(("x", "y")), max_degree=3), st.booleans())
def test_zeros_are_those_of_the_tower(point: Point, poly: Poly, times: bool) -> None:
    """Also of multiples of the polynomials that define the point, which vanish."""
    g = poly.convert(RING)
    if times:
        assert isinstance(point.value, FibreRoot)
        g = g * point.value.fibre.polynomial() + (X**2 - 2) * (X**5 - X - 1) * (X**2 - 3)
    reduced = point.reduce(g)
    assume(reduced and reduced.level == 1)
    assert isinstance(point.value, FibreRoot)
    assert point.value.annuls(reduced) is point.tower.is_zero(reduced)


@given(st.sampled_from(POINTS), polynomials(Ring.of(("x", "y", "z")), max_degree=2), st.integers(1, 3))
def test_squarefree_parts_have_the_same_roots(point: Point, poly: Poly, power: int) -> None:
    f = (poly + Z**3) ** power
    coefficients = squarefree_coefficients(f.coefficients(2), point.vanishes)
    part = sum((c * Z**k for k, c in enumerate(coefficients)), RING.constant(0))
    plain, reduced = isolate_over(point, (poly + Z**3,)), isolate_over(point, (part,))
    assert all(s.ball().overlaps(t.ball()) for s, t in zip(plain.sections, reduced.sections, strict=True))
    again = squarefree_coefficients(coefficients, point.vanishes)
    assert len(again) == len(coefficients)


@each(
    (Z**2 - X, Z**2 - X, 2),
    ((Z - X) * (Z - 1), (Z + X) * (Z - 1), 1),
    (Z**2 - 2, Z - X, 1),  # only because x^2 = 2
    (Z**3 - 2, Z - X, 0),
    ((X**2 - 2) * Z**3 + Z - X, Z - X, 1),  # the leading coefficient vanishes
    (Z - X, (X**2 - 2) * Z, 1),  # the other one is zero
)
def test_common_divisors_over_the_square_root_of_two(f: Poly, g: Poly, degree: int) -> None:
    (_, root) = real_roots((X**2 - 2).to_univariate(0))
    point = Point(RING).extend(root).extend(Point.of(RING, [Fraction(0)]).coordinate(0))
    common = common_coefficients(f.coefficients(2), g.coefficients(2), point.vanishes)
    assert len(common) == degree + 1
    assert not point.vanishes(common[-1])


# Arithmetic at points asks a clock between its calls, and ends when that says so.

EQUAL_ROOTS = ((Y - X) * (Y**3 - 2), (Y - X) * (Y**3 + Y - 5))


def _stops_at(looks: int) -> tuple[Callable[[], None], list[int]]:
    """Something to ask that raises when it is asked for the ``looks``-th time, and the times it was asked."""
    asked: list[int] = []

    def ask() -> None:
        asked.append(len(asked))
        if len(asked) >= looks:
            raise BudgetExceeded("time limit reached", limit="time")

    return ask, asked


def _root_of_a_quintic(ask: Callable[[], object]) -> Point:
    (root, *_) = real_roots((X**5 - X - 1).to_univariate(0))
    return Point(RING, watch=Watch(ask)).extend(root)


@given(polynomials(RING, max_degree=4), polynomials(RING, max_degree=4), st.integers(1, 30))
def test_a_product_in_pieces_is_the_product(a: Poly, b: Poly, piece: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(watch, "PIECE", piece)
        assert watched_product(a, b, Watch()) == a * b


def test_a_long_product_is_left_between_two_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watch, "PIECE", 10)
    ask, asked = _stops_at(4)
    with pytest.raises(BudgetExceeded):
        watched_product((X + Y + Z + 1) ** 4, (X - Y) ** 4, Watch(ask))
    assert len(asked) == 4


def test_long_products_are_work() -> None:
    """A search for values of a form on a sphere overran its share of the work a hundred times in a few products."""
    units: list[int] = []
    short, tall = (X + Y + Z + 1) ** 3, (X + 10**900 * Y + Z + 1) ** 6
    watched_product(short, short, Watch(spend=units.append))
    assert units == []
    watched_product(tall, tall, Watch(spend=units.append))
    assert units[0] > 10


def test_a_remainder_sequence_is_left_between_two_products() -> None:
    f, g = (p.coefficients(1) for p in EQUAL_ROOTS)
    point = _root_of_a_quintic(lambda: None)
    ask, counted = _stops_at(10**9)
    common_coefficients(f, g, point.vanishes, Watch(ask))
    assert len(counted) > 20
    for looks in (1, len(counted) // 2, len(counted)):
        ask, asked = _stops_at(looks)
        with pytest.raises(BudgetExceeded):
            common_coefficients(f, g, point.vanishes, Watch(ask))
        assert len(asked) == looks


def test_a_stack_is_left_inside() -> None:
    """The roots that coincide are found by a remainder sequence, which asks the watch of the point's root."""
    ask, asked = _stops_at(3)
    with pytest.raises(BudgetExceeded):
        isolate_over(_root_of_a_quintic(ask), EQUAL_ROOTS)
    assert len(asked) == 3


def test_points_share_the_watch_of_their_root_and_copies_have_an_idle_one() -> None:
    ask, asked = _stops_at(1)
    point = _root_of_a_quintic(ask).extend(_root_of_a_quintic(ask).coordinate(0))
    copy = pickle.loads(pickle.dumps(point))
    assert copy.watch is copy.ancestor(0).watch
    copy.watch()
    assert not asked
    with pytest.raises(BudgetExceeded):
        point.watch()
    assert Point(RING).watch is not Point(RING).watch


def test_decomposition_watches_its_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    """The points that are lifted over ask the budget of the decomposition."""
    budget, seen = Budget(), list[Point]()
    run = Lifter.run
    monkeypatch.setattr(Lifter, "run", lambda lifter, point, node: (seen.append(point), run(lifter, point, node))[1])
    decompose(read("y^2 - x = 0"), ("x", "y"), ("E", "E"), budget=budget)
    seen[0].watch()
    budget.cancel()
    with pytest.raises(BudgetExceeded, match="cancel"):
        seen[0].watch()
