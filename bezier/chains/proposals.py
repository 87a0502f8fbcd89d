"""What floating point proposes about chains (clarabel, extra ``squares``): points, multipliers, the least radius.
Nothing of it is believed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, sqrt
from typing import Any

from bezier.chains.chain import Chain
from bezier.chains.form import Affine, Form, Requirement
from qe.extras import wanted

TOLERANCES = (1e-12, 1e-10, 1e-8)
"""Tried in this order: what is out of reach ends far from the optimum."""
ACTIVE = Fraction(1, 10**6)
"""The share of its room within which a condition counts as active."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """``excess``: by how much (a length) the conditions have to be given up, negative where there is room; ``weights``:
    one for each requirement."""

    point: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]
    excess: float = 0.0


def least_excess(chain: Chain, size: int, rows: Sequence[Requirement], *, balls_only: bool = False) -> Proposal | None:
    """The smallest t such that all conditions hold with balls and half-spaces larger by t. ``balls_only``: half-spaces
    as they are. None where clarabel gives up."""
    return _solved(chain, size, rows, None, balls_only)


def least_value(chain: Chain, size: int, rows: Sequence[Requirement], objective: Form) -> Proposal | None:
    """The point where the objective is least, with multipliers."""
    return _solved(chain, size, rows, objective, False)


def _solved(
    chain: Chain, size: int, rows: Sequence[Requirement], objective: Form | None, balls_only: bool
) -> Proposal | None:
    with wanted():
        from bezier.conic import Conic
    d, unit = chain.dimension, max(abs(float(c)) for p in chain.points for c in p)
    if not size * d and objective is not None:
        return Proposal((), (0.0,) * len(rows))
    program, lengths = Conic(*TOLERANCES), list[float]()
    at = program.variables((size, d)).tolist()
    excess = [(int(k), 1.0) for k in program.variables((int(objective is None),), 1.0)]
    for row in rows:
        if row.squares:
            lengths.append(sqrt(max(float(row.right), 0.0)) / unit)
            parts = [part for w, point in row.squares for part in _scaled(point, sqrt(w), at, d, unit)]
            program.cone([(excess if row.is_ball or not balls_only else [], lengths[-1]), *parts])
        else:
            line = [(at[i][k], float(c)) for i, g in row.form.gradient.items() for k, c in enumerate(g)]
            lengths.append(sqrt(sum(c * c for _, c in line)))
            downhill = [(k, -c / lengths[-1]) for k, c in line]
            level = float(row.form.constant) / lengths[-1] / unit
            program.at_least([*downhill, *([] if balls_only else excess)], level)
    scale = 1.0
    if objective is None:
        program.at_least(excess, -(max(lengths, default=1.0) or 1.0))
    else:
        scale = max((abs(float(m)) for m in objective.matrix.values()), default=1.0)
        for (i, j), m in objective.matrix.items():
            for k in range(d if i <= j else 0):
                program.add_product(at[i][k], at[j][k], float(m) * (1 + (i < j)) / scale)
        for i, g in objective.gradient.items():
            program.add_cost([(at[i][k], float(c) / unit / scale) for k, c in enumerate(g)])
    x = program.solved()
    if x is None or not all(map(isfinite, program.multipliers)):
        return None
    most = x[-1] if objective is None else 0.0
    weights, first = [], 0
    for row, length in zip(rows, lengths, strict=True):
        z = max(program.multipliers[first], 0.0)
        if row.squares:
            weights.append(scale * z / 2 / max(length + (most if row.is_ball else 0.0), 1e-9))
        else:
            weights.append(scale * z * unit / length)
        first += 1 + d * len(row.squares)
    return Proposal(tuple(tuple(x[k] * unit for k in place) for place in at), tuple(weights), most * unit)


def _scaled(
    point: Affine, factor: float, at: Sequence[Sequence[int]], dimension: int, unit: float
) -> Iterator[tuple[list[tuple[int, float]], float]]:
    """The coordinates of a multiple of a point, as forms in the variables, in the unit."""
    for k in range(dimension):
        terms = [(at[i][k], factor * float(a)) for i, a in point.coefficients.items()]
        yield terms, factor * float(point.constant[k]) / unit


def fitted_weights(
    rows: Sequence[Requirement], objective: Form, point: Sequence[Sequence[float]]
) -> tuple[float, ...] | None:
    """Multipliers of the conditions that are active at a point, for which the Lagrange function is nearly stationary
    there (least squares): better ones than the solver's where it stopped early."""
    with wanted():
        import numpy as np
        from scipy.optimize import nnls
    free = tuple(tuple(Fraction(c) for c in p) for p in point)
    active = [k for k, row in enumerate(rows) if row.form.value(free) > -ACTIVE * (abs(row.form.constant) + 1)]
    if not active:
        return None
    at = np.array(point, dtype=float)
    columns = np.array([_slope(rows[k].form, at).ravel() for k in active]).T
    try:
        weights, _ = nnls(columns, -_slope(objective, at).ravel())
    except (RuntimeError, ValueError):
        return None
    named = dict(zip(active, weights.tolist(), strict=True))
    return tuple(named.get(k, 0.0) for k in range(len(rows)))


def _slope(form: Form, at: Any) -> Any:
    """The gradient, in floating point."""
    slope = 0 * at
    for (i, j), m in form.matrix.items():
        slope[i] += 2 * float(m) * at[j]
    for i, g in form.gradient.items():
        slope[i] += [float(c) for c in g]
    return slope
