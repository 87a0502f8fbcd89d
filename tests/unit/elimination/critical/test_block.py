"""Truth sets of blocks by critical values, as tables and as convex bodies, against sets that are known."""

import pytest

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.operators.operator import Operator
from qe.elimination.critical import block
from qe.elimination.critical.block import Disjunct, Tabulated, eliminate_block
from qe.elimination.critical.table import Shape
from qe.errors import NotWellOriented, Unable
from qe.formula.syntax import Exists
from qe.io.text import read
from qe.options import Budget
from qe.proof.cells import CellTable
from tests.tables import each


def found(text: str, *parameters: str) -> list[Disjunct]:
    asked = read(text)
    assert isinstance(asked, Exists)
    return eliminate_block(asked.variables, asked.body, parameters, budget=Budget())


def truths(table: CellTable) -> dict[str, bool | None]:
    """The cells of a line: the values between the roots, and the truth there; what is at a root comes after it."""
    stack = table.root.stack
    assert stack is not None
    return {cell.signs: cell.truth for cell in stack.cells}


def test_a_convex_body() -> None:
    (part,) = found("ex x. (x - a)^2 <= 1 and x^2 <= 4", "a")
    made = part.found
    assert isinstance(made, Tabulated) and not made.unsettled
    assert truths(made.table) == {"--": False, "-0": True, "-+": True, "0+": True, "++": False}
    assert truths(made.refine(frozenset((0,)), frozenset())) == truths(made.table)
    a = made.table.factors[0][0].ring.gen(0)
    finer = truths(made.refine(frozenset(), frozenset((a,))))
    assert len(finer) == 7 and list(finer.values()).count(True) == 5


def test_an_unbounded_body() -> None:
    (part,) = found("ex x. (x - a)^2 <= 1 and x >= 0", "a")
    assert isinstance(part.found, Tabulated)
    assert truths(part.found.table) == {"-": False, "0": True, "+": True}


def test_any_set_as_a_table() -> None:
    (part,) = found("ex x. (x - a)^2 < 1 and x^3 = 4*x", "a")
    assert isinstance(part.found, Tabulated) and not part.found.unsettled
    stack = part.found.table.root.stack
    assert stack is not None
    at = dict(zip(stack.sectors, [c.truth for c in stack.cells[::2]], strict=True))
    assert at == {x: min(abs(x - r) for r in (-2, 0, 2)) < 1 for x in at} and set(at.values()) == {True, False}
    borders = [c.truth for c in stack.cells[1::2] if "0" in c.signs]
    assert False in borders, "a = 1 among others: the conditions are strict"


def test_a_single_point_is_no_body() -> None:
    (part,) = found("ex x. x^2 + a^2 <= 0", "a")
    assert isinstance(part.found, Tabulated) and truths(part.found.table) == {"-": False, "0": True, "+": False}


def test_irrational_points_off_which_it_is_false() -> None:
    """Decided at the points themselves: rational points next to them say no."""
    (part,) = found("ex x. x^2 + (a^2 - 2)^2 <= 0", "a")
    assert isinstance(part.found, Tabulated) and not part.found.unsettled
    assert truths(part.found.table) == {"+": False, "0": True, "-": False}


@each((" and x^2 <= 1", Shape.CONVEX), ("", Shape.CLOSED))
def test_in_space_only_bounded_convex_sets_are_taken_for_convex(
    more: str, shape: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The theorem about convex sets needs a bounded set there, and the projection whose order it looks at."""
    asked: list[tuple[Operator, Shape]] = []

    def recorded(levels: object, operator: Operator, boundary: object, shape: Shape, *_: object) -> None:
        asked.append((operator, shape))
        raise NotWellOriented("as if")

    monkeypatch.setattr(block, "TableBuilder", recorded)
    with pytest.raises(NotWellOriented):
        found(f"ex x. (x - a)^2 + b^2 + c^2 <= 1{more}", "a", "b", "c")
    assert asked == [(BROWN_MCCALLUM, shape), (LAZARD, Shape.CLOSED)]


def test_sentences_and_disjuncts() -> None:
    parts = found("ex x. x^2 <= 2 and x^2 = 2 or x^2 <= 1 and x > 2")
    assert [p.found for p in parts] == [True, False]
    assert str(parts[1].body) == "x^2 <= 1 and x > 2"


@each("ex x. x > a", "ex x. a*x = 1", "ex x. x^2 <= 1 or x > a")
def test_unbounded_fibres_are_refused(text: str) -> None:
    with pytest.raises(Unable, match="bounded"):
        found(text, "a")
