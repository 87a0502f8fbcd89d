"""One stack of a decomposition over a sample point: its sections, sector samples and signs.

Where an equational constraint restricts a level, only the roots of the constraint's factors are sections; the signs
of the other factors are known on the sections and left open (``?``) in the sectors.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod

from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.proof.cells import CHARACTER_OF, SIGN_OF


@dataclass(frozen=True, slots=True)
class SampledStack:
    """``texts[p]``: the signs of the used factors on the cell at position p from below. ``sections``: for each section
    the factors whose root it is. ``nullified``: factors that are zero on the whole line. ``known``: samples that were
    needed already. ``restricted``: the sections are those of a constraint.
    """

    isolation: Isolation
    texts: Sequence[str]
    sections: tuple[tuple[int, ...], ...]
    nullified: tuple[int, ...]
    known: Mapping[int, Point]
    restricted: bool

    @property
    def sectors(self) -> Sequence[Fraction]:
        """A rational sample of every sector."""
        return self.isolation.samples

    def sample(self, position: int) -> Point:
        """The sample point of a cell of the stack."""
        return self.known.get(position) or self.isolation.sample(position)


def stack_over(point: Point, factors: Sequence[Poly], used: tuple[int, ...], *, lazard: bool) -> SampledStack:
    """The stack of the used factors of a level over the point."""
    found = isolate_over(point, tuple(factors[j] for j in used), lazard=lazard)
    sections = tuple(tuple([used[j] for j in s.members]) for s in found.sections)
    return SampledStack(found, found.texts, sections, tuple(used[j] for j in found.nullified), {}, False)


def restricted_stack(
    point: Point, factors: Sequence[Poly], used: tuple[int, ...], constraint: frozenset[int]
) -> SampledStack:
    """The stack of the constraint's factors alone, with the signs of all used factors on its sections."""
    own = tuple(j for j in used if j in constraint)
    others = [j for j in used if j not in constraint]
    core = stack_over(point, factors, own, lazard=False)
    known = {position: core.sample(position) for position in range(1, len(core.texts), 2)}
    signs = {j: [place.apparent_sign(factors[j]) for place in known.values()] for j in others}
    unsettled = [j for j in others if None in signs[j]]
    if unsettled and not core.nullified:
        signs |= _common_stack(core.isolation, factors, own, unsettled)
    texts: list[str] = []
    for position, text in enumerate(core.texts):
        characters = dict(zip(own, text, strict=True))
        for j in others:
            characters[j] = CHARACTER_OF[signs[j][position // 2]] if position % 2 else "?"
        texts.append("".join([characters[j] for j in used]))
    return SampledStack(core.isolation, texts, core.sections, core.nullified, known, True)


def _common_stack(
    core: Isolation, factors: Sequence[Poly], own: tuple[int, ...], others: Sequence[int]
) -> dict[int, list[int | None]]:
    """The signs of ``others`` on the sections of ``own``, those of ``core``, from the stack of them all: no coordinate
    above the point has to be computed with to prove a zero.
    """
    fine = isolate_over(core.point, tuple(factors[j] for j in (*own, *others)), known=core.shapes)
    found: dict[int, list[int | None]] = {j: [] for j in others}
    for sector, section in enumerate(fine.sections):
        if min(section.members) < len(own):
            for place, j in enumerate(others, start=len(own)):
                found[j].append(SIGN_OF[fine.texts[2 * sector + 1][place]])
    return found


def sign_by_factors(poly: Poly, sign: Callable[[Poly], int]) -> int:
    """The sign of a polynomial, by those of its irreducible factors."""
    unit, factors = poly.factors()
    return prod((sign(f) if exponent % 2 else abs(sign(f)) for f, exponent in factors), start=1 if unit > 0 else -1)


def is_nullified(point: Point, factor: Poly) -> bool:
    """Whether the factor is zero on the whole line over the point."""
    return not any(point.sign(c) for c in reversed(factor.coefficients(point.depth)))
