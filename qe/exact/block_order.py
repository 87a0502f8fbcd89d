"""Groebner bases of parametric ideals: in an order in which the variables count before the parameters.

FLINT knows no block orders. Weights on the variables, introduced by inflation of exponents, make its degree reverse
lexicographic order compare the variables' monomials as the wanted order does, as long as exponents stay small: one
variable's weight is W - K^i, W + K^(n-i) or K^(n-i). Whether it did is checked on the result: if every element has the
same leading monomial in both orders, the initial ideals are the same (one contains the other, and both leave a basis
of the same quotient), so that the basis is one for the wanted order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from qe.errors import Unable
from qe.exact.fglm import changed_order
from qe.exact.groebner import BRIEF, Basis, Limits, MonomialOrder, groebner_basis
from qe.exact.ideals import LIMITS
from qe.exact.quotient import Quotient, dimension
from qe.exact.ring import Poly

Exponents = tuple[int, ...]
Terms = dict[Exponents, Poly]

MOST_CONVERTED = 80
"""Complex solutions, with multiplicities, of a system whose basis is changed into another order."""

_TRIALS = ((4, 16), (8, 128), (24, 1024), (96, 8192))
"""(K, scale): differences of exponents of one variable up to K, degrees in the parameters up to the scale."""


@dataclass(frozen=True, slots=True)
class BlockOrder:
    """Variables and parameters by ring index, largest first, and the order of the variables' monomials."""

    variables: tuple[int, ...]
    parameters: tuple[int, ...]
    order: MonomialOrder = MonomialOrder.DEGREVLEX

    def terms(self, poly: Poly) -> Terms:
        """The polynomial as one in the variables: exponents -> coefficient in the parameters; highest first."""
        coefficients = poly.collected(self.variables)
        return dict(sorted(coefficients.items(), key=lambda pair: self.order.key(pair[0]), reverse=True))

    def lead(self, poly: Poly) -> tuple[Exponents, Poly]:
        """The leading monomial in the variables of a polynomial other than 0, and its coefficient."""
        groups: dict[Exponents, dict[Exponents, int]] = {}
        for exponents, c in poly.terms():
            groups.setdefault(tuple([exponents[i] for i in self.variables]), {})[exponents] = c
        top = max(groups, key=self.order.key)
        inside = set(self.variables)
        rest = {tuple([0 if i in inside else k for i, k in enumerate(e)]): c for e, c in groups[top].items()}
        return top, poly.ring.from_terms(rest)

    def is_free(self, poly: Poly) -> bool:
        """Whether only parameters occur."""
        return not set(self.variables) & set(poly.variables)


def parametric_basis(polys: Sequence[Poly], block: BlockOrder, limits: Limits = LIMITS) -> tuple[Poly, ...]:
    """The reduced Groebner basis over Q in the order "variables first, then parameters by degree and reverse lex".

    () for the zero ideal, (1,) for the unit ideal. Raises ``Unable`` at a limit.
    """
    given = sorted({p for p in polys if p}, key=lambda p: (p.term_count(), p.total_degree))
    if not given:
        return ()
    everything = (*block.variables, *block.parameters)
    if all(block.is_free(p) for p in given) or not block.parameters:
        order = block.order if not block.parameters else MonomialOrder.DEGREVLEX
        basis = _plain_basis(given, everything, order, limits)
        if basis is None:
            raise Unable("a Gröbner basis grows past its limits")
        return basis.polys
    if block.order is not MonomialOrder.DEGREVLEX:
        if (brief := _weighted_basis(given, block, BRIEF)) is not None:
            return brief.polys
        given = list(parametric_basis(given, replace(block, order=MonomialOrder.DEGREVLEX), limits))
    basis = _weighted_basis(given, block, limits)
    if basis is None:
        raise Unable("a parametric Gröbner basis grows past its limits")
    return basis.polys


def _weighted_basis(given: list[Poly], block: BlockOrder, limits: Limits) -> Basis | None:
    """By the first weights that give the order of the block; None at a limit."""
    everything = (*block.variables, *block.parameters)
    for most, scale in _TRIALS:
        weights = (*_weights(block.order, len(block.variables), most, scale), *(1 for _ in block.parameters))
        basis = groebner_basis(given, variables=everything, weights=weights, limits=limits)
        if basis is None or _agrees(basis, block):
            return basis
    return None


def _plain_basis(given: list[Poly], variables: tuple[int, ...], order: MonomialOrder, limits: Limits) -> Basis | None:
    """Without parameters; from the graded order where that is the way around a long computation."""
    if order is MonomialOrder.DEGREVLEX:
        return groebner_basis(given, variables=variables, limits=limits)
    brief = groebner_basis(given, variables=variables, order=order, limits=BRIEF)
    if brief is not None:
        return brief
    graded = groebner_basis(given, variables=variables, limits=limits)
    if graded is not None and dimension(graded) == 0 and len(Quotient(graded).monomials) <= MOST_CONVERTED:
        return changed_order(graded, order)
    return groebner_basis(given, variables=variables, order=order, limits=limits)


def _agrees(basis: Basis, block: BlockOrder) -> bool:
    """Whether every element has the leading monomial that the order of the block gives it."""
    order, size, places = block.order, len(block.variables), (*block.variables, *block.parameters)
    for poly, lead in zip(basis.polys, basis.leads, strict=True):
        exponents = ([e[i] for i in places] for e, _ in poly.terms())
        if max(exponents, key=lambda e: (order.key(e[:size]), MonomialOrder.DEGREVLEX.key(e[size:]))) != list(lead):
            return False
    return True


def _weights(order: MonomialOrder, size: int, most: int, scale: int) -> list[int]:
    if order is MonomialOrder.LEX:
        return [scale * most ** (size - 1 - i) for i in range(size)]
    if order is MonomialOrder.DEGLEX:
        return [scale * (most**size + most ** (size - 1 - i)) for i in range(size)]
    return [scale * (most**size - most**i) for i in range(size)]
