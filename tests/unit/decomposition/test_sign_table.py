"""Free cells of a table and the literals on them; whether an answer follows from the signs."""

import random
from dataclasses import replace
from itertools import product
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.decomposition.decompose import decompose
from qe.decomposition.follows import follows, is_listed
from qe.decomposition.formulas import Undistinguished, formula_of_cells
from qe.decomposition.matrix import compile_matrix, specialise
from qe.decomposition.sign_table import Columns, SignTable, free_cells
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Atom, Formula, Not, Or, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import CellTable, FreeCell
from tests.tables import each

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


@each(
    ("b < 0", True),
    ("b < 0 and b /= 0", True),
    ("b <= 0", False),
    ("b > 0", False),
    ("b < 1", False),
    ("b^3 < 0", True),
    ("b*(b^2) < 0 or b^2 < 0", True),
)
def test_whether_an_answer_follows(answer: str, right: bool) -> None:
    assert follows(read(answer), table("x^2 + b < 0", "b x", ("", "E"))) is right


@each(
    ("x^2 + b < 0", "b x", "E", "true", False),
    ("x^2 + b < 0", "b x", "E", "false", False),
    ("x^2 >= 0", "x", "A", "true", True),
    ("x^2 >= 0", "x", "A", "false", False),
    ("x^2 + b + c < 0", "b c x", "E", "b + c < 0", True),
    ("x^2 + b + c < 0", "b c x", "E", "b + c <= 0", False),
    ("x^2 < 2", "x", "", "x > root(1, x^2 - 2)", True),  # of root atoms only the polynomials are looked at
    ("x^2 < 2", "x", "", "x > root(1, x^2 - 3)", False),
)
def test_answers_that_a_table_gives(text: str, order: str, last: str, answer: str, given: bool) -> None:
    free = ("",) * (len(order.split()) - 1)
    assert follows(read(answer), table(text, order, (*free, last))) is given


@each(("b + 1 < 0", False), ("b^2 > 0", True))
def test_answers_whose_polynomials_are_listed(answer: str, listed: bool) -> None:
    assert is_listed(read(answer), table("x^2 + b < 0", "b x", ("", "E"))) is listed


def test_polynomials_of_huge_degree_are_told_apart() -> None:
    """The cost of x^1000 outweighed that it excludes a cell, and a literal that excludes nothing was chosen."""
    listed = [("++", True), ("-+", False), ("+-", False)]
    cells = [FreeCell((k,), (signs,), truth) for k, (signs, truth) in enumerate(listed)]
    found = formula_of_cells([[X**1000 - Y, X**2000 - Y]], cells)
    assert len(conjuncts(found)) == 2
    assert holds_at(found, {"x": 2, "y": 0}) and not holds_at(found, {"x": 2, "y": 2**1500})


def test_two_cases_of_signs_are_one_product() -> None:
    cells = [FreeCell((i, j), (x, y), x + y in ("+-", "-+")) for i, x in enumerate("-0+") for j, y in enumerate("-0+")]
    assert formula_of_cells([[X], [-Y]], cells) == read("x*y > 0")
    cells = [replace(c, truth=not c.truth) for c in cells]
    assert formula_of_cells([[X], [Y]], cells) == read("x*y >= 0")


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 2**27 - 2))
def test_formulas_hold_on_the_true_cells_alone(truths: int) -> None:
    rows = list(product("-0+", repeat=3))
    cells = [FreeCell((k,), ("".join(row),), bool(truths >> k & 1)) for k, row in enumerate(rows)]
    ring = Ring.of("xyz")
    found = formula_of_cells([[ring.gen(0), -ring.gen(1), ring.gen(2)]], cells)
    for row, cell in zip(rows, cells, strict=True):
        x, y, z = ("-0+".index(sign) - 1 for sign in row)
        assert holds_at(found, {"x": x, "y": -y, "z": z}) is cell.truth


def test_all_cells_at_once_as_one_by_one() -> None:
    """Signs that are not known among them; products with even and odd exponents, and negative units."""
    rng, polys = random.Random(5), (X, Y, X + Y, X - 2)

    def part(depth: int) -> Formula:
        if depth and rng.random() < 0.7:
            return rng.choice([And, Or])(tuple(part(depth - 1) for _ in range(3)))
        if depth and rng.random() < 0.2:
            return Not(part(depth - 1))
        term = prod((p ** rng.randint(1, 2) for p in rng.sample(polys, rng.randint(1, 3))), start=RING.constant(1))
        return Atom(rng.choice([term, -term]), rng.choice(list(Relation)))

    places = {p: (0, j) for j, p in enumerate(polys)}
    for _ in range(200):
        rows, claim = ["".join(rng.choices("+-0?", k=4)) for _ in range(9)], part(3)
        columns = Columns([FreeCell((k,), (row,), True) for k, row in enumerate(rows)], [polys])
        true, false = columns.where(claim)
        for k, row in enumerate(rows):
            signs = {j: {"+": 1, "-": -1, "0": 0}[c] for j, c in enumerate(row) if c != "?"}
            known = specialise(compile_matrix(claim, places), 0, signs)
            assert (bool(true >> k & 1), bool(false >> k & 1)) == (known is True, known is False)


def test_cells_of_one_sign_name_the_level_at_which_they_part() -> None:
    cells = [FreeCell((0, 2), ("+", "-"), True), FreeCell((0, 4), ("+", "-"), False), FreeCell((1,), ("0",), False)]
    with pytest.raises(Undistinguished) as raised:
        formula_of_cells([[X], [Y]], cells)
    assert raised.value.level == 1
    shallow = [FreeCell((0,), ("+",), True), FreeCell((2, 1), ("+", "0"), False)]
    with pytest.raises(Undistinguished) as raised:
        formula_of_cells([[X], [Y]], shallow)
    assert raised.value.level == 0
