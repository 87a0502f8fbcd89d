"""What has to keep its order around a sample for the factors of one level to be delineable there.

THEOREM. Let S be a connected submanifold of R^k on which the leading coefficients, discriminants and pairwise
resultants of some polynomials in x_k are order-invariant and not zero as polynomials, and no point of which makes one
of them zero on its whole line. Then they are delineable over S, and order-invariant on the cells over it (McCallum
1998; Brown 2001, theorem 3.1). With trailing coefficients, and Lazard's valuation in place of the order, points that
make one zero do no harm: its Lazard evaluation has the roots (Lazard 1994; McCallum, Parusinski, Paunescu 2019, theorem
5.1).

THEOREM. On a section of such polynomials (the ``core``) another one is sign-invariant where its resultants with them
are order-invariant (McCallum 1999, theorem 2.2); it is order-invariant where its leading coefficient and discriminant
are, too, and no point makes it zero on its line (McCallum 2001). Resultants of two such others are not needed.

That discriminants and resultants are not zero shows that the polynomials are squarefree and coprime. Each is compared
with a Sylvester determinant at an integer point, a second route to the same value.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.kernel.arithmetic.products import FactorLists, Product
from qe.kernel.arithmetic.sturm import coefficients_at, sylvester_determinant, value_at_integers
from qe.kernel.limits import check_resultant
from qe.options import Budget

LEADING, TRAILING, DISCRIMINANT, RESULTANT = "leading coefficient", "trailing coefficient", "discriminant", "resultant"

Factor = tuple[int, int]
"""Level and index."""


class Projected:
    """Leading and trailing coefficients, discriminants and resultants of listed factors as products of these, each
    computed once. ``evaluates``: by Lazard's theorem."""

    def __init__(self, lists: FactorLists, budget: Budget, *, evaluates: bool) -> None:
        self.lists, self.budget, self.evaluates = lists, budget, evaluates
        self._products: dict[tuple[str, int, int, int], Product | None] = {}
        self._needed: dict[tuple[int, frozenset[int], frozenset[int], bool], frozenset[Factor]] = {}
        self._witnesses: dict[Factor, list[Poly]] = {}

    def product(self, what: str, k: int, i: int, j: int) -> Product | None:
        """A part of the projection of factors i <= j of level k; None for what is no product of listed factors."""
        key = (what, k, i, j)
        if key not in self._products:
            self.budget.check("verify")
            f, g = self.lists.lists[k][i], self.lists.lists[k][j]
            self._products[key] = self.lists.decompose(self._polynomial(what, f, g, k, j))
        return self._products[key]

    def _polynomial(self, what: str, f: Poly, g: Poly, k: int, j: int) -> Poly:
        if what == LEADING:
            return f.leading(k)
        if what == TRAILING:
            return f.coefficients(k)[0]
        if what == DISCRIMINANT:
            return checked_discriminant(self.lists, f, k, j)
        return checked_resultant(self.lists, f, g, k, j)

    def needed(self, k: int, polys: frozenset[int], core: frozenset[int], *, order: bool) -> frozenset[Factor]:
        """The factors that have to be order-invariant for these of level k to be so on the cells over a connected set;
        for those beside the ``core`` on its sections, and there sign-invariant without ``order``.

        ``CertificateRejected`` naming a factor of which a polynomial is missing.
        """
        key = (k, polys, core, order)
        if key not in self._needed:
            self._needed[key] = frozenset(f for product in self._all(*key) for f in factors(product))
        return self._needed[key]

    def closed(self) -> None:
        """``CertificateRejected`` unless all that all factors need is listed."""
        for k in range(1, len(self.lists.lists)):
            everything = frozenset(range(len(self.lists.lists[k])))
            self.needed(k, everything, everything, order=True)

    def not_nullified(self, k: int, i: int) -> list[Poly]:
        """Polynomials that are zero wherever the factor is zero on a whole line: its coefficients, and resultants of
        these."""
        if (k, i) not in self._witnesses:
            self._witnesses[k, i] = nullification_witnesses(self.lists.lists[k][i], k)
        return self._witnesses[k, i]

    def _all(self, k: int, polys: frozenset[int], core: frozenset[int], order: bool) -> Iterator[Product]:
        variable = self.lists.ring.gen(k)  # the only irreducible polynomial without a trailing coefficient
        for i in sorted(polys):
            if order or i in core:
                yield self._listed(LEADING, k, i, i)
                yield self._listed(DISCRIMINANT, k, i, i)
            if self.evaluates and self.lists.lists[k][i] != variable:
                yield self._listed(TRAILING, k, i, i)
            for j in polys:
                if j < i and (i in core or j in core):
                    yield self._listed(RESULTANT, k, j, i)

    def _listed(self, what: str, k: int, i: int, j: int) -> Product:
        product = self.product(what, k, i, j)
        if product is not None and product.unit:
            return product
        other = "" if i == j else f" with payload.factors[{k}][{i}]"
        reason = "not a product of listed factors" if product is None else "zero: they are not squarefree and coprime"
        raise CertificateRejected(f"payload.factors[{k}][{j}]", f"its {what}{other} is {reason}")


def factors(product: Product) -> Iterator[Factor]:
    """The factors of a product."""
    return ((level, index) for level, index, _ in product.powers)


def checked_discriminant(lists: FactorLists, f: Poly, k: int, i: int) -> Poly:
    """The discriminant with respect to variable k, compared with its second computation."""
    n = f.degree(k)
    if n == 1:
        return lists.ring.constant(1)
    check_resultant(f, f, k)
    discriminant = f.discriminant(k)
    lead = value_at_integers(f.leading(k), lists.point)
    sign = -1 if n * (n - 1) // 2 % 2 else 1
    derivative = coefficients_at(f.derivative(k), k, lists.point)
    other = sign * sylvester_determinant(coefficients_at(f, k, lists.point), derivative)
    if value_at_integers(discriminant, lists.point) * lead != other:
        raise CertificateRejected(f"payload.factors[{k}][{i}]", "two ways to its discriminant disagree")
    return discriminant


def checked_resultant(lists: FactorLists, f: Poly, g: Poly, k: int, i: int) -> Poly:
    """The resultant with respect to variable k, compared with its second computation."""
    check_resultant(f, g, k)
    resultant = f.resultant(g, k)
    other = sylvester_determinant(coefficients_at(f, k, lists.point), coefficients_at(g, k, lists.point))
    if value_at_integers(resultant, lists.point) != other:
        raise CertificateRejected(f"payload.factors[{k}][{i}]", "two ways to a resultant of it disagree")
    return resultant


def nullification_witnesses(f: Poly, k: int) -> list[Poly]:
    """Polynomials in the ideal of the coefficients of f in variable k: where one is nonzero, f is not nullified."""
    coefficients = [c for c in f.coefficients(k) if c]
    found = list(coefficients)
    for i, c in enumerate(coefficients):
        for d in coefficients[:i]:
            shared = set(c.variables) & set(d.variables)
            found += [c.resultant(d, v) for v in sorted(shared, reverse=True)[:1]]
    return found
