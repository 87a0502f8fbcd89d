"""Whatever the projection, the tactics and the order of a decomposition: the same answer, and a certificate for it."""

from __future__ import annotations

from itertools import groupby, permutations, product

import pytest

import qe
from qe.certify.verify import verify
from qe.decomposition.decompose import Tactics, decompose
from qe.decomposition.formulas import construct
from qe.decomposition.operators.table import OPERATORS
from qe.decomposition.order import choose_order
from qe.exact.ring import Ring
from qe.formula.build import convert, exists, forall
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget, Projection
from qe.proof.certificate import Certificate

PROBLEMS = {
    "quadratic": ("x^2 + b*x + c = 0", "b c x", "..E", "b^2 >= 4*c"),
    "strict": ("x^2 + y^2 < 1 and x + y > a", "a x y", ".EE", "a^2 < 2 or a < 0"),
    "weak universal": ("x^2 + y^2 + a*x >= -1", "a x y", ".AA", "a^2 <= 4"),
    "a constraint": ("y^2 = x and y > a", "a x y", ".EE", "true"),
    "a constraint and a bound": ("y^3 = x and y^2 < 2 and y > 0", "x y", ".E", "x > 0 and x^2 < 8"),
    "two constraints": ("x^2 + y^2 = a and x*y = 1 and y > x", "a x y", ".EE", "a > 2"),
    "three constraints": ("z = x*y and y^2 = x and z^2 = a and z > 0", "a x y z", ".EEE", "a > 0"),
    "constraints below": ("x^2 = 2 and y^2 = x and z*y > a", "a x y z", ".EEE", "true"),
    "implication": ("x^2 + y^2 /= a or x*y /= 1 or y <= x", "a x y", ".AA", "a <= 2"),
    "disjunction of equations": ("(y = x or y = -x) and x^2 + y^2 = a and y > 1", "a x y", ".EE", "a > 2"),
    "alternation": ("y^2 = x or x < 0", "x y", "AE", "true"),
    "constraint under alternation": ("y^2 = x and y > z", "z x y", "AEE", "true"),
    "nullified constraint": ("a*x + b = 0 and x > 0", "a b x", "..E", "a*b < 0 or a = 0 and b = 0"),
    "curtain": ("x*z + y = 0 and x^2 + y^2 = 0 and z > a", "a x y z", ".EEE", "true"),
}
TACTICS = {
    "all": Tactics(),
    "no constraints": Tactics(constraints=False),
    "whole stacks": Tactics(partial=False),
    "sections everywhere": Tactics(open_only=False),
    "the whole free space": Tactics(whole_free=True),
    "no bisection": Tactics(monotone=False),
    "nothing": Tactics(constraints=False, partial=False, open_only=False),
}


def _setting(name: str) -> tuple[Formula, tuple[str, ...], tuple[str, ...], str]:
    text, order, quantifiers, expected = PROBLEMS[name]
    return read(text), tuple(order.split()), tuple(q.replace(".", "") for q in quantifiers), expected


def _check(name: str, order: tuple[str, ...], tactics: Tactics, projection: Projection) -> None:
    matrix, _, quantifiers, expected = _setting(name)

    def table(levels: frozenset[int] = frozenset()) -> object:
        given = {"operator": OPERATORS[projection], "thom_levels": levels, "tactics": tactics}
        return decompose(matrix, order, quantifiers, budget=Budget(20), **given).table  # type: ignore[arg-type]

    answer, proof = construct(table(), table)  # type: ignore[arg-type]
    free = tuple(v for v, q in zip(order, quantifiers, strict=True) if not q)
    assert qe.equivalent(convert(answer, Ring.of(free)), expected)
    assert str(verify(Certificate.cells(proof, answer))) == "accepted"


@pytest.mark.parametrize("projection", list(Projection))
@pytest.mark.parametrize("tactics", TACTICS)
@pytest.mark.parametrize("name", PROBLEMS)
def test_tactics_and_projections(name: str, tactics: str, projection: Projection) -> None:
    _check(name, _setting(name)[1], TACTICS[tactics], projection)


@pytest.mark.parametrize("name", PROBLEMS)
def test_orders(name: str) -> None:
    """Every order that keeps the blocks apart."""
    _, order, quantifiers, _ = _setting(name)
    blocks = [[v for v, _ in part] for _, part in groupby(zip(order, quantifiers, strict=True), key=lambda p: p[1])]
    for chosen in product(*(permutations(block) for block in blocks)):
        _check(name, tuple(v for block in chosen for v in block), Tactics(), Projection.BROWN_MCCALLUM)


@pytest.mark.parametrize("written", [False, True])
@pytest.mark.parametrize("name", PROBLEMS)
def test_chosen_orders_keep_the_blocks(name: str, written: bool) -> None:
    matrix, order, quantifiers, _ = _setting(name)
    blocks = [[v for v, _ in part] for _, part in groupby(zip(order, quantifiers, strict=True), key=lambda p: p[1])]
    chosen, reason = choose_order(matrix, blocks, written=written, budget=Budget())
    assert reason
    for block in blocks:
        assert set(chosen[: len(block)]) == set(block)
        chosen = chosen[len(block) :]
    assert not chosen


@pytest.mark.parametrize("name", PROBLEMS)
def test_coverings_say_the_same(name: str) -> None:
    """The other decomposition, by intervals that overlap."""
    matrix, order, quantifiers, expected = _setting(name)
    formula = matrix
    for variable, quantifier in reversed(list(zip(order, quantifiers, strict=True))):
        formula = formula if not quantifier else (exists if quantifier == "E" else forall)((variable,), formula)
    answer = qe.eliminate(formula, method="coverings", check=True, process=False)
    assert qe.equivalent(answer, expected)
    assert answer.guarantee.name == "CHECKED"
