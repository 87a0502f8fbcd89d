"""What every projection operator promises: closed lists, a theorem of the checker, nothing nullified unseen."""

from __future__ import annotations

import ast
import pickle
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest

import qe as qe_package
from qe.decomposition.decompose import decompose
from qe.decomposition.operators.operator import Operator
from qe.decomposition.operators.table import OPERATORS
from qe.decomposition.projection import FactorSet, factor_lists, project
from qe.errors import NotWellOriented
from qe.exact.ring import Poly, Ring
from qe.formula.traverse import polynomials
from qe.io.text import read
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.projection import Projected
from qe.options import Budget, Projection

RING = Ring.of(("a", "b", "x", "y"))
SETS = {
    "quadratic and line": ("x^2 + a*x + b", "a*x - b"),
    "a curtain over a point": ("a*x + b", "x^2 + y^2 - 1"),
    "a curtain over a line": ("a*y + b*x", "y^2 - x"),
    "cubics": ("y^3 + a*y + x", "x^2 + b^2 - 1"),
    "no trailing coefficient": ("y", "a*y^2 + x*y + b", "x"),
}


def factors(name: str) -> tuple[Poly, ...]:
    return tuple(p.convert(RING) for text in SETS[name] for p in polynomials(read(f"{text} = 0")))


def test_the_table_has_every_name_once() -> None:
    assert set(OPERATORS) == set(Projection)
    assert all(OPERATORS[name].name is name and OPERATORS[name].source for name in Projection)


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("projection", Projection)
def test_lists_are_closed_by_the_theorem_that_proves_the_tables(projection: Projection, name: str) -> None:
    """``Operator.proof``, by the checker's computation; also one with a constraint, where the theorem allows it."""
    operator = OPERATORS[projection]
    lists = factor_lists(factors(name), RING.size, operator, Budget())
    Projected(FactorLists(RING, lists), Budget(), evaluates=operator.evaluates).closed()
    if operator.restricted:
        last = lists[-1][:1]
        shorter = factor_lists(factors(name), RING.size, operator, Budget(), constraints={3: frozenset(last)})
        kept, everything = frozenset(shorter[-1].index(f) for f in last), frozenset(range(len(shorter[-1])))
        checked = Projected(FactorLists(RING, shorter), Budget(), evaluates=operator.evaluates)
        assert checked.needed(3, everything, kept, order=False) <= {(k, i) for k in range(3) for i in range(99)}


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("projection", Projection)
def test_a_projection_is_that_of_each_and_of_each_pair(projection: Projection, name: str) -> None:
    operator, variable = OPERATORS[projection], 3
    top = FactorSet(factors(name)).at(variable)
    parts = FactorSet(p for f in top for p in operator.of_one(f, variable))
    parts.add(p for f, g in combinations(top, 2) for p in operator.of_two(f, g, variable))
    projected = FactorSet(project(top, variable, operator))
    assert set(projected) == set(parts) and all(f.level < variable for f in projected)


@pytest.mark.parametrize("projection", Projection)
def test_without_a_side_condition_in_the_end(projection: Projection) -> None:
    """Whatever takes over, takes over for good."""
    operator, seen = OPERATORS[projection], list[Operator]()

    def refusing(used: Operator) -> Operator:
        seen.append(used)
        used.check_nullified(1, 1)
        return used

    assert operator.applied(refusing) is operator.complete is seen[-1]
    assert operator.complete.otherwise is None and len(set(map(id, seen))) == len(seen)
    with pytest.raises(NotWellOriented, match="as if"):
        operator.applied(_not_well_oriented)


def _not_well_oriented(operator: Operator) -> None:
    raise NotWellOriented("as if")


@pytest.mark.parametrize("projection", Projection)
def test_a_factor_that_is_zero_over_a_curve_is_no_surprise(projection: Projection) -> None:
    """x*w + y*z vanishes for all w over x = y = 0: the operator, or one that takes over, knows what to do."""
    order, kinds, operator = ("x", "y", "z", "w"), ("", "", "", "E"), OPERATORS[projection]
    made = decompose(read("x*w + y*z > 0 and w > 1"), order, kinds, budget=Budget(20), operator=operator)
    assert made.operator == operator.complete and made.nullified is (operator.otherwise is not None)


def test_only_the_operators_and_the_checker_tell_them_apart() -> None:
    """Whoever else compares one with another has missed what the value says."""
    qe = Path(qe_package.__file__).parent
    files = {path.relative_to(qe).as_posix() for path in qe.rglob("*.py") if _compares(ast.parse(path.read_text()))}
    assert files == {"kernel/cells.py"}


def _compares(module: ast.Module) -> bool:
    """Whether something is compared, or matched, with an operator or the name of one."""
    for node in ast.walk(module):
        if isinstance(node, ast.Compare | ast.MatchValue):
            for part in ast.walk(node):
                if isinstance(part, ast.Attribute) and ast.unparse(part.value) == "Projection":
                    return True
                if isinstance(part, ast.Name) and part.id in {p.name for p in Projection}:
                    return True
    return False


def test_constraints_restrict_no_operator_without_a_side_condition() -> None:
    """Lifting would take a constraint that is nullified for one that says something."""
    for operator in OPERATORS.values():
        with pytest.raises(ValueError, match="nullified"):
            replace(operator, restricted=True, otherwise=None)


@pytest.mark.parametrize("projection", Projection)
def test_operators_are_sent_to_helpers(projection: Projection) -> None:
    assert pickle.loads(pickle.dumps(OPERATORS[projection])) == OPERATORS[projection]
