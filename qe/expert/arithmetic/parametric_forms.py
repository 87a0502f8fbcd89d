"""Hermite's trace forms over a case of the parameters, for the checker: their characteristic polynomials."""

from __future__ import annotations

from qe.errors import Unable
from qe.exact.ring import Poly
from qe.expert.arithmetic.parametric import MOST_TERMS, Case, Exponents, Terms

Matrix = list[list[Poly]]


class ParametricForms:
    """Hermite's trace forms over a case with finitely many complex solutions, scaled to polynomials.

    With D a common denominator of the multiplications by the variables, row and column of a monomial b are multiplied
    by D^deg(b), and the form for h by an even power of D: D vanishes nowhere, so the signature stays.
    """

    def __init__(self, case: Case) -> None:
        self.case, self.ring = case, case.where.ring
        self._place = {e: k for k, e in enumerate(case.monomials)}
        one, zero = self.ring.constant(1), self.ring.constant(0)
        columns = [
            [case.remainder({(*e[:k], e[k] + 1, *e[k + 1 :]): one}) for e in case.monomials] for k in range(case.size)
        ]
        self.denominator = one
        for scale, _ in (c for row in columns for c in row):
            self.denominator = self.denominator * scale.exact_divide(self.denominator.gcd(scale))
        self._steps: list[Matrix] = []
        for row in columns:
            matrix = [[zero] * len(row) for _ in row]
            for j, (scale, rest) in enumerate(row):
                factor = self.denominator.exact_divide(scale)
                for e, c in rest.items():
                    matrix[self._place[e]][j] = c * factor
            self._steps.append(matrix)
        size = len(case.monomials)
        unit = [[one if i == j else zero for j in range(size)] for i in range(size)]
        self._products: dict[Exponents, Matrix] = {(0,) * case.size: unit}

    def _times(self, a: Matrix, b: Matrix) -> Matrix:
        self.case.where.tick()
        columns = list(zip(*b, strict=True))
        zero = self.ring.constant(0)
        found = [
            [sum((x * y for x, y in zip(row, column, strict=True) if x and y), zero) for column in columns] for row in a
        ]
        if max((c.term_count() for row in found for c in row), default=0) > MOST_TERMS:
            raise Unable("a trace form grows past the limits of the checker")
        return found

    def _product(self, e: Exponents) -> Matrix:
        """D^|e| times the multiplication by a monomial."""
        if e not in self._products:
            k = next(k for k, power in enumerate(e) if power)
            self._products[e] = self._times(self._steps[k], self._product((*e[:k], e[k] - 1, *e[k + 1 :])))
        return self._products[e]

    def _weighted(self, h: Terms) -> Matrix:
        """An even power of D times the multiplication by h."""
        degree = max(map(sum, h))
        degree += degree % 2
        size = len(self.case.monomials)
        total = [[self.ring.constant(0)] * size for _ in range(size)]
        for e, c in h.items():
            factor = c * self.denominator ** (degree - sum(e))
            for row, part in zip(total, self._product(e), strict=True):
                for j, value in enumerate(part):
                    row[j] = row[j] + factor * value
        return total

    def matrix(self, h: Terms) -> Matrix:
        """The form for h /= 0, up to an even power of D and rows and columns times powers of it."""
        weighted, monomials = self._weighted(h), self.case.monomials
        size, zero = len(monomials), self.ring.constant(0)
        rows = [[zero] * size for _ in range(size)]
        for i, a in enumerate(monomials):
            left = self._times(weighted, self._product(a))
            for j, b in enumerate(monomials[: i + 1]):
                other = self._product(b)
                trace = sum((left[r][c] * other[c][r] for r in range(size) for c in range(size)), zero)
                rows[i][j] = rows[j][i] = trace
        flat = self.case.where.reduced([c for row in rows for c in row])
        return [flat[i * size : (i + 1) * size] for i in range(size)]

    def coefficients(self, matrix: Matrix) -> list[Poly]:
        """The characteristic polynomial of a form, highest coefficient (1) first, up to positive factors and squares
        that do not vanish."""
        return [self._sign_of(c) for c in self._characteristic(matrix)]

    def _characteristic(self, matrix: Matrix) -> list[Poly]:
        """By the recursion of Faddeev and LeVerrier."""
        size, one = len(matrix), self.ring.constant(1)
        found, current = [one], [[one if i == j else one * 0 for j in range(size)] for i in range(size)]
        for k in range(1, size + 1):
            image = self._times(matrix, current)
            c = -sum((image[i][i] for i in range(size)), one * 0)
            c = c.exact_divide(k) if c else c
            found.append(c)
            current = [[image[i][j] + c if i == j else image[i][j] for j in range(size)] for i in range(size)]
        return found

    def _sign_of(self, p: Poly) -> Poly:
        """A polynomial with the same sign wherever the conditions hold."""
        (p,) = self.case.where.reduced([p])
        if not p or p.is_constant:
            return p
        unit, factors = p.factors()
        found = self.ring.constant(1 if unit > 0 else -1)
        for f, k in factors:
            found = found * f ** (k % 2 if f in self.case.where.nonzero else 2 - k % 2)
        return found
