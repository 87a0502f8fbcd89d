"""Strict problems: sections are left out, and answers and certificates stand."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify
from qe.decomposition.decompose import decompose
from qe.decomposition.lifting import sector_levels
from qe.exact.ring import Ring, format_poly
from qe.formula.build import convert
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate
from tests.tables import each


@each(
    ("x < y and y /= 0", ("", "E"), 1),
    ("x < y and y /= 0", ("E", "E"), 0),
    ("x < y and y /= 0", ("A", "E"), 1),
    ("x <= y", ("", "E"), 2),
    ("x <= y or y = 1", ("", "A"), 1),
    ("x <= y or y > 1", ("", "A"), 2),
    ("x < y", ("", ""), 2),
)
def test_where_sections_can_be_left_out(text: str, quantifiers: tuple[str, ...], level: int) -> None:
    assert sector_levels(convert(read(text), Ring.of(("x", "y"))), quantifiers) == level


def _table(text: str, order: tuple[str, ...], quantifiers: tuple[str, ...]) -> CellTable:
    return decompose(read(text), order, quantifiers, budget=Budget()).table


def test_certificate_without_sections_is_accepted_only_for_strict_problems() -> None:
    strict = _table("x^2 + y^2 < 1 and x + y > 2", ("x", "y"), ("E", "E"))
    assert strict.root.truth is False
    assert verify(Certificate.cells(strict)).accepted
    weak = _table("x^2 + y^2 <= 1 and x + y >= 2", ("x", "y"), ("E", "E"))
    assert verify(Certificate.cells(weak)).accepted
    stack = weak.root.stack
    assert stack is not None
    forged = tuple(Cell(c.signs, None) if p % 2 else c for p, c in enumerate(stack.cells))
    table = replace(weak, root=replace(weak.root, stack=replace(stack, cells=forged)))
    assert not verify(Certificate.cells(table)).accepted


def test_a_solution_on_a_section_only_is_found() -> None:
    assert qe.decide("ex x, y. x^2 + y^2 <= 1 and x >= 1", method="cad")
    assert not qe.decide("ex x, y. x^2 + y^2 < 1 and x >= 1", method="cad")
    assert not qe.decide("all x. x^2 > 0", method="cad")


terms = st.dictionaries(st.tuples(st.integers(0, 2), st.integers(0, 2)), st.integers(-3, 3), min_size=1, max_size=4)


@settings(max_examples=25)
@given(terms, terms, st.sampled_from(["<", ">", "/="]), st.sampled_from(["<", ">", "/="]))
def test_strict_sentences_agree_with_substitution(f: dict, g: dict, r: str, s: str) -> None:
    ring = Ring.of(("x", "y"))
    text = f"{format_poly(ring.from_terms(f))} {r} 0 and {format_poly(ring.from_terms(g))} {s} 0"
    answer = qe.eliminate(f"ex x, y. {text}", method="cad", check=True)
    assert answer.truth == qe.decide(f"ex x, y. {text}")
    whole = qe.decide(f"all x, y. {text}", method="cad")
    assert whole == qe.decide(f"all x, y. {text}")
