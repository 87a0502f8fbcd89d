"""Degree shift, recomputed: x^d renamed to x.

THEOREM (Dolzmann, Sturm & Weispfenning 1998). If the exponents of x in the atoms of F are multiples of d, but for
atoms that compare x itself with 0, then exists x. F iff exists x. G, with x for x^d in G; for even d with x >= 0
added. There, atoms x < 0, <=, >, >= need x >= 0 wherever F holds; x = 0 and x /= 0 do not. For odd d, x^d takes every
value once and has the sign of x; for even d and x >= 0 it takes every value >= 0 once, is 0 where x is, and F without
such atoms is the same at -x. If all atoms with x in F are strict, the solutions are an open set, so 0 is not the only
one, and x > 0 may be added instead.
"""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, conjuncts, map_atoms
from qe.proof.entry import Entry

GT, GE = Relation.GT, Relation.GE


def lowered(body: Formula, x: int, shift: int, entry: Entry) -> Formula:
    """The formula G of the theorem with what is added; ``CertificateRejected`` where the theorem does not apply."""
    ring = body.ring
    if shift == 1 or ring is None:
        return body
    with_x = [a for a in atoms(body) if isinstance(a, Atom) and a.poly.degree(x)]
    if shift % 2 == 0 and any(asks_sign(a, x) for a in with_x) and not _is_known(body, x):
        raise entry.fail("the sign of the variable is asked for, and it may be negative")

    def change(found: Atom | RootAtom) -> Formula:
        if isinstance(found, RootAtom) and ring.names[x] in found.free:
            raise entry.fail("no shift of degrees inside root atoms")
        return found if isinstance(found, RootAtom) else divided(found, x, shift, entry)

    strict = all(a.relation.is_strict for a in with_x)
    values = () if shift % 2 else (atom(ring.gen(x), GT if strict else GE),)
    return conj((map_atoms(body, change), *values))


def lowered_poly(p: Poly, x: int, shift: int) -> Poly:
    """The polynomial with every exponent of x divided by ``shift``."""
    result = p.ring.constant(0)
    for part in reversed(p.coefficients(x)[::shift]):
        result = result * p.ring.gen(x) + part
    return result


def divided(found: Atom, x: int, shift: int, entry: Entry) -> Formula:
    """The atom with x for x^shift; one that compares x itself stays."""
    if _is_bare(found.poly, x):
        return found
    if any(part and k % shift for k, part in enumerate(found.poly.coefficients(x))):
        raise entry.fail("not all exponents are multiples of it")
    return atom(lowered_poly(found.poly, x, shift), found.relation)


def asks_sign(found: Atom, x: int) -> bool:
    """Whether the atom says on which side of 0 the variable may lie."""
    return _is_bare(found.poly, x) and found.relation not in (Relation.EQ, Relation.NE)


def _is_bare(p: Poly, x: int) -> bool:
    return p.total_degree == 1 and p.term_count() == 1 and p.degree(x) == 1


def _is_known(body: Formula, x: int) -> bool:
    """Whether a conjunct says that the variable is not negative."""
    return any(isinstance(c, Atom) and _is_bare(c.poly, x) and -1 not in c.relation.signs for c in conjuncts(body))
