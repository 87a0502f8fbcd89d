"""A linear form in a variable as the new variable: what looks at the variable by this form alone becomes simple.

THEOREM. Let m and n be polynomials without x and without variables bound inside f. Where m /= 0, w = m*x + n takes
every real value as x does. Let d be the degree of p in x, and q(w) * m^e = m^d * p((w - n)/m) where d - e is even; an
odd d - e will do for p = 0 and p /= 0, and where m is a positive number. Then p(x) has the sign of q(w) where m /= 0.
So with f' for f with every p replaced by its q, and x as the name of w,

    ex x, y f  iff  ex x, y (m /= 0 and f')  or  ex x, y (m = 0 and f).

Lift: x = (w - n)/m, or as it is.

Where m is a number, this is a shear of the space (a translation where n is one, too). The forms that are tried kill the
second coefficient of a polynomial of degree 2 and more (Tschirnhaus 1683).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from qe.errors import BudgetExceeded
from qe.exact.ring import Poly, format_poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms, bound_variables, conjuncts, has_root_atoms
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Solve
from qe.rules.rewrite import rewrite
from qe.rules.step import StepKind
from qe.rules.tree import Any, Lifted, Node, Pending

_LEAST, _MOST = 16, 600
"""Terms of all atoms together from which, and up to which, forms are looked for."""

_GAIN = 2
"""The atoms must become shorter by this factor: the new variable may stand in conditions that were simple before."""

_FORM_TERMS = 12
"""Forms of more terms are not tried."""


def linear_form(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem for the first form that makes the atoms much shorter."""
    polys = list(dict.fromkeys(a.poly for a in atoms(body)))
    size, ring = sum(a.poly.term_count() for a in atoms(body)), polys[0].ring
    if not _LEAST <= size <= _MOST or has_root_atoms(body):
        return None
    inner = {ring.index[name] for name in bound_variables(body)}
    for name in variables:
        x = ring.index[name]
        if x in inner:
            continue
        for m, n in dict.fromkeys(_forms(polys, x)):
            context.budget.check("prepare")
            if inner.isdisjoint((*m.variables, *n.variables)) and _helps(polys, x, m, n):
                if not context.may_split(StepKind.SHEAR, 1 if m.is_constant else 2):
                    return None
                form = m * ring.gen(x) + n
                node = _cases(variables, body, name, m, n)
                proof = {"variable": name, "form": form}
                return Found(StepKind.SHEAR, f"{name} for {format_poly(form)}", node, proof)
    return None


def _forms(polys: Sequence[Poly], x: int) -> Iterator[tuple[Poly, Poly]]:
    """m and n such that the second coefficient of a polynomial vanishes in m*x + n."""
    for p in polys:
        coefficients = p.coefficients(x)
        degree = len(coefficients) - 1
        if degree < 2 or not coefficients[-2]:
            continue
        slope, offset = coefficients[-1] * degree, coefficients[-2]
        common = slope.gcd(offset)
        slope, offset = slope.exact_divide(common), offset.exact_divide(common)
        is_negative = (slope * p.ring.gen(x) + offset).normal()[0] < 0
        if slope.is_constant:
            is_negative = slope.constant_value() < 0
        if slope.term_count() + offset.term_count() <= _FORM_TERMS:
            yield (-slope, -offset) if is_negative else (slope, offset)


def _helps(polys: Sequence[Poly], x: int, m: Poly, n: Poly) -> bool:
    """Whether the polynomials become shorter by the factor ``_GAIN``."""
    allowed = sum(p.term_count() for p in polys) // _GAIN
    for p in polys:
        try:
            allowed -= by_form(p, x, m, n, even=False, most_terms=4 * allowed + 100).term_count()
        except BudgetExceeded:
            return False
        if allowed < 0:
            return False
    return True


def by_form(p: Poly, x: int, m: Poly, n: Poly, *, even: bool, most_terms: int | None = None) -> Poly:
    """The q of the theorem, with the greatest e; ``even``: d - e is to be even. Raises ``BudgetExceeded``."""
    power = p.degree(x)
    q = p.at_quotient(x, p.ring.gen(x) - n, m, most_terms=most_terms)
    while power and not m.is_constant and q.gcd(m) in (m, -m):
        q, power = q.exact_divide(m), power - 1
    return q * m if even and power % 2 and not m.is_constant else q


def _cases(variables: tuple[str, ...], body: Formula, name: str, m: Poly, n: Poly) -> Node:
    ring = m.ring
    x = ring.index[name]

    def change(given: Atom) -> Formula:
        even = given.relation not in (Relation.EQ, Relation.NE)
        return atom(by_form(given.poly, x, m, n, even=even), given.relation)

    image = rewrite(body, change)
    lift = Solve(name, ring.gen(x) - n, m)
    if m.is_constant:
        return Lifted((lift,), Pending(variables, image))
    regular = Pending(variables, conj((atom(m, Relation.NE), *conjuncts(image))))
    return Any((Lifted((lift,), regular), Pending(variables, conj((atom(m, Relation.EQ), *conjuncts(body))))))
