"""What is true of a whole curve, as sentences with derivations that the kernel checks.

A curve is x = P_x(t), y = P_y(t), ... for 0 <= t <= 1, polynomials over Q, or over a field whose generator is named
by its polynomial and an interval. A sentence says that there is a point of the curve, between two parameters, at which
one of several systems of comparisons holds.

That it is false is proved in two steps: the coordinates are put in, and the signs of what they give are looked at.
Over Q the irreducible factors of the comparisons and of the ends of the interval have no common roots, so their signs
between all their real roots tell (lemma "line" of ``qe.kernel.signs``): there is a proof whenever the sentence is
false. Over a number field a polynomial of degree n is, on [a, b], the sum of its Bernstein coefficients times
(t - a)^k (b - t)^(n - k), up to a multiple of the generator's polynomial: an identity; and where the coefficients have
one sign, it has that sign (Farouki, "The Bernstein polynomial basis", CAGD 2012, section 3). Signs of the coefficients,
which are polynomials in the generator, are those on a line, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import count
from math import floor, lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Terms, rational
from qe.certify.registry import RULES
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.arithmetic.sturm import count_roots_between
from qe.kernel.block import block_goals
from qe.kernel.derivation import limits_of
from qe.kernel.linear_equation import Pivot, substituted
from qe.kernel.step import Claim
from qe.options import Budget
from qe.proof.certificate import Certificate, written
from qe.proof.entry import Entry, Json, poly_to_text
from qe.proving.lemma_list import EMPTY, Lemmas, Term, with_cases

System = Sequence[tuple[Terms, Relation]]
Span = tuple[Fraction, Fraction, int | None]
"""Ends of an interval of t, and the number of a comparison that fails on it; None where several do."""
COORDINATES = ("x", "y", "z")
UNIT = (Fraction(0), Fraction(1))


@dataclass(frozen=True)
class CurveSentence:
    """That at a point of the curve one of the systems holds, with t in ``between``; less than the second end where
    that is ``before``, and more than the first where that is ``after``."""

    curve: Bezier
    systems: Sequence[System]
    between: tuple[Fraction, Fraction] = UNIT
    before: bool = False
    after: bool = False

    @cached_property
    def theta(self) -> Any:
        """The generator of the field of the curve; None over Q."""
        values: Iterator[Any] = (c for p in self.curve.points for c in p)
        return next((v.field.theta for v in values if rational(v) is None), None)

    @cached_property
    def ring(self) -> Ring:
        """Of the generator and of t, and then of the coordinates."""
        return Ring.of((*(() if self.theta is None else ("root",)), "t", *COORDINATES[: self.curve.dimension]))

    @property
    def parameters(self) -> tuple[str, ...]:
        """The variables that are no coordinates."""
        return self.ring.names[: -self.curve.dimension]

    @cached_property
    def generator(self) -> tuple[Poly, ...]:
        """The polynomial of theta, and two linear ones: not negative and not positive there, and at no other root."""
        if self.theta is None:
            return ()
        root = self.ring.var("root")
        p = _total(self.ring, ((c, root**k) for k, c in enumerate(self.theta.minimal_polynomial)))
        ends = (dyadic_interval(self.theta, bits) for bits in count(1))
        low, high = next(pair for pair in ends if count_roots_between(p.to_univariate(0), *pair) == 1)
        return p, _above(root, low), _above(root, high)

    @cached_property
    def ends(self) -> tuple[Poly, Poly]:
        """Two polynomials in t: it is above the first end, and above the second, where they are positive."""
        t = self.ring.var("t")
        return _above(t, self.between[0]), _above(t, self.between[1])

    @cached_property
    def equations(self) -> dict[str, Poly]:
        """One for each coordinate, linear in it with a positive number as its coefficient."""
        return {name: self._equation(i) for i, name in enumerate(COORDINATES[: self.curve.dimension])}

    def _equation(self, i: int) -> Poly:
        rows = [coefficients_of(c) for c in bs.to_power(self.curve.coordinate(i))]
        below, t = lcm(*(c.denominator for row in rows for c in row)), self.ring.var("t")
        listed = ((k, j, int(c * below)) for k, row in enumerate(rows) for j, c in enumerate(row) if c)
        parts = [(c, t**k * self.ring.var("root") ** j if j else t**k) for k, j, c in listed]
        return below * self.ring.var(COORDINATES[i]) - _total(self.ring, parts)

    def comparison(self, item: tuple[Terms, Relation]) -> Formula:
        """A comparison in the coordinates."""
        terms, relation = item
        below = lcm(*(Fraction(c).denominator for c in terms.values()))
        rest = (0,) * len(self.parameters)
        return atom(self.ring.from_terms({(*rest, *e): int(c * below) for e, c in terms.items()}), relation)

    @cached_property
    def formula(self) -> Formula:
        """The sentence."""
        low, high = self.ends
        place = [atom(p, r) for p, r in zip(self.generator, (Relation.EQ, Relation.GE, Relation.LE), strict=False)]
        if self.between[0] == self.between[1]:
            place.append(atom(low, Relation.EQ))
        else:
            place.append(atom(low, Relation.GT if self.after else Relation.GE))
            place.append(atom(high, Relation.LT if self.before else Relation.LE))
        place += [atom(e, Relation.EQ) for e in self.equations.values()]
        return exists(self.ring.names, conj((*place, disj(conj(map(self.comparison, s)) for s in self.systems))))

    def put_in(self, formula: Formula) -> Iterator[tuple[str, Formula]]:
        """A conjunction with the curve's coordinates put in, after each of them."""
        claim = Claim("", TRUE, TRUE, self.ring, Entry({}, ""), "")
        for name, equation in self.equations.items():
            i = self.ring.index[name]
            rest, lead = equation.coefficients(i)
            kept = conj(part for part in conjuncts(formula) if part != atom(equation, Relation.EQ))
            formula = substituted(Pivot(i, name, lead, rest, 1, kept), claim)
            yield name, formula

    def with_coordinates(self) -> tuple[Formula, Json]:
        """The sentence about the parameters alone, and the step that leads to it."""
        assert isinstance(self.formula, Exists)
        body, solved = self.formula.body, list[Json]()
        for name, formula in self.put_in(body):
            if body != FALSE:  # it may be so before all coordinates are put in
                body, (unit, normal) = formula, self.equations[name].normal()
                solved.append([name, poly_to_text(normal), 1 if unit > 0 else -1])
        after, evidence = exists(self.parameters, body), {"solved": solved, "theory": EMPTY}
        return after, written("linear equation solved", (), self.formula, after, (), evidence)

    # --- proofs --------------------------------------------------------------------------------------------------

    def refuted(self, spans: Sequence[Sequence[Span]], budget: Budget | None = None) -> Certificate | None:
        """That it is false. ``spans``, of each system: intervals of t that follow one another, each with the number of
        a comparison that fails on it. None where these do not prove it."""
        if self.formula == FALSE:  # no system has a solution anywhere
            return Certificate.derivation(self.ring.names, FALSE, [], FALSE)
        after, first = self.with_coordinates()
        if after == FALSE:
            return Certificate.derivation(self.ring.names, self.formula, [first], FALSE)
        lemmas = Lemmas(self.ring)
        for system, listed in zip(self.systems, spans, strict=True):
            if self.theta is None:
                self._by_lines(lemmas, system, listed)
            else:
                self._by_coefficients(lemmas, system, listed)
        claim = Claim("signs", after, FALSE, self.ring, Entry({"theory": None}, ""), "")
        theory = lemmas.only(range(len(lemmas.lemmas)))
        proved = with_cases(theory, block_goals(claim, ()), self.ring, limits_of(budget or Budget(), RULES))
        if proved is None:
            return None
        steps = [first, written("signs", (), after, FALSE, (), {"theory": proved})]
        return Certificate.derivation(self.ring.names, self.formula, steps, FALSE)

    def holds_at(self, t: Fraction) -> Certificate:
        """That it is true, since it holds at this parameter."""
        after, first = self.with_coordinates()
        values: list[Json] = [str(t)]
        if self.generator:
            low, high = (str(_zero(end)) for end in self.generator[1:])
            polynomial = poly_to_text(self.generator[0].convert(Ring.of(("root",))))
            values.insert(0, {"polynomial": polynomial, "interval": [low, high]})
        evidence: Json = {"order": list(self.parameters), "values": values}
        steps = [first, written("instance", (), after, TRUE, (), evidence)]
        return Certificate.derivation(self.ring.names, self.formula, steps, TRUE)

    def _along(self, item: tuple[Terms, Relation]) -> Iterator[Poly]:
        """The polynomial of a comparison along the curve, where that depends on the parameters."""
        *_, (_, along) = self.put_in(self.comparison(item))
        if isinstance(along, Atom):
            yield along.poly

    def _by_lines(self, lemmas: Lemmas, system: System, spans: Sequence[Span]) -> None:
        """The signs of the comparisons that the spans name."""
        named = {i for _, _, i in spans}
        used = range(len(system)) if None in named else sorted(i for i in named if i is not None)
        polys = [p for i in used for p in self._along(system[i])]
        factors = [factor for p in polys for factor in _factored(lemmas, p)]
        lemmas.line(list(dict.fromkeys((*self.ends, *factors))), self.ring.index["t"])

    def _by_coefficients(self, lemmas: Lemmas, system: System, spans: Sequence[Span]) -> None:
        """The signs of Bernstein coefficients, and what they say."""
        signs = dict.fromkeys(self.generator)
        for low, high, i in spans:
            if i is not None:
                degree = self.curve.degree * max(map(sum, system[i][0]))
                for poly in self._along(system[i]):
                    signs.update(dict.fromkeys(self._coefficients(lemmas, poly, degree, (low, high))))
        lemmas.line(list(signs), 0)

    def _coefficients(
        self, lemmas: Lemmas, poly: Poly, degree: int, span: tuple[Fraction, Fraction]
    ) -> Iterator[Poly]:
        """The irreducible factors of the coefficients on a span; with A = da t - na and B = nb - db t, which are not
        negative on it, w = na db - nb da: w t = na B + nb A, and w = db A + da B."""
        (na, da), (nb, db) = (end.as_integer_ratio() for end in span)
        t, i = self.ring.var("t"), self.ring.index["t"]
        w, from_low, to_high = nb * da - na * db, da * t - na, nb - db * t
        scale, quotient, rest = _divided(poly, self.generator[0])
        above, whole = nb * t + na, db * t + da
        powers = enumerate(rest.coefficients(i))
        form = _total(self.ring, ((1, c * above**j * whole ** (degree - j)) for j, c in powers))
        terms: list[Term] = [(-scale * w**degree, ((poly, 1),))]
        if quotient:
            terms.append((w**degree, ((self.generator[0], 1), (quotient, 1))))
        for k, c in enumerate(form.coefficients(i)):
            if c:
                unit, factors = c.factors()
                basis = [(p, e) for p, e in ((from_low, k), (to_high, degree - k)) if e]
                terms.append((unit, (*factors, *basis)))
                yield from (factor for factor, _ in factors)
        lemmas.identity(terms)
        lemmas.identity(((db, ((from_low, 1),)), (da, ((to_high, 1),)), (-w, ())))


def _total(ring: Ring, terms: Iterable[tuple[int, Poly]]) -> Poly:
    return sum((c * p for c, p in terms), ring.constant(0))


def _above(x: Poly, value: Fraction) -> Poly:
    """Positive where x is above the value."""
    return x * value.denominator - value.numerator


def _zero(linear: Poly) -> Fraction:
    """Where a linear polynomial in one variable vanishes."""
    rest, lead = (c.constant_value() for c in linear.coefficients(linear.variables[0]))
    return Fraction(-rest, lead)


def _factored(lemmas: Lemmas, poly: Poly) -> list[Poly]:
    """The irreducible factors, with the identity that makes the polynomial of them."""
    unit, factors = poly.factors()
    if factors != ((poly, 1),):
        lemmas.identity(((1, ((poly, 1),)), (-unit, factors)))
    return [factor for factor, _ in factors]


def _divided(poly: Poly, p: Poly) -> tuple[int, Poly, Poly]:
    """(c, q, r): c*poly = q*p + r with c > 0, and r of lower degree than p in the first variable."""
    root, degree = poly.ring.gen(0), p.degree(0)
    lead = p.leading(0).constant_value()
    scale, quotient, rest = 1, poly.ring.constant(0), poly
    while rest.degree(0) >= degree:
        factor = rest.leading(0) * root ** (rest.degree(0) - degree)
        scale, quotient, rest = scale * lead, quotient * lead + factor, rest * lead - factor * p
    return scale, quotient, rest


def coefficients_of(value: Any) -> list[Fraction]:
    """A coordinate as a polynomial in the generator of its field."""
    number = rational(value)
    if number is not None:
        return [number]
    coefficients = list(value.coefficients)
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    return coefficients


def dyadic_interval(theta: Any, bits: int) -> tuple[Fraction, Fraction]:
    """The neighbouring multiples of 2^(e - bits) around an irrational theta with 2^e < |theta| < 2^(e + 1)."""
    working = bits + 32
    while True:
        ends = [Fraction(end) for end in theta.interval(working)]
        if ends[0] * ends[1] > 0 and _size(ends[0]) == _size(ends[1]):
            unit = Fraction(2) ** (_size(ends[0]) - bits)
            first, last = (floor(end / unit) for end in ends)
            if first == last:
                return first * unit, (first + 1) * unit
        working *= 2


def _size(value: Fraction) -> int:
    """The e with 2^e <= |value| < 2^(e + 1)."""
    result = value.numerator.bit_length() - value.denominator.bit_length()
    return result if abs(value) >= Fraction(2) ** result else result - 1
