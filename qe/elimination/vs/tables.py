"""The substitution tables: sign conditions on A + B*sqrt(r) without the square root."""

from __future__ import annotations

from collections.abc import Callable

from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import Formula, Relation

EQ, NE, LT, LE, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT, Relation.GE

MakeAtom = Callable[[Poly, Relation], Formula]


def root_condition(a: Poly, b: Poly, d: Poly, relation: Relation, atom: MakeAtom) -> Formula:
    """A formula equivalent to ``a + b*sqrt(r) relation 0`` wherever r >= 0.

    ``d`` has everywhere the sign of a^2 - b^2*r (Weispfenning 1997, section 2; Kosta 2016, section 2.3):
    a + b*sqrt(r) = 0   iff  a*b <= 0 and d = 0
    a + b*sqrt(r) < 0   iff  a < 0 and d > 0, or b <= 0 and (a < 0 or d < 0)
    a + b*sqrt(r) <= 0  iff  a <= 0 and d >= 0, or b <= 0 and d <= 0
    and the others by negation.
    """
    if not b:
        return atom(a, relation)
    match relation:
        case Relation.EQ:
            return conj((atom(d, EQ), atom(a * b, LE)))
        case Relation.NE:
            return disj((atom(d, NE), atom(a * b, GT)))
        case Relation.LT:
            negative = atom(a, LT)
            return disj((conj((negative, atom(d, GT))), conj((atom(b, LE), disj((negative, atom(d, LT)))))))
        case Relation.LE:
            return disj((conj((atom(a, LE), atom(d, GE))), conj((atom(b, LE), atom(d, LE)))))
    return root_condition(-a, -b, d, relation.flipped, atom)
