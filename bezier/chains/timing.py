"""Durations that are free: only their sum is given. A search by coordinates in floating point picks them, from three
usual choices; what is proved afterwards holds for the durations picked, not over all durations, of which the least
value is not a convex function."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from bezier.chains import proposals
from bezier.chains.chain import Chain, objective_form, requirements

_FIRST, _LAST = 1.6, 1.03
"""Factors by which durations are changed, the largest and the smallest one."""
_MOST = 400
"""Chains that are looked at."""
_GRID = 1000


def timed(chain: Chain) -> Chain:
    """The chain with durations of the given sum, as good as the search finds them."""
    assert chain.free_total is not None
    lengths = [float(sum((y - x) ** 2 for x, y in zip(a, b, strict=True))) ** 0.5 for a, b in pairwise(chain.corners)]
    starts = [[size**power for size in lengths] for power in (0.0, 0.5, 1.0)]
    value, times = min((_value(chain, s), s) for s in starts)
    factor, looked = _FIRST, len(starts)
    while factor > _LAST and looked < _MOST:
        better = False
        for k in range(chain.pieces):
            for change in (factor, 1 / factor):
                other = [t * change if i == k else t for i, t in enumerate(times)]
                looked += 1
                if (new := _value(chain, other)) < value * (1 - 1e-9):
                    value, times, better = new, other, True
                    break
        factor = factor if better else factor**0.5
    return _lasting(chain, times)


def _lasting(chain: Chain, times: Sequence[float]) -> Chain:
    """The chain with durations in this proportion."""
    whole = [max(1, round(_GRID * chain.pieces * t / sum(times))) for t in times]
    total = chain.free_total or Fraction(1)
    return replace(chain, durations=tuple(total * n / sum(whole) for n in whole), free_total=None)


def _value(chain: Chain, times: Sequence[float]) -> float:
    """The least value of the objective; where there is no chain a large number, larger where more is missing."""
    other = _lasting(chain, times)
    if (solved := other.solved).joins:
        return float("inf")
    rows = requirements(other, solved)
    varying, objective = [row for row in rows if not row.form.is_constant], objective_form(other, solved)
    lowest = objective.minimum(solved.size, chain.dimension)
    if lowest is not None and all(row.form.value(lowest[0]) <= 0 for row in rows):
        return float(lowest[1])
    excess = proposals.best(other, solved.size, varying) if varying else None
    if excess is None or excess.excess > 0:
        return 1e12 * (1 + (1e3 if excess is None else excess.excess))
    proposal = proposals.best(other, solved.size, varying, objective)
    if proposal is None:
        return 1e12
    return float(objective.value(tuple(tuple(map(Fraction, p)) for p in proposal.point)))
