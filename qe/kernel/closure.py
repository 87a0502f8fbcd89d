"""Closure of the factor lists under projection, recomputed.

Lazard (1994; validity: McCallum, Parusinski, Paunescu 2019, theorem 5.1): leading coefficients, trailing
coefficients, discriminants, pairwise resultants. Brown-McCallum (Brown 2001, theorem 3.1): leading coefficients,
discriminants, pairwise resultants, with a condition on every cell that ``stacks`` checks. Both need the listed
polynomials of a level to be squarefree and pairwise coprime, which nonzero discriminants and resultants prove.
Level 0 needs nothing: its stack is checked root by root.

Brown-McCallum with an equational constraint e_1*...*e_m = 0 on level k: only its sections are decomposed further, so
the other factors g need to be invariant on these sections alone. On the last level sign-invariance is enough: leading
coefficients and discriminants of the e_i, resultants of the e_i with each other and with every g (McCallum 1999,
theorem 2.2). Below it order-invariance is needed: leading coefficients and discriminants of the g as well (McCallum
2001); only the resultants of two g are not. Nothing about the matrix is needed here: that the formula is decided
between the sections is checked cell by cell.

Each resultant and discriminant is compared with a Sylvester determinant at an integer point, a second route to
the same value.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, format_poly
from qe.kernel.arithmetic.products import FactorLists, Product
from qe.kernel.arithmetic.sturm import coefficients_at, sylvester_determinant, value_at_integers
from qe.kernel.limits import check_resultant
from qe.options import Budget, Projection


@dataclass(frozen=True, slots=True)
class Closure:
    """For each level: leading coefficients and discriminants of its factors (by index), and resultants of pairs i < j.

    ``discriminants[0]`` and ``resultants[0]`` are empty: they are constants, and are not needed. ``constraints[k]``:
    the factors whose sections alone are decomposed on level k (empty: all are). What a constraint makes unnecessary
    is missing. ``evaluates``: by Lazard's theorem, so that a factor which vanishes on a whole line has the roots of its
    Lazard evaluation there; by Brown and McCallum's, such a line is only allowed over a single point.
    """

    leading: tuple[dict[int, Product], ...]
    discriminants: tuple[dict[int, Product], ...]
    resultants: tuple[dict[tuple[int, int], Product], ...]
    constraints: tuple[frozenset[int], ...]
    evaluates: bool


def check_closure(
    lists: FactorLists, projection: Projection, listed: tuple[tuple[int, ...], ...], budget: Budget
) -> Closure:
    """The products, or ``CertificateRejected`` naming the factor whose projection is not covered.

    ``listed``: the constraints as the certificate has them.
    """
    if projection not in (Projection.LAZARD, Projection.BROWN_MCCALLUM):
        raise CertificateRejected("payload.projection", "an operator that this checker has no theorem for")
    evaluates = projection is Projection.LAZARD
    constraints = _check_constraints(lists, listed, allowed=not evaluates)
    leading, discriminants, resultants = [], [], []
    for k, level in enumerate(lists.lists):
        budget.check("verify")
        core = constraints[k] or frozenset(range(len(level)))
        own = core if k == len(lists.lists) - 1 else range(len(level))
        leading.append({i: _covered(lists, level[i].leading(k), k, i, "leading coefficient") for i in own})
        found: dict[int, Product] = {}
        pairs: dict[tuple[int, int], Product] = {}
        if k > 0:
            for i, f in enumerate(level):
                if evaluates:
                    _trailing(lists, f, k, i)
                if i in own:
                    found[i] = _covered(lists, checked_discriminant(lists, f, k, i), k, i, "discriminant")
                for j in range(i):
                    budget.check("verify")
                    if i in core or j in core:
                        what = f"resultant with payload.factors[{k}][{j}]"
                        pairs[j, i] = _covered(lists, checked_resultant(lists, level[j], f, k, i), k, i, what)
        discriminants.append(found)
        resultants.append(pairs)
    return Closure(tuple(leading), tuple(discriminants), tuple(resultants), constraints, evaluates)


def _check_constraints(
    lists: FactorLists, listed: tuple[tuple[int, ...], ...], *, allowed: bool
) -> tuple[frozenset[int], ...]:
    """The constraint of every level: ascending indices of some of its factors, where the operator allows any."""
    if listed and len(listed) != len(lists.lists):
        raise CertificateRejected("payload.constraints", "expected one list per variable, or none")
    for k, own in enumerate(listed):
        if any(a >= b for a, b in pairwise(own)) or (own and not 0 <= own[0] <= own[-1] < len(lists.lists[k])):
            raise CertificateRejected(f"payload.constraints[{k}]", "not an ascending list of factors of this level")
        if own and not allowed:
            raise CertificateRejected("payload.projection", "no theorem restricts this operator by constraints")
    return tuple(frozenset(own) for own in listed) if listed else (frozenset(),) * len(lists.lists)


def _covered(lists: FactorLists, p: Poly, k: int, i: int, what: str) -> Product:
    step = f"payload.factors[{k}][{i}]"
    if not p:
        raise CertificateRejected(step, f"its {what} is zero: the list is not squarefree and coprime")
    product = lists.decompose(p)
    if product is None:
        text = format_poly(p)
        shown = text if len(text) < 200 else f"of {p.term_count()} terms"
        raise CertificateRejected(step, f"its {what} {shown} is not a product of listed factors")
    return product


def _trailing(lists: FactorLists, f: Poly, k: int, i: int) -> None:
    trailing = f.coefficients(k)[0]
    if trailing or f != lists.ring.gen(k):  # the variable itself is the only irreducible factor without one
        _covered(lists, trailing, k, i, "trailing coefficient")


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
