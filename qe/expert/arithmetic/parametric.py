"""Ideals with parameters, for the checker: parameter space in cases, each with a Gröbner basis for all of its points.

THEOREM (Buchberger; Weispfenning 1992). Let E vanish and nothing of N vanish at a point, let the leading coefficients
of G be products of members of N and constants, and let every S-polynomial of G leave no remainder on pseudo-division
by G modulo E. Then G at the point is a Gröbner basis of what it generates, with the same leading monomials at all such
points. Pseudo-division multiplies by leading coefficients alone, so what is generated stays what it was.

Where a leading coefficient is not known to vanish or not to, the case is divided into two by one of its factors: so the
cases cover everything and are disjoint, whatever the coefficients. Nothing here is shared with the producers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import lcm, prod

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.ideal import Ideal, Pairs, divides, is_finite, key, monomials_below, over, terms_of

Exponents = tuple[int, ...]
Terms = dict[Exponents, Poly]
"""A polynomial in the variables; coefficients are polynomials in the parameters."""

MOST_STEPS = 150
"""Steps that showing that a case is empty may take: it is not needed, only quicker."""

MOST_CASES, MOST_ELEMENTS, MOST_TERMS = 200, 60, 1000


@dataclass(frozen=True, slots=True)
class Conditions:
    """All of ``equal`` vanish, none of ``nonzero`` does."""

    ring: Ring
    equal: tuple[Poly, ...]
    nonzero: tuple[Poly, ...]
    tick: Callable[[], None]
    ideal: Ideal

    @staticmethod
    def of(ring: Ring, equal: Sequence[Poly], nonzero: Sequence[Poly], tick: Callable[[], None]) -> Conditions:
        """Raises ``Unable`` where the equations are beyond the limits."""
        factors = dict.fromkeys(f for p in nonzero for f in irreducible(p))
        ideal = Ideal([terms_of(p) for p in equal], [1] * ring.size, tick)
        return Conditions(ring, tuple(equal), tuple(factors), tick, ideal)

    def reduced(self, polys: Sequence[Poly]) -> list[Poly]:
        """One positive multiple of all of them, modulo the equations."""
        if not self.equal:
            return list(polys)
        rests = [self.ideal.remainder(terms_of(p)) for p in polys]
        scale = lcm(*(int(c.q) for rest in rests for c in rest.values()))
        return [self.ring.from_terms({e: int((c * scale).p) for e, c in rest.items()}) for rest in rests]

    def undecided(self, p: Poly) -> Poly | None:
        """A factor of p (not zero) that is not known to vanish nowhere; None where there is none."""
        return next((f for f in irreducible(p) if f not in self.nonzero), None)

    @property
    def is_empty(self) -> bool:
        """Whether no complex point is left: proved where True."""
        if not self.equal:
            return False
        wide = Ring.of((*self.ring.names, "|t|"))
        t, one = wide.gen(self.ring.size), wide.constant(1)
        product = prod((p.convert(wide) for p in self.nonzero), start=one)
        if product.term_count() > MOST_STEPS:
            return False
        polys = [*(p.convert(wide) for p in self.equal), one - t * product]
        left = iter(range(MOST_STEPS))

        def step() -> None:
            self.tick()
            if next(left, None) is None:
                raise Unable("a case is not shown to be empty")

        try:
            found = Ideal([terms_of(p) for p in polys], [1] * wide.size, step)
        except Unable:
            return False
        return any(not any(lead) for lead, _ in found.basis)


def irreducible(p: Poly) -> list[Poly]:
    """The factors of a polynomial that is not zero: their product, with powers, was multiplied out."""
    unit, factors = p.factors()
    if prod((f**k for f, k in factors), start=p.ring.constant(unit)) != p:
        raise Unable("a polynomial is not the product of its factors")
    return [f for f, _ in factors]


@dataclass(frozen=True)
class Case:
    """``basis``: pairs of leading monomial and polynomial, in degree reverse lexicographic order."""

    where: Conditions
    size: int
    basis: tuple[tuple[Exponents, Terms], ...]

    @property
    def leads(self) -> list[Exponents]:
        """The leading monomials."""
        return [lead for lead, _ in self.basis]

    @property
    def is_finite(self) -> bool:
        """Whether there are finitely many complex solutions."""
        return is_finite(self.leads, self.size)

    @cached_property
    def monomials(self) -> list[Exponents]:
        """Those that no leading monomial divides, 1 first. ``is_finite`` must hold."""
        return sorted(monomials_below(self.leads, self.size, MOST_ELEMENTS), key=key, reverse=True)

    def remainder(self, p: Terms, *, whole: bool = True) -> tuple[Poly, Terms]:
        """(s, r) with s p = r modulo the basis, s a product of leading coefficients and positive integers.

        No monomial of r is divisible by a leading one; without ``whole`` only its first one is not.
        """
        scale, *numbers = self.where.reduced([self.where.ring.constant(1), *p.values()])
        done, rest = Terms(), {e: c for e, c in zip(p, numbers, strict=True) if c}
        while rest:
            self.where.tick()
            top = min(rest, key=key)
            found = next(((lead, g) for lead, g in self.basis if divides(lead, top)), None)
            if found is None:
                if not whole:
                    break
                done[top] = rest.pop(top)
                continue
            lead, g = found
            common = g[lead].gcd(rest[top])
            factor, c = g[lead].exact_divide(common), rest[top].exact_divide(common)
            scale = scale * factor
            done = {e: d * factor for e, d in done.items()}
            rest, shift = {e: d * factor for e, d in rest.items()}, over(top, lead)
            for e, d in g.items():
                place = tuple(i + j for i, j in zip(e, shift, strict=True))
                rest[place] = rest.get(place, self.where.ring.constant(0)) - c * d
            places = [*done, *rest]
            scale, *numbers = self.where.reduced([scale, *done.values(), *rest.values()])
            listed = dict(zip(places, numbers, strict=True))
            done = {e: d for e in done if (d := listed[e])}
            rest = {e: d for e in rest if (d := listed[e])}
            if not scale:
                raise Unable("a case without points is not proved to be empty")
            if sum(d.term_count() for d in listed.values()) > MOST_TERMS:
                raise Unable("a polynomial with parameters grows past the limits of the checker")
        return scale, {**done, **rest}


@dataclass(frozen=True)
class _Task:
    """A case under way: what is still to be added, and the pairs whose S-polynomials are to be reduced."""

    case: Case
    queue: tuple[Terms, ...]
    pairs: Pairs = field(default_factory=Pairs)

    def within(self, where: Conditions) -> _Task:
        """The same under more conditions."""
        pairs = Pairs((), list(self.pairs.pending), set(self.pairs.done))
        return _Task(replace(self.case, where=where), self.queue, pairs)


def cases(polys: Sequence[Terms], size: int, where: Conditions) -> Iterator[Case]:
    """Disjoint cases that cover all points of ``where``. Raises ``Unable`` where there are too many, or they grow."""
    ordered = sorted((p for p in polys if p), key=lambda p: key(min(p, key=key)), reverse=True)
    pending, count = [_Task(Case(where, size, ()), tuple(ordered))], 0
    while pending:
        task, factor = _run(pending.pop())
        if factor is None:
            count += 1
            if count > MOST_CASES:
                raise Unable(f"a system with parameters has more than {MOST_CASES} cases")
            yield task.case
            continue
        here = task.case.where
        for equal, nonzero in (((*here.equal, factor), here.nonzero), (here.equal, (*here.nonzero, factor))):
            inside = Conditions.of(here.ring, equal, nonzero, here.tick)
            if not inside.is_empty:
                pending.append(task.within(inside))


def _run(task: _Task) -> tuple[_Task, Poly | None]:
    """The task when it is done, or when it has to know whether a factor vanishes."""
    case, queue, pairs = task.case, list(task.queue), task.pairs
    while True:
        case.where.tick()
        if not queue:
            pair = pairs.next(case.leads, case.where.tick)
            if pair is None:
                return _Task(case, ()), None
            queue.append(_s_polynomial(case, *pair))
        p = _tidied(case.remainder(queue.pop(0), whole=False)[1], case.where)
        if not p:
            continue
        lead = min(p, key=key)
        factor = case.where.undecided(p[lead])
        if factor is not None:
            return _Task(case, (p, *queue), pairs), factor
        if not any(lead):
            return _Task(replace(case, basis=((lead, p),)), ()), None
        if len(case.basis) >= MOST_ELEMENTS:
            raise Unable("a Gröbner basis with parameters grows past the limits of the checker")
        pairs.add(lead, case.leads)
        case = replace(case, basis=(*case.basis, (lead, p)))


def _s_polynomial(case: Case, i: int, j: int) -> Terms:
    (a, f), (b, g) = case.basis[i], case.basis[j]
    top = tuple(map(max, a, b))
    common = f[a].gcd(g[b])
    found: Terms = {}
    for lead, p, factor, sign in ((a, f, g[b], 1), (b, g, f[a], -1)):
        shift, own = over(top, lead), factor.exact_divide(common) * sign
        for e, c in p.items():
            place = tuple(x + y for x, y in zip(e, shift, strict=True))
            found[place] = found[place] + own * c if place in found else own * c
    return {e: c for e, c in found.items() if c}


def _tidied(p: Terms, where: Conditions) -> Terms:
    """Modulo the equations, without common integers and common factors that vanish nowhere."""
    listed = dict(zip(p, where.reduced(list(p.values())), strict=True))
    kept = {e: c for e, c in listed.items() if c}
    common = where.ring.constant(0)
    for c in kept.values():
        common = common.gcd(c)
    if not kept or (common.is_constant and abs(common.constant_value()) == 1):
        return kept
    unit = common.ring.constant(abs(common.normal()[0]))
    divisor = prod((f**k for f, k in common.factors()[1] if f in where.nonzero), start=unit)
    return {e: c.exact_divide(divisor) for e, c in kept.items()}
