"""Chains whose length or curvature is bounded: floating point looks for one, and exact enclosures prove it for all t.

LENGTH. A curve is at most as long as the polygons of its parts, and |a| <= |a|²/(2 l) + l/2 for every l > 0, with
equality for l = |a|: so sum |a|²/(2 l) + l/2 <= L over the legs is a convex condition that keeps the length within L, and
choosing l anew (majorisation; Hunter, Lange, The American Statistician 58, 2004) leads to the optimum under the length
of the polygon. A curve is at least as long as its chords: sum u . chord <= L is necessary for all |u| <= 1, a half-space,
which takes part in the bound from below and in contradictions.

CURVATURE has no convex condition: it is linearised again and again near the last chain (sequential convex programming).
Chains without that bound are more, so that their bound from below holds, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from math import comb
from typing import Any

from bezier.chains import proposals
from bezier.chains.chain import Chain, Requirement, Solved, objective_form
from bezier.chains.form import Affine, Point, affine_sum, linear_form, squared_length, weighted_sum
from bezier.chains.proof import Best, Contradiction, best, bounded, decided, rational_weights, rounded_point
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import curvature_enclosure, length_enclosure
from qe.errors import Unable

_ZERO, _ONE, _HALF = Fraction(0), Fraction(1), Fraction(1, 2)
LENGTH = "length"
"""The label of the half-space that a bound on the length implies."""
DEPTH = 3
"""A curve is halved so often."""
_ROUNDS, _STEPS, _PLACES = 12, 40, 10**6
_INSIDE = Fraction(1, 10**9)
_SAMPLES = tuple(k / 12 for k in range(13))


def keeps_limits(chain: Chain, curves: Sequence[Bezier]) -> str:
    """Which bound these curves break; empty where all are proved to be kept."""
    rel = Fraction(1, 10**9)
    if chain.max_length is not None:
        high = sum((length_enclosure(curve, rel).high or _ZERO for curve in curves), _ZERO)
        if high > chain.max_length:
            return f"the length is not within {chain.max_length}"
    for k, curve in enumerate(curves if chain.max_curvature is not None else ()):
        bend = curvature_enclosure(curve, rel).high
        if bend is None or bend > (chain.max_curvature or 0):
            return f"the curvature of C{k + 1} is not within {chain.max_curvature}"
    return ""


def best_within(chain: Chain, solved: Solved, rows: Sequence[Requirement], inside: Sequence[Point]) -> Best | Contradiction:
    """The best chain that is seen to keep the bounds, with a proved bound from below; or a proof that none is short
    enough. Raises ``Unable``."""
    free = best(chain, solved, rows, inside)
    if not keeps_limits(chain, solved.curves(free.free)):
        return free
    inner, outer, point = list(rows), list(rows), free.free
    if chain.max_length is not None:
        shortest = _shortest(chain, solved, rows, point)
        cut = chord_condition(chain, solved, directions(solved, shortest))
        if isinstance(none := _decided(chain, solved, [*rows, cut]), Contradiction):
            return none
        inner, point = _short_enough(chain, solved, rows, shortest)
        outer.append(chord_condition(chain, solved, directions(solved, point)))
    if chain.max_curvature is not None:
        point = _bent_less(chain, solved, inner, point)
    if (broken := keeps_limits(chain, solved.curves(point))) or any(row.form.value(point) > 0 for row in rows):
        raise Unable(f"no chain was seen to keep the bounds: {broken or 'conditions are broken'}")
    varying = [row for row in outer if not row.form.is_constant]
    proposal = proposals.least_value(chain, solved.size, varying, objective_form(chain, solved))
    for weights in rational_weights(proposal.weights) if proposal is not None else ():
        named = {row.label: w for w, row in zip(weights, varying, strict=True) if w}
        try:
            return _with_chords(bounded(chain, solved, outer, point, named, _ONE), directions(solved, point), named)
        except Unable:
            continue
    raise Unable("no bound from below was proved")


def _decided(chain: Chain, solved: Solved, rows: Sequence[Requirement]) -> Any:
    try:
        return decided(chain, solved, rows)
    except Unable:
        return None


# --- length ---------------------------------------------------------------------------------------------------
def parts(piece: Sequence[Affine], depth: int = DEPTH) -> Iterator[tuple[Affine, ...]]:
    """The control points of the parts of a curve, by de Casteljau's construction."""
    if not depth:
        yield tuple(piece)
        return
    rows = [list(piece)]
    while len(rows[-1]) > 1:
        rows.append([affine_sum(((_HALF, a), (_HALF, b))) for a, b in zip(rows[-1], rows[-1][1:], strict=False)])
    yield from parts([row[0] for row in rows], depth - 1)
    yield from parts([row[-1] for row in reversed(rows)], depth - 1)


def _legs(solved: Solved) -> list[Affine]:
    pairs = ((p[j], p[j + 1]) for piece in solved.controls for p in parts(piece) for j in range(len(p) - 1))
    return [affine_sum(((_ONE, b), (-_ONE, a))) for a, b in pairs]


def _chords(solved: Solved) -> list[Affine]:
    ends = ((p[0], p[-1]) for piece in solved.controls for p in parts(piece))
    return [affine_sum(((_ONE, b), (-_ONE, a))) for a, b in ends]


def _length(vector: Affine, free: Sequence[Point]) -> float:
    return max(float(sum(c * c for c in vector.at(free))) ** 0.5, 1e-6)


def _majorant(legs: Sequence[Affine], free: Sequence[Point], most: Fraction) -> Requirement:
    """The convex condition that is exact for these free points."""
    lengths = [Fraction(_length(leg, free)).limit_denominator(_PLACES) or Fraction(1, _PLACES) for leg in legs]
    squares = tuple((1 / (2 * size), leg) for size, leg in zip(lengths, legs, strict=True))
    form = weighted_sum((w, squared_length(leg)) for w, leg in squares).shifted(sum(lengths, _ZERO) / 2 - most)
    return Requirement("length of the polygon", form, squares)


def _shortest(chain: Chain, solved: Solved, rows: Sequence[Requirement], point: Sequence[Point]) -> tuple[Point, ...]:
    """Nearly the shortest chain, in floating point."""
    legs, varying, near = _legs(solved), [row for row in rows if not row.form.is_constant], tuple(point)
    for _ in range(_ROUNDS):
        proposal = proposals.least_value(chain, solved.size, varying, _majorant(legs, near, _ZERO).form)
        if proposal is None:
            break
        near = rounded_point(chain, proposal.point, 50)
    return near


def _short_enough(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], shortest: tuple[Point, ...]
) -> tuple[list[Requirement], tuple[Point, ...]]:
    """The best chain whose polygon is short enough, and the conditions that it keeps. Raises ``Unable``."""
    legs, most, near = _legs(solved), chain.max_length or _ZERO, shortest
    last = None
    for _ in range(_ROUNDS):
        inner = [*rows, _majorant(legs, near, most)]
        inside = _decided(chain, solved, inner)
        if inside is None or isinstance(inside, Contradiction):
            break
        near = best(chain, solved, inner, inside).free
        last = inner, near
    if last is None:
        raise Unable("no chain was seen to be short enough, and none was proved not to exist")
    return last


def directions(solved: Solved, free: Sequence[Point]) -> tuple[Point, ...]:
    """Vectors of length at most 1 along the chords."""
    result = []
    for chord in _chords(solved):
        vector, length = chord.at(free), _length(chord, free) * (1 + 1e-6)
        result.append(tuple(Fraction(round(float(c) / length * 1000), 1000) for c in vector))
    return tuple(u if sum(c * c for c in u) <= 1 else tuple(c * Fraction(998, 1000) for c in u) for u in result)


def chord_condition(chain: Chain, solved: Solved, along: Sequence[Point]) -> Requirement:
    """What every chain within the bound of the length keeps. Raises ``ValueError`` for vectors longer than 1."""
    if chain.max_length is None or any(sum(c * c for c in u) > 1 for u in along):
        raise ValueError("vectors of length at most 1 expected, and a bound on the length")
    forms = [(_ONE, linear_form(u, chord)) for u, chord in zip(along, _chords(solved), strict=True)]
    return Requirement(LENGTH, weighted_sum(forms).shifted(-chain.max_length))


def _with_chords(found: Best, along: Sequence[Point], weights: Any) -> Best:
    """The certificate, with the directions of its half-space in the label of the bound."""
    from qe.proof.certificate import Certificate, Labelled

    if LENGTH not in weights:
        return found
    text = "; ".join(" ".join(map(str, u)) for u in along)
    members = [m for m in found.certificate.payload if isinstance(m, Labelled)]
    first = (f"{members[0].label} with chords {text}", members[0].certificate)
    return replace(found, certificate=Certificate.bundle([first, *((m.label, m.certificate) for m in members[1:])]))


def stated_chords(chain: Chain, solved: Solved, text: str) -> Requirement:
    """The half-space of a label. Raises ``ValueError``."""
    if not re.fullmatch(r"[-0-9/ ;]+", text):
        raise ValueError("directions of chords expected")
    return chord_condition(chain, solved, [tuple(map(Fraction, part.split())) for part in text.split("; ")])


# --- curvature ------------------------------------------------------------------------------------------------
def _bent_less(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], start: tuple[Point, ...]
) -> tuple[Point, ...]:
    """A chain that samples show to be within the bound of the curvature. Raises ``Unable``."""
    objective, size, point, kept = objective_form(chain, solved), solved.size, start, None
    most = float(chain.max_curvature or 0) * (1 - 1e-5)
    unit = max(abs(float(c)) for p in chain.points for c in p)
    varying = [replace(r, form=r.form.shifted(_INSIDE * abs(r.right))) for r in rows if not r.form.is_constant]
    reach = unit / 2
    for _ in range(_STEPS):
        near = [_near(i, u, Fraction(reach).limit_denominator(_PLACES)) for i, u in enumerate(point)]
        bent = [*varying, *_linearised(chain, solved, point, most), *near]
        proposal = proposals.least_excess(chain, size, bent)
        if proposal is not None and proposal.excess < 0:
            proposal = proposals.least_value(chain, size, bent, objective)
        if proposal is None:
            break
        other = rounded_point(chain, proposal.point, 50)
        better, worse = _worst(solved, other), _worst(solved, point)
        if better <= most and all(row.form.value(other) <= 0 for row in rows):
            if kept is None or objective.value(other) < objective.value(kept):
                kept = other
            point = other
        elif better < worse:
            point = other
        else:
            reach /= 2
        if reach < 1e-4 * unit:
            break
    if kept is None:
        raise Unable(f"no chain with a curvature within {chain.max_curvature} was seen")
    return kept


def _near(i: int, at: Point, reach: Fraction) -> Requirement:
    away = Affine({i: _ONE}, tuple(-c for c in at))
    return Requirement(f"near {i}", squared_length(away).shifted(-(reach**2)), ((_ONE, away),))


def _bends(points: Any, t: float, sign: float) -> tuple[float, float]:
    """|v|³ and the area of v and a, in the plane signed, at t."""
    import numpy as np

    d = len(points) - 1
    first, second = np.diff(points, axis=0) * d, np.diff(points, 2, axis=0) * d * (d - 1)
    v, a = (sum(comb(len(b) - 1, k) * t**k * (1 - t) ** (len(b) - 1 - k) * b[k] for k in range(len(b))) for b in (first, second))
    if points.shape[1] == 2:
        return float(np.linalg.norm(v) ** 3), float(sign * (v[0] * a[1] - v[1] * a[0]))
    return float(np.linalg.norm(v) ** 3), float(np.linalg.norm(np.cross(v, a)))


def _floats(solved: Solved, free: Sequence[Point]) -> list[Any]:
    import numpy as np

    return [np.array([[float(c) for c in p.at(free)] for p in piece]) for piece in solved.controls]


def _worst(solved: Solved, free: Sequence[Point]) -> float:
    values = [_bends(p, t / 40, s) for p in _floats(solved, free) for t in range(41) for s in (1, -1)]
    return max(area / max(cube, 1e-12) for cube, area in values)


def _linearised(chain: Chain, solved: Solved, free: Sequence[Point], most: float) -> Iterator[Requirement]:
    """k |v|³ - |v x a| >= 0 at some t of each curve, to first order in its control points, by differences."""
    import numpy as np

    for k, points in enumerate(_floats(solved, free)):
        step = 1e-6 * (np.ptp(points) or 1.0)
        for t, sign in ((t, s) for t in _SAMPLES for s in ((1, -1) if chain.dimension == 2 else (1,))):
            cube, area = _bends(points, t, sign)
            value, slope = most * cube - area, np.zeros_like(points)
            if value > 2 * most * cube and sign < 0:
                continue
            for place in np.ndindex(points.shape):
                moved = points.copy()
                moved[place] += step
                above, side = _bends(moved, t, sign)
                slope[place] = (most * above - side - value) / step
            scale = 1 / max(float(np.linalg.norm(slope)), 1e-9)
            constant = Fraction(float((slope * points).sum() - value) * scale)
            normals = [tuple(Fraction(float(-c) * scale) for c in row) for row in slope]
            forms = [(_ONE, linear_form(n, p)) for n, p in zip(normals, solved.controls[k], strict=True)]
            if not (form := weighted_sum(forms).shifted(constant)).is_constant:
                yield Requirement(f"bend of C{k + 1} at {t:.3f}, {sign}", form)
