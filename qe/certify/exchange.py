"""Rule "two variables exchanged": the sum and the product of two variables in their place.

THEOREM. Real numbers s and p are x + y and x*y for some real x and y iff s^2 - 4*p >= 0. So let g imply s^2 - 4*p >= 0,
and let f(x, y) iff g(x + y, x*y); then ex x, y f iff ex s, p g. Here g has the names x and y for s and p. Of a
condition with p in f, g may have p^2 where it is an equation or an inequation; of two conditions p rel 0 and q rel 0,
p + q rel 0 together with p*q > 0 (rel is < or >), p*q >= 0 (<= or >=), p*q = 0 (=), or p*q /= 0 alone (/=): two numbers
have one sign iff their sum has it and their product is positive.

Evidence: ``variables``: x and y.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.certify.block import existential
from qe.certify.limits import check_power
from qe.certify.step import Claim, Context, Limits, only
from qe.certify.substitution import mapped
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import atoms, conjuncts

EQUAL = (Relation.EQ, Relation.NE)


def check_exchange(claim: Claim, context: Context, limits: Limits) -> None:
    """The sum and the product are put into what stands after, and it is compared with what stands before."""
    (listed,) = only(claim, "variables")
    names = [entry.text() for entry in listed.items()]
    before, after = existential(claim)
    if not isinstance(before, Exists) or not isinstance(after, Exists) or before.variables != after.variables:
        raise claim.fail("two blocks over the same variables expected")
    if len(set(names)) != 2 or len(names) != 2 or not set(names) <= set(before.variables):
        raise listed.fail("two variables of the block expected")
    x, y = (claim.ring.var(name) for name in names)
    i, j = (claim.ring.index[name] for name in names)
    if atom(x**2 - y * 4, Relation.GE) not in conjuncts(after.body):
        raise claim.fail("nothing says that there are such numbers")

    def back(given: Atom) -> Formula:
        limits.tick()
        check_power(x + y, given.poly.degree(i))
        check_power(x * y, given.poly.degree(j))
        return atom(given.poly.compose({i: x + y, j: x * y}), given.relation)

    found = mapped(after.body, back, (x, y), claim)
    wanted = conj((*_parts(before.body, i, j, claim), atom((x - y) ** 2, Relation.GE)))
    if exists(before.variables, found).free != before.free or set(conjuncts(found)) != set(conjuncts(wanted)):
        raise claim.fail("not the same conditions on the sum and the product")


def _parts(body: Formula, i: int, j: int, claim: Claim) -> Iterator[Formula]:
    """The conjuncts, those that change places taken together."""
    left, names = list(conjuncts(body)), (claim.ring.gen(i), claim.ring.gen(j))
    while left:
        part = left.pop(0)
        if all(isinstance(a, Atom) and _stays(a, i, j) for a in atoms(part)):
            yield mapped(part, lambda a: a if _swapped(a.poly, i, j) == a.poly else _squared(a), names, claim)
            continue
        other = atom(_swapped(part.poly, i, j), part.relation) if isinstance(part, Atom) else None
        if not isinstance(part, Atom) or other not in left:
            raise claim.fail("a condition changes when the variables change places")
        left.remove(other)
        yield from _together(part.poly, _swapped(part.poly, i, j), part.relation)


def _stays(found: Atom, i: int, j: int) -> bool:
    swapped = _swapped(found.poly, i, j)
    return swapped == found.poly or (swapped == -found.poly and found.relation in EQUAL)


def _squared(found: Atom) -> Formula:
    return atom(found.poly**2, found.relation)


def _swapped(poly: Poly, i: int, j: int) -> Poly:
    return poly.compose({i: poly.ring.gen(j), j: poly.ring.gen(i)})


def _together(p: Poly, q: Poly, relation: Relation) -> Iterator[Formula]:
    """p rel 0 and q rel 0, by their sum and their product."""
    if relation is not Relation.NE:
        yield atom(p + q, relation)
    strict = relation in (Relation.LT, Relation.GT)
    yield atom(p * q, relation if relation in EQUAL else Relation.GT if strict else Relation.GE)
