"""One stack of a decomposition over a sample point: its sections, sector samples and signs.

Where an equational constraint restricts a level, only the roots of the constraint's factors are sections; the signs
of the other factors are known on the sections and left open (``?``) in the sectors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point

_CHARACTER = {1: "+", -1: "-", 0: "0"}


@dataclass(frozen=True, slots=True)
class Layers:
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
    def sectors(self) -> tuple[Fraction, ...]:
        """A rational sample of every sector."""
        return tuple(Fraction(int(q.p), int(q.q)) for q in self.isolation.sectors)

    def sample(self, below: Point, position: int) -> Point:
        """The sample point of a cell of the stack over ``below``."""
        if position in self.known:
            return self.known[position]
        found = self.isolation
        return below.extend(found.sections[position // 2].value if position % 2 else found.sectors[position // 2])


def layers_over(point: Point, factors: Sequence[Poly], used: tuple[int, ...], *, lazard: bool) -> Layers:
    """The stack of the used factors of a level over the point."""
    found = isolate_over(point, tuple(factors[j] for j in used), lazard=lazard)
    sections = tuple(tuple(sorted(used[j] for j in s.members)) for s in found.sections)
    return Layers(found, found.sign_texts(), sections, tuple(used[j] for j in found.nullified), {}, False)


def restricted_layers(
    point: Point, factors: Sequence[Poly], used: tuple[int, ...], constraint: frozenset[int]
) -> Layers:
    """The stack of the constraint's factors alone, with the signs of all used factors on its sections."""
    core = layers_over(point, factors, tuple(j for j in used if j in constraint), lazard=False)
    texts: list[str] = []
    known: dict[int, Point] = {}
    for position, text in enumerate(core.texts):
        own = iter(text)
        if position % 2 == 0:
            texts.append("".join([next(own) if j in constraint else "?" for j in used]))
        else:
            place = known[position] = core.sample(point, position)
            texts.append(
                "".join([next(own) if j in constraint else _CHARACTER[place.sign(factors[j])] for j in used])
            )
    return Layers(core.isolation, texts, core.sections, core.nullified, known, True)


def is_nullified(point: Point, factor: Poly) -> bool:
    """Whether the factor is zero on the whole line over the point."""
    return not any(point.sign(c) for c in reversed(factor.coefficients(point.depth)))
