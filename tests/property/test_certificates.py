"""Random decompositions are accepted, and what the checker's arithmetic says agrees with other methods."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice

import pytest
from flint import fmpz_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from qe.certify.verify import verify
from qe.decomposition.decompose import decompose
from qe.decomposition.operators.table import OPERATORS
from qe.errors import BudgetExceeded
from qe.exact.algebraic import real_roots
from qe.exact.ring import Ring
from qe.exact.univariate import from_univariate
from qe.formula.build import conj, disj
from qe.formula.syntax import Atom, Formula
from qe.kernel.arithmetic.fibre import AlgebraicFibre, fibre
from qe.kernel.arithmetic.sturm import (
    _count_by_enclosure,
    count_real_roots,
    count_roots_between,
    sylvester_determinant,
)
from qe.kernel.arithmetic.triangular import ORIGIN, Coordinate
from qe.options import Budget, Projection
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate
from tests.enough import enough
from tests.strategies import atoms, integers, rationals
from tests.tables import each

INTEGERS = st.lists(integers(6, rarity=24), min_size=1, max_size=7)
NAMES = ("x", "y", "z")


def _table(matrix: Formula, quantifiers: tuple[str, ...], projection: Projection, seconds: float) -> CellTable | None:
    """None at the time limit."""
    try:
        names = NAMES[: len(quantifiers)]
        return decompose(matrix, names, quantifiers, budget=Budget(seconds), operator=OPERATORS[projection]).table
    except BudgetExceeded:
        return None


def _flipped(cell: Cell) -> Cell | None:
    """The cell with the first decided leaf below it saying the opposite."""
    if cell.stack is None:
        return None if cell.truth is None else replace(cell, truth=not cell.truth)
    for i, child in enumerate(cell.stack.cells):
        other = _flipped(child)
        if other is not None:
            cells = (*cell.stack.cells[:i], other, *cell.stack.cells[i + 1 :])
            return replace(cell, stack=replace(cell.stack, cells=cells))
    return None


def _narrower(cell: Cell, *, merge: bool) -> Iterator[Cell]:
    """The cell with one section of one stack below it left out, or merged with the next one."""
    stack = cell.stack
    if stack is None:
        return
    for j in range(len(stack.sections) - merge):
        sectors = stack.sectors[: j + 1] + stack.sectors[j + 2 :]
        kept = tuple(sorted({*stack.sections[j], *stack.sections[j + 1]})) if merge else None
        sections = stack.sections[:j] + (() if kept is None else (kept,)) + stack.sections[j + 1 + merge :]
        cells = stack.cells[: 2 * j + 1 + merge] + stack.cells[2 * j + 3 + merge :]
        yield replace(cell, stack=replace(stack, sectors=sectors, sections=sections, cells=cells))
    for i, child in enumerate(stack.cells):
        for other in _narrower(child, merge=merge):
            cells = (*stack.cells[:i], other, *stack.cells[i + 1 :])
            yield replace(cell, stack=replace(stack, cells=cells))


def _check(matrix: Formula, quantifiers: tuple[str, ...], projection: Projection, seconds: float) -> bool:
    table = _table(matrix, quantifiers, projection, seconds)
    if table is None:
        return False
    certificate = Certificate.cells(table)
    assert str(verify(certificate)) == "accepted"
    assert Certificate.from_json(certificate.to_json()) == certificate
    wrong = _flipped(table.root)
    assert wrong is not None
    assert not verify(Certificate.cells(replace(table, root=wrong))).accepted
    for merge in (False, True):
        for narrower in islice(_narrower(table.root, merge=merge), 12):
            assert not verify(Certificate.cells(replace(table, root=narrower))).accepted
    return True


def _matrices(names: tuple[str, ...], degree: int, width: int) -> st.SearchStrategy[Formula]:
    found = atoms(Ring.of(names), max_degree=degree).filter(lambda a: isinstance(a, Atom))
    parts = st.lists(found, min_size=1, max_size=width)
    return st.one_of(parts.map(conj), parts.map(disj))


PLANE, SPACE = _matrices(NAMES[:2], 3, 3), _matrices(NAMES, 2, 2)


IN_SPACE = [("", "", ""), ("", "E", "A"), ("E", "E", "E")]


@each(
    (13, 50, PLANE, [("", ""), ("", "E"), ("E", "A"), ("A", "E")], 1.0),
    (8, 34, SPACE, IN_SPACE, 1.0),
    pytest.param(400, 1500, SPACE, IN_SPACE, 5.0, marks=pytest.mark.deep),
)
def test_random_tables(at_least: int, of: int, matrices, prefixes: list[tuple[str, ...]], seconds: float) -> None:  # type: ignore[no-untyped-def]
    drawn = (matrices, st.sampled_from(prefixes), st.sampled_from(Projection))
    enough(at_least, of, *drawn)(lambda *values: _check(*values, seconds))()


@given(INTEGERS, INTEGERS, rationals(4, 5), rationals(4, 5))
def test_sturm_counts_what_isolation_finds(f: list[int], g: list[int], low: Fraction, high: Fraction) -> None:
    p = fmpz_poly(f) * fmpz_poly(g) ** 2
    assume(p)
    roots = real_roots(p) if p.degree() > 0 else []
    assert count_real_roots(p) == len(roots)
    low, high = min(low, high), max(low, high)
    if p.degree() > 0 and not any(r.compare(s) == 0 for r in roots for s in map(_number, (low, high))):
        inside = [r for r in roots if _number(low) < r < _number(high)]
        assert count_roots_between(p, low, high) == len(inside)


@settings(max_examples=20)
@given(st.lists(st.integers(-9, 9), min_size=1, max_size=4), st.integers(21, 27))
def test_roots_of_long_polynomials_are_enclosed_as_they_are(f: list[int], count: int) -> None:
    """With coefficients rounded to the working precision no enclosure told the roots of 1, 2, 3, … apart."""
    p = fmpz_poly(f)
    assume(p)
    for k in range(1, count):
        p *= fmpz_poly([-10 * k, 1])
    p /= p.gcd(p.derivative())
    assert p.degree() * p.height_bits() > 1500
    assert _count_by_enclosure(p) == len(real_roots(p))


def _number(x: Fraction):  # type: ignore[no-untyped-def]
    from qe.exact.algebraic import RealAlgebraic

    return RealAlgebraic.rational(x)


@given(INTEGERS, INTEGERS)
def test_the_sylvester_determinant_is_the_resultant(f: list[int], g: list[int]) -> None:
    assume(f[-1] and g[-1] and len(f) > 1 and len(g) > 1)
    assert sylvester_determinant(f, g) == int(fmpz_poly(f).resultant(fmpz_poly(g)))


@given(st.lists(st.lists(integers(3, rarity=24), min_size=1, max_size=3), min_size=2, max_size=4))
def test_fibres_over_sqrt2_have_the_roots_of_their_norm(rows: list[list[int]]) -> None:
    """f(sqrt 2, y) * f(-sqrt 2, y) has integer coefficients; its real roots are those of the two fibres."""
    ring = Ring.of(("x", "y"))
    x, y = ring.gen(0), ring.gen(1)
    f = ring.constant(0)
    for k, row in enumerate(rows):
        for i, c in enumerate(row):
            f = f + c * x**i * y**k
    minimal = x * x - 2
    counts, shared = 0, None
    for low, high, rising in ((1, 2, 1), (-2, -1, -1)):
        point = ORIGIN.extended(Coordinate(0, minimal, Fraction(low), Fraction(high), rising))
        here = fibre(point, f, 1)
        assume(here.degree > 0)
        counts += here.count()
        assert here.squarefree().count() == here.count()
        if isinstance(here, AlgebraicFibre):
            assert here.count_by_remainders() == here.count()
        lifted = here.poly if isinstance(here, AlgebraicFibre) else from_univariate(ring, 1, here.p)
        conjugate = AlgebraicFibre(point, 1, f.compose({0: -x}))
        shared = AlgebraicFibre(point, 1, lifted).gcd(conjugate)
    norm = minimal.resultant(f, 0) if f.degree(0) else f * f
    assert shared is not None
    expected = count_real_roots(norm.to_univariate(1))
    assert expected == counts - (shared.count() if shared.degree > 0 else 0)
