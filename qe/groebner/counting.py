"""The number of real solutions of a parametric system as conditions on the parameters."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from qe import arguments
from qe.errors import Unable
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.build import conj, convert, disj
from qe.formula.evaluate import truth_under
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.groebner import files
from qe.groebner.question import ParametricSystem
from qe.groebner.segment import Segment
from qe.groebner.signs import SignatureConditions, signatures_sum_to
from qe.groebner.system import ComprehensiveGroebnerSystem, Numbers, outside, within
from qe.groebner.trace_form import ParametricQuotient
from qe.options import Budget
from qe.proof.certificate import Certificate, certificate_from
from qe.proof.entry import Entry, Json, formula_from_json, formula_to_json
from qe.simplifier.simplify import simplify

_WHAT = "real root classification"

MOST_CASES = 3000
"""Cases of the signatures of all trace forms of a segment, in one formula."""

_WEIGHTS = {
    Relation.GT: (2, {1: 1, 2: 1}),
    Relation.GE: (2, {0: 2, 1: 1, 2: -1}),
    Relation.NE: (1, {2: 1}),
}
"""Scale, and weights of powers of a sign s in {-1, 0, 1}: the sum is the scale where the relation holds, and else 0."""


class SolutionCount:
    """Conditions on the number of real solutions over a segment at which further conditions g > 0, g >= 0, g /= 0 hold.

    The signature of the form M_h is the sum of the signs of h at the real solutions. A product over the conditions of
    combinations of powers of their signs is 1 where they hold and 0 elsewhere (``_WEIGHTS``), and so the number of
    solutions is a combination of the signatures for products of powers of the g (Ben-Or, Kozen, Reif 1986; Pedersen,
    Roy, Szpirglas 1993).
    """

    def __init__(self, segment: Segment, conditions: Sequence[tuple[Poly, Relation]], budget: Budget) -> None:
        self._quotient = ParametricQuotient(segment, budget)
        one = segment.basis[0].ring.constant(1)
        self._scale, factors = 1, {one: 1}
        for g, relation in conditions:
            scale, weights = _WEIGHTS[relation]
            self._scale *= scale
            wider: dict[Poly, int] = {}
            for factor, weight in factors.items():
                for power, c in weights.items():
                    budget.check("sign conditions")
                    product, number = _without_sign(factor * g**power)
                    wider[product] = wider.get(product, 0) + weight * c * number
            factors = wider
        self._factors = {factor: weight for factor, weight in factors.items() if weight}
        if (2 * self.most + 1) ** (len(self._factors) - 1) > MOST_CASES:
            raise Unable("too many inequalities for trace forms")

    @property
    def most(self) -> int:
        """No more real solutions than complex ones."""
        return self._quotient.size

    @cached_property
    def _signatures(self) -> list[tuple[int, SignatureConditions]]:
        return [(w, self._quotient.conditions(None if h.is_constant else h)) for h, w in self._factors.items()]

    def is_in(self, counts: Collection[int]) -> Formula:
        """That the number of distinct real solutions is one of these."""
        if not self._factors:  # a condition that never holds
            return TRUE if 0 in counts else FALSE
        return signatures_sum_to(self._signatures, {k * self._scale for k in counts})

    @property
    def is_positive(self) -> Formula:
        """That there is a real solution."""
        return self.is_in(range(1, self.most + 1))


def _without_sign(h: Poly) -> tuple[Poly, int]:
    """A number is 1 times its sign, which is the weight of its form."""
    if not h.is_constant:
        return h, 1
    value = h.constant_value() if h else 0
    return h.ring.constant(1), (value > 0) - (value < 0)


@dataclass(frozen=True)
class RootClass:
    """Where the system has ``count`` distinct real solutions; None: where it has infinitely many complex ones."""

    count: int | None
    condition: Formula


@dataclass(frozen=True)
class RealRootClassification:
    """A partition of parameter space by the number of distinct real solutions; ``classes``: by count, None last;
    ``positive``: only solutions with these positive count. Conditions may hold the names of constants, which stand for
    their numbers. ``certificate``: of the whole partition, where one was asked for.
    """

    system: ComprehensiveGroebnerSystem
    classes: tuple[RootClass, ...]
    positive: tuple[Poly, ...] = ()
    certificate: Certificate | None = None

    def __repr__(self) -> str:
        cases = [f"{'infinite' if c.count is None else c.count}: {c.condition.brief()}" for c in self.classes]
        return f"RealRootClassification({', '.join(cases[:4])}{', …' if len(cases) > 4 else ''})"

    def __iter__(self) -> Iterator[RootClass]:
        return iter(self.classes)

    def condition(self, count: int | None) -> Formula:
        """Where there are so many real solutions. ``InputError`` for a count that occurs nowhere."""
        for found in self.classes:
            if found.count == count and not isinstance(count, bool):
                return found.condition
        raise arguments.wrong("count", f"one of {', '.join(str(c.count) for c in self.classes)}", count)

    def at(self, point: Numbers, *, timeout: float | None = None) -> int | None:
        """The number of distinct real solutions at a point, exactly; ``BudgetExceeded`` after ``timeout`` seconds."""
        return within(timeout, self._at, self.system.place(point))

    def _at(self, place: Point) -> int | None:
        for found in self.classes:
            if truth_under(convert(found.condition, place.ring), place.sign):
                return found.count
        raise outside()

    def certificate_at(self, point: Numbers, *, timeout: float | None = None) -> Certificate:
        """A certificate of the solutions at a point, as many as ``at`` says there are, for ``qe.verify``.

        ``timeout`` in seconds. Raises ``PositiveDimensional`` where there are infinitely many complex ones, ``Unable``.
        """
        return self.system.certificate_at(point, self.positive, timeout=timeout)

    def to_dict(self) -> dict[str, Json]:
        """The partition as plain data, formulas as text and as trees."""
        return {
            "variables": list[Json](self.system.variables),
            "parameters": list[Json](self.system.parameters),
            "constants": {name: str(value) for name, value in self.system.constants.items()},
            "positive": files.texts(self.positive),
            "classes": [
                {"count": c.count, "condition": str(c.condition), "formula": formula_to_json(c.condition)}
                for c in self.classes
            ],
            "system": self.system.to_dict(),
            "certificate": None if self.certificate is None else self.certificate.to_data(),
        }

    def to_json(self, *, indent: int | None = None) -> str:
        """``to_dict`` as JSON, with format, version and digest."""
        return files.written(_WHAT, self.to_dict(), indent)

    @staticmethod
    def from_json(text: str) -> RealRootClassification:
        """The partition that ``to_json`` wrote: an equal one. Raises ``InputError`` with one line naming what is wrong.

        Nothing is verified; use ``qe.verify`` on ``certificate`` for that.
        """
        return files.read(text, _WHAT, _from_entry, lambda found: found.to_dict())

    def __str__(self) -> str:
        many = "infinitely many complex solutions"
        return "\n".join(f"{many if c.count is None else c.count}: {c.condition}" for c in self.classes)


def _from_entry(entry: Entry) -> RealRootClassification:
    names = ("variables", "parameters", "constants", "positive", "classes", "system", "certificate")
    *_, positive, classes, inside, certificate = entry.fields(*names)
    system = ComprehensiveGroebnerSystem(*files.system_parts(inside))
    ring, found = system.polys[0].ring, list[RootClass]()
    for part in classes.items():
        count, _, tree = part.fields("count", "condition", "formula")
        number, condition = None if count.value is None else count.integer(), formula_from_json(tree, ring)
        if number in [c.count for c in found]:
            raise count.fail("a count is listed twice")
        if {*condition.free} & {*system.variables}:
            raise tree.fail("expected a condition on the parameters")
        found.append(RootClass(number, condition))
    proof = None if certificate.value is None else certificate_from(certificate)
    return RealRootClassification(system, tuple(found), files.polynomials(positive, ring), proof)


def classified(question: ParametricSystem, positive: Sequence[Poly], budget: Budget) -> RealRootClassification:
    """The partition of the parameters of a system by its number of real solutions with all of ``positive`` positive.

    Raises ``Unable`` where a basis or a trace form grows past its limits, ``BudgetExceeded``.
    """
    system = question.solved(budget)
    parts: dict[int | None, list[Formula]] = {}
    for segment in system:
        where = system.condition(segment)
        if segment.is_unit:
            parts.setdefault(0, []).append(where)
        elif segment.dimension > 0:
            parts.setdefault(None, []).append(where)
        else:
            number = SolutionCount(segment, [(g, Relation.GT) for g in positive], budget)
            for k in range(number.most + 1):
                parts.setdefault(k, []).append(conj([where, number.is_in({k})]))
    found = {count: simplify(disj(conditions), watch=budget.check) for count, conditions in parts.items()}
    classes = [RootClass(count, f) for count, f in found.items() if f != FALSE]
    return RealRootClassification(
        system, tuple(sorted(classes, key=lambda c: (c.count is None, c.count or 0))), tuple(positive)
    )
