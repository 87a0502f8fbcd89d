"""What a projection knows about a sample point: which polynomials over it have multiple roots, and which share one.

Let f and g have the degrees m and n in x, and let a be a sample point of the other variables; f_a and g_a are the
polynomials over it. These are facts about the single point a, whatever f and g do near it:
- disc(f)(a) = disc(f_a) where the degree of f_a is m, and up to sign disc(f)(a) = c^2 disc(f_a) where it is m - 1 and
  c its leading coefficient. So f_a, of degree d >= m - 1, has d distinct roots if disc(f) does not vanish at a, and at
  most d - 1 if it does (Basu, Pollack, Roy 2006, section 4.1; c^2 from the Sylvester matrix);
- res(f, g) is a combination of f and g: where it does not vanish, f_a and g_a have no root in common. Where it does and
  one of the degrees is kept, they have one, real or not (section 4.2 there).
Which factors of discriminants and resultants vanish at a is known exactly from the stacks below: they are projection
factors, and the sections of a sample list all that vanish there. So signs of the sample are enough for counting its
roots; no order-invariance is needed here (that the counts hold all over the cell is delineability, the theorem of the
projection, as before). Balls that isolate as many roots as are counted then prove what coincides: counts of this kind
settle most coincidences of validated numerics (McCallum, Collins 2002; Strzebonski 2006), the others are left to exact
arithmetic at the point.

Only what the projection has computed is asked for: a discriminant of a restricted level may be very large.
"""

from __future__ import annotations

from collections.abc import Callable

from qe.exact.ring import Poly

SignAt = Callable[[Poly], int]
"""The sign of a polynomial at the sample point, exactly."""

COUNTED_TO = 512
"""Bits up to which as many roots are looked for as the projection lets expect."""


def discriminant(f: Poly, variable: int) -> Poly:
    """The discriminant, remembered."""
    return f.ring.remembered(("discriminant", f, variable), lambda: f.discriminant(variable))


def resultant(f: Poly, g: Poly, variable: int) -> Poly:
    """The resultant, remembered."""
    return f.ring.remembered(("resultant in", f, g, variable), lambda: f.resultant(g, variable))


def most_distinct(sign: SignAt, f: Poly, var: int, degree: int) -> int | None:
    """How many distinct complex roots f has at most over the point, where its degree in ``var`` is ``degree``; that
    many if the number is ``degree``. None if the projection does not tell.
    """
    remembered = f.ring.cache.get(("discriminant", f, var))
    if not isinstance(remembered, Poly) or degree < max(1, f.degree(var) - 1):
        return None
    return degree - 1 if _vanishes(sign, remembered) else degree


def have_common_root(sign: SignAt, f: Poly, g: Poly, var: int) -> bool | None:
    """Whether two polynomials have a complex root in common over the point, where one of them keeps its degree; None if
    the projection does not tell. Without a kept degree only a False is true.
    """
    for pair in ((f, g), (g, f)):
        remembered = f.ring.cache.get(("resultant in", *pair, var))
        if isinstance(remembered, Poly):
            return _vanishes(sign, remembered)
    return None


def _vanishes(sign: SignAt, poly: Poly) -> bool:
    """Whether a polynomial vanishes, by its factors: they are the ones whose signs the sample knows."""
    return not poly or any(sign(p) == 0 for p, _ in poly.factors()[1])
