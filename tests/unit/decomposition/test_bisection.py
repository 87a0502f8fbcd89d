"""Decompositions that look at less: values told apart by bisection, and sectors only."""

import random
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.certify.verify import verify
from qe.decomposition.decompose import Tactics, decompose
from qe.decomposition.lifting import sector_levels
from qe.exact.ring import Ring, format_poly
from qe.formula.build import atom, conj, convert, disj
from qe.formula.monotone import direction
from qe.formula.syntax import Formula, Relation
from qe.io.text import read
from qe.kernel.cells import one_way
from qe.options import Budget, Projection
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate
from tests.tables import each

# Where the truth changes only once along the last free variable, that place is found by bisection, and checked.

ORDER = ("m", "x", "y")


def table(matrix: Formula, quantifiers: str = "EA", *, monotone: bool = True) -> CellTable:
    kinds = ("", *quantifiers)
    return decompose(matrix, ORDER, kinds, budget=Budget(), tactics=Tactics(monotone=monotone)).table


def truths(cell: Cell, depth: int = 1) -> list[bool | None]:
    if cell.stack is None or not depth:
        return [cell.truth]
    return [truth for below in cell.stack.cells for truth in truths(below, depth - 1)]


def undecomposed(cell: Cell, depth: int = 1) -> int:
    if not depth or cell.stack is None:
        return int(cell.stack is None)
    return sum(undecomposed(below, depth - 1) for below in cell.stack.cells)


QUESTION = "m >= x^2 + y^2 + 1 and x*y >= 1 and x <= 4"


@each((QUESTION, 1), (QUESTION.replace("m", "(-m)"), -1))
def test_one_change_along_the_last_free_variable(text: str, way: int) -> None:
    matrix = convert(read(text), Ring.of(ORDER))
    whole, part = table(matrix, "EE", monotone=False), table(matrix, "EE")
    assert direction(matrix, 0) == one_way(part, 0) == way
    assert truths(whole.root) == truths(part.root)
    assert undecomposed(part.root) > undecomposed(whole.root)
    assert verify(Certificate.cells(part, None)).accepted


@each(
    ("m > x", 1),
    ("m <= x", -1),
    ("m*x^2 > 1 and y > 0", 1),
    ("m*x > 1", 0),
    ("m^2 > x", 0),
    ("x > m*y^2", -1),
    ("m*y^2 >= x and m > 1", 1),
    ("m*(x^2 + 1) <= x or m < y", -1),
    ("m^3 + m > x or x < 0", 1),
    ("m > x and m < y", 0),
    ("m = x", 0),
    ("x > y", 0),
)
def test_directions(text: str, way: int) -> None:
    matrix = convert(read(text), Ring.of(ORDER))
    claimed = CellTable(ORDER, ("", "E", "E"), matrix, Projection.LAZARD, ((), (), ()), Cell("", None))
    assert direction(matrix, 0) == way and one_way(claimed, 0) == (way or int(text == "x > y"))


def random_matrix(rng: random.Random) -> Formula:
    ring = Ring.of(ORDER)
    m, x, y = (ring.gen(i) for i in range(3))
    parts = []
    for _ in range(rng.choice((2, 3))):
        slope = rng.choice((ring.constant(1), ring.constant(2), x**2 + 1))
        rest = rng.choice((x, y, x * y, x**2 - y, x + y)) * rng.choice((1, -1, 2)) + rng.choice((0, 1, -2))
        parts.append(atom(m * slope + rest, rng.choice((Relation.GT, Relation.GE))))
    if rng.random() < 0.3:
        parts.append(atom(x**2 + y - 1, rng.choice(tuple(Relation))))
    return rng.choice((conj, disj))(parts)


@settings(deadline=None, max_examples=12, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_the_same_truth_with_and_without(seed: int) -> None:
    rng = random.Random(seed)
    matrix, quantifiers = random_matrix(rng), rng.choice(("EE", "EA", "AE", "AA"))
    part, whole = (table(matrix, quantifiers, monotone=flag) for flag in (True, False))
    assert truths(part.root) == truths(whole.root)
    assert verify(Certificate.cells(part, None)).accepted


@each(True, False)
def test_an_altered_truth_is_refused(wanted: bool) -> None:
    part = table(convert(read(QUESTION), Ring.of(ORDER)), "EE")
    stack = part.root.stack
    assert stack is not None
    cells = list(stack.cells)
    k = next(k for k, cell in enumerate(cells) if cell.stack is None and cell.truth is wanted)
    cells[k] = replace(cells[k], truth=not wanted)
    altered = replace(part, root=replace(part.root, stack=replace(stack, cells=tuple(cells))))
    assert not verify(Certificate.cells(altered, None)).accepted


@each(True, False)
def test_truth_follows_from_decomposed_cells_alone(wanted: bool) -> None:
    """Cells that say the same, and of which none is decomposed, do not prove each other."""
    part = table(convert(read(QUESTION), Ring.of(ORDER)), "EE")
    stack = part.root.stack
    assert stack is not None and any(cell.stack is not None for cell in stack.cells if cell.truth is wanted)
    cells = tuple(replace(cell, stack=None) if cell.truth is wanted else cell for cell in stack.cells)
    altered = replace(part, root=replace(part.root, stack=replace(stack, cells=cells)))
    assert not verify(Certificate.cells(altered, None)).accepted


def test_a_direction_that_is_not_there_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """A producer that bisects where the truth changes twice."""
    import qe.decomposition.decompose as module

    monkeypatch.setattr(module, "direction", lambda matrix, x: 1)
    matrix = convert(read("m > x^2 and m < x^2 + 1 and x*y > 1"), Ring.of(ORDER))
    broken = table(matrix, "EE")
    assert undecomposed(broken.root) > undecomposed(table(matrix, "EE", monotone=False).root)
    assert not verify(Certificate.cells(broken, None)).accepted
    spared = replace(broken, root=table(matrix, "EE", monotone=False).root)
    assert verify(Certificate.cells(spared, None)).accepted


def test_an_answer_by_bisection_has_its_certificate() -> None:
    answer = qe.eliminate("ex x, y. m >= x^2*y - x and x^2 + y^2 >= 1 and x >= 2 - m and y < 0", check=True)
    assert not answer.unchecked_steps


# Strict problems: sections are left out, and answers and certificates stand.


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
