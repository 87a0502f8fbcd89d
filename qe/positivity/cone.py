"""Polynomials without negative coefficients in linear forms that are not negative: on simplices, chains and cones.

THEOREM. Let g_0, …, g_n be affine forms in x_1, …, x_n (the number 1 may be one of them), linearly independent, so that
every x_k and 1 are linear combinations of them. A polynomial of degree d, made homogeneous by the combination that is
1, is a form of degree d in the g_k, in one way. Where that is >= 0 for all g_k >= 0, as it is where no coefficient is
negative, the polynomial is >= 0 wherever all g_k are; it is > 0 where the g_k in a positive term are. On a simplex with
the faces g_k = 0 these are Bernstein coefficients; x_n, x_(n-1) - x_n, …, 1 - x_1 say 1 >= x_1 >= … >= x_n >= 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, combinations, islice, repeat
from math import comb, lcm
from operator import mul

from qe.exact.quadratic_form import echelon
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Atom, Formula, Relation
from qe.positivity.identity import Positive, monomials
from qe.positivity.ordered import ordered_differences
from qe.positivity.prove import FEWEST_VARIABLES, nowhere_negative
from qe.positivity.samples import may_be_positive

MOST_VARIABLES, MOST_COEFFICIENTS, MOST_CHOICES = 5, 1_500, 12

Bound = tuple[Poly, int, bool]
"""A linear form, the sign that it has or may have beside 0, and whether it is never 0."""


def bounds_of(parts: Sequence[Formula]) -> tuple[Bound, ...]:
    """The inequalities among these conditions that are linear."""
    return tuple(
        (part.poly, 1 if part.relation in (Relation.GE, Relation.GT) else -1, part.relation.is_strict)
        for part in parts
        if isinstance(part, Atom) and part.relation not in (Relation.EQ, Relation.NE) and part.poly.total_degree == 1
    )


@lru_cache(maxsize=2_000)
def positive_on_cone(poly: Poly, bounds: tuple[Bound, ...]) -> Positive | None:
    """That the polynomial is nowhere negative where the bounds hold; None if no choice of them says so."""
    used = poly.variables
    if len(used) > MOST_VARIABLES or comb(poly.total_degree + len(used), len(used)) > MOST_COEFFICIENTS:
        return None
    one: Bound = (poly.ring.constant(1), 1, True)
    forms = [*(b for b in bounds if set(b[0].variables) <= set(used)), one]
    for chosen in islice(combinations(forms, len(used) + 1), MOST_CHOICES):
        proof = _in_forms(poly, chosen)
        if proof is not None:
            return proof
    return None


def _in_forms(poly: Poly, chosen: Sequence[Bound]) -> Positive | None:
    """The proof by these forms, if they are independent."""
    combined = _combined(poly.variables, chosen)
    if combined is None:
        return None
    scaled = combined
    degree, one = poly.total_degree, scaled[0].ring.constant(1)
    powers = [list(accumulate(repeat(base, degree), mul, initial=one)) for base in scaled]
    total = one.ring.constant(0)
    for exponents, c in poly.terms():
        term = powers[-1][degree - sum(exponents)] * c
        for k, i in enumerate(poly.variables):
            if exponents[i]:
                term = term * powers[k][exponents[i]]
        total = total + term
    every = frozenset(range(total.ring.size))
    proof = monomials(total)
    if proof is None and may_be_positive(total, every):
        least = FEWEST_VARIABLES + len(total.variables) - len(poly.variables)  # one more is the number 1
        proof = ordered_differences(total, every) or nowhere_negative(total, every, least)
    if proof is None:
        return None
    never = {total.ring.gen(k) for k, bound in enumerate(chosen) if bound[2]}
    strict = any(all(base in never for base, _ in powers) for _, powers in proof.identities[0].terms[1:])
    forms = Ring.of((*total.ring.names, *poly.ring.names))
    places = {k: form.convert(forms) * sign for k, (form, sign, _) in enumerate(chosen)}
    said = proof.at(lambda base: base.convert(forms).compose(places).convert(poly.ring))
    return Positive(said, strict and len(said) == 1)


def _combined(variables: Sequence[int], chosen: Sequence[Bound]) -> list[Poly] | None:
    """The variables and, last, 1, all times the same positive number, in new variables that stand for the forms."""
    size, count = len(chosen), chosen[0][0].ring.size
    units = [tuple(int(j == i) for j in range(count)) for i in (*variables, count)]
    rows = [[Fraction(dict(form.terms()).get(unit, 0) * sign) for unit in units] for form, sign, _ in chosen]
    reduced, pivots = echelon([[*row, *(Fraction(j == k) for j in range(size))] for k, row in enumerate(rows)])
    if [*pivots] != [*range(size)]:
        return None
    inverse = [[Fraction(entry) for entry in row[size:]] for row in reduced]
    ring, scale = Ring.of(f"g{k}" for k in range(size)), lcm(*(entry.denominator for row in inverse for entry in row))
    return [sum((ring.gen(k) * int(e * scale) for k, e in enumerate(row)), ring.constant(0)) for row in inverse]
