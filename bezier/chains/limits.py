"""Chains whose length or curvature is bounded: floating point looks for one, and exact enclosures prove it for all t.

LENGTH. A curve is at most as long as the polygons of its parts, and |a| <= |a|²/(2 l) + l/2 for every l > 0, with
equality for l = |a|: so sum |a|²/(2 l) + l/2 <= L over the legs is a convex condition that keeps the length within L;
choosing l anew (majorisation; Hunter, Lange, The American Statistician 58, 2004) leads to the optimum under the length
of the polygon. A curve is at least as long as its chords: sum u . chord <= L is necessary for all |u| <= 1, a
half-space, which takes part in the bound from below and in contradictions.

CURVATURE has no convex condition: it is linearised again and again near the last chain (sequential convex programming).
Chains without that bound are more, so that their bound from below holds, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import comb
from typing import Any

from bezier.chains import proof, proposals
from bezier.chains.chain import Chain, objective_form
from bezier.chains.form import Affine, Point, Requirement, Solved, affine_sum, linear_form, squared_length, weighted_sum
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import curvature_enclosure, length_enclosure
from qe.errors import Unable

_ZERO, _ONE, _HALF = Fraction(0), Fraction(1), Fraction(1, 2)
LENGTH = "length"
"""The label of the half-space that a bound on the length implies."""
CHORDS = " with chords "
"""In labels: the directions follow, from which that half-space is made."""
DEPTH = 3
"""A curve is halved so often."""
_ROUNDS, _STEPS, _PLACES = 12, 60, 10**6
_INSIDE = Fraction(1, 10**9)
_COARSE, _FINE = 12, 240


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


def best_within(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], inside: Sequence[Point]
) -> proof.Best | proof.Contradiction:
    """The best chain that is seen to keep the bounds, with a proved bound from below; or a proof that none is short
    enough. Raises ``Unable``."""
    free = proof.best(chain, solved, rows, inside)
    if not keeps_limits(chain, solved.curves(free.free)):
        return free
    inner, outer, point = list(rows), list(rows), free.free
    if chain.max_length is not None:
        least = _shortest(chain, solved, rows, point, _chords(solved))
        for along in (_straight(chain), directions(solved, least)):
            cut = chord_condition(chain, solved, along)
            if (none := _too_long(chain, solved, rows, cut)) is not None:
                return none
        inner, point = _short_enough(chain, solved, rows, _shortest(chain, solved, rows, point, _legs(solved)))
        outer.append(chord_condition(chain, solved, directions(solved, point)))
    if chain.max_curvature is not None:
        point = _bent_less(chain, solved, inner, point)
    if (broken := keeps_limits(chain, solved.curves(point))) or any(row.form.value(point) > 0 for row in rows):
        raise Unable(f"no chain was seen to keep the bounds: {broken or 'conditions are broken'}")
    varying = [row for row in outer if not row.form.is_constant]
    proposal = proposals.best(chain, solved.size, varying, objective_form(chain, solved))
    nothing = (_ZERO,) * len(varying)
    for weights in (*proof.rational_weights(proposal.weights), nothing) if proposal is not None else ():
        named = {row.label: w for w, row in zip(weights, varying, strict=True) if w}
        try:
            return proof.bounded(chain, solved, outer, point, named, _ONE)
        except Unable:
            continue
    raise Unable("no bound from below was proved")


def _too_long(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], cut: Requirement
) -> proof.Contradiction | None:
    """That the half-space excludes every chain: near the shortest one it hardly varies, and small multipliers of the
    balls hold the points that it leaves nearly free."""
    if isinstance(none := _decided(chain, solved, [*rows, cut]), proof.Contradiction):
        return none
    support = [cut, *(row for row in rows if row.is_ball and not row.form.is_constant)]
    for share in (Fraction(1, 10**k) for k in range(2, 10)):
        try:
            weights = {row.label: _ONE if row is cut else share / (row.right * len(support)) for row in support}
            return proof.contradiction(chain, solved.size, weights, support)
        except Unable:
            continue
    return None


def _decided(chain: Chain, solved: Solved, rows: Sequence[Requirement]) -> Any:
    try:
        return proof.decided(chain, solved, rows)
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
    square = float(sum(c * c for c in vector.at(free)))
    return float(max(square, 1e-12) ** 0.5)


def _majorant(legs: Sequence[Affine], free: Sequence[Point], most: Fraction) -> Requirement:
    """The convex condition that is exact for these free points."""
    lengths = [Fraction(_length(leg, free)).limit_denominator(_PLACES) or Fraction(1, _PLACES) for leg in legs]
    squares = tuple((1 / (2 * size), leg) for size, leg in zip(lengths, legs, strict=True))
    form = weighted_sum((w, squared_length(leg)) for w, leg in squares).shifted(sum(lengths, _ZERO) / 2 - most)
    return Requirement("length of the polygon", form, squares)


def _shortest(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], point: Sequence[Point], legs: Sequence[Affine]
) -> tuple[Point, ...]:
    """Where these vectors are nearly shortest in all, in floating point."""
    varying, near = [row for row in rows if not row.form.is_constant], tuple(point)
    for _ in range(_ROUNDS):
        proposal = proposals.best(chain, solved.size, varying, _majorant(legs, near, _ZERO).form)
        if proposal is None:
            break
        near = proof.rounded_point(chain, proposal.point, 50)
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
        if inside is None or isinstance(inside, proof.Contradiction):
            break
        near = proof.best(chain, solved, inner, inside).free
        last = inner, near
    if last is None:
        raise Unable("no chain was seen to be short enough, and none was proved not to exist")
    return last


def _straight(chain: Chain) -> tuple[Point, ...]:
    """From corner to corner, for all parts of a curve."""
    result = []
    for a, b in pairwise(chain.corners):
        arrow = tuple(y - x for x, y in zip(a, b, strict=True))
        result += [_shortened(arrow, float(sum(c * c for c in arrow)) ** 0.5)] * 2**DEPTH
    return tuple(result)


def _shortened(arrow: Point, length: float) -> Point:
    """Along the arrow, of length at most 1."""
    return tuple(Fraction(round(float(c) / (length * (1 + 2 / _PLACES)) * _PLACES), _PLACES) for c in arrow)


def directions(solved: Solved, free: Sequence[Point]) -> tuple[Point, ...]:
    """Vectors of length at most 1 along the chords."""
    return tuple(_shortened(chord.at(free), _length(chord, free)) for chord in _chords(solved))


def chord_condition(chain: Chain, solved: Solved, along: Sequence[Point]) -> Requirement:
    """What every chain within the bound of the length keeps. Raises ``ValueError`` for vectors longer than 1."""
    if chain.max_length is None or any(sum(c * c for c in u) > 1 for u in along):
        raise ValueError("vectors of length at most 1 expected, and a bound on the length")
    forms = [(_ONE, linear_form(u, chord)) for u, chord in zip(along, _chords(solved), strict=True)]
    text = "; ".join(" ".join(map(str, u)) for u in along)
    return Requirement(LENGTH, weighted_sum(forms).shifted(-chain.max_length), detail=f"{CHORDS}{text}")


def stated_chords(chain: Chain, solved: Solved, text: str) -> Requirement:
    """The half-space of a label. Raises ``ValueError``."""
    if not re.fullmatch(r"[-0-9/ ;]+", text):
        raise ValueError("directions of chords expected")
    return chord_condition(chain, solved, [tuple(map(Fraction, part.split())) for part in text.split("; ")])


# --- curvature ------------------------------------------------------------------------------------------------
def _bent_less(
    chain: Chain, solved: Solved, rows: Sequence[Requirement], start: tuple[Point, ...]
) -> tuple[Point, ...]:
    """A chain within the bounds, the best of those that were seen. Raises ``Unable``."""
    objective, size, point, kept = objective_form(chain, solved), solved.size, start, list[tuple[Point, ...]]()
    most = float(chain.max_curvature or 0) * (1 - 1e-5)
    unit = max(abs(float(c)) for p in chain.points for c in p)
    varying = [replace(r, form=r.form.shifted(_INSIDE * abs(r.right))) for r in rows if not r.form.is_constant]
    reach = unit / 10
    for _ in range(_STEPS):
        most_square, near = Fraction(reach).limit_denominator(_PLACES) ** 2, list[Requirement]()
        for i, u in enumerate(point):
            away = Affine({i: _ONE}, tuple(-c for c in u))
            near.append(Requirement(f"near {i}", squared_length(away).shifted(-most_square), ((_ONE, away),)))
        bent = [*varying, *_linearised(chain, solved, point, most), *near]
        proposal = proposals.best(chain, size, bent)
        if proposal is not None and proposal.excess < 0:
            proposal = proposals.best(chain, size, bent, objective)
        if proposal is None:
            break
        other = proof.rounded_point(chain, proposal.point, 50)
        better, worse = _excess(solved, other, most), _excess(solved, point, most)
        if not better and all(row.form.value(other) <= 0 for row in rows):
            if kept and objective.value(other) >= objective.value(kept[-1]):
                reach /= 2
            elif not keeps_limits(chain, solved.curves(other)):
                kept.append(other)
            point = other
        elif better < worse:
            point = other
        else:
            reach /= 2
        if reach < 1e-4 * unit:
            break
    if not kept:
        raise Unable(f"no chain with a curvature within {chain.max_curvature} was seen")
    return kept[-1]


def _bends(points: Any, t: Any) -> tuple[Any, Any]:
    """|v|³ and the area of v and a at these t, in the plane signed."""
    import numpy as np

    d = len(points) - 1
    v, a = (_values(np.diff(points, k, axis=0) * scale, t) for k, scale in ((1, d), (2, d * (d - 1))))
    areas = v[:, 0] * a[:, 1] - v[:, 1] * a[:, 0] if points.shape[1] == 2 else np.linalg.norm(np.cross(v, a), axis=1)
    return np.linalg.norm(v, axis=1) ** 3, areas


def _values(points: Any, t: Any) -> Any:
    d = len(points) - 1
    return sum(comb(d, k) * (t**k * (1 - t) ** (d - k))[:, None] * points[k] for k in range(d + 1))


def _floats(solved: Solved, free: Sequence[Point]) -> list[Any]:
    import numpy as np

    return [np.array([[float(c) for c in p.at(free)] for p in piece]) for piece in solved.controls]


def _curvatures(points: Any) -> tuple[Any, Any]:
    import numpy as np

    t = np.linspace(0, 1, _FINE + 1)
    cubes, areas = _bends(points, t)
    return t, np.abs(areas) / np.maximum(cubes, 1e-12)


def _excess(solved: Solved, free: Sequence[Point], most: float) -> float:
    """By how much the curvatures of the curves are too large at samples, in all."""
    return sum(max(0.0, float(_curvatures(points)[1].max()) - most) for points in _floats(solved, free))


def _linearised(chain: Chain, solved: Solved, free: Sequence[Point], most: float) -> Iterator[Requirement]:
    """k |v|³ - |v x a| >= 0 at some t of each curve, to first order in its control points, by differences."""
    import numpy as np

    for k, points in enumerate(_floats(solved, free)):
        fine, bends = _curvatures(points)
        t = np.unique(np.append(np.linspace(0, 1, _COARSE + 1), fine[bends.argmax()]))
        step = 1e-6 * float(np.ptp(points) or 1.0)
        cubes, areas = _bends(points, t)
        slopes = np.zeros((2, len(t), *points.shape))
        for place in np.ndindex(points.shape):
            moved = points.copy()
            moved[place] += step
            above, side = _bends(moved, t)
            slopes[0][:, *place], slopes[1][:, *place] = (above - cubes) / step, (side - areas) / step
        for i, sign in ((i, s) for i in range(len(t)) for s in ((1, -1) if chain.dimension == 2 else (1,))):
            value, slope = most * cubes[i] - sign * areas[i], most * slopes[0][i] - sign * slopes[1][i]
            scale = 1 / max(float(np.linalg.norm(slope)), 1e-9)
            constant = Fraction(float((slope * points).sum() - value) * scale)
            normals = [tuple(Fraction(float(-c) * scale) for c in row) for row in slope]
            forms = [(_ONE, linear_form(n, p)) for n, p in zip(normals, solved.controls[k], strict=True)]
            if not (form := weighted_sum(forms).shifted(constant)).is_constant:
                yield Requirement(f"bend of C{k + 1} at {t[i]:.3f}, {sign}", form)
