"""Comparisons of polynomials that are nowhere negative, or nowhere positive, by an identity that says so.

THEOREM. Where p is a sum of products that are nowhere negative (squares, and linear forms that the conditions beside it
keep from being negative), p >= 0 holds, p < 0 does not, and p <= 0 says p = 0; if one of the products is a positive
number, p > 0 holds. The identities are found in ``qe.positivity``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from qe.exact.ring import Poly, format_poly
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, Atom, Atomic, Formula, Relation
from qe.formula.traverse import conjuncts, map_atoms, polynomials
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Leaf, Node, Pending
from qe.simplifier.facts import generator

if TYPE_CHECKING:
    from qe.positivity.identity import Identity, Positive

MOST_POLYNOMIALS, FEWEST_VARIABLES, MOST_CONDITIONS = 12, 3, 4
"""Polynomials of a block, variables of each (with fewer, other methods are as quick), conditions taken together."""


def signs_before_substitution(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The same where an equation makes polynomials homogeneous, which is hidden where it is solved for a variable."""
    return (
        known_signs(variables, body, context)
        if any(is_equation for _, (*_, is_equation) in conditions_of(conjuncts(body)))
        else None
    )


def conditions_of(parts: Sequence[Formula]) -> Iterator[tuple[Poly, tuple[Poly, int, bool]]]:
    """Forms that are not linear and not smaller than a positive number, that number, and whether they are equal to it,
    behind the polynomials that a condition compares."""
    for part in parts:
        if isinstance(part, Atom) and part.relation in (Relation.EQ, Relation.GE, Relation.GT):
            form = part.poly - (least := int(part.poly.evaluate((0,) * part.poly.ring.size)))
            if least < 0 and form.total_degree > 1 and len({sum(e) for e, _ in form.terms()}) == 1:
                yield part.poly, (form, -least, part.relation is Relation.EQ)


def _by_others(poly: Poly, sign: int, body: Formula, orthant: frozenset[int]) -> Positive | None:
    """The sign of a polynomial by the others, where the body denies it: no condition is dropped for another one."""
    from qe.positivity.gram import sum_of_squares

    denied = [a for a in conjuncts(body) if isinstance(a, Atom) and a.poly == poly and sign not in a.relation.signs]
    atoms = (a for a in conjuncts(body) if isinstance(a, Atom) and a.poly != poly)
    others = [a for a in atoms if a.poly.total_degree > 1 or a.poly.term_count() > 1]
    conditions = [a.poly * s for a in others for s in (1, -1) if s in a.relation.signs <= {0, s}]
    if not denied or not 0 < len(conditions) <= MOST_CONDITIONS or len(poly.variables) <= FEWEST_VARIABLES:
        return None
    proof = sum_of_squares(poly * sign, orthant, tuple(conditions))
    enough = proof is not None and (proof.strict or any(0 not in a.relation.signs for a in denied))
    return proof if enough else None


def known_signs(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Every comparison with a polynomial of a known sign replaced by what is left of it."""
    if not body.is_quantifier_free:
        return None
    polys = [p for p in polynomials(body) if len(p.variables) >= FEWEST_VARIABLES and p.total_degree > 1]
    if not polys or len(polys) > MOST_POLYNOMIALS:
        return None
    from qe.positivity.conditions import positive_under  # what finds identities is seldom needed
    from qe.positivity.cone import bounds_of, positive_on_cone
    from qe.positivity.nearby import positive_beyond
    from qe.positivity.prove import nowhere_negative

    facts = context.facts.extended([p for p in conjuncts(body) if isinstance(p, Atom) and p.poly.total_degree == 1])
    ring = polys[0].ring
    orthant = frozenset(i for i in range(ring.size) if -1 not in facts.signs(generator(ring, i)))
    positive = [i for i in orthant if 0 not in facts.signs(generator(ring, i))]
    stated = (*conjuncts(body), *context.known)
    bounds, forms = bounds_of(stated), dict(conditions_of(stated))
    signs: dict[Poly, frozenset[int]] = {}
    proofs: list[Identity] = []

    def replaced(atomic: Atomic) -> Formula:
        poly = atomic.poly
        if not isinstance(atomic, Atom) or poly not in signs:
            return atomic
        possible = atomic.relation.signs & signs[poly]
        if not possible or possible == signs[poly]:
            return TRUE if possible else FALSE
        return atom(poly, Relation.EQ) if possible == {0} else atomic

    for poly in polys:
        for sign in (1, -1):
            context.watch()
            p = poly * sign
            under = () if poly in forms else forms.values()  # of conditions that imply one another one has to stay
            proof = (
                positive_beyond(p, orthant, positive)
                or nowhere_negative(p, orthant)
                or positive_on_cone(p, bounds)
                or positive_under(p, under, orthant)
                or (_by_others(poly, sign, body, orthant) if set(body.free) <= set(variables) else None)
            )
            if proof is None:
                continue
            signs[poly] = frozenset((sign,)) if proof.strict else frozenset((0, sign))
            if map_atoms(body, replaced) == body:
                del signs[poly]
            else:
                proofs += proof.identities
            break
    if not signs:
        return None
    after = map_atoms(body, replaced)
    kept = tuple(v for v in variables if v in after.free)
    node: Node = Pending(kept, after) if kept else Leaf((), after)
    return Found(StepKind.SQUARES, ", ".join(map(format_poly, signs)), node, {"identities": [i.terms for i in proofs]})
