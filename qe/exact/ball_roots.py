"""Roots of polynomials with ball coefficients: disjoint balls, each with exactly one distinct root, or None.

THEOREM (Smith 1970, "Error bounds for zeros of a polynomial based upon Gerschgorin's theorems"). Let p have degree n,
leading coefficient a, and let z_1, …, z_n be different complex numbers. The discs around z_i of radius
n |p(z_i)| / |a prod_{j != i} (z_i - z_j)| hold all roots of p, and a connected component of m of them holds exactly m,
counted with multiplicity. So every component holds a root, and where there are as many components as p is known to have
distinct roots at most, each of them holds exactly one distinct root: a cluster that is a multiple root.
"""

from __future__ import annotations

import itertools
from contextlib import suppress

from flint import acb, acb_poly, arb, arb_poly

from qe.exact.balls import EXACT_FROM, ball_sign
from qe.exact.counted_roots import counted_roots

FINER = 4
"""Bits by which balls are narrower than half the precision: what is asked for is mostly just that, and a ball that
misses it is looked for again with twice the precision."""

COARSE = 64
"""Bits with which clusters are first looked for: FLINT takes longer to find closer roots, or does not."""


def quadratic_roots(c: list[arb]) -> list[arb] | None:
    """The real roots, ascending, of a polynomial of degree 2 (coefficients from degree 0 up)."""
    discriminant = c[1] * c[1] - 4 * c[2] * c[0]
    sign = ball_sign(discriminant)
    if not sign:
        return None
    if sign < 0:
        return []
    root = discriminant.sqrt()
    if c[1] > 0:
        low = -(c[1] + root)
        pair = [low / (2 * c[2]), 2 * c[0] / low]
    else:
        high = root - c[1]
        if high.contains(0):
            return None
        pair = [2 * c[0] / high, high / (2 * c[2])]
    if c[2] < 0:
        pair.reverse()
    return pair if pair[0] < pair[1] else None


def certified_roots(c: list[arb], bits: int, most: int | None = None) -> list[arb] | None:
    """The real ones among ``distinct_roots``, ascending.

    The roots come in pairs of conjugates; so one whose ball meets its mirror image and no other ball's is real. Where
    all are simple and not found, ``counted_roots`` may tell them apart.
    """
    roots = distinct_roots(c, bits, most)
    if roots is None:
        return counted_roots(c, bits) if bits > EXACT_FROM and (most is None or most == len(c) - 1) else None
    real: list[arb] = []
    for i, z in enumerate(roots):
        if z.imag.contains(0):
            mirror = z.conjugate()
            if any(mirror.overlaps(other) for j, other in enumerate(roots) if j != i):
                return None
            real.append(z.real)
    real.sort(key=arb.mid)
    return real if all(a < b for a, b in itertools.pairwise(real)) else None


def distinct_roots(c: list[arb], bits: int, most: int | None = None) -> list[acb] | None:
    """Disjoint balls, one for every distinct complex root of a polynomial that is known to have at most ``most`` of
    them (None: its degree). The leading coefficient's ball does not contain zero.
    """
    if most is not None and most < len(c) - 1:
        clusters = _clusters(c, bits)
        return clusters if clusters is not None and len(clusters) == most else None
    # The tolerance is absolute, and half the bits: cancellation in the coefficients costs some. Roots that are large
    # for their coefficients do not reach it at any precision, and FLINT would try for ever: hence the bound on the
    # precision, and a second call without tolerance. ``FibreRoot.ball`` asks again with more bits where it needs them.
    for tolerance in (arb(2) ** -(bits // 2 + FINER), None)[: 1 + (bits > EXACT_FROM)]:
        with suppress(ValueError):
            return list(acb_poly(arb_poly(c)).roots(tol=tolerance, maxprec=2 * bits))
    return None


def _clusters(c: list[arb], bits: int) -> list[acb] | None:
    """Balls around the components of Smith's discs; the centres are good guesses, whose quality proves nothing."""
    rough = _rough_roots(c)
    if rough is None or len(rough) != len(c) - 1:
        return None
    p = acb_poly(arb_poly(c))
    held = _merged(_discs(p, rough))
    groups = [[z for z in rough if ball.overlaps(z)] for ball in held]
    if sum(map(len, groups)) != len(rough):
        return None
    return _merged(_discs(p, [z for group in groups for z in _refined(p, group, bits)]))


def _rough_roots(c: list[arb]) -> list[acb] | None:
    """Different numbers near the roots: nearly every small change of one coefficient leaves simple roots, about
    2^-(COARSE/m) apart where m coincide.
    """
    size = sum((abs(x.mid()) for x in c), arb(0))
    near = [(c[0].mid() + size * arb(2) ** -COARSE).mid(), *(x.mid() for x in c[1:])]
    try:
        return [_exact(z) for z in acb_poly(arb_poly(near)).roots(tol=arb(2) ** -COARSE, maxprec=8 * COARSE)]
    except ValueError:
        return None


def _refined(p: acb_poly, group: list[acb], bits: int) -> list[acb]:
    """As many numbers around the root of a derivative, which a multiple root is a simple root of."""
    size = len(group)
    for _ in range(size - 1):
        p = p.derivative()
    slope, x = p.derivative(), _exact(sum(group, acb(0)) / size)
    for _ in range(bits.bit_length()):
        x = _exact(x - p(x) / slope(x))
    if size == 1:
        return [x]
    reach = (1 + abs(x)) * arb(2) ** -(bits // size + FINER)
    return [_exact(x + acb(arb(2 * k) / size).exp_pi_i() * reach) for k in range(size)]


def _exact(z: acb) -> acb:
    return acb(z.real.mid(), z.imag.mid())


def _discs(p: acb_poly, centres: list[acb]) -> list[acb]:
    """Squares around Smith's discs; infinite ones where centres coincide."""
    degree, lead = p.degree(), abs(p[p.degree()])
    squares: list[acb] = []
    for i, z in enumerate(centres):
        apart = lead
        for j, other in enumerate(centres):
            if j != i:
                apart = apart * abs(z - other)
        reach = arb(0, (degree * abs(p(z)) / apart).upper())
        squares.append(acb(z.real + reach, z.imag + reach))
    return squares


def _merged(balls: list[acb]) -> list[acb]:
    """The hulls of overlapping balls, until none overlap."""
    kept: list[acb] = []
    for ball in balls:
        grown = True
        while grown:
            grown = False
            for other in kept:
                if ball.overlaps(other):
                    kept.remove(other)
                    ball, grown = acb(ball.real.union(other.real), ball.imag.union(other.imag)), True
                    break
        kept.append(ball)
    return kept
