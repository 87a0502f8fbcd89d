"""Which method eliminates an existential block: a pure choice from counts and degrees, with its reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.exact.quadratic_form import Definiteness, definiteness, quadratic
from qe.formula.syntax import And, Atom, Formula, Relation
from qe.formula.traverse import free_variables, polynomials
from qe.options import Method, Options, Stage

CAD_VARIABLES = 3
"""Up to this many variables decomposition is fast and its answers are short (measured: tens of milliseconds)."""

CAD_FIRST_VARIABLES = 4
"""Up to this many variables decomposition goes first where substitution would square degrees."""

CRITICAL_PARAMETERS = 2
"""Up to this many parameters critical values go first for convex conditions (measured on four to six discs: half a
second to three seconds, where neither decomposition nor substitution ends in a minute)."""


@dataclass(frozen=True, slots=True)
class Choice:
    """Methods in the order in which they are tried, and why."""

    methods: tuple[Method, ...]
    reason: str


def allows(options: Options, method: Method) -> bool:
    """Whether the caller lets this method take part."""
    left_out = method is Method.VS and Stage.SUBSTITUTION in options.without
    return options.method in (Method.AUTO, method) and not left_out


def planned(variables: Sequence[str], body: Formula, options: Options) -> Choice:
    """The order of methods for ``exists variables. body``: the one asked for, or that of ``choose``."""
    asked = options.method
    if asked is Method.AUTO:
        return choose(variables, body) if allows(options, Method.VS) else Choice((Method.CAD,), "asked for")
    return Choice((asked,), "asked for")


def choose(variables: Sequence[str], body: Formula) -> Choice:
    """The order of methods for ``exists variables. body`` (body quantifier-free)."""
    polys = polynomials(body)
    index = polys[0].ring.index if polys else {}
    bound = [index[v] for v in variables if v in index]
    degree = max((p.degree(i) for p in polys for i in bound), default=0)
    total = len(free_variables(body))
    if len(bound) > 1 and total > CAD_VARIABLES and total - len(bound) <= CRITICAL_PARAMETERS and _is_convex(body):
        methods = (Method.CRITICAL, Method.CAD, Method.VS)
        return Choice(methods, "convex conditions on several quantified variables: critical values are few")
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


def _is_convex(body: Formula) -> bool:
    """Whether the body is a conjunction of weak convex quadratic inequalities of which one is not linear."""
    if not isinstance(body, And) or not all(isinstance(a, Atom) for a in body.args):
        return False
    curved = False
    for found in body.args:
        assert isinstance(found, Atom)
        form = quadratic(found.poly, range(found.poly.ring.size))
        if form is None or found.relation not in (Relation.LE, Relation.GE):
            return False
        hessian = [[-h for h in row] for row in form.hessian] if found.relation is Relation.GE else form.hessian
        if definiteness(hessian) is Definiteness.NOT_SEMIDEFINITE:
            return False
        curved = curved or not form.is_linear
    return curved
