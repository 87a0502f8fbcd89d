"""What floating point proposes about chains (clarabel, extra ``squares``): points, multipliers, the least radius.
Nothing of it is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt
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
        import clarabel
        import numpy as np
        from scipy import sparse
    d, unit = chain.dimension, max(abs(float(c)) for p in chain.points for c in p)
    n = size * d
    width = n + (objective is None)
    if not width:
        return Proposal((), (0.0,) * len(rows))
    lines: list[Any] = []
    right: list[float] = []
    cones: list[Any] = []
    lengths: list[float] = []
    for row in rows:
        slack = np.zeros(width)
        if row.squares:
            slack[n:] = -1.0 if row.is_ball or not balls_only else 0.0
            blocks = [_block(point, sqrt(w), d, width, unit) for w, point in row.squares]
            lengths.append(sqrt(max(float(row.right), 0.0)) / unit)
            lines += [slack, *(-line for block, _ in blocks for line in block)]
            right += [lengths[-1], *(c for _, constant in blocks for c in constant)]
            cones.append(clarabel.SecondOrderConeT(1 + d * len(blocks)))
        else:
            line = np.zeros(width)
            for i, g in row.form.gradient.items():
                line[i * d : (i + 1) * d] = [float(c) for c in g]
            lengths.append(float(np.linalg.norm(line)))
            slack[n:] = 0.0 if balls_only else -1.0
            lines.append(slack + line / lengths[-1])
            right.append(-float(row.form.constant) / lengths[-1] / unit)
            cones.append(clarabel.NonnegativeConeT(1))
    quadratic, linear = np.zeros((width, width)), np.zeros(width)
    scale = 1.0
    if objective is None:
        linear[n] = 1.0
        lines.append(np.array([0.0] * n + [-1.0]))
        right.append(max(lengths, default=1.0) or 1.0)
        cones.append(clarabel.NonnegativeConeT(1))
    else:
        scale = max((abs(float(m)) for m in objective.matrix.values()), default=1.0)
        for (i, j), m in objective.matrix.items():
            for k in range(d):
                quadratic[i * d + k, j * d + k] = 2 * float(m) / scale
        for i, g in objective.gradient.items():
            linear[i * d : (i + 1) * d] = [float(c) / unit / scale for c in g]
    upper, matrix = sparse.csc_matrix(np.triu(quadratic)), sparse.csc_matrix(np.array(lines).reshape(-1, width))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    for tolerance in TOLERANCES:
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
        answer = clarabel.DefaultSolver(upper, linear, matrix, np.array(right), cones, settings).solve()
        if str(answer.status) == "Solved":
            break
    x = np.array(answer.x)
    if not np.all(np.isfinite(x)) or not np.all(np.isfinite(np.array(answer.z))):
        return None
    excess = float(x[n]) if objective is None else 0.0
    weights, at = [], 0
    for row, length in zip(rows, lengths, strict=True):
        z = max(float(answer.z[at]), 0.0)
        if row.squares:
            weights.append(scale * z / 2 / max(length + (excess if row.is_ball else 0.0), 1e-9))
            at += 1 + d * len(row.squares)
        else:
            weights.append(scale * z * unit / length)
            at += 1
    point = tuple(tuple(float(c) * unit for c in x[i * d : (i + 1) * d]) for i in range(size))
    return Proposal(point, tuple(weights), excess * unit)


def _block(point: Affine, factor: float, dimension: int, width: int, unit: float) -> tuple[Any, Any]:
    """A multiple of a point as lines in the free coordinates, and its constant part, in the unit."""
    import numpy as np

    block = np.zeros((dimension, width))
    for i, a in point.coefficients.items():
        for k in range(dimension):
            block[k, i * dimension + k] = factor * float(a)
    return block, np.array([factor * float(c) for c in point.constant]) / unit


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
