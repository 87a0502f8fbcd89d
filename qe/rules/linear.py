"""Equations that are linear in a quantified variable.

Theorem (Loos & Weispfenning 1993, the Gauss case). Let a, b be polynomials without x.
* If a is nowhere zero (a constant, or under the facts):  ex x (a*x + b = 0 and f)  iff  f[-b/a].
* In general:  iff  (a /= 0 and f[-b/a])  or  ex x (a = 0 and b = 0 and f).
* If x occurs nowhere else:  ex x (a*x + b = 0) and f  iff  (a /= 0 or b = 0) and f.
Lift: x = -b/a (where a /= 0; any value will do in the third rule otherwise).
f[-b/a] replaces g(x) rel 0, deg_x g = d, by a^d * g(-b/a) rel 0, times a once more if d is odd and the
sign of a is not known, so the factor is positive.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass

from qe.errors import BudgetExceeded
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, map_children
from qe.formula.syntax import Atom, Atomic, Exists, ForAll, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.simplifier.facts import Facts

_TERMS = 3000  # a substitution whose result has more terms than this is not done


MOST_VARIABLES = 60
"""In more variables the search for linear forms that one atom alone looks at would take longer than it gains."""


@dataclass(frozen=True, slots=True)
class Pivot:
    """The equation lead*x + rest = 0 at ``position`` of a conjunction.

    ``sign``: of lead, when known (1, -1), 0 when only known not to vanish, None when it may vanish.
    ``alone``: x occurs nowhere else.
    """

    position: int
    variable: int
    lead: Poly
    rest: Poly
    sign: int | None
    alone: bool

    @property
    def name(self) -> str:
        """The variable to be solved for."""
        return self.lead.ring.names[self.variable]

    @property
    def guarded(self) -> bool:
        """Whether solving needs a case distinction that keeps x in one case."""
        return self.sign is None and not self.alone


def choose_pivot(parts: Sequence[Formula], variables: Sequence[str], facts: Callable[[int], Facts]) -> Pivot | None:
    """The cheapest linear equation among the conjuncts: without guard first, then few terms times few occurrences.

    ``facts(position)``: what is known from the other conjuncts.
    """
    best: Pivot | None = None
    best_cost: tuple[int, int, int] | None = None
    # those with a constant coefficient first: where there is one, the signs of the others need not be known
    linear = sorted(linear_in(parts, variables), key=lambda entry: not entry[3].is_constant)
    occurrences = _occurrences(parts if linear else ())
    for position, i, rest, lead in linear:
        if best_cost is not None and best_cost[0] == 0 and not lead.is_constant:
            break
        alone = occurrences[i] == 1
        sign = _sign(lead, position, facts)
        work = max(1, rest.term_count()) * (occurrences[i] - 1) * lead.term_count()
        degree = max(rest.total_degree, lead.total_degree + 1)
        cost = (2 if sign is None and not alone else 0 if lead.is_constant else 1, work, degree)
        if best_cost is None or cost < best_cost:
            best_cost, best = cost, Pivot(position, i, lead, rest, sign, alone)
    return best


def may_define(formula: Formula) -> bool:
    """Whether an equation, perhaps below a negation, is linear in a bound variable with a number before it: where there
    is none, nothing is ``defining`` in any block."""
    return any(
        isinstance(a, Atom)
        and a.relation in (Relation.EQ, Relation.NE)
        and any(a.poly.coefficients(i)[1].is_constant for i in _linear_variables(a.poly, formula.bound))
        for a in atoms(formula)
    )


def defining(parts: Sequence[Formula], variables: Sequence[str]) -> list[Pivot]:
    """Equations v = t among the conjuncts that are there to give t a name.

    All those with a v that occurs nowhere else; if there is none, the one of least cost whose t is not linear, or whose
    v stands in one other atom only: so no form is written out twice. In very many variables linear forms stay named.
    """
    alone: dict[int, Pivot] = {}
    best: tuple[int, Pivot] | None = None
    linear = [entry for entry in linear_in(parts, variables) if entry[3].is_constant]
    occurrences = _occurrences(parts if linear else ())
    few = len(occurrences) <= MOST_VARIABLES
    for position, i, rest, lead in linear:
        sign = 1 if lead.constant_value() > 0 else -1
        pivot = Pivot(position, i, lead, rest, sign, occurrences[i] == 1)
        if pivot.alone:
            alone.setdefault(position, pivot)
        elif rest.total_degree > 1 or (few and occurrences[i] == 2):
            cost = (occurrences[i] - 1) * rest.term_count()
            best = (cost, pivot) if best is None or cost < best[0] else best
    return list(alone.values()) or ([] if best is None else [best[1]])


def _occurrences(parts: Sequence[Formula]) -> Counter[int]:
    """In how many atoms each variable stands."""
    times: Counter[int] = Counter()
    for part in parts:
        for a in atoms(part):
            times.update(map(a.poly.ring.index.__getitem__, a.free))
    return times


def linear_in(parts: Sequence[Formula], variables: Sequence[str]) -> Iterator[tuple[int, int, Poly, Poly]]:
    """Position, variable, rest and coefficient of every variable in which an equation among the conjuncts is linear."""
    for position, part in enumerate(parts):
        if isinstance(part, Atom) and part.relation is Relation.EQ:
            for i in _linear_variables(part.poly, variables):
                rest, lead = part.poly.coefficients(i)
                yield position, i, rest, lead


def _linear_variables(poly: Poly, names: Container[str]) -> Iterator[int]:
    """Those of these names in which a polynomial has degree 1."""
    return (i for i in poly.variables if poly.ring.names[i] in names and poly.degree(i) == 1)


def _sign(lead: Poly, position: int, facts: Callable[[int], Facts]) -> int | None:
    if lead.is_constant:
        return 1 if lead.constant_value() > 0 else -1
    signs = facts(position).signs(lead)
    if 0 in signs:
        return None
    return next(iter(signs)) if len(signs) == 1 else 0


def substitute(formula: Formula, pivot: Pivot) -> Formula | None:
    """The formula with x = -rest/lead, or None where that is not possible.

    Not possible: a quantifier inside binds a variable of the equation, x is in a root atom, or the result is huge.
    """
    i, ring = pivot.variable, pivot.lead.ring
    name = ring.names[i]
    used = {ring.names[v] for p in (pivot.lead, pivot.rest) for v in p.variables}

    def walk(f: Formula) -> Formula:
        match f:
            case Atom(poly, relation):
                return f if not poly.degree(i) else _substituted(poly, relation, pivot)
            case Exists(variables, body) | ForAll(variables, body):
                if name in variables:
                    return f
                inner = walk(body)
                if inner != body and used & set(variables):
                    raise _NotPossible
                return map_children(f, lambda _: inner)
        if isinstance(f, Atomic) and name in f.free:
            raise _NotPossible
        return map_children(f, walk)

    try:
        return walk(formula)
    except _NotPossible:
        return None


def put_in(body: Formula, i: int, equation: Poly) -> Formula | None:
    """The other conjuncts with the value that a linear equation, whose coefficient is a number, gives a variable."""
    rest, lead = equation.coefficients(i)
    others = conj(part for part in conjuncts(body) if part != Atom(equation, Relation.EQ))
    return substitute(others, Pivot(0, i, lead, rest, 1 if lead.constant_value() > 0 else -1, alone=False))


class _NotPossible(Exception):
    """The substitution is not possible in a part of the formula."""


def _substituted(poly: Poly, relation: Relation, pivot: Pivot) -> Formula:
    try:
        image = poly.at_quotient(pivot.variable, -pivot.rest, pivot.lead, most_terms=_TERMS)
    except BudgetExceeded as error:
        raise _NotPossible from error
    if poly.degree(pivot.variable) % 2 and relation not in (Relation.EQ, Relation.NE):
        if pivot.sign == -1:
            image = -image
        elif pivot.sign != 1:
            image = image * pivot.lead
    return atom(image, relation)
