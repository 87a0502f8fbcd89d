"""Degree shift (Dolzmann, Sturm & Weispfenning, J. Automated Reasoning 21 (1998), section 3).

THEOREM. Let every exponent of x in f be a multiple of k > 1, f(x) = g(x^k). Then ex x f iff ex x (g and x >= 0) for
even k, and iff ex x g for odd k, because x^k takes all non-negative (all) real values. Atoms x = 0 and x /= 0 may stay
as they are, and other atoms x rel 0 for odd k, and for even k if x >= 0 is known: then x and x^k have the same sign. A
solution of the right side lifts to its real k-th root. Where the solutions of f form an open set, x = 0 is never the
only one, and x > 0 will do.
"""

from __future__ import annotations

from math import gcd

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import TRUE, Atom, Atomic, Formula, Relation
from qe.formula.traverse import atoms, bound_variables, conjuncts, map_atoms
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import RootOf
from qe.rules.step import StepKind
from qe.rules.tree import Lifted, Pending


def shift_degree(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first variable of the block that it applies to."""
    inner = bound_variables(body)
    ring = next(atoms(body)).poly.ring
    known = context.facts.extended(conjuncts(body))
    for name in variables:
        x = ring.index[name]
        step = 1 if name in inner else common_exponent(body, x, nonnegative=-1 not in known.signs(ring.gen(x)))
        if step > 1:
            shifted = conj((values(ring.gen(x), step), lowered(body, x, step)))
            node = Lifted((RootOf(name, step),), Pending(variables, shifted))
            return Found(StepKind.DEGREE_SHIFT, f"{name}^{step}", node, {"variable": name, "exponent": step})
    return None


def common_exponent(body: Formula, x: int, *, nonnegative: bool = False) -> int:
    """The exponent k > 1 of the theorem for variable x, or 1.

    It is the greatest common divisor of the exponents of the variable, leaving out atoms that compare the variable
    itself with 0; where those occur and the variable may be negative, its odd part. No root atom may contain it.
    """
    step, bare = 0, False
    for atomic in atoms(body):
        if not isinstance(atomic, Atom) and atomic.poly.ring.names[x] in atomic.free:
            return 1
        if _is_bare(atomic.poly, x):
            bare = bare or atomic.relation not in (Relation.EQ, Relation.NE)
        elif atomic.poly.degree(x):
            for exponent, coefficient in enumerate(atomic.poly.coefficients(x)):
                if coefficient:
                    step = gcd(step, exponent)
        if step == 1:
            break
    while bare and not nonnegative and step and step % 2 == 0:
        step //= 2
    return max(step, 1)


def _is_bare(poly: Poly, x: int) -> bool:
    return poly.total_degree == 1 and poly.term_count() == 1 and poly.degree(x) == 1


def lowered(body: Formula, x: int, k: int) -> Formula:
    """The formula with x^k renamed to x, but for atoms that compare x itself with 0."""

    def change(atomic: Atomic) -> Formula:
        poly = atomic.poly
        if not isinstance(atomic, Atom) or not poly.degree(x) or _is_bare(poly, x):
            return atomic
        image = poly.ring.constant(0)
        for c in reversed(poly.coefficients(x)[::k]):
            image = image * poly.ring.gen(x) + c
        return atom(image, atomic.relation)

    return map_atoms(body, change)


def values(variable: Poly, k: int, *, strict: bool = False) -> Formula:
    """What the values of x^k satisfy, written for x; ``strict``: the solutions form an open set."""
    return TRUE if k % 2 else Atom(variable, Relation.GT if strict else Relation.GE)
