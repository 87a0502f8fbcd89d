"""The free part of a table by more factors is that of a new decomposition with them."""

from qe.decomposition.decompose import decompose
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.refined import refined
from qe.decomposition.sampled_cells import free_part
from qe.decomposition.sign_table import free_cells
from qe.io.text import read
from qe.options import Budget
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
    fine = refined(found, frozenset(levels), Budget())
    again = decompose(read(text), ("a", "b", "x"), EXISTS, budget=Budget(), thom_levels=frozenset(levels))
    assert fine is not None and fine.factors == free_part(again.table).factors
    assert list(free_cells(fine)) == list(free_cells(again.table))


def test_nullified_factors_and_constraints_ask_for_a_new_decomposition() -> None:
    order, quantifiers, budget = ("a", "b", "c", "x"), ("", "", "", "E"), Budget()
    nullified = decompose(read("a*x^2 + b*x + c > 0 and x > 1"), order, quantifiers, budget=budget, operator=LAZARD)
    assert refined(nullified, frozenset({2}), budget) is None
    text = "a*x^2 + b*x + 1 = 0 and x^2 + a*x + b = 0 and x > c"
    assert refined(decompose(read(text), order, quantifiers, budget=budget), frozenset({0}), budget) is None
