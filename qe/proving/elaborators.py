"""Steps of rules that are no primitives, made of steps of primitives (``qe.kernel``).

Nothing here is trusted: the kernel checks what comes out. An elaborator is given a step, as its rule's evidence says,
and says by which steps of the kernel it is made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from math import lcm

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import conj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.root import root_goals
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.terms import Quotient, at_terms
from qe.kernel.theorem import theorem_goals
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json
from qe.proving.along import constant_along
from qe.proving.counted_roots import roots_counted
from qe.proving.decomposed import counted, decomposed, roots_by_signs
from qe.proving.far import infinity_first, zeros
from qe.proving.forms import named, seen_along
from qe.proving.lemma_list import EMPTY
from qe.proving.linear import guarded, term
from qe.proving.made import FRESH, Made, quantified, value
from qe.proving.mirrors import mirrored, ordered
from qe.proving.primitive_names import PROJECTION
from qe.proving.ranges import by_ranges
from qe.proving.scaling import scaled, translated
from qe.proving.shadows import projected
from qe.proving.shifts import shifted
from qe.proving.turns import turned
from qe.rules.closed_forms import matches

Elaborator = Callable[[Made, Formula], None]
"""Makes the steps from a formula to another one; ``CertificateRejected`` where there are none."""


def by_theorem(made: Made, block: Exists) -> None:
    """The block's answer in its place, by a theorem of the family that is called like the rule."""
    for match in matches((made.claim.rule,), block.variables, block.body):
        with suppress(CertificateRejected):
            answer = nnf(match.formula("answer"))
            return made.by_lemmas("theorem", theorem_goals, block, answer, match.evidence, used=())
    raise made.claim.fail("not an instance of a theorem")


def _alone(made: Made, entry: Entry) -> tuple[Exists, Formula]:
    """A variable that one condition looks at: that in a block of its own, now a part of the block of the others."""
    block, name, _ = made.claim.variable(entry)
    part = next((f for f in conjuncts(block.body) if name in f.free), TRUE)
    inner = Exists((name,), part)
    others = conj(inner if f is part else f for f in conjuncts(block.body))
    made.moved(block, quantified([v for v in block.variables if v != name], others))  # one inside the other stays so
    return inner, part


def square_alone(made: Made, after: Formula) -> None:
    """A variable that one condition looks at, as a parabola: that condition in a block of its own, by a theorem."""
    by_theorem(made, _alone(made, only(made.claim, "variable")[0])[0])


def value_taken(made: Made, after: Formula) -> None:
    """A variable of which one comparison alone asks something: a value far out, or a root, meets it."""
    variable = only(made.claim, "variable", optional=("theory",))[0]
    inner, part = _alone(made, variable)
    is_odd = isinstance(part, Atom) and part.poly.degree(made.ring.index[variable.text()]) % 2
    for rising in (0,) if is_odd else (1, -1):
        with suppress(CertificateRejected):
            return made.by_lemmas("root", root_goals, inner, TRUE, {"low": None, "high": None, "rising": rising})
    raise made.claim.fail("not shown that the value is taken")


def exchanged(made: Made, after: Formula) -> None:
    """The sum and the product of two variables in their place, which get two names that are free in the ring."""
    (listed,) = only(made.claim, "variables")
    ring, before = made.ring, made.current
    names, fresh = [entry.text() for entry in listed.items()], [name for name in FRESH if name in ring.index]
    if len(names) != 2 or len(fresh) != 2 or not set(names) <= ring.index.keys() - {*FRESH}:
        raise listed.fail("expected two variables, and two names for their sum and product in the order")
    (x, y), (z, w) = names, fresh
    if not isinstance(before, Exists) or not isinstance(after, Exists):
        raise made.claim.fail("two blocks expected")
    one, other = ring.var(z), ring.var(w)
    apart = tuple({x: z, y: w}.get(v, v) for v in after.variables)
    renamed = exists(apart, made.put(before.body, {x: one, y: other}))
    image = exists(apart, made.put(after.body, {x: one + other, y: one * other}))
    sums = [Atom((ring.var(v) - poly).normal()[1], Relation.EQ) for v, poly in ((x, one + other), (y, one * other))]
    values = [value(equation, v) for v, equation in zip((x, y), sums, strict=True)]
    named = Exists(tuple(dict.fromkeys((*apart, *after.variables))), conj((*sums, *conjuncts(after.body))))
    inner = Exists((z, w), conj(sums))
    back = written("linear equation solved", (), named, image, (), {"solved": values, "theory": EMPTY})
    made.moved(before, renamed)
    made.simplified(renamed, image)
    made.step("converse", image, named, {"steps": [back]})
    made.moved(named, exists(after.variables, conj((*conjuncts(after.body), inner))))
    by_theorem(made, inner)


def _at(quotient: Quotient, terms: Mapping[int, Quotient]) -> Quotient:
    """A quotient at such terms; all bottoms are numbers."""
    top, bottom = quotient
    for i, (_, lead) in terms.items():
        bottom = bottom * lead ** (top.degree(i) + (top.degree(i) % 2 if lead.constant_value() < 0 else 0))
    return at_terms(top, terms), bottom


def witness(made: Made, after: Formula) -> None:
    """Terms in the parameters that satisfy a block."""
    claim, ring = made.claim, made.ring
    equations, block = only(claim, "equations", optional=("theory",))[0], claim.block()
    there: dict[str, Quotient] = {}
    for entry in equations.items():
        pivot = term(entry, block.variables, block.body, claim)
        one = {ring.index[pivot.name]: (-pivot.rest, pivot.lead)}
        there = {name: _at(quotient, one) for name, quotient in there.items()}
        there[pivot.name] = (-pivot.rest, pivot.lead)
    made.terms(block, TRUE, there, {})


def positioned(made: Made, after: Formula) -> None:
    """Affine coordinates in place of the variables of a block, by one variable after the other."""
    index = made.ring.index
    there: dict[str, Quotient] = {}
    back: dict[str, Quotient] = {}
    for entry in only(made.claim, "values")[0].items():
        variable, listed = entry.row("variable", "coefficients")
        rows = [row.row("variable or 1", "rational number") for row in listed.items()]
        form = {name.text(): c.rational() for name, c in rows}
        name, lead = variable.text(), form.get(variable.text(), Fraction(0))
        if not lead:
            raise entry.fail("expected a form in the variable")
        value = _linear(form, made.ring)
        there = {v: _at(q, {index[name]: value}) for v, q in there.items()}
        there.setdefault(name, value)
        inverse = {v: -c / lead for v, c in form.items()} | {name: 1 / lead}
        back[name] = _at(_linear(inverse, made.ring), {index[v]: q for v, q in back.items()})
    made.terms(made.current, after, there, back)


def _linear(form: Mapping[str, Fraction], ring: Ring) -> Quotient:
    """A linear form, with "1" for the number in it."""
    whole = lcm(*(c.denominator for c in form.values()))
    parts = (int(c * whole) * (ring.constant(1) if v == "1" else ring.var(v)) for v, c in form.items())
    return sum(parts, ring.constant(0)), ring.constant(whole)


def distributed(made: Made, after: Formula) -> None:
    """A block that goes into a disjunction."""
    made.simplified(made.current, after)


NAMING = frozenset(
    (
        *("degree shift", "elimination set", "homogeneous scaling", "rotation of the axes"),
        *("sphere seen along a form", "two variables exchanged"),
    )
)
"""Names for variables that steps of these rules need on their way; where a formula has them, there are no steps."""

_BY_RULE: Mapping[str, Elaborator] = {
    "two variables exchanged": exchanged,
    "homogeneous scaling": scaled,
    "translation of the origin": translated,
    "square of a variable alone": square_alone,
    "value that is taken": value_taken,
    "roots counted": roots_counted,
    "witness in the parameters": witness,
    "degree shift": shifted,
    "constant along directions": constant_along,
    "conditions on zeros that follow": zeros,
    "infinity first": infinity_first,
    "ranges that exclude each other": by_ranges,
    "sphere seen along a form": seen_along,
    "linear form named": named,
    "mirror images of a convex set": mirrored,
    "exchangeable variables in order": ordered,
    "affine coordinates": positioned,
    "disjuncts with equations apart": distributed,
    "roots by signs": roots_by_signs,
    "rotation of the axes": turned,
    "linear equation solved under a guard": guarded,
    PROJECTION: projected,
    "critical values of a universal block": decomposed,
    "comprehensive Gröbner system": counted,
}


def _steps(elaborator: Elaborator) -> Callable[[Claim, Context, Limits], list[Json]]:
    """The steps from the formula before to that after. An existential block is one with its negations in the atoms, as
    the kernel's steps begin with it."""

    def made(claim: Claim, context: Context, limits: Limits) -> list[Json]:
        before, after = existential(claim)
        if isinstance(claim.before, Exists):
            claim = replace(claim, before=before, after=after)
        steps = Made(claim, limits, before, context)
        elaborator(steps, after)
        return steps.finished(after)

    return made


ELABORATORS = {rule: _steps(elaborator) for rule, elaborator in _BY_RULE.items()}
