"""Which method eliminates an existential block: a pure choice from features, with its reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.formula.syntax import Formula
from qe.formula.traverse import free_variables, polynomials
from qe.options import Method

CAD_VARIABLES = 3
"""Up to this many variables decomposition is fast and its answers are short (measured: tens of milliseconds)."""

CAD_FIRST_VARIABLES = 4
"""Up to this many variables decomposition goes first where substitution would square degrees."""


@dataclass(frozen=True, slots=True)
class Choice:
    """Methods in the order in which they are tried, and why."""

    methods: tuple[Method, ...]
    reason: str


def choose(variables: Sequence[str], body: Formula) -> Choice:
    """The order of methods for ``exists variables. body`` (body quantifier-free)."""
    polys = polynomials(body)
    index = polys[0].ring.index if polys else {}
    bound = [index[v] for v in variables if v in index]
    degree = max((p.degree(i) for p in polys for i in bound), default=0)
    total = len(free_variables(body))
    substitution_first, decomposition_first = (Method.VS, Method.CAD), (Method.CAD, Method.VS)
    if degree <= 1:
        return Choice(substitution_first, "every quantified variable is linear")
    if total <= CAD_VARIABLES:
        return Choice(decomposition_first, f"{total} variables in all: decomposition is cheap and its answer short")
    if len(bound) == 1 and degree <= 2:
        return Choice(substitution_first, "one quadratic variable and many parameters")
    if total <= CAD_FIRST_VARIABLES:
        return Choice(decomposition_first, f"{total} variables of degree {degree}")
    return Choice(substitution_first, f"{total} variables: substitution removes what it can first")
