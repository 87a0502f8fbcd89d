"""Change of order of a zero-dimensional Groebner basis by linear algebra (Faugère, Gianni, Lazard, Mora 1993)."""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from flint import fmpq, fmpq_mat, fmpz_mpoly_ctx

from qe.exact.groebner import Basis, MonomialOrder
from qe.exact.quotient import Exponents, Quotient


def changed_order(basis: Basis, order: MonomialOrder, variables: Sequence[int] | None = None) -> Basis:
    """The reduced Groebner basis of the same ideal in another order; ``variables``: its variables, largest first.

    Monomials are met from small to large. One whose coordinates in the quotient depend on those of the monomials kept
    so far is a leading monomial, and the dependence is its element. Raises ``PositiveDimensional``.
    """
    chosen = basis.variables if variables is None else tuple(variables)
    quotient, width = Quotient(basis), len(chosen)
    steps = [quotient.matrices[basis.variables.index(i)] for i in chosen] if quotient.size else []
    names = (*(f"v{k}" for k in range(width)), "tag")
    context = fmpz_mpoly_ctx.get(names, order.value)
    if not quotient.size:
        return Basis(basis.ring, chosen, order, None, [context.constant(1)], context)
    start = fmpq_mat(quotient.size, 1, [fmpq(i == 0) for i in range(quotient.size)])
    pending: dict[Exponents, fmpq_mat] = {(0,) * width: start}
    kept: list[Exponents] = []
    rows: list[list[fmpq]] = []
    elements = []
    leads: list[Exponents] = []
    while pending:
        monomial = min(pending, key=order.key)
        vector = pending.pop(monomial)
        if any(all(a <= b for a, b in zip(lead, monomial, strict=True)) for lead in leads):
            continue
        relation, rank = fmpq_mat([*rows, vector.entries()]).transpose().rref()
        if rank > len(rows):
            rows.append(vector.entries())
            kept.append(monomial)
            for k, step in enumerate(steps):
                larger = (*monomial[:k], monomial[k] + 1, *monomial[k + 1 :])
                pending.setdefault(larger, step * vector)
            continue
        leads.append(monomial)
        terms = {m: -c for k, m in enumerate(kept) if (c := relation[k, rank])} | {monomial: fmpq(1)}
        scale = lcm(*(int(c.q) for c in terms.values()))
        elements.append(context.from_dict({(*m, 0): int((c * scale).p) for m, c in terms.items()}))
    return Basis(basis.ring, chosen, order, None, elements, context)
