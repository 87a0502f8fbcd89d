"""Stacks written by hand, over cells of one to three variables: the right ones with their signs, others refused."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.arithmetic.fibre import fibre
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.line import Line, Sample, line_over
from qe.kernel.neighbourhood import Neighbourhood
from qe.kernel.projection import Projected
from qe.options import Budget
from qe.proof.cells import Cell, Stack

BROWN, LAZARD = False, True
Place = int | tuple[str, int, int]
"""A sector, by its sample, or the section of the only root of a polynomial between two numbers."""


class Table:
    """Factors by level (``"x, x - 1; y^2 - x"``), and the cells over which stacks are put."""

    def __init__(self, factors: str, evaluates: bool = BROWN, constraints: tuple[tuple[int, ...], ...] = ()):
        levels = factors.split(";")
        self.ring = Ring.of(tuple("xyzw"[: len(levels)]))
        lists = FactorLists(self.ring, [[self.poly(f) for f in level.split(",") if f.strip()] for level in levels])
        self.lists, self.constraints = lists, constraints or ((),) * len(levels)
        self.projection = Projected(lists, Budget(), evaluates=evaluates)

    def poly(self, text: str) -> Poly:
        return convert(read(f"{text} = 0"), self.ring).poly  # type: ignore[attr-defined,no-any-return]

    def over(self, places: tuple[Place, ...]) -> Sample:
        sample = Sample(self.lists, Point(), {}, [], (0,))
        for k, place in enumerate(places):
            number: Fraction | Coordinate | None = Fraction(place) if isinstance(place, int) else None
            if isinstance(place, tuple):
                low, high = map(Fraction, place[1:])
                number = fibre(sample.point, self.poly(place[0]), k).squarefree().coordinate(low, high)
            assert number is not None
            sample = sample.extended(number, [], alone=isinstance(place, tuple))
            here = [sample.point.sign(sample.factor(k, i)) for i in range(len(self.lists.lists[k]))]
            sample = replace(sample, signs=[*sample.signs[:-1], here])
        return sample

    def checked(
        self,
        places: tuple[Place, ...],
        sectors: tuple[int, ...],
        *sections: tuple[int, ...],
        used: tuple[int, ...],
        above: bool = False,
    ) -> Line:
        cells = (Cell("", None, Stack((), (), (), ()) if above else None),) * (2 * len(sections) + 1)
        stack = Stack(used, tuple(map(Fraction, sectors)), sections, cells)
        return self.around(stack, self.over(places))

    def around(self, stack: Stack, sample: Sample) -> Line:
        """The line, and what holds of its cells around the sample."""
        constraint = frozenset(self.constraints[sample.depth])
        line = line_over(sample, stack, constraint, CertificateRejected, evaluates=self.projection.evaluates)
        around = Neighbourhood(line, sample.signs, self.projection)
        parts = around.parts()
        if not sample.is_alone:
            around.check_delineated(parts)
        self.samples = [around.sample_of(part) for part in parts]
        self.known = [around.known(part) for part in parts]
        around.check_cover(parts)
        return line

    def signs(
        self,
        places: tuple[Place, ...],
        sectors: tuple[int, ...],
        *sections: tuple[int, ...],
        used: tuple[int, ...] = (0,),
        above: bool = False,
    ) -> str:
        """The signs of all factors, cell by cell."""
        rows = self.checked(places, sectors, *sections, used=used, above=above).signs
        return " ".join("".join("?" if s is None else "0+-"[s] for s in row) for row in rows)

    def objection(
        self,
        places: tuple[Place, ...],
        sectors: tuple[int, ...],
        *sections: tuple[int, ...],
        used: tuple[int, ...] = (0,),
        above: bool = False,
    ) -> str:
        with pytest.raises(CertificateRejected) as caught:
            self.checked(places, sectors, *sections, used=used, above=above)
        return f"{caught.value.step}: {caught.value.reason}"


ZERO = ("x", -1, 1)
PARABOLA = Table("x; y^2 - x")


def test_a_parabola() -> None:
    assert PARABOLA.signs((1,), (-2, 0, 2), (0,), (0,)) == "+ 0 - 0 +"
    assert PARABOLA.signs((ZERO,), (-2, 2), (0,)) == "+ 0 +"
    assert PARABOLA.signs((-1,), (0,)) == "+"
    assert PARABOLA.signs((1,), (7,), used=()) == "?"  # on the last level what does not matter may be left out
    assert "missing" in PARABOLA.objection((1,), (5,))
    assert "no root here" in PARABOLA.objection((-1,), (0, 1), (0,))
    assert "missing" in PARABOLA.objection((ZERO,), (3,))
    assert PARABOLA.objection((1,), (-2, 1, 2), (0,), (0,)) == "sectors[1]: factor 0: it is zero at this sector sample"


def test_the_first_level_needs_no_projection() -> None:
    table = Table("x^2 - 2, x; y")
    assert table.signs((), (-2, -1, 1, 2), (0,), (1,), (0,), used=(0, 1)) == "+- 0- -- -0 -+ 0+ ++"
    assert (
        table.signs((), (-2, 0, 2), (0,), (0,), used=(0,)) == "+? 0? -? 0? +?"
    )  # nothing is known of what is left out


SHARED = Table("x^2 - 2, x; y - x, y^2 - 2")
ROOT, MINUS = ("x^2 - 2", 1, 2), ("x^2 - 2", -2, -1)


def test_common_roots_over_algebraic_and_rational_numbers() -> None:
    assert SHARED.signs((ROOT,), (-2, 0, 2), (1,), (0, 1), used=(0, 1)) == "-+ -0 -- 00 ++"
    assert SHARED.signs((MINUS,), (-2, 0, 2), (0, 1), (1,), used=(0, 1)) == "-+ 00 +- +0 ++"
    assert SHARED.signs((1,), (-2, 0, 2), (1,), (1,), used=(1,)) == "?+ ?0 ?- ?0 ?+"
    assert "have no common root there" in SHARED.objection((1,), (-2, 0, 2), (1,), (0, 1), used=(0, 1))
    assert "factor 0: it has no root here" in SHARED.objection((ROOT,), (-2, 0, 2), (0, 1), (0, 1), used=(0, 1))


def test_algebraic_factors_that_share_another_root_do_not_share_this_one() -> None:
    table = Table("x^2 - 2, x + 3; y^2 - 2, y^2 + x*y - 3*y - 3*x")  # the second is (y + x)*(y - 3)
    assert "no common root" in table.objection((ROOT,), (-2, 0, 4), (0, 1), (0, 1), used=(0, 1))
    assert table.signs((ROOT,), (-2, 0, 2, 4), (0, 1), (0,), (1,), used=(0, 1)) == "++ 00 -- 0- +- +0 ++"
    assert "no common root" in table.objection((1,), (-2, 0, 2, 4), (0, 1), (0,), (1,), used=(0, 1))


def test_a_resultant_that_is_zero_as_both_degrees_drop_shows_no_common_root() -> None:
    table = Table("x^2 - 2, 4*x^2 - 7, 4*x^3 - 8*x + 1, x - 1; (x^2 - 2)*y^2 + y - 1, (x^2 - 2)*y^2 + y - x")
    assert table.signs((ROOT,), (0, 2), (0,), used=(0,)) == "-? 0? +?"
    assert "no common root" in table.objection((ROOT,), (0, 2), (0, 1), used=(0, 1))


@pytest.mark.parametrize(
    ("sectors", "sections", "used", "objection"),
    [
        ((-2, 0, 2), ((0,), (0,)), (0, 0), "used: not an ascending list"),
        ((-2, 0, 2), ((0,), (0,)), (1,), "used: not an ascending list"),
        ((-2, 0, 2), ((0,), (0,)), (-1,), "used: not an ascending list"),
        ((), (), (0,), "sectors: no sector"),
        ((-2, -2, 2), ((0,), (0,)), (0,), "sectors[1]: the sector samples do not ascend"),
        ((2, 0), ((0,),), (0,), "sectors[1]: the sector samples do not ascend"),
        ((-2, 0, 2), ((0,),), (0,), "sections: 1 sections between 3 sectors"),
        ((-2, 0, 2, 3), ((0,), (0,), ()), (0,), "cells[4]: none of its factors has a root at its end"),
        ((-2, 0, 2), ((0,), (0, 0)), (0,), "sections[1]: not an ascending list"),
        ((-2, 0, 2), ((1,), (0,)), (0,), "sections[0]: not an ascending list of used factors"),
        ((-2, 0, 2), ((0,), (0,)), (), "sections[0]: not an ascending list of used factors"),
    ],
)
def test_shapes(
    sectors: tuple[int, ...], sections: tuple[tuple[int, ...], ...], used: tuple[int, ...], objection: str
) -> None:
    assert PARABOLA.objection((1,), sectors, *sections, used=used).startswith(objection)


def test_the_number_of_cells() -> None:
    stack = Stack((0,), (Fraction(0),), (), (Cell("", None),) * 2)
    with pytest.raises(CertificateRejected, match="2 cells where 1 are needed"):
        PARABOLA.around(stack, PARABOLA.over((-1,)))


ORIGIN = (ZERO, ("y", -1, 1))


def test_a_factor_zero_on_a_line_is_known_over_one_point_or_where_its_coefficients_are() -> None:
    table = Table("x; y; x*z + y")
    assert table.signs(ORIGIN, (0,)) == "0" and table.known == [{0}]
    assert table.signs((ZERO, 1), (0,)) == "+"
    assert table.signs((1, ("y", -1, 1)), (-1, 1), (0,)) == "- 0 +"
    assert "is zero on the whole line" in table.objection(ORIGIN, (0, 1), (0,))
    table = Table("x; y; z; x*w + y")
    assert table.signs((*ORIGIN, 1), (0,)) == "0" and table.known == [{0}]
    assert table.signs((*ORIGIN, ("z", -1, 1)), (0,)) == "0" and table.known == [{0}]
    table = Table("x; y; z; x*w + z - 1")
    assert table.signs((ZERO, 0, 1), (0,)) == "0" and table.known == [set()]  # nobody says that z stays 1


def test_lines_above_a_factor_that_is_zero_on_a_line_need_its_order() -> None:
    assert Table("x; y; x*z + y; w").signs(ORIGIN, (0,), above=True) == "0"  # order 1, as its derivative in y is 1
    table = Table("x; y; x^2 + y*z, z; w")  # order 1, but 2 where z is 0
    assert table.signs(ORIGIN, (0,), used=(0,), above=True) == "0?" and table.known == [set()]
    assert table.signs(ORIGIN, (0,), used=(0,)) == "0?" and table.known == [{0}]
    assert table.signs(ORIGIN, (-1, 1), (1,), used=(0, 1), above=True) == "0- 00 0+" and table.known == [{0, 1}] * 3
    table = Table("x; y; z; x*w + y; w")
    assert table.signs((*ORIGIN, 1), (0,), above=True) == "0" and table.known == [set()]  # over more than a point


def test_lazard_lifts_over_what_is_zero_on_a_line() -> None:
    table = Table("x; y; x*z + y", LAZARD)
    assert table.signs((ZERO, ("y", -1, 1)), (0,)) == "0"
    above = Table("x; y, y - 1; x*z + y - 1; w", LAZARD)
    assert above.checked((ZERO, ("y - 1", 0, 2)), (0,), used=(0,), above=True).zero == {0} and above.known == [{0}]


def test_no_point_of_a_cell_may_make_a_factor_zero() -> None:
    """Over x = 0 the leading coefficient says nothing, and that y has one sign is known only where y is a factor."""
    assert Table("x; y; x*z + y").signs((ZERO, 1), (0,)) == "+"
    assert "may vanish identically at a point" in Table("x; y - 7; x*z + y").objection((ZERO, 1), (0,))
    assert Table("x; y - 7; x*z + y").signs((1, 1), (-2, 2), (0,)) == "- 0 +"
    assert Table("x; y - 7; z; x*w + y").signs((ZERO, ("y - 7", 6, 8), 1), (0,)) == "+"  # known at (0, 7)
    assert Table("x; y - 7; x*z + 2").signs((ZERO, 1), (0,)) == "+"


CONSTRAINED = Table("x, x - 1; y^2 - x, y - 1", constraints=((), (0,)))


def test_a_constraint_has_the_only_sections() -> None:
    assert CONSTRAINED.signs((2,), (-2, 0, 2), (0,), (0,), used=(0, 1)) == "+? 0- -? 0+ +?"
    assert CONSTRAINED.signs((("x - 1", 0, 2),), (-2, 0, 2), (0,), (0,), used=(0, 1)) == "+? 0- -? 00 +?"
    assert CONSTRAINED.signs((-1,), (0,), used=(0, 1)) == "+?"
    found = CONSTRAINED.checked((2,), (-2, 0, 2), (0,), (0,), used=(0, 1))
    assert sorted(found.branches) == [0] and CONSTRAINED.known == [{0}, {0, 1}, {0}, {0, 1}, {0}]
    assert [sample is not None for sample in CONSTRAINED.samples] == [False, True, False, True, False]


def test_a_section_that_lists_a_factor_besides_the_constraint_s_is_refused_where_it_was_a_key_error() -> None:
    for sections in (((0,), (0, 1)), ((0,), (1,)), ((0, 1), (0,))):
        message = CONSTRAINED.objection((("x - 1", 0, 2),), (-2, 0, 2), *sections, used=(0, 1))
        assert re.fullmatch(r"sections\[\d\]: factor (1 is none of the constraint's|0: .* not listed)", message)


def test_where_its_constraint_does_not_restrict_a_line_all_is_needed() -> None:
    table = Table("x, x - 1; y^2 - x, y - 1, y - x - 5", constraints=((), (0,)))
    assert table.signs((2,), (0, 2), (1,), used=(1,)) == "?-? ?0? ?+?"
    assert "its resultant" in table.objection((2,), (0, 2, 8), (1,), (2,), used=(1, 2))
    assert table.signs((("x - 1", 0, 2),), (0, 2, 8), (1,), (2,), used=(1, 2)) == "?-- ?0- ?+- ?+0 ?++"
    nullified = Table("x; y; x*z + y, z", constraints=((), (), (0,)))
    assert nullified.signs(ORIGIN, (-1, 1), (1,), used=(0, 1)) == "0- 00 0+"


def test_where_a_section_is_decomposed_no_other_factor_is_zero_on_its_line() -> None:
    table = Table("x; y - 7, y + x; z - 1, x*z + y; w", constraints=((), (), (0,), ()))
    assert table.signs((ZERO, 1), (0, 2), (0,), used=(0, 1)) == "-? 0+ +?"
    assert "may vanish identically" in table.objection((ZERO, 1), (0, 2), (0,), used=(0, 1), above=True)
    table = Table("x; y, y + x; z - 1, x*z + y; w", constraints=((), (), (0,), ()))
    assert table.signs((1, 1), (0, 2), (0,), used=(0, 1), above=True) == "-? 0+ +?"
    assert table.signs((ZERO, 1), (0, 2), (0,), used=(0, 1), above=True) == "-? 0+ +?"


def test_numbers_of_sections() -> None:
    found = SHARED.checked((ROOT,), (-2, 0, 2), (1,), (0, 1), used=(0, 1))
    number = found.number(3)
    assert isinstance(number, Coordinate) and (number.index, number.poly) == (1, SHARED.poly("y - x"))
    found = PARABOLA.checked((ZERO,), (-2, 2), (0,), used=(0,))
    assert found.number(1) == 0 and found.number(2) == 2


Interval = tuple[int, int, int, tuple[int, ...] | None]


def objected(table: Table, places: tuple[Place, ...], sectors: tuple[int, ...], sections: str, *cells: Interval) -> str:
    """What is objected to intervals (first, last and sample's position, own factors); sections as "0 01 ." """
    listed = tuple(tuple(int(i) for i in section.strip(".")) for section in sections.split())
    used = tuple(sorted({i for section in listed for i in section}))
    intervals = tuple(Cell("", None, None, (first, last, at), own) for first, last, at, own in cells)
    try:
        table.around(Stack(used, tuple(map(Fraction, sectors)), listed, intervals), table.over(places))
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


RAYS = Table("x; y^2 - x, y - x - 5, y")
ROOTS = ((1,), (-2, 0, 2, 7), "0 0 1")
GOOD: tuple[Interval, ...] = ((0, 0, 0, (0,)), (1, 1, 1, (0,)), (2, 2, 2, (0,)), (3, 3, 3, (0,)), (4, 6, 6, (0,)))


def test_intervals_know_their_own_factors() -> None:
    assert objected(RAYS, *ROOTS, *GOOD) == "" and RAYS.known == [{0}] * 5
    cut: tuple[Interval, ...] = ((0, 2, 0, (0,)), *((p + 2, p + 2, p + 2, (0,)) for p in (1, 2, 3)), (6, 8, 8, (0,)))
    assert objected(RAYS, (1,), (-3, -2, 0, 2, 7), ". 0 0 1", *cut) == ""


@pytest.mark.parametrize(
    ("change", "objection"),
    [
        ({0: (0, 2, 0, (0,))}, "contains a root"),
        ({1: (1, 1, 1, ())}, "begins and ends with a sector"),
        ({4: (3, 6, 6, ())}, "begins and ends with a sector"),
        ({0: (0, 0, 0, (1,))}, "no root at its end|none of its factors has a root at its end"),
        ({2: (2, 2, 2, (1,))}, "none of its factors has a root at its end"),
        ({4: (4, 6, 6, (0, 1))}, "contains a root"),
        ({2: (2, 2, 2, (0, 2))}, "factors of the line expected"),
        ({2: (2, 2, 2, None)}, "what holds around the sample is needed"),
        ({2: (2, 2, 3, (0,))}, "are needed"),
        ({2: (2, 1, 1, (0,))}, "are needed"),
        ({4: (4, 7, 4, (0,))}, "are needed"),
        ({4: None}, "not covered to its ends"),
        ({0: GOOD[1]}, "not covered to its ends"),
        ({1: GOOD[2]}, "a gap before cell 1"),
        ({2: GOOD[3]}, "a gap before cell 2"),
    ],
)
def test_intervals_cover_their_line_between_roots_of_their_own(
    change: dict[int, Interval | None], objection: str
) -> None:
    cells = [change.get(k, cell) for k, cell in enumerate(GOOD)]
    assert re.search(objection, objected(RAYS, *ROOTS, *(cell for cell in cells if cell)))


def test_no_theorem_of_lazard_is_about_intervals() -> None:
    table = Table("x; y^2 - x, y - x - 5, y", LAZARD)
    assert "factors of the line expected" in objected(table, *ROOTS, *GOOD)


def test_intervals_that_overlap_need_the_resultant_of_their_ends() -> None:
    cells: tuple[Interval, ...] = ((0, 2, 0, (1,)), (2, 4, 4, (0,)))
    for below, accepted in (("x - 7", False), ("x - 7, x - 2", True)):
        table = Table(f"{below}; y - 2, y - x")
        assert (objected(table, (4,), (0, 3, 5), "0 1", *cells) == "") is accepted
    touching: tuple[Interval, ...] = ((0, 0, 0, (1,)), (1, 1, 1, (0,)), (2, 2, 2, (0,)))
    assert "need not meet" in objected(Table("x - 7; y - 2, y - x"), (2,), (0, 5), "01", *touching)
    assert objected(Table("x - 2; y - 2, y - x"), (("x - 2", 0, 3),), (0, 5), "01", *touching) == ""


def test_a_sample_alone_covers_no_line() -> None:
    cells: tuple[Interval, ...] = ((0, 0, 0, None), (1, 1, 1, (0,)), (2, 2, 2, (0,)))
    assert "covers its sample only" in objected(RAYS, (), (-1, 1), "0", *cells)


def test_what_keeps_a_factor_from_being_zero_on_a_line_nearby() -> None:
    """A coefficient that is not zero, if it has only coordinates that are fixed, or its factors are own ones."""
    table = Table("x; y - 7; z; x*w + y")
    assert table.signs((ZERO, ("y - 7", 6, 8), 1), (0,)) == "+"
    assert "may vanish identically" in table.objection((ZERO, 1, 1), (0,))
    table, stack = Table("x; y; x*z + y"), Stack((0,), (Fraction(0),), (), (Cell("+", None),))
    sample = table.over((ZERO, 1))
    table.around(stack, sample)
    sample.signs[1][0] = None  # y is 1 at the sample, but is no own factor of the cell
    with pytest.raises(CertificateRejected, match="may vanish identically"):
        table.around(stack, sample)


def test_a_lazard_evaluation_has_the_sections_of_a_factor_that_is_zero_on_the_line() -> None:
    """x + y*(z - 1) over x = 0, then y = 0, leaves z - 1."""
    table = Table("x; y; x + y*z - y", LAZARD)
    assert table.signs(ORIGIN, (0, 2), (0,)) == "0 0 0"
    assert "missing" in table.objection(ORIGIN, (0,)) and "no root here" in table.objection(ORIGIN, (2, 3), (0,))
