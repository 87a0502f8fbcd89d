"""Cell tables as certificates: where sectors suffice, and tables that say something else refused."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.kernel.cells import check_cells, sectors_suffice
from qe.options import Budget
from qe.proof.cells import Cell, CellTable, Stack
from tests.certificates.producing import cell_table, table_in


def made(text: str, order: str, quantifiers: str = "") -> CellTable:
    return table_in(cell_table(text, order, quantifiers))


def check(table: CellTable, answer: Formula | None = None, *given: Formula) -> None:
    check_cells(table, answer, given, Budget())


@pytest.mark.parametrize(
    ("text", "quantifiers", "level", "enough"),
    [
        ("x^2 < y and x*y /= 1", "EE", 0, True),
        ("x^2 < y and x*y /= 1", "EE", 1, True),
        ("x^2 < y or x*y > 1", ".E", 1, True),
        ("x^2 < y or x*y > 1", "AE", 1, True),
        ("x^2 < y or x*y > 1", "AE", 0, False),
        ("x^2 < y or x*y >= 1", "EE", 0, False),
        ("x^2 < y or x*y = 1", "EE", 1, False),
        ("x^2 <= y or x*y = 1", "AA", 0, True),
        ("x^2 <= y and x*y >= 1", "AA", 1, True),
        ("x^2 <= y and x*y > 1", "AA", 1, False),
        ("x^2 <= y and x*y /= 1", "AA", 1, False),
        ("x^2 < y", ".A", 1, False),
        ("x^2 <= y", ".E", 1, False),
        ("x^2 <= y", "EA", 0, False),
        ("x^2 < y", "AE", 0, False),
        ("not (x^2 < y and x > 0) and y > 0", "EE", 0, False),
    ],
)
def test_where_sectors_suffice(text: str, quantifiers: str, level: int, enough: bool) -> None:
    table = made("x^2 < y", "x y")
    asked = replace(table, matrix=read(text), quantifiers=tuple(q.replace(".", "") for q in quantifiers))
    assert sectors_suffice(asked, level) is enough


CASES = [
    ("x^2 + y^2 < 1 and x > 2", "x y", "EE"),
    ("x^2 + y^2 < 1", "x y", ".."),
    ("x^2 + y^2 < 1", "x y", ".E"),
    ("x^2 + y^2 <= 1 and x = y", "x y", "EA"),
]


SHARED = [
    ("y > x^2 or y < x", "x y", ".."),  # two factors with common roots
    ("y^2 = x and x*y > 1", "x y", ".E"),  # a constraint
    ("(x - y)^2 > 1 and x + y >= 0 and x*y = 1", "x y", "EE"),
    ("x*y^2 - y + 1 = 0", "x y", ".."),  # the degree drops
]


@pytest.mark.parametrize("case", [*CASES, *SHARED])
def test_tables_as_they_are_made(case: Any) -> None:
    check(made(*case))


def changed(cell: Cell, place: tuple[int, ...], **parts: Any) -> Cell:
    """The cell tree with one cell changed."""
    if not place:
        return replace(cell, **parts)
    assert cell.stack is not None
    cells = list(cell.stack.cells)
    cells[place[0]] = changed(cells[place[0]], place[1:], **parts)
    return replace(cell, stack=replace(cell.stack, cells=tuple(cells)))


def places(cell: Cell, place: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    below = cell.stack.cells if cell.stack is not None else ()
    return [place, *(p for k, c in enumerate(below) for p in places(c, (*place, k)))]


def at(cell: Cell, place: tuple[int, ...]) -> Cell:
    for k in place:
        assert cell.stack is not None
        cell = cell.stack.cells[k]
    return cell


@pytest.mark.parametrize("case", CASES)
def test_no_truth_value_and_no_sign_can_be_turned(case: Any) -> None:
    given = made(*case)
    for place in places(given.root):
        cell = at(given.root, place)
        others: list[dict[str, Any]] = [{"truth": not cell.truth}] if cell.truth is not None else []
        for k, sign in enumerate(cell.signs):
            others += [{"signs": cell.signs[:k] + s + cell.signs[k + 1 :]} for s in "+-0?" if s != sign]
        for other in others:
            table = replace(given, root=changed(given.root, place, **other))
            with pytest.raises(CertificateRejected):
                check(table)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda t: replace(t, quantifiers=("", "")), "no truth value|differs|follows"),
        (lambda t: replace(t, quantifiers=("",)), "one entry per variable"),
        (lambda t: replace(t, quantifiers=("", "U")), 'expected "", "E" or "A"'),
        (lambda t: replace(t, quantifiers=("E", "")), "a free variable after a quantified one"),
        (lambda t: replace(t, quantifiers=("", "A")), "does not follow from the signs"),
        (lambda t: replace(t, root=replace(t.root, signs="+")), "the whole space has no signs"),
        (lambda t: replace(t, matrix=read("x^2 + y^2 > 1")), "does not follow from the signs"),
        (lambda t: replace(t, root=replace(t.root, stack=None)), "no truth value"),
    ],
)
def test_other_claims_on_the_same_cells(change: Any, reason: str) -> None:
    given = made("x^2 + y^2 < 1", "x y", ".E")
    table: CellTable = change(given)
    with pytest.raises(CertificateRejected, match=reason):
        check(table)


def test_between_the_sections_of_a_constraint_nothing_is_decomposed() -> None:
    """There the signs of the other factors are not known: a truth value found below would say nothing."""
    given = made("y^2 = x and y*z = 1", "x y z", ".EE")
    root = given.root
    open_sectors = [p for p in places(root) if p and "?" in at(root, p).signs]
    assert open_sectors
    for place in open_sectors:
        stack = at(root, place[:-1]).stack
        assert stack is not None
        y = stack.sectors[place[-1] // 2]
        cells = tuple(Cell(sign, False) for sign in ("-0+" if y > 0 else "+0-"))
        above = Stack((0,), (Fraction(),), (), (Cell("-", False),))  # the right one
        if y:
            above = Stack((0,), (1 / y - 1, 1 / y + 1), ((0,),), cells)
        table = replace(given, root=changed(root, place, stack=above))
        with pytest.raises(CertificateRejected, match="may change its sign or order"):
            check(table)


@pytest.mark.parametrize("case", [*SHARED[1:3], ("y^2 = x and y*z = 1", "x y z", ".EE")])
def test_no_section_can_list_other_factors(case: Any) -> None:
    """Also factors besides a constraint's, which have no branch of their own: refused, with no other error."""
    given = made(*case)
    for place in places(given.root):
        stack = at(given.root, place).stack
        count = len(given.factors[len(place)]) if stack is not None else 0
        for k, section in enumerate(stack.sections if stack is not None else ()):
            subsets = [s for size in (1, 2) for s in combinations(range(count), size) if s != section]
            for other in subsets[:6]:
                assert stack is not None
                sections = (*stack.sections[:k], other, *stack.sections[k + 1 :])
                root = changed(given.root, place, stack=replace(stack, sections=sections))
                with pytest.raises(CertificateRejected):
                    check(replace(given, root=root))


def over(text: str) -> Formula:
    return convert(read(text), Ring.of(("x", "y")))


def test_the_answer_has_the_truth_of_the_cells() -> None:
    given = made("x^2 + y^2 < 1", "x y", ".E")
    check(given, over("x - 1 < 0 and x + 1 > 0"))
    for wrong in ("x + 1 > 0", "x - 1 <= 0 and x + 1 > 0", "false", "true"):
        with pytest.raises(CertificateRejected, match="differs from the truth value"):
            check(given, over(wrong))


def test_where_what_is_given_is_false_the_answer_and_the_cells_say_nothing() -> None:
    given = made("x^2 + y^2 < 1", "x y", ".E")
    check(given, over("true"), over("x - 1 < 0 and x + 1 > 0"))
    check(given, over("false"), over("x - 1 >= 0"))
    check(given, over("x + 1 > 0"), over("x - 1 < 0"))
    for answer, fact in (("true", "x - 1 < 0"), ("false", "x + 1 >= 0"), ("true", "x - 2 < 0"), ("true", "x - 1 <= 0")):
        with pytest.raises(CertificateRejected, match="differs from the truth value"):
            check(given, over(answer), over(fact))
    open_right = replace(given, root=changed(given.root, (4,), truth=None, stack=None))
    check(open_right, over("true"), over("x - 1 < 0 and x + 1 > 0"))
    for facts in ((), (over("x + 1 > 0"),)):
        with pytest.raises(CertificateRejected, match="no truth value"):
            check(open_right, over("x - 1 < 0 and x + 1 > 0"), *facts)
