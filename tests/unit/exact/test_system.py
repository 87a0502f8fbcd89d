"""Critical points on intersections of quadrics, and recognition of algebraic numbers from digits."""

from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import real_roots
from qe.exact.field import NumberField
from qe.exact.kkt_system import Flat, HighDegree, critical_point, cut_linear_combinations
from qe.exact.lattice_recognition import FieldLattice, algebraic_candidate, element_candidate
from qe.exact.quadratic_form import Quadratic, quadratic
from qe.exact.ring import Ring

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
