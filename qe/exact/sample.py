"""Sample points with real algebraic coordinates: signs of polynomials at them, real roots above them.

A ``Point`` of depth k fixes variables 0..k-1 of a ring, each to a rational number, to a ``RealAlgebraic``
or to a ``FibreRoot`` (a root of a polynomial over the earlier coordinates). Rational coordinates are
substituted; signs come from ball arithmetic, and only where a ball cannot exclude zero does the exact
tower of fields (built lazily) prove the zero. No primitive elements.
"""

from __future__ import annotations

import copyreg
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from flint import acb, arb, arb_poly, fmpq, fmpq_mpoly, fmpq_poly, fmpz_poly

from qe.exact.algebraic import RealAlgebraic, select_root
from qe.exact.ball_roots import certified_roots, distinct_roots, quadratic_roots
from qe.exact.balls import EXACT_FROM, FIRST_PRECISION, ball_sign, lower_end, precision, upper_end
from qe.exact.from_projection import COUNTED_TO, most_distinct
from qe.exact.remainder import common_coefficients, divides, squarefree_coefficients
from qe.exact.ring import Poly, Ring
from qe.exact.tower import Tower
from qe.exact.univariate import from_univariate
from qe.exact.watch import Watch

SMALL = 100
"""Zero tests use remainder sequences up to this degree, and normal forms in the tower of fields above (measured)."""


class Point:
    """A point of R^depth; immutable apart from caches. Long arithmetic at it and above asks its ``watch``."""

    __slots__ = (
        "_balls",
        "_given",
        "_reduced",
        "_tower",
        "_vanishing",
        "algebraic",
        "depth",
        "memory",
        "parent",
        "ring",
        "value",
        "watch",
        "zeros",
    )

    def __init__(
        self,
        ring: Ring,
        parent: Point | None = None,
        value: fmpq | RealAlgebraic | FibreRoot | None = None,
        zeros: tuple[Poly, ...] = (),
        watch: Watch | None = None,
    ) -> None:
        self.ring, self.parent, self.zeros = ring, parent, zeros
        self.watch: Watch = parent.watch if parent is not None else watch or Watch()
        self._vanishing: tuple[Poly, ...] | None = None
        if isinstance(value, RealAlgebraic) and value.is_rational:
            value = value.as_fmpq()
        self.value = value
        self.depth: int = 0 if parent is None else parent.depth + 1
        inherited: tuple[int, ...] = () if parent is None else parent.algebraic
        rational = parent is None or isinstance(value, fmpq)
        self.algebraic: tuple[int, ...] = inherited if rational else (*inherited, self.depth - 1)
        self._reduced: dict[Poly, Poly] = {}
        self._tower: Tower | None = None
        self._balls: dict[tuple[int, int], arb] = {}
        self.memory: dict[tuple[Poly, int], Any] = {}  # what stands over this point in lines over longer ones
        self._given: dict[int, Fraction] | None = None  # where all rational coordinates are substituted at once

    @staticmethod
    def of(ring: Ring, values: Iterable[Fraction | int | RealAlgebraic]) -> Point:
        """The point with the given coordinates for variables 0, 1, …"""
        point = Point(ring)
        for value in values:
            point = point.extend(value if isinstance(value, RealAlgebraic) else RealAlgebraic.rational(value))
        if not ring.is_wide:  # nothing else stands over the points on the way: no step would be used again
            numbers = enumerate(map(point.number, range(point.depth)))
            point._given = {i: value for i, value in numbers if isinstance(value, Fraction)}
        return point

    def extend(self, value: fmpq | RealAlgebraic | FibreRoot, zeros: tuple[Poly, ...] = ()) -> Point:
        """The point one coordinate longer; ``zeros``: polynomials known to vanish at it."""
        return Point(self.ring, self, value, zeros)

    def ancestor(self, depth: int) -> Point:
        """The projection to the first ``depth`` coordinates."""
        point = self
        while point.depth > depth:
            assert point.parent is not None
            point = point.parent
        return point

    def supporting(self, f: Poly) -> Point:
        """The shortest of the points below and this on which it depends what f, in one variable more, is over it."""
        below = [i for i in f.variables if i < self.depth]
        return self if self._given is not None else self.ancestor(below[-1] + 1 if below else 0)

    def coordinate(self, i: int) -> fmpq | RealAlgebraic | FibreRoot:
        """The stored value of variable i."""
        value = self.ancestor(i + 1).value
        assert value is not None
        return value

    def number(self, i: int) -> Fraction | RealAlgebraic:
        """The value of variable i as a rational or a real algebraic number with its own minimal polynomial."""
        value = self.coordinate(i)
        if isinstance(value, fmpq):
            return Fraction(int(value.p), int(value.q))
        number = value if isinstance(value, RealAlgebraic) else value.number()
        return number.as_fraction() if number.is_rational else number

    # --- evaluation --------------------------------------------------------------------------
    def reduce(self, f: Poly) -> Poly:
        """A positive multiple of f with the rational coordinates substituted; cached."""
        stored = f if self.parent is None else self._reduced.get(f)
        if stored is None:
            i = self.depth - 1
            assert self.parent is not None
            stored = (
                self.parent.reduce(f)
                if self._given is None
                else f.at_rationals({i: v for i, v in self._given.items() if f.degree(i)})
            )
            if isinstance(self.value, fmpq) and stored.degree(i):
                stored = stored.at_rational(i, self.value)
            self._reduced[f] = stored
        return stored

    def univariate(self, f: Poly, i: int) -> fmpz_poly | None:
        """A positive multiple of f with the rational coordinates substituted, where it has no variable but ``i``."""
        if self.parent is None or self._given is not None or not isinstance(self.value, fmpq):
            g = self.reduce(f)
            return g.to_univariate(i) if g.variables in ((), (i,)) else None
        g, own = self.parent.reduce(f), self.depth - 1
        rows = _rows(g, own, i)
        return None if rows is None else fmpq_poly([row(self.value) for row in rows]).numer()

    def ball(self, i: int, bits: int) -> arb:
        """A ball around coordinate i (algebraic)."""
        point = self.ancestor(i + 1)
        key = (i, bits)
        stored = point._balls.get(key)
        if stored is None:
            value = point.value
            assert isinstance(value, RealAlgebraic | FibreRoot)
            stored = point._balls[key] = value.ball(bits)
        return stored

    def enclose(self, f: Poly, bits: int) -> arb:
        """A ball around f, whose variables are algebraic coordinates only, at this working precision."""
        variables = f.variables
        if not variables:
            return arb(f.p.leading_coefficient() if f else 0)
        i = variables[-1]
        x = self.ball(i, bits)
        if len(variables) == 1:
            univariate = f.__dict__.get("univariate")
            if univariate is None:
                univariate = f.__dict__["univariate"] = f.to_univariate(i)
            return univariate(x)
        total = arb(0)
        for c in reversed(f.coefficients(i)):
            total = total * x + self.enclose(c, bits)
        return total

    def sign(self, f: Poly) -> int:
        """The sign of f (in variables below the depth) at the point, exactly."""
        return self.sign_reduced(self.reduce(f))

    def sign_reduced(self, g: Poly) -> int:
        """The sign of a polynomial in the algebraic coordinates only."""
        sign = self._ball_sign(g, FIRST_PRECISION, EXACT_FROM)
        if sign is None:
            sign = 0 if self.is_zero(g) else self._ball_sign(g, 2 * EXACT_FROM, None)
        assert sign is not None
        return sign

    def apparent_sign(self, f: Poly) -> int | None:
        """The sign of f at the point where balls settle it, or None."""
        return self._ball_sign(self.reduce(f), FIRST_PRECISION, EXACT_FROM)

    def _ball_sign(self, g: Poly, bits: int, last: int | None) -> int | None:
        """The sign by balls of doubling precision up to ``last``."""
        if g.is_constant:
            value = g.constant_value()
            return (value > 0) - (value < 0)
        while last is None or bits <= last:
            with precision(bits + 16):
                sign = ball_sign(self.enclose(g, bits))
            if sign is not None:
                return sign
            self.watch()
            bits *= 2
        return None

    def is_zero(self, g: Poly) -> bool:
        """Whether a polynomial in the algebraic coordinates vanishes, by exact arithmetic alone."""
        if g.is_constant:
            return not g
        self.watch()
        at = self.ancestor(g.level + 1)
        if any(divides(f, g) for f in at.vanishing):
            return True
        value = at.value
        if isinstance(value, FibreRoot) and value.size_with(g) <= SMALL:
            return value.annuls(g)
        return self.tower.is_zero(g)

    def vanishes(self, g: Poly) -> bool:
        """Whether a polynomial in the algebraic coordinates vanishes: balls first, then exactly."""
        if g.is_constant:
            return not g
        with precision(EXACT_FROM + 16):
            if not self.enclose(g, EXACT_FROM).contains(0):
                return False
        return self.is_zero(g)

    @property
    def vanishing(self) -> tuple[Poly, ...]:
        """The polynomials known to vanish here, rational coordinates substituted: what they divide needs no proof."""
        if self._vanishing is None:
            own = (self.reduce(f) for f in self.zeros)
            below = () if self.parent is None else self.parent.vanishing
            self._vanishing = (*(f for f in own if not f.is_constant), *below)
        return self._vanishing

    @property
    def tower(self) -> Tower:
        """The field of the algebraic coordinates."""
        if self._tower is None:
            self._tower = Tower(self.ring) if self.parent is None else self._extended_tower()
        return self._tower

    def _extended_tower(self) -> Tower:
        assert self.parent is not None
        if isinstance(self.value, fmpq):
            return self.parent.tower
        below, i, value = self.parent.tower, self.depth - 1, self.value
        assert isinstance(value, RealAlgebraic | FibreRoot)
        known = value.fibre.polynomial() if isinstance(value, FibreRoot) else from_univariate(self.ring, i, value.poly)
        element = below.embed(known)
        if below.variables or isinstance(value, FibreRoot):
            element = below.squarefree_part(element, i)
            modulus = below.irreducible_factor(element, i, value.ball, self.parent.ball)
        else:
            modulus = below.monic(element, i)
        return below.extended(i, modulus)

    def __repr__(self) -> str:
        return f"Point({', '.join(str(self.number(i)) for i in range(self.depth))})"


def _rows(f: Poly, i: int, j: int) -> list[fmpz_poly] | None:
    """The coefficients in variable ``j``, from degree 0 up, as FLINT polynomials in variable ``i``; None where another
    variable occurs. They are kept with the polynomial, which stands over many points.
    """
    memory: dict[Any, Any] = f.__dict__
    key = ("rows", i, j)
    if key not in memory:
        memory[key] = None if set(f.variables) - {i, j} else [c.to_univariate(i) for c in f.coefficients(j)]
    stored: list[fmpz_poly] | None = memory[key]
    return stored


class Fibre:
    """A polynomial in variable ``var`` over an algebraic point: coefficients low to high, in algebraic coordinates.

    ``origin``: the polynomial of all variables that this is over the point, where it is one.
    """

    __slots__ = (
        "_bits",
        "_divided",
        "_most",
        "_roots",
        "_top",
        "_values",
        "coefficients",
        "exact",
        "origin",
        "point",
        "source",
        "var",
    )

    def __init__(self, point: Point, var: int, coefficients: tuple[Poly, ...], origin: Poly | None = None) -> None:
        self.point, self.var, self.coefficients, self.origin = point, var, coefficients, origin
        self.source = coefficients  # as given; ``coefficients`` may become the squarefree part
        self.exact = False  # whether the leading coefficient and squarefreeness have been proved
        self._roots: list[arb] | None = None
        self._bits = 0
        self._values: dict[int, arb_poly] = {}
        self._divided = False  # whether ``coefficients`` are those of a proper divisor
        self._top: int | None = None
        self._most: int | None = None  # the number of distinct complex roots is at most this, if less than the degree

    def value_sign(self, q: fmpq) -> int:
        """The sign of the polynomial as given (``source``) at a rational number that is not a root of it."""
        bits = min(self._values, default=FIRST_PRECISION)
        while True:
            with precision(bits + 16):
                if bits not in self._values:
                    self._values[bits] = arb_poly([self.point.enclose(c, bits) for c in self.source])
                sign = ball_sign(self._values[bits](arb(q)))
            if sign is not None:
                return sign
            bits *= 2

    @property
    def top_of_simple(self) -> int | None:
        """The sign above all roots, once these are isolated and all of them, the complex ones too, are simple."""
        simple = self._most is None and not self._divided and self._roots is not None
        return self._top if simple else None

    def vanishes_at(self, q: fmpq) -> bool:
        """Whether a rational number is a root, exactly."""
        return self.point.vanishes(self.polynomial().at_rational(self.var, Fraction(int(q.p), int(q.q))))

    def polynomial(self) -> Poly:
        """The polynomial itself."""
        total, x = self.point.ring.constant(0), self.point.ring.gen(self.var)
        for c in reversed(self.coefficients):
            total = total * x + c
        return total

    def strip(self) -> bool:
        """Remove leading coefficients that vanish at the point; False if nothing is left."""
        while self.coefficients and self.point.vanishes(self.coefficients[-1]):
            self.coefficients = self.coefficients[:-1]
        return bool(self.coefficients)

    def roots(self, bits: int = FIRST_PRECISION) -> list[arb]:
        """Disjoint balls around the distinct real roots, ascending; the polynomial is not zero at the point."""
        if self._roots is not None and self._bits >= bits:
            return self._roots
        bits = max(bits, EXACT_FROM if len(self.coefficients) > 3 else bits)  # fewer: too wide, looked for again
        enough = max(COUNTED_TO, 4 * bits)
        while True:
            self.point.watch()
            with precision(bits + 16):
                roots = self._attempt(bits)
            if roots is not None:
                self._roots, self._bits = roots, bits
                return roots
            if bits >= EXACT_FROM and not self.exact:
                self._make_exact()
            else:
                if self._most is not None and bits >= enough:
                    self._make_squarefree()  # fewer distinct roots than counted, or too close ones
                bits *= 2

    def distinct_roots(self, bits: int) -> list[acb] | None:
        """Disjoint balls around the distinct complex roots, one each, if so many bits tell them apart."""
        with precision(bits + 16):
            c = [self.point.enclose(a, bits) for a in self.coefficients]
            return None if c[-1].contains(0) else distinct_roots(c, bits, self._most)

    def _attempt(self, bits: int) -> list[arb] | None:
        c = [self.point.enclose(a, bits) for a in self.coefficients]
        if self.coefficients is self.source:
            self._values[bits] = arb_poly(c)
        if c[-1].contains(0):
            return None
        self._top = 1 if c[-1] > 0 else -1
        if len(c) <= 2:
            return [] if len(c) == 1 else [-c[0] / c[1]]
        if len(c) == 3:
            return quadratic_roots(c)
        return certified_roots(c, bits, self._most)

    def _make_exact(self) -> None:
        """Prove the degree. Then count the distinct roots, or make them all simple ones of another polynomial."""
        self.strip()
        self.exact = True
        if len(self.coefficients) == 3:
            c0, c1, c2 = self.coefficients
            if self.point.vanishes(c1 * c1 - 4 * (c2 * c0)):
                self.coefficients, self._divided = (c1, 2 * c2), True
        if len(self.coefficients) <= 3:
            return
        degree = len(self.coefficients) - 1
        most = None if self.origin is None else most_distinct(self.point.sign, self.origin, self.var, degree)
        if most is None:
            self._make_squarefree()
        elif most < degree:
            self._most = most

    def _make_squarefree(self) -> None:
        self._most, self._divided = None, True
        self.coefficients = squarefree_coefficients(self.coefficients, self.point.vanishes, self.point.watch)

    def element(self) -> fmpq_mpoly:
        """The polynomial over the point's tower, reduced, with a provably nonzero leading coefficient."""
        if not self.exact:
            self.strip()
        return self.point.tower.embed(self.polynomial())


class FibreRoot:
    """The index-th real root (from 0) of a fibre."""

    __slots__ = ("_number", "fibre", "index")

    def __init__(self, fibre: Fibre, index: int) -> None:
        self.fibre, self.index = fibre, index
        self._number: RealAlgebraic | None = None

    def ball(self, bits: int = FIRST_PRECISION) -> arb:
        """A ball around the root whose relative or absolute error is about 2^-bits."""
        working = bits
        while True:
            x = self.fibre.roots(working)[self.index]
            if x.rel_accuracy_bits() >= bits or x.rad() < arb(2) ** -bits:
                return x
            working *= 2

    def compare_rational(self, q: fmpq) -> int:
        """The sign of self - q, exactly."""
        bits, different = FIRST_PRECISION, False
        while True:
            x = self.ball(bits)
            if q < lower_end(x):
                return 1
            if q > upper_end(x):
                return -1
            if bits >= EXACT_FROM and not different:
                if self.fibre.vanishes_at(q):
                    return 0  # the balls of the real roots are disjoint, so q is the root whose ball it lies in
                different = True
            bits *= 2

    def size_with(self, g: Poly) -> int:
        """A bound on the degrees met in a remainder sequence with g."""
        coefficients, degree = self.fibre.coefficients, g.degree(self.fibre.var)
        below = max(c.total_degree for c in coefficients)
        return degree * below + (len(coefficients) - 1) * (g.total_degree - degree)

    def annuls(self, g: Poly) -> bool:
        """Whether g, in the fibre's variable and the coordinates below, vanishes at the root."""
        shared = common_fibre(self.fibre, Fibre(self.fibre.point, self.fibre.var, g.coefficients(self.fibre.var)))
        bits = EXACT_FROM
        while shared is not None:
            roots, common = self.fibre.roots(bits), shared.roots(bits)
            places = [[k for k, x in enumerate(roots) if x.overlaps(y)] for y in common]
            if all(len(matches) == 1 for matches in places):
                return [self.index] in places
            bits *= 2
        return False

    def number(self) -> RealAlgebraic:
        """The root with its minimal polynomial over Q, through the norm."""
        fibre, tower = self.fibre, self.fibre.point.tower
        if self._number is None:
            element = tower.squarefree_part(fibre.element(), fibre.var)
            factor = tower.irreducible_factor(element, fibre.var, self.ball, fibre.point.ball)
            self._number = select_root(tower.norm(factor, fibre.var), self.ball)
        return self._number


def common_fibre(f: Fibre, g: Fibre) -> Fibre | None:
    """The greatest common divisor of two fibres over one point, not both zero, or None if it is constant."""
    common = common_coefficients(f.coefficients, g.coefficients, f.point.vanishes, f.point.watch)
    return None if len(common) == 1 else Fibre(f.point, f.var, common)


# Balls cannot be sent to other processes, which find them again from what the coordinates are.
copyreg.pickle(Point, lambda p: (Point, (p.ring, p.parent, p.value, p.zeros)))
copyreg.pickle(Fibre, lambda f: (Fibre, (f.point, f.var, f.source, f.origin)))
copyreg.pickle(FibreRoot, lambda r: (FibreRoot, (r.fibre, r.index)))
