"""Members of a sum of two ideals taken apart: s*g = f + e with f in the one and e in the other.

THEOREM. With a new variable t let J be the ideal of t*F, (1 - t)*E and <F>*<E>. If s*t*g - e lies in J and e is free
of t, then t = 1 gives s*g - e in <F>, and t = 0 gives e in <E>. Every element t*p + q of the algorithm below stands for
p in <F> + <E> whose part -q in <E> is known modulo <F>. What is free of t lies in both ideals: it makes the parts
smaller, but no further pairs; pairs inside either ideal, whose bases are known, are needless. So this is Buchberger's
algorithm for <F> + <E> alone, and it ends as soon as all members that are asked about have been reduced (the idea of
Kapur, Sun and Wang 2013, with each pair as one polynomial). Critical pairs are taken by sugar, the degree that they
would have if everything had been homogeneous (Giovini, Mora, Niesi, Robbiano, Traverso, ISSAC 1991).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from heapq import heappop, heappush

from flint import fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from qe.errors import InternalError, Unable
from qe.exact.groebner import groebner_basis
from qe.exact.ideals import LIMITS
from qe.exact.ring import Poly, Ring

HEAVY = 1_000_000
"""The weight of t: no polynomial has such a degree."""

MOST_PAIRS, MOST_TERMS = 2_000, 20_000
"""Pairs that are reduced, and terms of one polynomial."""

MOST_SHARED = 200
"""Terms of a polynomial in both ideals that is used in reductions."""


def taken_apart(
    members: Sequence[Poly],
    first: Sequence[Poly],
    second: Sequence[Poly],
    variables: Sequence[int],
    tick: Callable[[], None],
) -> list[tuple[int, Poly]]:
    """For each member g of <first, second> a number s > 0 and f such that f is in <first> and s*g - f in <second>.

    ``first``, ``second``: bases by ``graded_basis`` with the same ``variables``. Raises ``Unable`` at a limit.
    """
    if not members or any(p.is_constant for p in first):
        return [(1, g) for g in members]
    if any(p.is_constant for p in second):
        return [(1, g.ring.constant(0)) for g in members]
    return _Search(members[0].ring, variables, (first, second), tick).run(members)


def graded_basis(polys: Sequence[Poly], variables: Sequence[int]) -> tuple[Poly, ...]:
    """``variables``: all of the ring, in the order in which bases are small. Raises ``Unable`` at a limit."""
    basis = groebner_basis(polys, variables=variables, limits=LIMITS)
    if basis is None:
        raise Unable("the Gröbner basis of an ideal grows past its limits")
    return basis.polys


class _Search:
    """Elements t*p + q with the leading monomials of p, and those free of t that reduce, too."""

    def __init__(
        self, ring: Ring, variables: Sequence[int], bases: Sequence[Sequence[Poly]], tick: Callable[[], None]
    ) -> None:
        self.ring, self.variables, self.tick = ring, variables, tick
        self.context = fmpz_mpoly_ctx.get(("t", *(f"v{k}" for k in range(ring.size)), "tag"), "degrevlex")
        self.tag = self.context.gens()[-1]
        self.elements: list[fmpz_mpoly] = []
        self.reducers: fmpz_mpoly_vec | None = None
        self.leads: list[tuple[int, ...]] = []
        self.sides: list[int] = []
        self.sugars: list[int] = []
        self.pairs: list[tuple[int, int, tuple[int, ...], int, int]] = []
        self.done: set[tuple[int, int]] = set()
        self.shared = [self.inside(p) for p in bases[0] if p in bases[1]]
        self.shared += [self.inside(p * e) for p in bases[0] for e in bases[1] if p != e]
        for side, basis in enumerate(bases):
            for p in basis:
                self.add(self.inside(p, heavy=1) if side == 0 else self.inside(p) - self.inside(p, heavy=1), side)

    def inside(self, p: Poly, heavy: int = 0) -> fmpz_mpoly:
        return self.context.from_dict({(heavy * HEAVY, *(e[i] for i in self.variables), 0): c for e, c in p.terms()})

    def reduced(self, p: fmpz_mpoly) -> fmpz_mpoly:
        if self.reducers is None:
            self.reducers = fmpz_mpoly_vec([*self.elements, *self.shared], self.context)
        remainder = p.reduction_primitive_part(self.reducers)
        if len(remainder) > MOST_TERMS:
            raise Unable("taking the members of a sum of ideals apart grows past its limits")
        return remainder

    def add(self, p: fmpz_mpoly, side: int = 2, sugar: int = 0) -> None:
        """An element, and its pairs with those of another side (2: of neither ideal alone)."""
        place, lead = len(self.elements), tuple(int(k) for k in p.monomial(0))[1:]
        sugar = sugar or max(sum(int(k) for k in e[1:]) for e in p.monoms())
        for k, other in enumerate(self.leads):
            if side == self.sides[k] != 2 or not any(map(min, lead, other)):
                self.done.add((k, place))
            else:
                top = tuple(map(max, lead, other))
                rise = max(sugar - sum(lead), self.sugars[k] - sum(other))
                heappush(self.pairs, (sum(top) + rise, sum(top), top, k, place))
        self.reducers = None
        self.elements.append(p)
        self.leads.append(lead)
        self.sides.append(side)
        self.sugars.append(sugar)

    def run(self, members: Sequence[Poly]) -> list[tuple[int, Poly]]:
        left, parts = dict(enumerate(members)), dict[int, tuple[int, Poly]]()
        for _ in range(MOST_PAIRS):
            self.tick()
            for k, g in list(left.items()):
                if (part := self.part(g)) is not None:
                    parts[k] = part
                    del left[k]
            if not left:
                return [parts[k] for k in range(len(members))]
            while not self.enlarged():
                self.tick()
        raise Unable("taking the members of a sum of ideals apart takes too many steps")

    def part(self, g: Poly) -> tuple[int, Poly] | None:
        """s > 0, and what of s*g is in the first ideal; None where that is not known yet."""
        rest = self.reduced(self.inside(g, heavy=1) + self.tag)
        scale, terms = 0, {}
        for exponents, c in rest.terms():
            t, *e, tag = (int(k) for k in exponents)
            if t:
                return None
            if tag:
                scale = int(c)
            else:
                places = dict(zip(self.variables, e, strict=True))
                terms[tuple(places[i] for i in range(self.ring.size))] = int(c)
        member = scale * g - self.ring.from_terms(terms)
        return (scale, member) if scale > 0 else (-scale, -member)

    def enlarged(self) -> bool:
        """Whether the next pair gives a new element."""
        if not self.pairs:
            raise InternalError("a polynomial is no member of a sum of ideals")
        sugar, _, top, i, j = heappop(self.pairs)
        self.done.add((i, j))
        if self.is_needless(i, j, top):
            return False
        rest = self.reduced(self.elements[i].spoly(self.elements[j]))
        if rest and int(rest.monomial(0)[0]):
            self.add(rest, sugar=sugar)
            return True
        if rest and len(rest) <= MOST_SHARED:
            self.shared.append(rest)
            self.reducers = None
        return False

    def is_needless(self, i: int, j: int, top: tuple[int, ...]) -> bool:
        """Buchberger's second criterion."""
        return any(
            k not in (i, j)
            and all(a <= b for a, b in zip(lead, top, strict=True))
            and {(min(i, k), max(i, k)), (min(j, k), max(j, k))} <= self.done
            for k, lead in enumerate(self.leads)
        )
