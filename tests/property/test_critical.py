"""Critical-value elimination against decomposition, on random blocks over bounded fibres."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

import qe
from qe.elimination.cad import decomposed
from qe.elimination.critical.method import CriticalValues
from qe.elimination.protocol import Context
from qe.engine.run import _Run
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj, exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula, Relation
from qe.options import Budget, Method, Options
from qe.proof.run_log import RunLog
from tests.enough import enough
from tests.tables import each

RELATIONS = (Relation.LE, Relation.LT, Relation.EQ, Relation.GE, Relation.GT, Relation.NE)


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
        condition = atom(draw(polys(ring, 2)), draw(st.sampled_from(RELATIONS)))
        if draw(st.booleans()) and draw(st.booleans()):
            condition = disj((condition, atom(draw(polys(ring, 1)), draw(st.sampled_from(RELATIONS)))))
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
