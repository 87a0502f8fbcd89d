"""Real roots of polynomials with ball coefficients: disjoint balls, each with exactly one root, or None."""

from __future__ import annotations

import itertools

from flint import acb_poly, arb, arb_poly

from qe.exact.balls import ball_sign


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


def certified_roots(c: list[arb], bits: int) -> list[arb] | None:
    """Real roots from isolating complex balls: a ball that meets its conjugate and no other holds a real root."""
    try:
        # Half the bits: cancellation in the coefficients costs some, and a tolerance out of reach at every
        # precision would never end. ``FibreRoot.ball`` asks again with more bits where it needs them.
        found = acb_poly(arb_poly(c)).roots(tol=arb(2) ** -(bits // 2))
    except ValueError:
        return None
    real: list[arb] = []
    for i, z in enumerate(found):
        if z.imag.contains(0):
            mirror = z.conjugate()
            if any(mirror.overlaps(other) for j, other in enumerate(found) if j != i):
                return None
            real.append(z.real)
    real.sort(key=arb.mid)
    return real if all(a < b for a, b in itertools.pairwise(real)) else None
