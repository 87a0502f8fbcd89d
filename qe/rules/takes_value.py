"""A variable that only one atom looks at, whose polynomial is bound to take a value that will do.

THEOREM. Let x occur in one conjunct only, an atom p rel 0 of degree d >= 1 in x whose leading coefficient c does not
vanish. For odd d, p takes every real value (intermediate value theorem, from limits of opposite signs); for even d, p
has the sign of c far out. So ex x, y (p rel 0 and f)  iff  ex y f  where d is odd, where rel is /=, or where rel is
> or >= and c > 0 (< or <= and c < 0).
Lift: a root of p, or a power of two that is large enough.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Poly, Ring, format_poly
from qe.exact.sample import Point
from qe.formula.build import conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import bound_variables, conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Assignment, Value, sign_at
from qe.rules.step import StepKind
from qe.rules.tree import solved

Parts = tuple[Formula, ...]
_WANTED = {Relation.GT: 1, Relation.GE: 1, Relation.LT: -1, Relation.LE: -1}


@dataclass(frozen=True, slots=True)
class TakesValue:
    """A value of ``variable`` for which the polynomial has the relation to 0; the theorem says that there is one."""

    variable: str
    poly: Poly
    relation: Relation

    def value(self, assignment: Assignment) -> Value:
        """A root, or the first of 0, 1, -1, 2, -2, 4, … that does."""
        if self.relation is Relation.EQ:
            return self._root(assignment)
        size, trial = Fraction(1), Fraction(0)
        while not self.relation.holds(sign_at(self.poly, {**assignment, self.variable: trial})):
            trial = -trial if trial > 0 else size
            size = 2 * size if trial < 0 else size
        return trial

    def _root(self, assignment: Assignment) -> Value:
        names = self.poly.ring.names
        others = tuple(names[i] for i in self.poly.variables if names[i] != self.variable)
        ring = Ring.of((*others, self.variable))
        point = Point.of(ring, [assignment.get(name, Fraction(0)) for name in others])
        sections = isolate_over(point, (self.poly.convert(ring),)).sections
        return point.extend(sections[0].value).number(len(others))


def looked_at_once(variables: Sequence[str], body: Formula) -> Iterator[tuple[str, Atom, Parts, Parts]]:
    """Every variable of the block that one comparison alone has, as a conjunct: with that, and what stands before and
    after it."""
    parts, inner = conjuncts(body), set(bound_variables(body))
    for name in variables:
        having = [k for k, part in enumerate(parts) if name in part.free]
        if len(having) == 1 and name not in inner and isinstance(part := parts[having[0]], Atom):
            yield name, part, parts[: having[0]], parts[having[0] + 1 :]


def drop_what_can_be_met(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first variable of the block that it applies to."""
    for name, condition, before, after in looked_at_once(variables, body):
        others = before + after
        if _is_met(condition, name, others, context):
            node = solved([TakesValue(name, condition.poly, condition.relation)], variables, conj(others))
            return Found(StepKind.TAKES_VALUE, f"{name} in {format_poly(condition.poly)}", node, {"variable": name})
    return None


def _is_met(given: Atom, name: str, others: Parts, context: BlockContext) -> bool:
    """Whether the theorem applies; its leading coefficient is looked at where the other conjuncts hold."""
    index = given.poly.ring.index[name]
    lead = given.poly.leading(index)
    signs = context.facts.extended([p for p in others if isinstance(p, Atom)]).signs(lead)
    if 0 in signs:
        return False
    if given.poly.degree(index) % 2 or given.relation is Relation.NE:
        return True
    return signs == {_WANTED.get(given.relation, 0)}
