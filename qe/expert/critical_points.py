"""Critical points of a block, and polynomials in the parameters that vanish over all of them.

THEOREM (after Fritz John 1948). Let T be the set of p for which some y has g_i(p, y) <= 0 and h_j(p, y) = 0, the y
bounded while p is. If p is a boundary point of T, then over p some y with g_i <= 0, h_j = 0 has lambda_i >= 0 and mu_j,
not all 0, and lambda_i = 0 where g_i < 0, with sum lambda_i grad g_i + sum mu_j grad h_j = 0 (gradients in y).
PROOF. Otherwise at every y of the closed fibre the gradients of h are independent and some d has grad h . d = 0 and
grad g_i . d < 0 for the active i (Motzkin); then all p' near p have strictly feasible y (implicit functions). If the
fibre is empty, it is so nearby, since it is bounded. By Caratheodory's theorem the set I of the i with lambda_i > 0 may
be taken such that |I| + |h| <= m + 1 for m variables y, or empty. A condition without y is a set of its own.

For each set I so given, g_I and h vanish at such a point, and so do the maximal minors of their Jacobian matrix in y if
|I| + |h| <= m. A *chain* derives further polynomials, each a combination of those before it with polynomials as
coefficients, up to constants: they all vanish there too. Those without y vanish over the points.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.kernel.reading import determinant
from qe.proof.entry import Entry

MOST_SETS, MOST_TERMS, MOST_VARIABLES = 5_000, 200_000, 6
"""Sets that may be active, terms of a product, and variables of the block (of determinants), at most."""


def active_sets(inequalities: Sequence[Poly], equations: Sequence[Poly], free: int) -> Iterator[list[Poly]]:
    """For each set of the theorem the polynomials that vanish; the variables from index ``free`` on are the block's."""
    alone = [g for g in inequalities if g.level < free]
    others = [g for g in dict.fromkeys(inequalities) if g.level >= free]
    yield from ([g] for g in alone)
    size = (others or equations)[0].ring.size if others or equations else free
    bound, sets = range(free, size), 0
    if len(bound) > MOST_VARIABLES:
        raise Unable(f"critical points in more than {MOST_VARIABLES} variables")
    for count in range(min(max(0, len(bound) + 1 - len(equations)), len(others)) + 1):
        for chosen in combinations(others, count) if count or equations else ():
            sets += 1
            if sets > MOST_SETS:
                raise Unable(f"more than {MOST_SETS} sets of active conditions")
            active = [*equations, *chosen]
            yield [*active, *_minors(active, bound)]


def _minors(active: Sequence[Poly], bound: Sequence[int]) -> list[Poly]:
    if len(active) > len(bound):
        return []
    rows = [[f.derivative(i) for i in bound] for f in active]
    chosen = combinations(range(len(bound)), len(active))
    return [d for columns in chosen if (d := determinant([[row[c] for c in columns] for row in rows], active[0].ring))]


def vanishing(start: Sequence[Poly], chain: Entry, free: int, ring: Ring) -> list[Poly]:
    """The polynomials without y that a chain leads to; ``CertificateRejected`` where there are none.

    A row of the chain is a list of [number of a polynomial, coefficient].
    """
    polys = list(start)
    for row in chain.items():
        total = ring.constant(0)
        for term in row.items():
            number, coefficient = term.row("number of a polynomial", "coefficient")
            if number.integer() >= len(polys):
                raise number.fail("expected the number of a polynomial before it")
            factor, poly = coefficient.polynomial(ring), polys[number.integer()]
            if factor.term_count() * poly.term_count() > MOST_TERMS:
                raise Unable(f"a product of more than {MOST_TERMS} terms")
            total = total + factor * poly
        if not total:
            raise row.fail("the combination is 0")
        polys.append(total.normal()[1])
    found = [p for p in polys if p and p.level < free]
    if not found:
        raise chain.fail("no polynomial in the parameters alone")
    return found
