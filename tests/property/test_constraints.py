"""Restricted projection and lifting: the same answers as without, and as the reference elimination; certificates hold.

The formulas are conjunctions with equations, or disjunctions with inequations (the dual), in two and three variables.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume
from hypothesis import strategies as st

from qe import Guarantee, eliminate, reference
from qe.certify.claims import is_about
from qe.certify.verify import verify
from qe.decomposition.decompose import Decomposed, Tactics, decompose
from qe.decomposition.formulas import construct
from qe.decomposition.operators.table import OPERATORS
from qe.errors import BudgetExceeded
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, neg
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf
from qe.formula.syntax import Constant, Formula, Relation
from qe.kernel.renaming import is_same
from qe.options import Budget, Projection
from qe.proof.cells import Cell
from qe.proof.certificate import Certificate
from tests.differential.generate import at_point
from tests.enough import enough
from tests.strategies import RELATIONS, polynomials

NAMES = ("x", "y", "z")
SPACE, PLANE = Ring.of(NAMES), Ring.of(NAMES[:2])
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
    low, poly = Ring.of(NAMES[:1]), polynomials(PLANE, max_degree=2, max_terms=3, max_coefficient=3)

    def side() -> Formula:
        return atom(draw(polynomials(low, max_degree=1, max_terms=2)).convert(PLANE), draw(RELATIONS))

    def linear() -> Formula:
        rest = draw(polynomials(low, max_degree=2, max_terms=2, max_coefficient=2)).convert(PLANE)
        return atom(PLANE.gen(1) ** draw(st.integers(1, 2)) + rest, Relation.EQ)

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


@enough(5, 20, constrained(SPACE, max_degree=3), st.sampled_from(PREFIXES))
def test_sentences_in_space(matrix: Formula, quantifiers: tuple[str, ...]) -> bool:
    found, plain = _decomposed(matrix, quantifiers), _decomposed(matrix, quantifiers, PLAIN)
    if found is None or plain is None:
        return False
    assert found.table.root.truth is plain.table.root.truth
    assert str(verify(Certificate.cells(found.table))) == "accepted"
    for other in _flipped_leaves(found.table.root):
        assert not verify(Certificate.cells(replace(found.table, root=other))).accepted
    return True


@enough(5, 20, constrained(PLANE, max_degree=2), st.sampled_from([("E", "E"), ("A", "A"), ("A", "E"), ("E", "A")]))
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


@enough(4, 15, constrained(SPACE, max_degree=2), st.sampled_from(["E", "A"]), st.sampled_from([1, 2]))
def test_answers_over_free_variables(matrix: Formula, kind: str, free: int) -> bool:
    """The formula agrees with the reference at rational points; also where a free level is restricted."""
    quantifiers = ("",) * free + (kind,) * (3 - free)

    def table(thom_levels: frozenset[int] = frozenset()) -> object:
        return decompose(matrix, NAMES, quantifiers, budget=Budget(3), thom_levels=thom_levels).table

    try:
        answer, proof = construct(table(), table)  # type: ignore[arg-type]
    except BudgetExceeded:
        return False
    assert str(verify(Certificate.cells(proof, convert(answer, SPACE)))) == "accepted"
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
    7, 24, constrained(SPACE, max_degree=2), st.sampled_from((exists, forall)), st.sampled_from((1, 2)), st.booleans()
)
def test_checked_answers_where_a_free_level_may_have_a_constraint(
    matrix: Formula, quantify: Callable[..., Formula], free: int, root_atoms: bool
) -> bool:
    """Between the sections of a constraint signs are unknown, and a simplified answer may need one of them."""
    return _checked(quantify(NAMES[free:], matrix), "cad", root_atoms=root_atoms)


@pytest.mark.deep
@enough(250, 1000, constrained(SPACE, max_degree=3), st.sampled_from(PREFIXES), st.sampled_from(list(Projection)))
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
