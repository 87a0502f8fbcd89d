"""What floating point proposes about chains (clarabel, extra ``squares``): points, multipliers, the least radius.
Nothing of it is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, isfinite, sqrt

from bezier.chains.chain import Chain, Equation, Place, equations
from bezier.chains.form import Form, Requirement
from qe.extras import wanted

TOLERANCES = (1e-12, 1e-10, 1e-8)
"""Tried in this order: what is out of reach ends far from the optimum."""
ROUGH = 1e-9
"""Where many problems are compared."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """``excess``: by how much (a length) the conditions have to be given up, negative where there is room; ``weights``:
    one for each requirement."""

    point: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]
    excess: float = 0.0


def best(chain: Chain, size: int, rows: Sequence[Requirement], objective: Form | None = None) -> Proposal | None:
    """The point where the objective is least, with multipliers; without an objective the smallest t such that all
    conditions hold with balls and half-spaces larger by t. None where clarabel gives up."""
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
            parts = [
                (
                    [(at[i][k], sqrt(w) * float(a)) for i, a in p.coefficients.items()],
                    sqrt(w) * float(p.constant[k]) / unit,
                )
                for w, p in row.squares
                for k in range(d)
            ]
            program.cone([(excess, lengths[-1]), *parts])
        else:
            line = [(at[i][k], float(c)) for i, g in row.form.gradient.items() for k, c in enumerate(g)]
            lengths.append(sqrt(sum(c * c for _, c in line)))
            downhill = [(k, -c / lengths[-1]) for k, c in line]
            level = float(row.form.constant) / lengths[-1] / unit
            program.at_least([*downhill, *excess], level)
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


@dataclass(frozen=True, slots=True)
class Loosened:
    """``excess``: the least length by which something has to be given up. ``slopes``: by how much that falls, at first,
    where a point or velocity moves by 1, or the logarithm of a duration grows by 1 (negative: where it shrinks)."""

    excess: float
    slopes: dict[str, float]

    def change(self, name: str) -> float:
        """By how much this has to change until nothing has to be given up, if the excess is linear in it; by at least
        so much where it is convex."""
        return self.excess / abs(self.slopes[name]) if self.slopes[name] else inf


def loosened(chain: Chain, free: str = "") -> Loosened | None:
    """By how much conditions have to be given up, with "radius" ``free`` those of the ball; where a point or velocity
    is free they hold, and that is by how much it has to move. Joins are equations here, between all control points,
    which is quick. None where no length is enough."""
    with wanted():
        from bezier.conic import Conic
    d, unit, program = chain.dimension, max(abs(float(c)) for p in chain.points for c in p), Conic(ROUGH)
    corners = program.variables((len(chain.points), d)).tolist()
    inner = program.variables((chain.pieces, chain.degree - 1, d)).tolist()
    length = (int(program.variables((1,), 1.0)[0]), 1.0)
    excess = [] if free in chain.moving else [length]

    def at(place: Place) -> list[int]:
        k, j = place
        return list(inner[k][j - 1] if 0 < j < chain.degree else corners[(k + (j > 0)) % len(corners)])

    names = enumerate(zip(chain.point_names, chain.points, strict=True))
    given = (Equation("", 0, (name,), (((k, 0), Fraction(1)),), point) for k, (name, point) in names)
    listed = sorted((*given, *equations(chain)), key=lambda e: free in e.without)
    kept = [e for e in listed if free not in e.without]
    for number, e in enumerate(listed):
        forms = [([(at(p)[i], float(w)) for p, w in e.terms], -float(e.value[i]) / unit) for i in range(d)]
        if number < len(kept):
            program.cone(forms, "ZeroConeT")
        elif not excess:
            program.cone([([length], 0.0), *forms])
    program.at_least([length], -1.0)
    for point in (*corners, *(p for row in inner for p in row)):
        if chain.radius_squared is not None:
            away = [([(i, 1.0)], -float(c) / unit) for i, c in zip(point, chain.centre, strict=True)]
            program.cone([(excess, sqrt(chain.radius_squared) / unit), *away])
        for normal, offset in chain.half_spaces:
            size = sqrt(sum(c * c for c in normal))
            downhill = [(i, float(c) / size) for i, c in zip(point, normal, strict=True)]
            program.at_least([*downhill, *(excess if free != "radius" else [])], float(offset) / size / unit)
    if (x := program.solved()) is None:
        return None
    paces = chain.paces
    slopes = dict.fromkeys((*chain.moving, *paces), 0.0)
    for k, e in enumerate(kept):
        z = program.multipliers[k * d : k * d + d]
        for name in e.without if e.order < 2 and e.without[0] in chain.moving else ():
            slopes[name] += sqrt(sum(c * c for c in z))
        for p, w in e.terms if e.order else ():
            slopes[paces[p[0]]] -= unit * e.order * float(w) * sum(c * x[i] for c, i in zip(z, at(p), strict=True))
    return Loosened(x[length[0]] * unit, slopes)
