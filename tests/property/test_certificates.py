"""Certificates of random questions, and decompositions restricted by equations: right, checked, and as without."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice

import pytest
from flint import fmpz_poly
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from experiments import reference
from qe import Guarantee, eliminate
from qe.certify.claims import is_about
from qe.certify.verify import verify
from qe.decomposition.decompose import Decomposed, Tactics, decompose
from qe.decomposition.formulas import construct
from qe.decomposition.operators.table import OPERATORS
from qe.errors import BudgetExceeded
from qe.exact.algebraic import real_roots
from qe.exact.ring import Ring
from qe.exact.univariate import from_univariate
from qe.formula.build import atom, conj, convert, disj, exists, forall, neg
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Constant, Formula, Relation
from qe.kernel.arithmetic.fibre import AlgebraicFibre, fibre
from qe.kernel.arithmetic.sturm import (
    _count_by_enclosure,
    count_real_roots,
    count_roots_between,
    sylvester_determinant,
)
from qe.kernel.arithmetic.triangular import ORIGIN, Coordinate
from qe.kernel.renaming import is_same
from qe.options import Budget, Projection
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate
from tests.differential.generate import at_point
from tests.enough import enough
from tests.strategies import RELATIONS, atoms, integers, polynomials, rationals
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


SPACE_CONSTRAINTS, PLANE_CONSTRAINTS = Ring.of(NAMES), Ring.of(NAMES[:2])
PREFIXES = [("E", "E", "E"), ("A", "A", "A"), ("A", "E", "E"), ("E", "A", "E"), ("E", "E", "A")]


@st.composite
def constrained(draw: st.DrawFn, ring: Ring, *, max_degree: int) -> Formula:
    """One to three equations and up to two other atoms conjoined, or the dual disjunction."""
    dual = draw(st.booleans())
    relation = Relation.NE if dual else Relation.EQ
    poly = polynomials(ring, max_degree=max_degree, max_terms=3, max_coefficient=3)
    equations = [atom(draw(poly), relation) for _ in range(draw(st.integers(1, 3)))]
    others = [atom(draw(poly), draw(RELATIONS)) for _ in range(draw(st.integers(0, 2)))]
    found = (disj if dual else conj)(equations + others)
    assume(not isinstance(found, Constant))
    return found


@st.composite
def nested(draw: st.DrawFn) -> Formula:
    """Equations in the top variable under disjunctions, whose branches die at different cells below."""
    low, poly = Ring.of(NAMES[:1]), polynomials(PLANE_CONSTRAINTS, max_degree=2, max_terms=3, max_coefficient=3)

    def side() -> Formula:
        return atom(draw(polynomials(low, max_degree=1, max_terms=2)).convert(PLANE_CONSTRAINTS), draw(RELATIONS))

    def linear() -> Formula:
        rest = draw(polynomials(low, max_degree=2, max_terms=2, max_coefficient=2)).convert(PLANE_CONSTRAINTS)
        return atom(PLANE_CONSTRAINTS.gen(1) ** draw(st.integers(1, 2)) + rest, Relation.EQ)

    branches = [conj((linear(), side(), disj((side(), atom(draw(poly), draw(RELATIONS)))))) for _ in range(3)]
    found = conj((disj(branches), disj((side(), atom(draw(poly), draw(RELATIONS))))))
    if draw(st.booleans()):
        found = nnf(neg(found))
    assume(not isinstance(found, Constant))
    return found


def _decomposed(matrix: Formula, quantifiers: tuple[str, ...], tactics: Tactics = Tactics()) -> Decomposed | None:
    """None at the time limit."""
    try:
        return decompose(matrix, NAMES[: len(quantifiers)], quantifiers, budget=Budget(2), tactics=tactics)
    except BudgetExceeded:
        return None


PLAIN = Tactics(constraints=False)


def _flipped_leaves(cell: Cell) -> list[Cell]:
    """The cell with one decided leaf below it saying the opposite, for each of the first few leaves."""
    if cell.stack is None:
        return [] if cell.truth is None else [replace(cell, truth=not cell.truth)]
    stack, found = cell.stack, []
    for i, below in enumerate(stack.cells):
        for other in _flipped_leaves(below)[:2]:
            found.append(replace(cell, stack=replace(stack, cells=(*stack.cells[:i], other, *stack.cells[i + 1 :]))))
    return found[:6]


@enough(5, 20, constrained(SPACE_CONSTRAINTS, max_degree=3), st.sampled_from(PREFIXES))
def test_sentences_in_space(matrix: Formula, quantifiers: tuple[str, ...]) -> bool:
    found, plain = _decomposed(matrix, quantifiers), _decomposed(matrix, quantifiers, PLAIN)
    if found is None or plain is None:
        return False
    assert found.table.root.truth is plain.table.root.truth
    assert str(verify(Certificate.cells(found.table))) == "accepted"
    for other in _flipped_leaves(found.table.root):
        assert not verify(Certificate.cells(replace(found.table, root=other))).accepted
    return True


@enough(
    5,
    20,
    constrained(PLANE_CONSTRAINTS, max_degree=2),
    st.sampled_from([("E", "E"), ("A", "A"), ("A", "E"), ("E", "A")]),
)
def test_sentences_in_the_plane_against_the_reference(matrix: Formula, quantifiers: tuple[str, ...]) -> bool:
    found = _decomposed(matrix, quantifiers)
    if found is None:
        return False
    sentence = matrix
    for name, kind in reversed(list(zip(NAMES, quantifiers, strict=False))):
        sentence = (exists if kind == "E" else forall)([name], sentence)
    try:
        assert found.table.root.truth is reference.decide(sentence, budget=Budget(1))
    except BudgetExceeded:
        return False
    return True


@enough(8, 32, nested(), st.sampled_from([("E", "E"), ("A", "A"), ("A", "E"), ("E", "A")]))
def test_constraints_of_disjunctions(matrix: Formula, quantifiers: tuple[str, ...]) -> bool:
    found, plain = _decomposed(matrix, quantifiers), _decomposed(matrix, quantifiers, PLAIN)
    if found is None or plain is None:
        return False
    assert found.table.root.truth is plain.table.root.truth
    assert str(verify(Certificate.cells(found.table))) == "accepted"
    return True


@enough(4, 15, constrained(SPACE_CONSTRAINTS, max_degree=2), st.sampled_from(["E", "A"]), st.sampled_from([1, 2]))
def test_answers_over_free_variables(matrix: Formula, kind: str, free: int) -> bool:
    """The formula agrees with the reference at rational points; also where a free level is restricted."""
    quantifiers = ("",) * free + (kind,) * (3 - free)

    def table(thom_levels: frozenset[int] = frozenset()) -> object:
        return decompose(matrix, NAMES, quantifiers, budget=Budget(3), thom_levels=thom_levels).table

    try:
        answer, proof = construct(table(), table)  # type: ignore[arg-type]
    except BudgetExceeded:
        return False
    assert str(verify(Certificate.cells(proof, convert(answer, SPACE_CONSTRAINTS)))) == "accepted"
    formula = (exists if kind == "E" else forall)(NAMES[free:], matrix)
    for values in [(0, 0), (1, -1), (Fraction(1, 2), 2)]:
        point = {name: Fraction(v) for name, v in zip(NAMES[:free], values, strict=False)}
        try:
            expected = reference.decide(at_point(formula, point), budget=Budget(0.5))
        except BudgetExceeded:
            continue
        assert holds_at(answer, point) is expected
    return True


def _checked(formula: Formula, method: str, *, root_atoms: bool = False) -> bool:
    answer = eliminate(formula, check=True, method=method, timeout=3, root_atoms=root_atoms)
    if answer.formula is None:
        return False
    if answer.guarantee is Guarantee.DERIVED:
        assert answer.certificate is None
        return False
    if answer.certificate is not None:
        said = is_about(answer.certificate, formula)
        assert said is not None and is_same(said, answer.formula)  # it proves what is answered
    return True


@enough(
    7,
    24,
    constrained(SPACE_CONSTRAINTS, max_degree=2),
    st.sampled_from((exists, forall)),
    st.sampled_from((1, 2)),
    st.booleans(),
)
def test_checked_answers_where_a_free_level_may_have_a_constraint(
    matrix: Formula, quantify: Callable[..., Formula], free: int, root_atoms: bool
) -> bool:
    """Between the sections of a constraint signs are unknown, and a simplified answer may need one of them."""
    return _checked(quantify(NAMES[free:], matrix), "cad", root_atoms=root_atoms)


@pytest.mark.deep
@enough(
    250,
    1000,
    constrained(SPACE_CONSTRAINTS, max_degree=3),
    st.sampled_from(PREFIXES),
    st.sampled_from(list(Projection)),
)
def test_many_sentences_in_space(matrix: Formula, quantifiers: tuple[str, ...], projection: Projection) -> bool:
    found = _decomposed(matrix, quantifiers)
    try:
        plain = decompose(matrix, NAMES, quantifiers, budget=Budget(5), operator=OPERATORS[projection], tactics=PLAIN)
    except BudgetExceeded:
        return False
    if found is None:
        return False
    assert found.table.root.truth is plain.table.root.truth
    assert str(verify(Certificate.cells(found.table))) == "accepted"
    return True
