"""Degree shift, recomputed: x^d renamed to x.

THEOREM (Dolzmann, Sturm & Weispfenning 1998). If the exponents of x in the atoms of F are multiples of d, but for
atoms that compare x itself with 0, then exists x. F iff exists x. G, with x for x^d in G; for even d with x >= 0
added, and atoms that compare x itself, but by = or /=, need a conjunct of F that says x >= 0. For odd d, x^d takes
every value once and has the sign of x; for even d and x >= 0 it takes every value >= 0 once, and F without such atoms
is the same at -x. If all atoms with x in F are strict, the solutions are an open set, so 0 is not the only one, and
x > 0 may be added instead.
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
    if shift == 1:
        return body
    with_x = [a for a in atoms(body) if isinstance(a, Atom) and a.poly.degree(x)]
    bare = [a for a in with_x if _is_bare(a.poly, x) and a.relation not in (Relation.EQ, Relation.NE)]
    if shift % 2 == 0 and bare and not any(b in conjuncts(body) and 1 not in _below(b) for b in bare):
        raise entry.fail("the sign of the variable is asked for, and it may be negative")

    def change(found: Atom | RootAtom) -> Formula:
        if isinstance(found, RootAtom) or _is_bare(found.poly, x):
            return found
        parts = found.poly.coefficients(x)
        if any(part and k % shift for k, part in enumerate(parts)):
            raise entry.fail("an exponent that is no multiple of it")
        return atom(lowered_poly(found.poly, x, shift), found.relation)

    strict = all(a.relation.is_strict for a in with_x)
    ring = body.ring
    assert ring is not None
    values = () if shift % 2 else (atom(ring.gen(x), GT if strict else GE),)
    return conj((map_atoms(body, change), *values))


def lowered_poly(p: Poly, x: int, shift: int) -> Poly:
    """The polynomial with every exponent of x divided by ``shift``."""
    result = p.ring.constant(0)
    for part in reversed(p.coefficients(x)[::shift]):
        result = result * p.ring.gen(x) + part
    return result


def _is_bare(p: Poly, x: int) -> bool:
    return p.total_degree == 1 and p.term_count() == 1 and p.degree(x) == 1


def _below(found: Atom) -> frozenset[int]:
    """1 is a member if the atom x relation 0 allows negative x."""
    return frozenset(-s for s in found.relation.signs if s < 0)
