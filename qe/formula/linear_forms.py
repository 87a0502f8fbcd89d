"""Polynomials in variables that stand for linear forms: ``(a - c)^2 + (b - d)^2``, ``(x - 1/2)^2 + y^2``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from math import gcd
from typing import NamedTuple

from qe.exact.ring import Poly, format_poly
from qe.formula.notation import Notation, digits, monomials, polynomial
from qe.spelling import quoted

MOST_TERMS = 40
"""Terms, and total degree, up to which another way to write a polynomial is looked for."""


class Form(NamedTuple):
    """A linear form ``poly``, and a number that is subtracted."""

    poly: Poly
    less: Fraction = Fraction(0)

    def written(self, notation: Notation) -> str:
        """In brackets."""
        number = digits(abs(self.less.numerator))
        if self.less.denominator > 1:
            number = notation.quotient(number, digits(self.less.denominator))
        shift = f" {'-' if self.less > 0 else '+'} {number}" if self.less else ""
        return f"{notation.brackets[0]}{polynomial(monomials(self.poly), notation)}{shift}{notation.brackets[1]}"

    def __str__(self) -> str:
        return f"({format_poly(self.poly)}{f' - {self.less}' if self.less else ''})"


Forms = Mapping[str, Form]


def with_forms(forms: Forms, notation: Notation) -> Notation:
    """The notation with linear forms in the place of variables."""
    names = {name: form.written(notation) for name, form in forms.items()}
    return replace(notation, name=lambda name: names.get(name) or notation.name(name))


def is_short(poly: Poly) -> bool:
    """Whether another way to write a polynomial is looked for."""
    return 1 < poly.term_count() <= MOST_TERMS and 1 < poly.total_degree <= MOST_TERMS


def in_linear_forms(poly: Poly) -> tuple[Poly, Forms]:
    """A polynomial that depends on two variables only by ``x + s*y``, s an integer, with x in the place of that, and so
    on; a sphere's about its centre; a positive multiple. With what these variables stand for: nothing where that makes
    it longer.

    In the first case its derivative in y is s times that in x, and it is its value at y = 0 with the form for x.
    """
    if not is_short(poly):
        return poly, {}
    other, forms = _in_fewer(poly)
    if not forms:
        other, forms = _about_centre(poly)
    spelled = {name: str(form) for name, form in forms.items()}
    text = format_poly(other, lambda name: spelled.get(name) or quoted(name))
    return (other, forms) if forms and len(text) <= len(format_poly(poly)) else (poly, {})


def _in_fewer(poly: Poly) -> tuple[Poly, Forms]:
    names, forms = poly.ring.names, dict[str, Poly]()
    for pair in combinations(poly.variables, 2):
        for x, y in (pair, pair[::-1]):
            if not {x, y} <= {*poly.variables}:
                continue
            of_x, of_y = poly.derivative(x), poly.derivative(y)
            s, rest = divmod(of_y.terms()[0][1], of_x.terms()[0][1])
            if rest == 0 and of_y == s * of_x:
                form, other = (forms.pop(names[k], poly.ring.gen(k)) for k in (x, y))
                poly, forms[names[x]] = poly.at_rational(y, 0), form + s * other
    return poly, {name: Form(form) for name, form in forms.items()}


def _about_centre(poly: Poly) -> tuple[Poly, Forms]:
    """The polynomial of a sphere; another one as it is."""
    ring, terms = poly.ring, dict(poly.sparse_terms())
    squares = {used[0][0]: c for used, c in terms.items() if used and used[0][1] == 2}
    linear = {used[0][0]: c for used, c in terms.items() if used and used[0][1] == 1}
    size, number = next(iter(squares.values()), 0), terms.pop((), 0)
    alone = all(len(used) == 1 for used in terms) and len(terms) == len(squares) + len(linear)
    if not (alone and linear and len(squares) > 1 and {*squares.values()} == {size} and {*linear} <= {*squares}):
        return poly, {}
    centre = {i: Fraction(-c, 2 * size) for i, c in linear.items()}
    rest = Fraction(number) - size * sum(m * m for m in centre.values())
    common = gcd(size * rest.denominator, rest.numerator)
    factor = size * rest.denominator // common
    moved = sum((factor * ring.gen(i) ** 2 for i in squares), ring.constant(rest.numerator // common))
    return moved, {ring.names[i]: Form(ring.gen(i), m) for i, m in centre.items()}
