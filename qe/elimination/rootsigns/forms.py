"""The leading minors of Hermite's forms of a polynomial with parameters, as polynomials in its coefficients.

Let f = c_0 + … + c_n*x^n with a = c_n, p_k the sum of the k-th powers of its roots, g of degree m. Newton's identities
make a^k*p_k a polynomial in the c_i. The leading minor of size k of the matrix Tr(g*x^(i+j)) is a sum of products of
g(x_i) and squares of differences over k roots x_i (Cauchy, Binet), in each root of degree 2*(k - 1) + m; so
a^(2*(k-1) + m) times it is a polynomial in the coefficients, which is what is found here. Its sign is that of the minor
for even m, and for odd m that times the sign of a.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from qe.errors import Unable
from qe.exact.hermite import leading_minors
from qe.exact.ring import Poly, Ring
from qe.options import Budget

MOST_TERMS = 4_000
"""With more terms in a minor the answer is of no use."""


def power_sums(c: Sequence[Poly], most: int) -> list[Poly]:
    """a^k times the sums of the k-th powers of the roots, for k up to ``most``."""
    n, a = len(c) - 1, c[-1]
    sums = [a.ring.constant(n)]
    for k in range(1, most + 1):
        total = a.ring.constant(0)
        for i in range(1, min(k, n) + 1):
            total = total - a ** (i - 1) * c[n - i] * (sums[k - i] if i < k else k)
        sums.append(total)
    return sums


@lru_cache(maxsize=16)
def general(degree: int, g: tuple[int, ...]) -> tuple[dict[tuple[int, ...], int], ...]:
    """``minors`` for coefficients that are variables and a g with integer ones: exponents and factors."""
    ring = Ring.of(tuple(f"c{k}" for k in range(degree + 1)))
    forms = minors([ring.gen(k) for k in range(degree + 1)], [ring.constant(v) for v in g], Budget())
    return tuple(dict(p.terms()) for p in forms)


def special(c: Sequence[Poly], g: tuple[int, ...], budget: Budget) -> list[Poly]:
    """``minors`` from the general ones: nothing has to be divided. Raises ``Unable`` past the limit."""
    forms = []
    for terms in general(len(c) - 1, g):
        total = c[0].ring.constant(0)
        for exponents, factor in terms.items():
            budget.check("minors of Hermite's forms")
            total = total + _monomial(c, exponents, budget) * factor
        forms.append(total)
    return forms


def _monomial(c: Sequence[Poly], exponents: tuple[int, ...], budget: Budget) -> Poly:
    product = c[0].ring.constant(1)
    for p, power in zip(c, exponents, strict=True):
        for _ in range(power):
            product = _product(product, p, budget)
    return product


def _product(left: Poly, right: Poly, budget: Budget) -> Poly:
    """Raises ``Unable`` where it has too many terms."""
    budget.spend(1 + left.term_count() * right.term_count() // 1_000)
    product = left * right
    if product.term_count() > MOST_TERMS:
        raise Unable("a minor of a form of Hermite grows past its limits")
    return product


def minors(c: Sequence[Poly], g: Sequence[Poly], budget: Budget) -> list[Poly]:
    """Those of the form of g, of sizes 1 to n, as above. Raises ``Unable`` where they grow past their limit."""
    n, m, a = len(c) - 1, len(g) - 1, c[-1]
    sums = power_sums(c, 2 * n - 2 + m)
    zero = a.ring.constant(0)
    weights = [p * a ** (m - j) for j, p in enumerate(g)]
    entries = [sum((w * sums[k + j] for j, w in enumerate(weights) if w), start=zero) for k in range(2 * n - 1)]
    leading: list[Poly] = []

    def times(one: Poly, other: Poly) -> Poly:
        budget.check("minors of Hermite's forms")
        return _product(one, other, budget)

    for k, minor in enumerate(leading_minors(lambda i, j: entries[i + j], n, a.ring.constant(1), times=times)):
        spare = k * (k - 1 + m)
        leading.append(minor.exact_divide(a**spare) if spare and a != 1 else minor)
    return leading
