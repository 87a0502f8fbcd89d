"""Directions along which polynomials are constant, and weights by which they are homogeneous."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.quadratic_form import independent_rows
from qe.exact.ring import Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import TRUE, Relation
from qe.formula.traverse import polynomials
from qe.io.text import read
from qe.rules.nullspace import constant_direction, homogeneous_weights

RING = Ring.of(("x", "y", "z"))
ROWS = st.lists(st.lists(st.integers(-2, 2), min_size=3, max_size=3), max_size=4)


@given(ROWS)
def test_linear_forms_are_constant_along_what_annihilates_them(rows: list[list[int]]) -> None:
    forms = [sum((RING.gen(i) * c for i, c in enumerate(row)), RING.constant(1)) for row in rows]
    body = conj(atom(form, Relation.GT) for form in forms)
    found, kept = constant_direction(body, frozenset("xyz")), [[Fraction(c) for c in row] for row in rows if any(row)]
    occurring = {RING.names[i] for row in rows for i, c in enumerate(row) if c}
    assert bool(found) == (bool(kept) and len(independent_rows(kept)) < len(occurring))
    assert all(found.values()) and set(found) <= occurring
    for row in kept:
        assert sum(c * found.get(name, 0) for c, name in zip(row, "xyz", strict=True)) == 0


@pytest.mark.parametrize(
    ("text", "names", "directed", "weighted"),
    [
        ("(x - y)^2 > 1 and (z = 1 or x - y < 2)", "xyz", True, False),
        ("(x - y)^2 > 1 and (z = 1 or x - y < 2)", "xz", False, False),
        ("x*y^2 > z^3 and x + 2*z < 0", "xyz", False, True),
        ("x*y^2 > z^3 and x + 2*z < 0", "xy", False, False),
    ],
)
def test_only_the_named_variables_move(text: str, names: str, directed: bool, weighted: bool) -> None:
    body = read(text)
    direction, weights = constant_direction(body, frozenset(names)), homogeneous_weights(body, frozenset(names))
    assert (bool(direction), bool(weights)) == (directed, weighted) and {*direction, *weights} <= set(names)
    for p in polynomials(body):
        degrees = {sum(e[p.ring.index[v]] * w for v, w in weights.items()) for e, _ in p.terms()}
        slopes = (p.derivative(p.ring.index[v]) * int(w * 60) for v, w in direction.items())
        assert (not weights or len(degrees) == 1) and not sum(slopes, p.ring.constant(0))


def test_no_polynomials() -> None:
    assert not constant_direction(TRUE, frozenset("x")) and not homogeneous_weights(TRUE, frozenset("x"))
