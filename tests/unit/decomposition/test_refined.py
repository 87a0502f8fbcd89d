"""The free part of a table by more factors is that of a new decomposition with them."""

from fractions import Fraction

from qe import decide
from qe.decomposition.decompose import decompose
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.refined import refined
from qe.decomposition.sampled_cells import free_part
from qe.decomposition.sign_table import free_cells
from qe.elimination.critical.block import Tabulated, eliminate_block
from qe.formula.syntax import Exists
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import CellTable
from tests.tables import each

EXISTS = ("", "", "E")


@each(
    ("b*x^2 + (3*a + 1)*x + b <= 0 and x > 0", {0}),
    ("a*x^2 - (3*a + 1)*x + b > 0 and x < 1", {0, 1}),
    ("x^3 + a*x + b >= 0 and x < 1", {1}),
    ("x^3 + a*x + b >= 0 and x < 1", {0, 1}),
)
def test_cells_are_those_of_a_new_decomposition(text: str, levels: set[int]) -> None:
    found = decompose(read(text), ("a", "b", "x"), EXISTS, budget=Budget())
    fine = refined(free_part(found.table), found.operator, frozenset(levels), Budget())
    again = decompose(read(text), ("a", "b", "x"), EXISTS, budget=Budget(), thom_levels=frozenset(levels))
    assert fine is not None and fine.factors == free_part(again.table).factors
    assert list(free_cells(fine)) == list(free_cells(again.table))


@each("a*x^2 + b*x + c > 0 and x > 1", "(a - b)*x >= c and x^2 < b", "a*b*x + c*(a - 1) = 0 and x > b", "c*a >= b*x")
def test_nullified_factors_have_the_sections_of_their_lazard_evaluations(text: str) -> None:
    """Their truths are known, but derivatives need not tell these sections apart."""
    order, quantifiers, budget = ("a", "b", "c", "x"), ("", "", "", "E"), Budget()
    found = decompose(read(text), order, quantifiers, budget=budget, operator=LAZARD)
    table = free_part(found.table)
    assert "a*x" not in text or refined(table, LAZARD, frozenset({2}), budget) is None
    a, b, c = (table.factors[0][0].ring.gen(i) for i in range(3))
    fine = refined(table, LAZARD, frozenset(), budget, (2 * a - 1, b - 3, c + a))
    assert fine is not None
    for one in free_cells(fine)[::31]:
        point = _sample(fine, one.path)
        if len(point) == 3:
            where = " and ".join(f"{name} = {value}" for name, value in zip(("a", "b", "c"), point, strict=True))
            assert decide(f"ex a, b, c. {where} and (ex x. {text})") is one.truth


def _sample(table: CellTable, path: tuple[int, ...]) -> list[Fraction]:
    """Its rational coordinates: all of them for an open cell."""
    values, cell = [], table.root
    for position in path:
        assert cell.stack is not None
        if position % 2:
            return []
        values.append(cell.stack.sectors[position // 2])
        cell = cell.stack.cells[position]
    return values


def test_other_operators_and_constraints_ask_for_a_new_decomposition() -> None:
    order, quantifiers, budget = ("a", "b", "c", "x"), ("", "", "", "E"), Budget()
    table = free_part(decompose(read("a*x^2 + b*x + c > 0 and x > 1"), order, quantifiers, budget=budget).table)
    assert refined(table, BROWN_MCCALLUM, frozenset({2}), budget) is None
    text = "a*x^2 + b*x + 1 = 0 and x^2 + a*x + b = 0 and x > c"
    found = decompose(read(text), order, quantifiers, budget=budget)
    assert refined(free_part(found.table), found.operator, frozenset({0}), budget) is None


@each(
    "ex x, y. x^2+y^2<=1 and (x-a)^2+(y-b)^2<=1 and (x+a)^2+(y-1)^2<=4",
    "ex x. (x - a)^2 < 1 and x^3 = b*x",
)
def test_planes_split_cells_that_keep_their_truth(text: str) -> None:
    block = read(text)
    assert isinstance(block, Exists)
    (part,) = eliminate_block(block.variables, block.body, ("a", "b"), budget=Budget())
    assert isinstance(part.found, Tabulated)
    a, b = (part.found.table.factors[0][0].ring.gen(i) for i in range(2))
    fine = part.found.refine(frozenset(), frozenset({3 * a - 1, 2 * b + a}))
    assert fine.root.stack is not None
    for x, cell in list(zip(fine.root.stack.sectors, fine.root.stack.cells[::2], strict=True))[::2]:
        assert cell.stack is not None
        for y, below in list(zip(cell.stack.sectors, cell.stack.cells[::2], strict=True))[::5]:
            question = f"ex a, b. a = {x} and b = {y} and ({text})"
            assert decide(question) is below.truth
