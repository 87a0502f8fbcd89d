"""One line of a covering: a sample point, and the roots of listed factors on the line over it, found correct."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from qe.exact.ring import Poly
from qe.kernel.arithmetic.fibre import Fibre, Simple, fibre, values
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.limits import check_value
from qe.kernel.stacks import Fail, have_common_root, roots_and_signs
from qe.proof.entry import Entry


@dataclass(frozen=True, slots=True)
class Sample:
    """A point: its algebraic coordinates, and the rational ones by level."""

    point: Point
    rationals: dict[int, Fraction]

    @property
    def depth(self) -> int:
        """How many coordinates it has."""
        return len(self.rationals) + len(self.point.indices)

    def reduced(self, f: Poly) -> Poly:
        """The polynomial with the rational coordinates put in."""
        for level, number in self.rationals.items():
            if f.degree(level):
                check_value(f, level, number)
                f = f.at_rational(level, number)
        return f

    def sign(self, f: Poly) -> int:
        """The sign of a polynomial at the point."""
        return self.point.sign(self.reduced(f))

    def extended(self, level: int, number: Fraction | Coordinate) -> Sample:
        """The point one coordinate longer."""
        if isinstance(number, Coordinate):
            return Sample(self.point.extended(number), self.rationals)
        return Sample(self.point, {**self.rationals, level: number})


@dataclass(slots=True)
class Row:
    """A factor over a sample: its sign in every sector; ``simple`` has the same roots, all simple, where known."""

    fibre: Fibre
    signs: list[int]
    simple: Simple | None


@dataclass(frozen=True, slots=True)
class Line:
    """The roots of the factors of a line, found correct. ``zero``: the factors that are zero on the whole line."""

    sample: Sample
    sectors: tuple[Fraction, ...]
    sections: list[list[int]]
    rows: dict[int, Row]
    zero: frozenset[int]

    def sign(self, index: int, position: int) -> int:
        """The sign of a factor at a position."""
        half = position // 2
        if index in self.zero or (position % 2 and index in self.sections[half]):
            return 0
        return self.rows[index].signs[half]

    def roots(self, own: set[int], first: int, last: int) -> list[int]:
        """The positions from ``first`` to ``last`` where one of the factors vanishes."""
        return [p for p in range(first | 1, last + 1, 2) if own & {*self.sections[p // 2]}]

    def number(self, position: int, entry: Entry) -> Fraction | Coordinate:
        """The value of the variable at a position: at a sector's sample, or at the root between two."""
        half = position // 2
        if position % 2 == 0:
            return self.sectors[half]
        for row in sorted((self.rows[i] for i in self.sections[half]), key=lambda row: row.fibre.degree):
            row.simple = row.simple or row.fibre.squarefree()
            found = row.simple.coordinate(self.sectors[half], self.sectors[half + 1])
            if found is not None:
                return found
        raise entry.fail("there is no root at the place of the sample")


def line_of(sample: Sample, factors: Sequence[Poly], used: Entry, sectors: Entry, sections: Entry) -> Line:
    """The sections are all the real roots of the factors used, each listed where it is."""
    known = [i.integer() for i in used.items()]
    numbers = tuple(q.rational() for q in sectors.items())
    listed = [[i.integer() for i in section.items()] for section in sections.items()]
    if len(set(known)) < len(known) or any(i >= len(factors) for i in known):
        raise used.fail("factors of this level expected, each once")
    if not numbers or any(a >= b for a, b in pairwise(numbers)):
        raise sectors.fail("ascending numbers expected")
    if len(listed) != len(numbers) - 1 or any(len(set(s)) < len(s) or not {*s} <= {*known} for s in listed):
        raise sections.fail("factors used, each once, expected between every two sectors")
    at, rows, zero = values(numbers), dict[int, Row](), set[int]()
    for i in known:
        f = fibre(sample.point, sample.reduced(factors[i]), sample.depth)
        places = [j for j, section in enumerate(listed) if i in section]
        if f.degree < 0:
            if places:
                raise sections.fail(f"factor {i} is zero on the whole line")
            zero.add(i)
            continue
        wrong: Fail = lambda _, why, i=i: sections.fail(f"factor {i}: {why}")  # type: ignore[misc]  # noqa: E731
        rows[i] = Row(f, *roots_and_signs(f, at, places, None, wrong))
    for j, section in enumerate(listed):
        for other in section[1:]:
            f, g = rows[section[0]].fibre, rows[other].fibre
            if not have_common_root(f, g, sample.point, at[j : j + 2]):
                raise sections.fail(f"factors {section[0]} and {other} have no common root")
    return Line(sample, numbers, listed, rows, frozenset(zero))
