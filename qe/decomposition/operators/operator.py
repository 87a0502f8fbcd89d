"""What a projection operator is: the polynomials that it derives, what lifting has to do, what proves its tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeVar

from qe.errors import NotWellOriented
from qe.exact.from_projection import discriminant, resultant
from qe.exact.ring import Poly
from qe.options import Projection

Result = TypeVar("Result")


def shared_roots(f: Poly, g: Poly, variable: int) -> Iterator[Poly]:
    """The resultant: where it keeps its order (McCallum) or valuation (Lazard), f and g share the same roots."""
    yield resultant(f, g, variable)


def multiple_roots(f: Poly, variable: int) -> Iterator[Poly]:
    """The discriminant, of a polynomial that can have multiple roots."""
    if f.degree(variable) >= 2:
        yield discriminant(f, variable)


@dataclass(frozen=True, slots=True, kw_only=True)
class Operator:
    """A projection operator with its theorem, a row of ``qe.decomposition.operators.table.OPERATORS``.

    It is applied to irreducible, pairwise coprime polynomials of positive degree in the projected variable, which are
    delineable over every cell of a decomposition for the polynomials that it derives, where lifting does as said here.
    """

    name: Projection
    """How callers ask for it."""

    source: str
    """Where the theorem is proved."""

    of_one: Callable[[Poly, int], Iterator[Poly]]
    """``of_one(f, variable)``: the polynomials that one polynomial contributes."""

    of_two: Callable[[Poly, Poly, int], Iterator[Poly]] = shared_roots
    """``of_two(f, g, variable)``: those that a pair contributes."""

    evaluates: bool = False
    """Whether a polynomial that is nullified over a sample has the roots of its Lazard evaluation there as sections."""

    restricted: bool = False
    """Whether McCallum's theorems on equational constraints hold for it (``qe.decomposition.constraints``)."""

    otherwise: Operator | None = None
    """The operator that takes over where this one's side condition fails: that no polynomial is nullified over a cell
    over which it has to be delineable. None: there is no side condition."""

    proof: Projection
    """The operator by whose theorem a table is recorded and checked: one whose factor lists these are as well."""

    def __post_init__(self) -> None:
        if self.restricted and self.otherwise is None:
            raise ValueError("the theorems on equational constraints need that nothing is nullified")

    @property
    def complete(self) -> Operator:
        """The operator without side condition among this one and those that take over from it."""
        return self if self.otherwise is None else self.otherwise.complete

    def check_nullified(self, level: int, dimension: int, *, is_needed: bool = True) -> None:
        """Raise ``NotWellOriented`` where a polynomial of the level may not be nullified over a cell of this dimension.

        ``is_needed``: whether something depends on that the polynomial is delineable. Over a single point of the last
        level nothing does: the cell below is the point, and nothing is lifted above.
        """
        if self.otherwise is not None and is_needed:
            raise NotWellOriented(f"a factor of level {level} is nullified over a cell of dimension {dimension}")

    def applied(self, work: Callable[[Operator], Result]) -> Result:
        """What ``work`` gives with this operator, or with the one that takes over where this one does not apply."""
        try:
            return work(self)
        except NotWellOriented:
            if self.otherwise is None:
                raise
            return self.otherwise.applied(work)
