"""Free cells of a table and the literals on them; whether an answer follows from the signs."""

from __future__ import annotations

import random

import pytest

from qe.decomposition import follows as following
from qe.decomposition import matrix
from qe.decomposition.decompose import decompose
from qe.decomposition.follows import follows, is_listed
from qe.decomposition.formulas import formula_of_cells
from qe.decomposition.matrix import Node, join, specialise
from qe.decomposition.sign_table import SignTable, free_cells
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import CellTable, FreeCell

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)


def table(text: str, order: str, quantifiers: tuple[str, ...]) -> CellTable:
    ring = Ring.of(order.split())
    return decompose(convert(read(text), ring), ring.names, quantifiers, budget=Budget()).table


def test_free_cells_in_their_order() -> None:
    found = list(free_cells(table("x^2 < 2", "x", ("",))))
    assert [c.path for c in found] == [(k,) for k in range(5)]
    assert [c.truth for c in found] == [False, False, True, False, False]
    assert [c.signs for c in found] == [("+",), ("0",), ("-",), ("0",), ("+",)]


def test_quantified_levels_are_not_walked() -> None:
    found = list(free_cells(table("x^2 + b < 0", "b x", ("", "E"))))
    assert [c.truth for c in found] == [True, False, False] and {len(c.path) for c in found} == {1}
    assert [c.truth for c in free_cells(table("x^2 < 0", "x", ("E",)))] == [False]


def test_signs_that_a_stack_does_not_need_are_not_known() -> None:
    found = table("x > 0 and y > 0 or x < 0 and y + 1 > 0", "x y", ("", ""))
    assert [str(f) for f in found.factors[1]] == ["Poly(y)", "Poly(y + 1)"]
    signs = [c.signs for c in free_cells(found)]
    assert signs == [*(("-", f"?{c}") for c in "-0+"), ("0",), *(("+", c) for c in "-0+")]


CELLS = [
    FreeCell((0,), ("-",), True),
    FreeCell((1,), ("0",), True),
    FreeCell((2,), ("+",), False),
    FreeCell((3,), ("",), False),
]


def test_literals_by_their_cells() -> None:
    found = {a.relation: a for a in SignTable([[X]], CELLS).literals}
    assert set(found) == {Relation.LE, Relation.EQ, Relation.LT}  # the others exclude nothing, or cover nothing
    assert (found[Relation.LE].holds, found[Relation.LE].keeps) == (0b11, 0b10)
    assert (found[Relation.LT].holds, found[Relation.LT].keeps) == (0b01, 0b10)
    assert (found[Relation.EQ].holds, found[Relation.EQ].keeps) == (0b10, 0b10)
    assert found[Relation.LE].poly == X and found[Relation.LE].cost == 2


def test_a_sign_that_is_not_known_covers_nothing_and_excludes_nothing() -> None:
    cells = [FreeCell((0,), ("",), True), FreeCell((1,), ("+",), True), FreeCell((2,), ("",), False)]
    assert SignTable([[X]], cells).literals == []
    deeper = SignTable([[X], [Y]], [FreeCell((0,), ("+",), True), FreeCell((1,), ("-", "+"), False)])
    assert all(a.poly == X for a in deeper.literals)


@pytest.mark.parametrize(
    ("answer", "right"),
    [
        ("b < 0", True),
        ("b < 0 and b /= 0", True),
        ("b <= 0", False),
        ("b > 0", False),
        ("b < 1", False),
        ("b^3 < 0", True),
        ("b*(b^2) < 0 or b^2 < 0", True),
    ],
)
def test_whether_an_answer_follows(answer: str, right: bool) -> None:
    assert follows(read(answer), table("x^2 + b < 0", "b x", ("", "E"))) is right


def test_answers_that_are_constants() -> None:
    whole = table("x^2 + b < 0", "b x", ("", "E"))
    assert not follows(TRUE, whole) and not follows(FALSE, whole)
    assert follows(TRUE, table("x^2 >= 0", "x", ("A",))) and not follows(FALSE, table("x^2 >= 0", "x", ("A",)))
    assert not is_listed(read("b + 1 < 0"), whole) and is_listed(read("b^2 > 0"), whole)


def test_two_free_variables() -> None:
    whole = table("x^2 + b + c < 0", "b c x", ("", "", "E"))
    assert follows(read("b + c < 0"), whole) and not follows(read("b + c <= 0"), whole)


def test_of_root_atoms_only_the_polynomials_are_looked_at() -> None:
    whole = table("x^2 < 2", "x", ("",))
    assert follows(read("x > root(1, x^2 - 2)"), whole) and not follows(read("x > root(1, x^2 - 3)"), whole)


def test_polynomials_of_huge_degree_are_told_apart() -> None:
    """The cost of x^1000 outweighed that it excludes a cell, and a literal that excludes nothing was chosen."""
    listed = [("++", True), ("-+", False), ("+-", False)]
    cells = [FreeCell((k,), (signs,), truth) for k, (signs, truth) in enumerate(listed)]
    found = formula_of_cells([[X**1000 - Y, X**2000 - Y]], cells)
    assert len(conjuncts(found)) == 2
    assert holds_at(found, {"x": 2, "y": 0}) and not holds_at(found, {"x": 2, "y": 2**1500})


def test_the_cells_of_a_stack_at_once_as_one_by_one() -> None:
    rng = random.Random(5)

    def node(depth: int) -> Node:
        if depth and rng.random() < 0.7:
            return join(rng.random() < 0.5, [node(depth - 1) for _ in range(3)])
        parts = tuple((1, j, rng.random() < 0.5) for j in rng.sample(range(4), rng.randint(1, 3)))
        return matrix.Test(parts, frozenset(rng.sample((-1, 0, 1), rng.randint(1, 2))))

    for _ in range(200):
        rows, asked = ["".join(rng.choices("+-0", k=4)) for _ in range(9)], node(3)
        columns = following._columns(rows, range(4))
        assert columns is not None
        found = following._where_true(asked, columns, (1 << len(rows)) - 1)
        signs = [{j: {"+": 1, "-": -1, "0": 0}[c] for j, c in enumerate(row)} for row in rows]
        one_by_one = [specialise(asked, 1, sign) for sign in signs]
        assert [bit == "1" for bit in f"{found:09b}"] == one_by_one


def test_signs_that_are_not_known_have_no_columns() -> None:
    assert following._columns(["+?", "-0"], range(2)) is None
