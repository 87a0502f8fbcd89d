"""Virtual substitution and critical values against other methods."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from experiments import reference
from qe.elimination.cad import decomposed
from qe.elimination.critical.method import CriticalValues
from qe.elimination.protocol import Context
from qe.elimination.vs.block import eliminate_block
from qe.engine.run import _Run
from qe.errors import BudgetExceeded
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.syntax import FALSE, TRUE, And, Exists, Formula, Or, Relation
from qe.formula.traverse import polynomials
from qe.options import Budget, Method, Options
from qe.proof.run_log import RunLog
from qe.simplifier.simplify import simplify
from tests.enough import enough
from tests.strategies import RELATIONS, atoms, rationals
from tests.strategies import polynomials as polynomials_of
from tests.tables import each
from tests.unit.elimination.vs.line import satisfiable, specialise

RING = Ring.of(("a", "b", "x"))
VALUES = st.one_of(st.sampled_from((Fraction(0), Fraction(1), Fraction(-1))), rationals(3, 2))
PARAMETERS = st.fixed_dictionaries({"a": VALUES, "b": VALUES})


def budget() -> Budget:
    return Budget(20)


def identity(formula: Formula) -> Formula:
    return formula


@st.composite
def matrices(draw: st.DrawFn, ring: Ring = RING, depth: int = 2, degree: int = 2) -> Formula:
    if depth == 0 or draw(st.integers(0, 3)) == 0:
        return draw(atoms(ring, max_degree=degree))
    parts = [draw(matrices(ring, depth - 1, degree)) for _ in range(draw(st.integers(2, 3)))]
    return conj(parts) if draw(st.booleans()) else disj(parts)


@given(matrices(), st.lists(PARAMETERS, min_size=4, max_size=4), st.sampled_from((simplify, identity)))
@settings(max_examples=28)
def test_one_variable(matrix: Formula, points: list[dict[str, Fraction]], tidy) -> None:  # type: ignore[no-untyped-def]
    """(exists x. F) iff the result, at random rational parameter values, with and without a simplifier."""
    result = eliminate_block(("x",), matrix, budget=budget(), simplify=tidy)
    assert not result.remaining
    answers = list(result.answers)
    for values in points:
        expected = satisfiable(specialise(matrix, values), 2)
        assert holds_at(result.formula, values) == expected
        guarded = [a for a in answers if holds_at(a.guard, values)]
        assert bool(guarded) == expected
        for answer in guarded[:2]:
            check_witness(matrix, values, answer.witness(values, budget=budget()))


def check_witness(matrix: Formula, values: dict[str, Fraction], found: dict) -> None:  # type: ignore[type-arg]
    """Exact evaluation of the matrix at the parameters and the values found."""
    everything = {**values, **found}
    if not polynomials(matrix):
        return
    names = polynomials(matrix)[0].ring.names
    order = sorted(names, key=lambda n: not isinstance(everything.get(n, 0), Fraction))
    ring = Ring.of(order)
    point = Point.of(ring, [everything.get(n, Fraction(0)) for n in order])
    assert truth_under(convert(matrix, ring), point.sign) is True


TWO = Ring.of(("a", "x", "y"))


@st.composite
def convex_families(draw: st.DrawFn) -> Formula:
    """Conjoined parabolas opening upwards (leading coefficients partly positive polynomials), other atoms, an Or."""
    line = Ring.of(("a", "b"))
    flat = polynomials_of(line, max_degree=1, max_terms=2, max_coefficient=3).map(lambda p: p.convert(RING))
    x, a = RING.gen(2), RING.gen(0)
    below = st.sampled_from((Relation.LT, Relation.LE))
    parts = []
    for _ in range(draw(st.integers(1, 3))):
        lead = draw(st.sampled_from((RING.constant(1), RING.constant(1), RING.constant(2), a * a + 1)))
        parts.append(atom(lead * x**2 + draw(flat) * x + draw(flat), draw(below)))
    loose = [
        atom(draw(st.sampled_from((0, 0, 1, -1))) * x**2 + draw(flat) * x + draw(flat), draw(RELATIONS))
        for _ in range(draw(st.integers(0, 2)))
    ]
    return conj((*parts, disj(loose) if loose else conj(())))


@st.composite
def open_matrices(draw: st.DrawFn) -> Formula:
    """Conjunctions of strict atoms of degree 2 in x and y."""
    strict = st.sampled_from((Relation.LT, Relation.GT, Relation.NE))
    poly = polynomials_of(TWO, max_degree=2, max_terms=5, max_coefficient=3)
    parts = draw(st.lists(st.builds(atom, poly, strict), min_size=2, max_size=3))
    return conj(parts)


@st.composite
def lone_quadratics(draw: st.DrawFn) -> Formula:
    """One quadratic polynomial, in one weak and perhaps a strict inequality, among linear ones."""
    line = Ring.of(("a", "b"))
    flat = polynomials_of(line, max_degree=1, max_terms=2, max_coefficient=3).map(lambda p: p.convert(RING))
    x = RING.gen(2)
    g = draw(st.sampled_from((RING.constant(1), RING.constant(-1), RING.gen(0)))) * x**2 + draw(flat) * x + draw(flat)
    relations = st.sampled_from([r for r in Relation if r is not Relation.EQ])
    parts = [atom(g, draw(relations))]
    if draw(st.booleans()):
        parts.append(atom(g, draw(st.sampled_from((Relation.LT, Relation.GT, Relation.NE)))))
    for _ in range(draw(st.integers(1, 3))):
        parts.append(atom(draw(flat) * x + draw(flat), draw(st.sampled_from(tuple(Relation)))))
    parts = draw(st.permutations(parts))
    cut = draw(st.integers(0, len(parts)))
    return conj((*parts[:cut], disj(parts[cut:]) if cut < len(parts) else conj(())))


@each(convex_families(), lone_quadratics())
@given(drawn=st.data(), points=st.lists(PARAMETERS, min_size=4, max_size=4))
@settings(max_examples=28)
def test_sets_without_square_roots(
    family: st.SearchStrategy[Formula], drawn: st.DataObject, points: list[dict[str, Fraction]]
) -> None:
    """Of vertices and crossings; of both infinities, the linear roots, the vertex."""
    matrix = drawn.draw(family)
    result = eliminate_block(("x",), matrix, budget=budget(), simplify=identity)
    for values in points:
        assert holds_at(result.formula, values) == satisfiable(specialise(matrix, values), 2)


@given(open_matrices(), st.lists(VALUES, min_size=3, max_size=3))
@settings(max_examples=28)
def test_open_blocks(matrix: Formula, points: list[Fraction]) -> None:
    """exists x, y over strict atoms: conditions of measure zero in the block are left out, truth stays."""
    result = eliminate_block(("x", "y"), matrix, budget=budget(), simplify=simplify)
    first = eliminate_block(("y",), matrix, budget=budget(), simplify=simplify)
    if result.remaining:
        return
    for value in points:
        values = {"a": value}
        assert holds_at(result.formula, values) == satisfiable(specialise(first.formula, values), 1)


@given(matrices(TWO, 2, 2), st.lists(VALUES, min_size=3, max_size=3))
@settings(max_examples=28)
def test_two_variables(matrix: Formula, points: list[Fraction]) -> None:
    """exists x, y: answers are solutions; and eliminating one after the other gives the same truth."""
    result = eliminate_block(("x", "y"), matrix, budget=budget(), simplify=simplify)
    first = eliminate_block(("y",), matrix, budget=budget(), simplify=identity)
    for value in points:
        values = {"a": value}
        if not first.remaining and not result.remaining:
            assert holds_at(result.formula, values) == satisfiable(specialise(first.formula, values), 1)
        for answer in list(result.answers)[:3]:
            if holds_at(answer.guard, values):
                check_witness(matrix, values, answer.witness(values, budget=budget()))


@enough(7, 28, matrices(Ring.of(("x", "y", "z")), 2, 2))
def test_sentences_against_z3(matrix: Formula) -> bool:
    z3 = pytest.importorskip("z3")
    from qe.io.smtlib import write

    result = eliminate_block(("x", "y", "z"), matrix, budget=budget(), simplify=simplify)
    if result.remaining:
        return False
    solver = z3.Solver()
    solver.set("timeout", 3000)
    solver.from_string(write(matrix))
    verdict = solver.check()
    if verdict == z3.unknown:
        return False
    assert (str(result.formula) == "true") == (verdict == z3.sat)
    if verdict == z3.sat:
        check_witness(matrix, {}, next(result.answers).witness(budget=budget()))
    return True


@enough(4, 15, matrices(Ring.of(("x", "y")), 1, 2))
def test_sentences_against_the_reference(matrix: Formula) -> bool:
    """exists x, y: the same truth as the textbook procedure, which shares no code with the engine."""
    result = eliminate_block(("x", "y"), matrix, budget=budget(), simplify=simplify)
    if result.remaining:
        return False
    try:
        expected = reference.decide(exists(("x", "y"), matrix), budget=Budget(0.5))
    except BudgetExceeded:
        return False
    assert result.formula == (TRUE if expected else FALSE)
    return True


@given(matrices(RING, 2, 4), st.lists(PARAMETERS, min_size=3, max_size=3))
@settings(max_examples=28)
def test_what_stays_too_high_is_still_equivalent(matrix: Formula, points: list[dict[str, Fraction]]) -> None:
    """Degree up to 4: leftover existential parts are kept, and the whole is equivalent."""
    result = eliminate_block(("x",), matrix, budget=budget(), simplify=simplify)
    for values in points:
        expected = satisfiable(specialise(matrix, values), 2)
        assert evaluate(result.formula, values) == expected


def evaluate(formula: Formula, values: dict[str, Fraction]) -> bool:
    """Truth of a positive formula with leftover existential quantifiers over x."""
    match formula:
        case Exists(("x",), body):
            return satisfiable(specialise(body, values), 2)
        case And(args):
            return all(evaluate(a, values) for a in args)
        case Or(args):
            return any(evaluate(a, values) for a in args)
    return holds_at(formula, values)


def test_budget_is_kept() -> None:
    late = Budget(-1.0)
    x, y = RING.gen(2), RING.gen(1)
    with pytest.raises(BudgetExceeded):
        eliminate_block(("x",), atom(x**2 - y, Relation.LT), budget=late, simplify=simplify)


STRICT_AND_WEAK = (Relation.LE, Relation.LT, Relation.EQ, Relation.GE, Relation.GT, Relation.NE)


def eliminated(variables: tuple[str, ...], body: Formula, seconds: float = 60) -> Formula:
    """By critical values, what these leave open by decomposition; without the preparation that would solve many."""
    budget = Budget(seconds)
    formula = CriticalValues().run(Block(variables, body), Context(Options(), budget, RunLog())).formula
    return _Run(Options(method=Method.CAD), budget).without_quantifiers(formula)


@st.composite
def polys(draw: st.DrawFn, ring: Ring, degree: int) -> Poly:
    total = ring.constant(draw(st.integers(-2, 2)))
    for _ in range(draw(st.integers(1, 3))):
        term = ring.constant(draw(st.sampled_from((-2, -1, 1, 2))))
        for _ in range(draw(st.integers(1, degree))):
            term = term * ring.gen(draw(st.integers(0, ring.size - 1)))
        total = total + term
    return total


@st.composite
def blocks(draw: st.DrawFn, free: int, bound: int, extra: int = 2) -> tuple[tuple[str, ...], Formula]:
    """(quantified variables, body): a ball of the quantified variables and other conditions of degree two."""
    ring = Ring.of([f"p{i}" for i in range(free)] + [f"y{i}" for i in range(bound)])
    names = ring.names[free:]
    ball = ring.constant(-draw(st.integers(1, 4)))
    for name in names:
        shifted = ring.var(name) - draw(st.sampled_from((0, 0, 1))) * ring.gen(0)
        ball = ball + shifted * shifted
    atoms = [atom(ball, draw(st.sampled_from((Relation.LE, Relation.LT, Relation.EQ))))]
    for _ in range(draw(st.integers(1, extra))):
        condition = atom(draw(polys(ring, 2)), draw(st.sampled_from(STRICT_AND_WEAK)))
        if draw(st.booleans()) and draw(st.booleans()):
            condition = disj((condition, atom(draw(polys(ring, 1)), draw(st.sampled_from(STRICT_AND_WEAK)))))
        atoms.append(condition)
    return names, conj(atoms)


def agrees(variables: tuple[str, ...], body: Formula) -> bool:
    try:
        answer = eliminated(variables, body)
    except qe.Unable:
        return False  # the method may refuse: critical points over all parameters, or a body without bounded fibres
    other = decomposed(exists(variables, body), Options(), Budget(60), RunLog()).formula
    assert qe.equivalent(answer, other), f"{answer}  |  {other}"
    return True


@each((2, 12, blocks(1, 1)), (3, 15, blocks(2, 1)), (2, 12, blocks(1, 2, extra=1)), (2, 8, blocks(3, 1, extra=1)))
def test_blocks(at_least: int, of: int, drawn: st.SearchStrategy[tuple[tuple[str, ...], Formula]]) -> None:
    enough(at_least, of, drawn)(lambda block: agrees(*block))()


def test_unbounded_convex_set_in_three_parameters() -> None:
    """Walls without the last variable are not settled by convexity there: the answer was too small."""
    ring = Ring.of(("x", "y", "z", "u"))
    x, y, z, u = (ring.gen(i) for i in range(4))
    body = conj(atom(p, Relation.LE) for p in ((u - x) * (u - x) + y * y - 1, u * u - 4, u - z))
    answer = eliminated(("u",), body)
    assert holds_at(answer, {"x": Fraction(-1, 2), "y": -1, "z": 0})
    assert not holds_at(answer, {"x": Fraction(-1, 2), "y": -1, "z": -1})
