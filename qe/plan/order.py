"""Variable orders for cylindrical algebraic decomposition, chosen within quantifier blocks only."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from qe.exact.ring import Poly


def brown_order(polys: Sequence[Poly], variables: Iterable[str]) -> tuple[str, ...]:
    """The variables from the one projected last to the one projected first (Brown's heuristic, 2004 tutorial).

    Projected first: lowest degree, then lowest total degree of a term containing it, then fewest terms containing it.
    """
    if not polys:
        return tuple(variables)
    index = polys[0].ring.index

    def weight(name: str) -> tuple[int, int, int, str]:
        i = index.get(name)
        if i is None:
            return 0, 0, 0, name
        inside = [e for p in polys if p.degree(i) for e, _ in p.terms() if e[i]]
        return max((p.degree(i) for p in polys), default=0), max((sum(e) for e in inside), default=0), len(inside), name

    return tuple(sorted(variables, key=weight, reverse=True))
