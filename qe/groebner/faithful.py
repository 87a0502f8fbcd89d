"""Faithful bases: elements of the given ideal itself with the values of a segment's basis on the segment.

Where g = f + e with f in the ideal of the given polynomials F and e in that of the equations E of a segment, f is
faithful: it has the values of g wherever E vanishes (Kapur, Sun, Wang 2013). The minimal polynomials of constants
belong to F: over the numbers for which the constants stand they are zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from qe.exact.ideal_sum import graded_basis, taken_apart
from qe.exact.ring import Poly
from qe.groebner.segment import Segment
from qe.options import Budget


def with_faithful(
    segments: Sequence[Segment], polys: Sequence[Poly], moduli: Sequence[Poly], budget: Budget
) -> tuple[Segment, ...]:
    """The segments with faithful elements; ``moduli``: of the constants. Raises ``Unable`` at a limit."""
    given = [p for p in polys if p]
    if not given or not segments:
        return tuple(replace(s, faithful=s.elements) for s in segments)
    block = segments[0].block
    variables = (*block.variables, *block.parameters)
    ideal = graded_basis([*given, *moduli], variables)
    found = []
    for segment in segments:
        budget.check("faithful bases")
        parts: Sequence[Poly] = segment.elements
        if not set(segment.equal) <= set(moduli):  # else they are in the ideal themselves
            equal = graded_basis(segment.equal, variables)
            split = taken_apart(parts, ideal, equal, variables, lambda: budget.check("faithful bases"))
            parts = [p for _, p in split]
        found.append(replace(segment, faithful=tuple(p.normal()[1] for p in parts)))
    return tuple(found)
