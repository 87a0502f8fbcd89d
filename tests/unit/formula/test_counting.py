"""Root atoms as formulas about numbers of roots: the same truth at rational points."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.eliminate import read_formula
from qe.formula.build import root_atom
from qe.formula.counting import without_root_atoms
from qe.formula.evaluate import holds_at, substituted
from qe.formula.syntax import Relation
from qe.formula.traverse import has_root_atoms
from tests.strategies import RELATIONS
from tests.tables import each

POLYNOMIALS = ["x^2 - y", "x^3 - 3*x + y", "y*x^2 + x - 1", "y*x", "x^2*(x - y)", "x^2 + 1 + y^2", "y^2 - 1"]
INDICES = [1, 2, 3, -1, -2, -3]


@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from(POLYNOMIALS),
    st.sampled_from(INDICES),
    RELATIONS,
    st.integers(-4, 4),
    st.sampled_from([-1, 0, 1, 2, 4]),
)
def test_same_truth_at_points(text: str, k: int, relation: Relation, x: int, y: int) -> None:
    sides = read_formula(f"{text} = 0 or x = y")
    poly = next(iter(sides.args)).poly  # type: ignore[attr-defined]
    given_atom = root_atom("x", relation, poly, k)
    counted = without_root_atoms(given_atom)
    assert not has_root_atoms(counted) and set(counted.free) <= {"x", "y"}
    assert qe.decide(substituted(counted, {"x": x, "y": y})) is holds_at(given_atom, {"x": x, "y": y})


def test_formulas_without_root_atoms_are_left_alone() -> None:
    formula = read_formula("ex x. x^2 < a")
    assert without_root_atoms(formula) is formula


@each(
    ("ex c. c <= root(2, 4*b^3 + 27*c^2)", "b < 0"),  # two roots in c only there
    ("all x. x < root(-1, x^2 - y) or x >= root(-1, x^2 - y)", "y >= 0"),  # false where there is no root
    ("x = root(1, x^2 - y)", "x^2 = y and x <= 0"),
    ("all t_0. t_0 > root(1, t_0 - a) -> t_0 > b", "b <= a"),  # the new names are new
)
def test_questions_about_roots_are_answered(text: str, expected: str) -> None:
    answer = qe.eliminate(text)
    assert answer.formula is not None and not has_root_atoms(answer.formula)
    assert qe.equivalent(answer.formula, expected)
    assert qe.equivalent(text, expected)
