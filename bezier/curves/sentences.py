"""What is true of a whole curve, as sentences with derivations that the kernel checks.

A curve is x = P_x(t), y = P_y(t), ... for 0 <= t <= 1, polynomials over Q, or over a field whose generator is named
by its polynomial and an interval. A sentence says that there is a point of the curve, between two parameters, at which
one of several systems of comparisons holds.

That it is false is one step by signs. An identity says what a comparison is along the curve, up to multiples of the
equations of the coordinates. Over Q: which irreducible factors it has; these and the ends of the interval have no
common roots, so their signs between all their real roots tell (lemma "line" of ``qe.kernel.signs``): there is a proof
whenever the sentence is false. Over a number field: a polynomial of degree n is, on [a, b], the sum of its Bernstein
coefficients times (t - a)^k (b - t)^(n - k), up to a multiple of the generator's polynomial; and where the
coefficients have one sign, it has that sign (Farouki, "The Bernstein polynomial basis", CAGD 2012, section 3). Signs
of the coefficients, which are polynomials in the generator, are those on a line, too. That it is true needs a point:
the coordinates are put in, and the numbers for what is left.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import count, zip_longest
from math import floor, lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Terms, coefficients_of, generator_of
from qe.certify.claims import is_about
from qe.certify.registry import RULES
from qe.certify.verify import verify
from qe.errors import CertificateRejected
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
        return generator_of(c for p in self.curve.points for c in p)

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

    # --- proofs --------------------------------------------------------------------------------------------------

    def refuted(self, spans: Sequence[Sequence[Span]], budget: Budget | None = None) -> Certificate | None:
        """That it is false. ``spans``, of each system: intervals of t that follow one another, each with the number of
        a comparison that fails on it. None where these do not prove it."""
        if self.formula == FALSE:  # no system has a solution anywhere
            return Certificate.derivation(self.ring.names, FALSE, [], FALSE)
        lemmas = Lemmas(self.ring)
        for system, listed in zip(self.systems, spans, strict=True):
            if self.theta is None:
                self._by_lines(lemmas, system, listed)
            else:
                self._by_coefficients(lemmas, system, listed)
        return by_signs(self.formula, lemmas, budget or Budget())

    def holds_at(self, t: Fraction) -> Certificate:
        """That it is true, since it holds at this parameter."""
        assert isinstance(self.formula, Exists)
        body, solved = self.formula.body, list[Json]()
        claim = Claim("", TRUE, TRUE, self.ring, Entry({}, ""), "")
        for name, equation in self.equations.items():
            (rest, lead), (unit, normal) = equation.coefficients(self.ring.index[name]), equation.normal()
            others = conj(part for part in conjuncts(body) if part != atom(equation, Relation.EQ))
            body = substituted(Pivot(self.ring.index[name], name, lead, rest, 1, others), claim)
            solved.append([name, poly_to_text(normal), 1 if unit > 0 else -1])
        after, linear = exists(self.parameters, body), {"solved": solved, "theory": EMPTY}
        first = written("linear equation solved", (), self.formula, after, (), linear)
        values: list[Json] = [str(t)]
        if self.generator:
            rows = ((c.constant_value() for c in end.coefficients(0)) for end in self.generator[1:])
            low, high = (str(Fraction(-rest, lead)) for rest, lead in rows)
            polynomial = poly_to_text(self.generator[0].convert(Ring.of(("root",))))
            values.insert(0, {"polynomial": polynomial, "interval": [low, high]})
        evidence: Json = {"order": list(self.parameters), "values": values}
        steps = [first, written("instance", (), after, TRUE, (), evidence)]
        return Certificate.derivation(self.ring.names, self.formula, steps, TRUE)

    def _along(self, item: tuple[Terms, Relation]) -> tuple[list[Term], Poly]:
        """Terms that add up to a polynomial in the parameters alone: a multiple of the comparison's, and multiples of
        the equations of the coordinates."""
        comparison = self.comparison(item)
        if not isinstance(comparison, Atom):
            return [], self.ring.constant(0)
        scale, rest, listed = 1, comparison.poly, list[tuple[int, Poly, Poly]]()
        for name, equation in self.equations.items():
            factor, quotient, rest = _divided(rest, equation, self.ring.index[name])
            scale, listed = scale * factor, [(c * factor, q, e) for c, q, e in listed]
            listed += [(-1, quotient, equation)] if quotient else []
        return [(scale, ((comparison.poly, 1),)), *((c, ((q, 1), (e, 1))) for c, q, e in listed)], rest

    def _by_lines(self, lemmas: Lemmas, system: System, spans: Sequence[Span]) -> None:
        """The signs of the comparisons that the spans name."""
        named = {i for _, _, i in spans}
        used = range(len(system)) if None in named else sorted(i for i in named if i is not None)
        listed = [(terms, along) for terms, along in (self._along(system[i]) for i in used) if terms]
        parts = [along.factors() if along else (0, ()) for _, along in listed]
        often = Counter((*self.ends, *(factor for _, factors in parts for factor, _ in factors)))
        signs = dict.fromkeys(self.ends)
        for (terms, along), (unit, factors) in zip(listed, parts, strict=True):
            if all(e == 1 and often[factor] == 1 for factor, e in factors) and factors:
                unit, whole = along.normal()  # no other has a root of it: one sign says more than those of its factors
                factors = ((whole, 1),)
            lemmas.identity([*terms, *([(-unit, factors)] if unit else [])])
            signs |= dict.fromkeys(factor for factor, _ in factors)
        lemmas.line(list(signs), self.ring.index["t"])

    def _by_coefficients(self, lemmas: Lemmas, system: System, spans: Sequence[Span]) -> None:
        """The signs of Bernstein coefficients, and what they say."""
        signs = dict.fromkeys(self.generator)
        for low, high, i in spans:
            if i is not None and isinstance(self.comparison(system[i]), Atom):
                degree = self.curve.degree * max(map(sum, system[i][0]), default=0)
                signs |= self._coefficients(lemmas, self._along(system[i]), degree, (low, high))
        lemmas.line(list(signs), 0)

    def _coefficients(
        self, lemmas: Lemmas, form: tuple[Sequence[Term], Poly], degree: int, span: tuple[Fraction, Fraction]
    ) -> dict[Poly, None]:
        """The irreducible factors of the coefficients on a span."""
        scale, quotient, rest = _divided(form[1], self.generator[0], 0)
        listed = in_bernstein(rest, self.ring.index["t"], degree, span)
        terms: list[Term] = [(-c * scale * listed.power, parts) for c, parts in form[0]]
        if quotient:
            terms.append((listed.power, ((self.generator[0], 1), (quotient, 1))))
        return listed.say(lemmas, terms)


@dataclass(frozen=True, slots=True)
class InBernstein:
    """A polynomial times ``power`` is the sum of ``coefficients`` times powers of ``ends``, which are not negative on a
    span; these times ``shares`` are ``whole``."""

    power: int
    ends: tuple[Poly, Poly]
    shares: tuple[int, int]
    whole: int
    coefficients: tuple[Poly, ...]

    def say(self, lemmas: Lemmas, terms: Sequence[Term]) -> dict[Poly, None]:
        """That the sum with these terms is 0. Returns the irreducible factors of the coefficients."""
        listed, degree, signs = list(terms), len(self.coefficients) - 1, dict[Poly, None]()
        for k, c in enumerate(self.coefficients):
            if c:
                unit, factors = c.factors()
                basis = [(p, e) for p, e in ((self.ends[0], k), (self.ends[1], degree - k)) if e]
                listed.append((unit, (*factors, *basis)))
                signs |= dict.fromkeys(factor for factor, _ in factors)
        lemmas.identity(listed)
        lemmas.identity((*((c, ((p, 1),)) for c, p in zip(self.shares, self.ends, strict=True)), (-self.whole, ())))
        return signs


def in_bernstein(poly: Poly, i: int, degree: int, span: tuple[Fraction, Fraction]) -> InBernstein:
    """By powers of A = da t - na and B = nb - db t for the variable t with this number, from na/da to nb/db; with
    w = nb da - na db: w t = na B + nb A, and w = db A + da B."""
    (na, da), (nb, db) = (end.as_integer_ratio() for end in span)
    t, w = poly.ring.gen(i), nb * da - na * db
    above, whole = nb * t + na, db * t + da
    total = _total(poly.ring, ((1, c * above**j * whole ** (degree - j)) for j, c in enumerate(poly.coefficients(i))))
    listed = (*total.coefficients(i), *[poly.ring.constant(0)] * degree)[: degree + 1]
    return InBernstein(w**degree, (da * t - na, nb - db * t), (db, da), w, listed)


def by_signs(sentence: Formula, lemmas: Lemmas, budget: Budget) -> Certificate | None:
    """That a sentence is false by the signs of polynomials that these lemmas tell. None where they do not prove it, or
    have products that are too long for the kernel."""
    limits = limits_of(budget, RULES)
    try:
        theory = lemmas.only(range(len(lemmas.lemmas)))
        claim = Claim("signs", sentence, FALSE, lemmas.ring, Entry({"theory": theory}, ""), "")
        proved = with_cases(theory, block_goals(claim, ()), lemmas.ring, limits)
    except CertificateRejected:
        return None
    if proved is None:
        return None
    return Certificate.step("signs", lemmas.ring.names, sentence, FALSE, {"theory": proved})


def _total(ring: Ring, terms: Iterable[tuple[int, Poly]]) -> Poly:
    return sum((c * p for c, p in terms), ring.constant(0))


def _above(x: Poly, value: Fraction) -> Poly:
    """Positive where x is above the value."""
    return x * value.denominator - value.numerator


def _divided(poly: Poly, p: Poly, i: int) -> tuple[int, Poly, Poly]:
    """(c, q, r): c*poly = q*p + r with c > 0, and r of lower degree than p in a variable, whose power in p with the
    highest exponent has a positive number as its coefficient."""
    x, degree, lead = poly.ring.gen(i), p.degree(i), p.leading(i).constant_value()
    scale, quotient, rest = 1, poly.ring.constant(0), poly
    while rest and rest.degree(i) >= degree:
        factor = rest.leading(i) * x ** (rest.degree(i) - degree)
        scale, quotient, rest = scale * lead, quotient * lead + factor, rest * lead - factor * p
    return scale, quotient, rest


def dyadic_above(value: Fraction) -> Fraction:
    """A power of two, more than a positive number and at most twice it; 0 for 0."""
    return Fraction(2) ** (_size(value) + 1) if value else value


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


Said = tuple[str, Formula, Formula]
"""A label, a sentence, and its truth."""


def said_of(sentences: Mapping[str, Formula], truth: Formula = TRUE) -> list[Said]:
    """That all of these are true, or false."""
    return [(label, sentence, truth) for label, sentence in sentences.items()]


def verified(
    certificate: Certificate | None, said: Sequence[Said], exactly: Sequence[tuple[str, Certificate]] = ()
) -> None:
    """Whether a certificate is accepted and its members say just this, and then are just these. Raises
    ``CertificateRejected``."""
    members = certificate.payload if certificate is not None and isinstance(certificate.payload, tuple) else ()
    labels = [*(label for label, _, _ in said), *(label for label, _ in exactly)]
    pairs = zip_longest(labels, (member.label for member in members), fillvalue="none")
    if differing := next(((a, b) for a, b in pairs if a != b), None):
        raise CertificateRejected("members", "expected {:.60}, found {:.60}".format(*differing))
    if certificate is None or not members:
        raise CertificateRejected("members", "expected some")
    for member, (label, sentence, truth) in zip(members, said, strict=False):
        if is_about(member.certificate, sentence) != truth:
            raise CertificateRejected(label, f"it does not say that the sentence is {truth}")
    for member, (label, proof) in zip(members[len(said) :], exactly, strict=True):
        if member.certificate != proof:
            raise CertificateRejected(label, "another proof than the one that is made anew")
    verdict = verify(certificate)
    if not verdict.accepted:
        raise CertificateRejected(verdict.step, verdict.reason)
