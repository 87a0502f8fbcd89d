"""Identities that write a polynomial as a sum: of squares, of its monomials, of products of distances from bounds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import islice, product
from math import lcm

from qe.exact.ring import Poly
from qe.proving.lemma_list import Lemmas, Term
from qe.simplifier.minima import minimum

MOST_MONOMIALS, MOST_ALIKE, MOST_CORNERS = 24, 500, 4


def as_squares(theory: Lemmas, poly: Poly) -> None:
    """The polynomial as a constant and positive multiples of squares (or of even monomials)."""
    for sign in (1, -1):
        least = minimum(poly * sign)
        if least is not None:
            scale = lcm(least.value.denominator, *(weight.denominator for weight, _ in least.squares))
            squares: list[Term] = [(int(weight * scale), _squared(root)) for weight, root in least.squares]
            theory.identity([(-scale * sign, ((poly, 1),)), *squares, (int(least.value * scale), ())])


def _squared(root: Poly) -> tuple[tuple[Poly, int], ...]:
    """The square of a polynomial as powers: of variables, if it is a monomial."""
    (exponents, _), *more = root.terms()
    return ((root, 2),) if more else tuple((root.ring.gen(i), 2 * k) for i, k in enumerate(exponents) if k)


def monomials(poly: Poly) -> list[Term]:
    """The terms of a polynomial, which add up to it."""
    return [(c, tuple((poly.ring.gen(i), k) for i, k in powers)) for powers, c in poly.sparse_terms()]


def ranges(theory: Lemmas, polys: Iterable[Poly]) -> None:
    """Polynomials as sums of monomials in their variables; long ones where all coefficients have one sign."""
    for poly in dict.fromkeys((*theory.numbers, *polys)):
        count = poly.term_count()
        if 1 < count <= MOST_MONOMIALS or (count <= MOST_ALIKE and len({c > 0 for _, c in poly.terms()}) == 1):
            theory.identity([(-1, ((poly, 1),)), *monomials(poly)])


def shifted(theory: Lemmas, polys: dict[Poly, bool]) -> None:
    """Polynomials as sums of products of the distances of their variables from bounds: m*b + 2*b - 1 is
    m*(b - 1) + 2*(b - 1) + m + 1, positive where m and b - 1 are."""
    bounds: dict[int, list[Poly]] = {}
    for poly in polys:
        if poly.total_degree == 1 and poly.term_count() == 2 and len(poly.variables) == 1:
            bounds.setdefault(poly.variables[0], []).append(poly)
    for corner in islice(product(*bounds.values()), MOST_CORNERS if bounds else 0):
        for poly in polys:
            _at_corner(theory, poly, {x: line for x, line in zip(bounds, corner, strict=True) if poly.degree(x)})


def _at_corner(theory: Lemmas, poly: Poly, lines: Mapping[int, Poly]) -> None:
    """scale * poly as a polynomial in these lines (u*x + v for x) and in the other variables."""
    ring, image, scale = poly.ring, poly, 1
    for x, line in lines.items():
        rest, lead = line.coefficients(x)
        scale *= lead.constant_value() ** poly.degree(x)
        image = image.at_quotient(x, ring.gen(x) - rest, lead)
    if lines and poly.total_degree > 1 and image.term_count() <= MOST_MONOMIALS:
        factors = [lines.get(i, ring.gen(i)) for i in range(ring.size)]
        terms = [(c, tuple((factors[i], k) for i, k in enumerate(e) if k)) for e, c in image.terms()]
        theory.identity([(-scale, ((poly, 1),)), *terms])
