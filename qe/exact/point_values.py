"""Real roots above a sample point, values there, and angles from cosine and sine, as rational intervals."""

from __future__ import annotations

import copyreg
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from flint import arb, arb_poly, fmpq

from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.balls import EXACT_FROM, ends, hull, lower_end, precision, upper_end
from qe.exact.ring import Poly
from qe.exact.sample import Fibre, FibreRoot, Point

Ends = tuple[Fraction, Fraction]


def roots_above(point: Point, var: int, f: Poly) -> list[FibreRoot] | None:
    """The distinct real roots, ascending, of a polynomial in variable ``var``, the next one after the point's.

    None if it vanishes identically at the point.
    """
    fibre = Fibre(point, var, point.reduce(f).coefficients(var))
    if not fibre.strip():
        return None
    fibre = Fibre(point, var, fibre.coefficients)
    return [FibreRoot(fibre, k) for k in range(len(fibre.roots()))]


def multiple_roots(roots: list[FibreRoot]) -> list[bool]:
    """Which of the real roots that ``roots_above`` found for one polynomial are multiple, exactly.

    Balls that keep all complex roots apart prove all simple; else the degree of the squarefree part tells how many
    coincide.
    """
    if not roots or not roots[0].fibre.exact:
        return [False] * len(roots)
    fibre = roots[0].fibre
    lost, point = len(fibre.source) - len(fibre.coefficients), fibre.point
    slope = Fibre(point, fibre.var, fibre.source).polynomial().derivative(fibre.var)
    places, open_ones, bits = (
        [point.extend(root) for root in roots],
        list(range(len(roots))) if lost else [],
        EXACT_FROM,
    )
    while lost == 1 and len(open_ones) > 1:  # then one real root is double, and the others will show their slopes
        with precision(bits + 16):
            open_ones = [k for k in open_ones if places[k].enclose(slope, bits).contains(0)]
        bits *= 2
    return [k in open_ones and (lost == 1 or places[k].sign(slope) == 0) for k in range(len(roots))]


def signs_around(point: Point, var: int, f: Poly, roots: list[FibreRoot]) -> list[int]:
    """The signs of the polynomial whose roots ``roots_above`` found: below the first one, between two, above the
    last."""
    samples, bits = list[fmpq](), EXACT_FROM
    while roots and not samples:
        balls = [root.ball(bits) for root in roots]
        gaps = [(upper_end(a), lower_end(b)) for a, b in pairwise(balls)]
        if all(low < high for low, high in gaps):
            samples = [lower_end(balls[0]) - 1, *((a + b) / 2 for a, b in gaps), upper_end(balls[-1]) + 1]
        bits *= 2
    return [point.extend(sample).sign(f) for sample in samples or [fmpq(0)]]


def roots_between(f: Poly, var: int) -> list[Fraction | RealAlgebraic]:
    """The real roots in [0, 1], ascending, of a nonzero polynomial in variable ``var`` alone."""
    roots = []
    for factor, _ in f.factors()[1]:
        p = factor.to_univariate(var)
        roots += [r for r in irreducible_roots(p) if r.compare_rational(fmpq(0)) >= 0 >= r.compare_rational(fmpq(1))]
    return [r.as_fraction() if r.is_rational else r for r in sorted(roots)]


@dataclass(frozen=True, slots=True, eq=False)
class Ball:
    """A number known to a ball; ``float``: about its middle. Its ends are worked out where they are asked for."""

    ball: arb

    @staticmethod
    def around(interval: Ends, bits: int) -> Ball:
        """A ball that holds an interval, with so many good bits."""
        with precision(bits):
            return Ball(hull(*(fmpq(v.numerator, v.denominator) for v in interval)))

    @property
    def ends(self) -> Ends:
        """The rational ends, exactly."""
        return ends(self.ball)

    def __float__(self) -> float:
        return float(self.ball.mid())


class Evaluation:
    """Balls around polynomials at a point, rational coordinates included (``Point.reduce`` keeps signs, not values).

    What the coordinates below have given is remembered, so that many points over one share it.
    """

    __slots__ = ("_known", "_parent", "_polynomials", "_powers", "point")

    def __init__(self, point: Point, parent: Evaluation | None = None) -> None:
        self.point, self._known = point, dict[tuple[Poly, int], arb]()
        self._polynomials: dict[tuple[Poly, int], arb_poly] = {}
        self._powers: dict[tuple[int, int, int], arb] = {}
        self._parent = Evaluation(point.parent) if parent is None and point.parent is not None else parent

    def extend(self, value: FibreRoot) -> Evaluation:
        """The same at the point one coordinate longer."""
        return Evaluation(self.point.extend(value), self)

    def enclose(self, f: Poly, bits: int) -> arb:
        """A ball around f, at FLINT's working precision."""
        if self._parent is not None and f.level < self.point.depth - 1 and isinstance(self.point.value, FibreRoot):
            return self._parent.enclose(f, bits)
        ball = self._known.get((f, bits))
        if ball is None:
            shared = isinstance(self.point.value, FibreRoot)
            ball = self._known[f, bits] = self._over_parent(f, bits) if shared else self._sum(f, bits)
        return ball

    def _over_parent(self, f: Poly, bits: int) -> arb:
        """The coordinates below are substituted once for all roots over them."""
        i, parent = self.point.depth - 1, self._parent
        assert parent is not None, "a root lies over a point"
        polynomial = parent._polynomials.get((f, bits))
        if polynomial is None:
            polynomial = arb_poly([parent.enclose(c, bits) for c in f.coefficients(i)])
            parent._polynomials[f, bits] = polynomial
        return polynomial(self._power(i, 1, bits))

    def _sum(self, f: Poly, bits: int) -> arb:
        """Term by term: the lists of terms are made once for each polynomial, the powers once for each point."""
        terms = f.__dict__.get("sparse")
        if terms is None:
            terms = f.__dict__["sparse"] = f.sparse_terms()
        total = arb(0)
        for powers, c in terms:
            term = arb(c)
            for i, k in powers:
                term = term * self._power(i, k, bits)
            total += term
        return total

    def _power(self, i: int, k: int, bits: int) -> arb:
        power = self._powers.get((i, k, bits))
        if power is None:
            value = self.point.coordinate(i)
            x = arb(value) if isinstance(value, fmpq) else self.point.ball(i, bits)
            power = self._powers[i, k, bits] = x**k
        return power

    def quotient(self, top: Poly, bottom: Poly, scale: Fraction, bits: int) -> Ball:
        """``scale * top / bottom`` in a ball at most 2^-bits wide; ``bottom`` does not vanish at the point."""
        factor, working = fmpq(scale.numerator, scale.denominator), bits + 16
        while True:
            with precision(working + 16):
                below = self.enclose(bottom, working)
                if not below.contains(0):
                    value = self.enclose(top, working) / below * factor
                    if 2 * value.rad() < arb(2) ** -bits:
                        return Ball(value)
            working *= 2


def angle(cosine: Ball, sine: Ball, bits: int) -> Ball:
    """The angle in (-pi, pi] with cosine and sine in these balls, not both of which contain 0.

    Where the angle pi cannot be told from -pi the ball is around pi.
    """
    with precision(bits + 16):
        c, s = cosine.ball, sine.ball
        if c > 0 or s > 0 or s < 0:
            return Ball(arb.atan2(s, c))
        return Ball(arb.pi() - (s / -c).atan())


def pi_ends(bits: int) -> Ends:
    """An interval around pi."""
    with precision(bits):
        return ends(arb.pi())


copyreg.pickle(Ball, lambda b: (Ball.around, (b.ends, 256)))
copyreg.pickle(Evaluation, lambda e: (Evaluation, (e.point, e._parent)))
