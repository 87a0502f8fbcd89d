"""Hermite's trace forms over a segment whose systems have finitely many complex solutions.

Over every point of the segment the quotient has the same monomials as a basis, and what the multiplications are is the
same rational function of the parameters everywhere: all denominators are products of leading coefficients, which vanish
nowhere on the segment. So one symmetric matrix of polynomials in the parameters, scaled by the square of a denominator,
has at every point the signature that counts the real solutions there (Weispfenning 1998; Fukasaku, Iwane, Sato 2015).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from math import lcm, prod
from operator import or_

from qe.errors import Unable
from qe.exact.block_order import Exponents
from qe.exact.hermite import leading_minors
from qe.exact.quotient import shifted, standard_monomials
from qe.exact.ring import Poly
from qe.groebner.segment import Segment
from qe.groebner.signs import SignatureConditions
from qe.options import Budget

MOST_MONOMIALS = 24
MOST_TERMS = 20_000
MOST_EXPANDED = 16
"""Complex solutions of which determinants are expanded; as many as the checker of the method takes."""

Matrix = tuple[tuple[Poly, ...], ...]
Powers = Counter[Poly]
"""A denominator, by irreducible factors: products would lose them where the equations of the segment reduce them."""


@dataclass(frozen=True)
class Vector:
    """Coordinates ``tops[k]/bottom`` of an element of the quotient; no factor of ``bottom`` vanishes on the segment."""

    tops: tuple[Poly, ...]
    bottom: Powers


class ParametricQuotient:
    """The quotient over a segment of dimension 0. Raises ``Unable`` where it grows past its limits."""

    def __init__(self, segment: Segment, budget: Budget) -> None:
        self.segment, self.block, self.budget = segment, segment.block, budget
        self.ring = segment.basis[0].ring
        self._rows = {lead: self.block.terms(p) for p, lead in zip(segment.basis, segment.leads, strict=True)}
        standard = standard_monomials(self._rows, len(self.block.variables), MOST_MONOMIALS, "a segment")
        self.monomials = tuple(sorted(standard, key=self.block.order.key))
        self._place = {m: k for k, m in enumerate(self.monomials)}
        self._known: dict[Exponents, Vector] = {}

    @property
    def size(self) -> int:
        """The number of complex solutions, with multiplicities, over every point of the segment."""
        return len(self.monomials)

    # --- normal forms ------------------------------------------------------------------------
    def normal_form(self, monomial: Exponents) -> Vector:
        """The coordinates of a monomial."""
        if monomial in self._place:
            one, zero = self.ring.constant(1), self.ring.constant(0)
            return Vector(tuple(one if m == monomial else zero for m in self.monomials), Powers())
        if monomial not in self._known:
            self.budget.check("trace forms")
            self.budget.spend(5)
            self._known[monomial] = self._found(monomial)
        return self._known[monomial]

    def _found(self, monomial: Exponents) -> Vector:
        if monomial in self._rows:
            terms = iter(self._rows[monomial].items())
            bottom = next(terms)[1]
            tops = [self.ring.constant(0)] * self.size
            for exponents, c in terms:
                tops[self._place[exponents]] = -c
            unit, factors = bottom.factors()
            return self._tidy([t * (1 if unit > 0 else -1) for t in tops], self._with_unit(factors, abs(unit)))
        k = next(k for k, e in enumerate(monomial) if e and shifted(monomial, k, -1) not in self._place)
        below = self.normal_form(shifted(monomial, k, -1))
        return self._combined(
            [(c, self.normal_form(shifted(m, k, 1))) for c, m in zip(below.tops, self.monomials, strict=True) if c],
            below.bottom,
        )

    def _with_unit(self, factors: Iterable[tuple[Poly, int]], unit: int) -> Powers:
        found = Powers(dict(factors))
        if unit > 1:
            found[self.ring.constant(unit)] = 1
        return found

    def _combined(self, parts: Sequence[tuple[Poly, Vector]], bottom: Powers) -> Vector:
        """The sum of multiples of vectors, over ``bottom``."""
        common = reduce(or_, (v.bottom for _, v in parts), Powers())
        tops = [self.ring.constant(0)] * self.size
        for c, v in parts:
            self.budget.check("trace forms")
            factor = c * self._expanded(common - v.bottom)
            for k, top in enumerate(v.tops):
                if top:
                    tops[k] = tops[k] + factor * top
        return self._tidy(tops, common + bottom)

    def _expanded(self, powers: Powers) -> Poly:
        return prod((f**e for f, e in powers.items()), start=self.ring.constant(1))

    def _tidy(self, tops: Sequence[Poly], bottom: Powers) -> Vector:
        """Reduced modulo the equations of the segment, and without common factors."""
        if (base := self.segment.base) is not None:
            reduced = [base.reduce(p) for p in tops]
            scale = lcm(*(s for s, _ in reduced))
            tops, bottom = [p * (scale // s) for s, p in reduced], bottom + self._with_unit((), scale)
        kept = Powers()
        for f, e in bottom.items():
            while e and all(not p or _divides(f, p) for p in tops):
                self.budget.check("trace forms")
                tops, e = [p.exact_divide(f) for p in tops], e - 1
            if e:
                kept[f] = e
        if sum(p.term_count() for p in tops) > MOST_TERMS:
            raise Unable("a trace form grows past its limits")
        return Vector(tuple(tops), kept)

    def of(self, poly: Poly) -> Vector:
        """The coordinates of a polynomial in variables and parameters."""
        parts = [(c, self.normal_form(e)) for e, c in self.block.terms(poly).items()]
        return self._combined(parts, Powers())

    def times(self, a: Vector, b: Vector) -> Vector:
        """The product of two elements."""
        parts = []
        for i, c in enumerate(a.tops):
            for j, d in enumerate(b.tops):
                if c and d:
                    parts.append((c * d, self.normal_form(_product(self.monomials[i], self.monomials[j]))))
        return self._combined(parts, a.bottom + b.bottom)

    # --- traces ------------------------------------------------------------------------------
    @cached_property
    def traces(self) -> Vector:
        """The traces of the monomials, over one denominator."""
        found = []
        for m in self.monomials:
            diagonal = [self.normal_form(_product(m, b)) for b in self.monomials]
            common = reduce(or_, (v.bottom for v in diagonal), Powers())
            parts = (v.tops[k] * self._expanded(common - v.bottom) for k, v in enumerate(diagonal))
            found.append((sum(parts, start=self.ring.constant(0)), common))
        common = reduce(or_, (bottom for _, bottom in found), Powers())
        return self._tidy([top * self._expanded(common - bottom) for top, bottom in found], common)

    def form(self, factor: Poly | None = None) -> Matrix:
        """Tr(h*b_i*b_j) for h = factor (1 by default), every b_i times a polynomial that vanishes nowhere on the
        segment.

        So the signature is that of the trace form, and the entries are polynomials.
        """
        size, h = self.size, None if factor is None else self.of(factor)
        entries: dict[tuple[int, int], tuple[Poly, Powers]] = {}
        for i in range(size):
            for j in range(i, size):
                v = self.normal_form(_product(self.monomials[i], self.monomials[j]))
                v = v if h is None else self.times(h, v)
                total = sum((c * t for c, t in zip(v.tops, self.traces.tops, strict=True)), start=self.ring.constant(0))
                tidy = self._tidy([total], v.bottom + self.traces.bottom)
                entries[i, j] = tidy.tops[0], tidy.bottom
        scales = row_scales({place: bottom for place, (top, bottom) in entries.items() if top}, size)
        rows = {}
        for (i, j), (top, bottom) in entries.items():
            missing = scales[i] + scales[j] - bottom if top else Powers()
            rows[i, j] = self._reduced(top * self._expanded(missing))
        return tuple(tuple(rows[min(i, j), max(i, j)] for j in range(size)) for i in range(size))

    def _reduced(self, poly: Poly) -> Poly:
        """A polynomial with the same values on the segment where that needs no factor, else the polynomial itself."""
        base = self.segment.base
        scale, rest = (1, poly) if base is None else base.reduce(poly)
        return rest if scale == 1 else poly

    def conditions(self, factor: Poly | None) -> SignatureConditions:
        """What decides the signature of the form for h = factor (1 for None)."""
        matrix = self.form(factor)
        minors = tuple(self._signed(m) for m in self._leading_minors(matrix))
        if factor is None:  # the trace of 1 is the number of solutions, times a square
            minors = (self.ring.constant(1), *minors[1:])
        is_hankel = len({k for m in self.monomials for k, e in enumerate(m) if e}) <= 1
        unit, factors = (1, ()) if factor is None else factor.factors()
        least = 0 if unit > 0 and all(power % 2 == 0 for _, power in factors) else None  # of a square
        return SignatureConditions(minors, lambda: self.characteristic(matrix), is_hankel, least, self.budget.check)

    def _leading_minors(self, matrix: Matrix) -> list[Poly]:
        """The determinants of the leading blocks, each reduced modulo the equations, which allow no divisions."""
        if self.size > MOST_EXPANDED:
            raise Unable(f"a trace form of {self.size} complex solutions is too large for sign conditions")

        def reduced(minor: Poly) -> Poly:
            if minor.term_count() > MOST_TERMS:
                raise Unable("a determinant of a trace form grows past its limits")
            return self._reduced(minor)

        def entry(i: int, j: int) -> Poly:
            self.budget.check("determinants of trace forms")
            return matrix[i][j]

        return list(leading_minors(entry, self.size, self.ring.constant(1), reduced=reduced))

    def characteristic(self, matrix: Matrix) -> tuple[Poly, ...]:
        """The coefficients of the characteristic polynomial, highest first, each with its sign, up to positive factors.

        Faddeev and LeVerrier's recursion: c_k = -Tr(A*M_k)/k, M_(k+1) = A*M_k + c_k.
        """
        size, ring = self.size, self.ring
        zero, one = ring.constant(0), ring.constant(1)
        current = [[one if i == j else zero for j in range(size)] for i in range(size)]
        coefficients = [one]

        def entry(i: int, j: int) -> Poly:
            self.budget.check("characteristic polynomials")
            return sum((matrix[i][m] * current[m][j] for m in range(size)), start=zero)

        for k in range(1, size + 1):
            product = [[entry(i, j) for j in range(size)] for i in range(size)]
            trace = sum((product[i][i] for i in range(size)), start=zero)
            c = (-trace).exact_divide(k)
            if c.term_count() > MOST_TERMS:
                raise Unable("a characteristic polynomial grows past its limits")
            coefficients.append(c)
            current = [[product[i][j] + c if i == j else product[i][j] for j in range(size)] for i in range(size)]
        return tuple(self._signed(c) for c in coefficients)

    def _signed(self, poly: Poly) -> Poly:
        """A polynomial with the same sign all over the segment: reduced modulo its equations."""
        base = self.segment.base
        if base is not None and poly:
            scale, poly = base.reduce(poly)
            poly = poly if scale > 0 else -poly
        unit, poly = poly.normal()
        for factor in self.segment.nonzero:
            while (halved := _over_square(poly, factor)) is not None:
                poly = halved
        return poly if unit >= 0 else -poly


def _over_square(poly: Poly, factor: Poly) -> Poly | None:
    """The quotient by the square of a polynomial, where there is one."""
    square = factor * factor
    if not poly or poly.total_degree < square.total_degree or poly.gcd(square).total_degree < square.total_degree:
        return None
    return poly.exact_divide(square)


def row_scales(bottoms: Mapping[tuple[int, int], Powers], size: int) -> list[Powers]:
    """For every row a polynomial such that scales[i]*scales[j] is a multiple of the denominator at (i, j)."""
    scales = [Powers() for _ in range(size)]
    for factor in dict.fromkeys(f for powers in bottoms.values() for f in powers):
        needed = {place: powers.get(factor, 0) for place, powers in bottoms.items()}
        own = [-(-needed.get((i, i), 0) // 2) for i in range(size)]
        for (i, j), power in needed.items():
            if own[i] + own[j] < power:
                own[j] += power - own[i] - own[j]
        for i, power in enumerate(own):
            if power:
                scales[i][factor] = power
    return scales


def _divides(factor: Poly, poly: Poly) -> bool:
    return factor.normal()[1] == factor.gcd(poly).normal()[1] and (
        not factor.is_constant or poly.normal()[0] % factor.constant_value() == 0
    )


def _product(a: Exponents, b: Exponents) -> Exponents:
    return tuple(i + j for i, j in zip(a, b, strict=True))
