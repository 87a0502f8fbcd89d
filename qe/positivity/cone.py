"""Polynomials without negative coefficients in linear forms that are not negative: on simplices, chains and cones.

THEOREM. Let g_0, …, g_n be affine forms in x_1, …, x_n (the number 1 may be one of them), linearly independent, so that
every x_k and 1 are linear combinations of them. A polynomial of degree d, made homogeneous by the combination that is
1, is a form of degree d in the g_k, in one way. Where all its coefficients are >= 0, the polynomial is >= 0 wherever
all g_k are; it is > 0 where the forms in one of its terms are. On a simplex with the faces g_k = 0 these are the
Bernstein coefficients; x_n, x_(n-1) - x_n, …, 1 - x_1 belong to the chain 1 >= x_1 >= … >= x_n >= 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import accumulate, combinations, islice, repeat
from math import comb, lcm, prod
from operator import mul

from qe.exact.quadratic_form import solve_linear
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Atom, Formula, Relation
from qe.positivity.identity import Positive, sum_of

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
        found = _in_forms(poly, chosen)
        if found is not None:
            return found
    return None


def _in_forms(poly: Poly, chosen: Sequence[Bound]) -> Positive | None:
    """The proof by these forms, if they are independent."""
    combined = _combined(poly.variables, chosen)
    if combined is None:
        return None
    scaled, scale = combined
    degree, one = poly.total_degree, scaled[0].ring.constant(1)
    powers = [list(accumulate(repeat(base, degree), mul, initial=one)) for base in scaled]
    total = one.ring.constant(0)
    for exponents, c in poly.terms():
        term = powers[-1][degree - sum(exponents)] * c
        for k, i in enumerate(poly.variables):
            if exponents[i]:
                term = term * powers[k][exponents[i]]
        total = total + term
    if any(c < 0 for _, c in total.terms()):
        return None
    parts, strict = [], False
    for exponents, c in total.terms():
        own = [(form, sign, never, e) for (form, sign, never), e in zip(chosen, exponents, strict=True) if e]
        turned = prod(sign**e for _, sign, _, e in own)
        parts.append((Fraction(c * turned, scale**degree), tuple((f, e) for f, _, _, e in own if not f.is_constant)))
        strict = strict or all(never for _, _, never, _ in own)
    return Positive((sum_of(poly, parts),), strict)


def _combined(variables: Sequence[int], chosen: Sequence[Bound]) -> tuple[list[Poly], int] | None:
    """The variables and, last, 1, all times the same positive number, in new variables that stand for the forms."""
    size = len(chosen)
    rows = [_row(form * sign, variables) for form, sign, _ in chosen]
    columns = [[row[j] for row in rows] for j in range(size)]
    inverse = []
    for k in range(size):
        solved = solve_linear(columns, [Fraction(j == k) for j in range(size)], size)
        if solved is None or solved.kernel:
            return None
        inverse.append([Fraction(e) for e in solved.particular])
    scale = lcm(*(entry.denominator for row in inverse for entry in row))
    ring = Ring.of(f"g{k}" for k in range(size))
    zero = ring.constant(0)
    return [sum((ring.gen(k) * int(e * scale) for k, e in enumerate(row)), zero) for row in inverse], scale


def _row(form: Poly, variables: Sequence[int]) -> list[Fraction]:
    """The coefficients of these variables, and the constant."""
    terms = dict(form.terms())
    units = [tuple(int(j == i) for j in range(form.ring.size)) for i in variables]
    return [Fraction(terms.get(exponents, 0)) for exponents in (*units, (0,) * form.ring.size)]
