"""Steps of rules that are no primitives, made of steps of primitives (``qe.kernel``).

Nothing here is trusted: the kernel checks what comes out. An elaborator is given a step, as its rule's evidence says,
and says by which steps of the kernel it is made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from math import lcm

from qe.errors import CertificateRejected
from qe.formula.build import atom, conj, disj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Or, Relation
from qe.formula.traverse import conjuncts, map_atoms
from qe.kernel.block import block_goals, existential
from qe.kernel.derivation import replaced
from qe.kernel.negation import normal
from qe.kernel.root import root_goals
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.terms import Quotient, at_terms
from qe.kernel.theorem import theorem_goals
from qe.proof.certificate import written
from qe.proof.entry import Json
from qe.proving.along import constant_along
from qe.proving.counted_roots import roots_counted
from qe.proving.decomposed import counted, decomposed, roots_by_signs
from qe.proving.far import infinity_first, zeros
from qe.proving.forms import named, seen_along
from qe.proving.lemma_list import EMPTY
from qe.proving.linear import guarded, term
from qe.proving.made import FRESH, by_lemmas, terms, value
from qe.proving.mirrors import mirrored
from qe.proving.primitive_names import PROJECTION
from qe.proving.ranges import by_ranges
from qe.proving.scaling import scaled, translated
from qe.proving.shadows import projected
from qe.proving.shifts import shifted
from qe.proving.thin import degenerate_truth_set
from qe.proving.turns import turned
from qe.rules.closed_forms import matches

Elaborator = Callable[[Claim, Context, Limits], list[Json]]
"""The steps that lead from ``claim.before`` to ``claim.after``; ``CertificateRejected`` where there are none."""


def by_theorems(
    block: Exists, context: Context, claim: Claim, limits: Limits, place: tuple[int, ...] = ()
) -> Iterator[tuple[Json, Formula]]:
    """Steps from a block to its answer by theorems of the family that is called like the rule, and the answers."""
    for match in matches((claim.rule,), block.variables, block.body):
        answer = nnf(match.formula("answer"))
        try:
            step = by_lemmas("theorem", theorem_goals, block, answer, match.evidence, context, claim, limits, place)
        except CertificateRejected:
            continue
        yield step, answer


def square_alone(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A variable that one condition looks at, as a parabola: that condition in a block of its own, by a theorem."""
    (variable,) = only(claim, "variable")
    block, name, _ = claim.variable(variable)
    parts = conjuncts(block.body)
    part = next((f for f in parts if name in f.free), TRUE)
    inner, rest = Exists((name,), part), tuple(v for v in block.variables if v != name)
    body = conj(inner if f is part else f for f in parts)
    middle = Exists(rest, body) if rest else body  # the blocks stay two, also where one stands in the other alone
    place = (*((0,) if rest else ()), *((parts.index(part),) if len(parts) > 1 else ()))
    solved = next(by_theorems(inner, (), claim, limits, place), None)
    if solved is None:
        raise claim.fail("not an instance of a theorem")
    return [*_regrouped(block, middle), solved[0]]


def value_taken(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A variable of which one comparison alone asks something: a value far out, or a root, meets it."""
    variable = only(claim, "variable", optional=("theory",))[0]
    block, name, _ = claim.variable(variable)
    parts = conjuncts(block.body)
    part = next((f for f in parts if name in f.free), TRUE)
    others = tuple(f for f in parts if f is not part)
    inner, rest = Exists((name,), part), tuple(v for v in block.variables if v != name)
    middle = exists(rest, conj((inner, *others)))
    place = (*((0,) if rest else ()), *((0,) if others else ()))
    facts = replaced(middle, place, inner, TRUE, context, variable)[0]
    is_odd = isinstance(part, Atom) and part.poly.degree(claim.ring.index[name]) % 2
    for rising in (0,) if is_odd else (1, -1):
        evidence: dict[str, Json] = {"low": None, "high": None, "rising": rising}
        with suppress(CertificateRejected):
            taken = by_lemmas("root", root_goals, inner, TRUE, evidence, facts, claim, limits, place)
            return [*_regrouped(block, middle), taken]
    raise claim.fail("not shown that the value is taken")


def exchanged(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """The sum and the product of two variables in their place, which get two names that are free in the ring."""
    (listed,) = only(claim, "variables")
    names, fresh = [entry.text() for entry in listed.items()], [name for name in FRESH if name in claim.ring.index]
    if len(names) != 2 or len(fresh) != 2 or not set(names) <= claim.ring.index.keys() - {*FRESH}:
        raise listed.fail("expected two variables, and two names for their sum and product in the order")
    (x, y), (z, w) = names, fresh
    (before, after), ring = existential(claim), claim.ring
    if not isinstance(before, Exists) or not isinstance(after, Exists):
        raise claim.fail("two blocks expected")
    one, other = ring.var(z), ring.var(w)
    by = {ring.index[x]: one + other, ring.index[y]: one * other}
    apart_by = {ring.index[x]: one, ring.index[y]: other}
    apart = tuple({x: z, y: w}.get(v, v) for v in after.variables)
    renamed = exists(apart, map_atoms(before.body, lambda a: atom(a.poly.compose(apart_by), a.relation)))
    image = exists(apart, map_atoms(after.body, lambda a: atom(a.poly.compose(by), a.relation)))
    sums = [Atom((ring.var(v) - poly).normal()[1], Relation.EQ) for v, poly in ((x, one + other), (y, one * other))]
    values = [value(equation, v) for v, equation in zip((x, y), sums, strict=True)]
    named = Exists(tuple(dict.fromkeys((*apart, *after.variables))), conj((*sums, *conjuncts(after.body))))
    inner = Exists((z, w), conj(sums))
    middle = exists(after.variables, conj((*conjuncts(after.body), inner)))
    back = written("linear equation solved", (), named, image, (), {"solved": values, "theory": EMPTY})
    place = (0, len(conjuncts(after.body)))
    theorem = next(by_theorems(inner, (), claim, limits, place), None)
    if theorem is None:
        raise claim.fail("not an instance of a theorem")
    return [
        written("quantifiers", (), before, renamed, (), {}),
        simplified(renamed, image, (), claim, limits),
        written("converse", (), image, named, (), {"steps": [back]}),
        written("quantifiers", (), named, middle, (), {}),
        theorem[0],
    ]


def _regrouped(before: Formula, after: Formula) -> list[Json]:
    """A step that moves quantifiers, unless nothing moves."""
    return [] if before == after else [written("quantifiers", (), before, after, (), {})]


def simplified(before: Formula, after: Formula, context: Context, claim: Claim, limits: Limits) -> Json:
    """A step that signs of polynomials prove."""
    return by_lemmas("signs", block_goals, before, after, {}, context, claim, limits)


def _at(quotient: Quotient, terms: Mapping[int, Quotient]) -> Quotient:
    """A quotient whose bottom is a number, at such terms."""
    (top, bottom), ((i, (_, lead)),) = quotient, terms.items()
    degree = top.degree(i)
    even = degree + (degree % 2 if lead.constant_value() < 0 else 0)
    return at_terms(top, terms), bottom * lead**even


def witness(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Terms in the parameters that satisfy a block."""
    equations, block = only(claim, "equations", optional=("theory",))[0], claim.block()
    there: dict[str, Quotient] = {}
    for entry in equations.items():
        pivot = term(entry, block.variables, block.body, claim)
        one = {claim.ring.index[pivot.name]: (-pivot.rest, pivot.lead)}
        there = {name: _at(quotient, one) for name, quotient in there.items()}
        there[pivot.name] = (-pivot.rest, pivot.lead)
    return [terms(claim.before, TRUE, there, {}, context, claim, limits)]


def sheared(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """m*x + n as the new x; where m may vanish, the case that it does stays as it is."""
    variable, form = only(claim, "variable", "form")
    (block, name, x), ring = claim.variable(variable), claim.ring
    linear = form.polynomial(ring)
    if linear.degree(x) != 1:
        raise form.fail("expected a polynomial of degree 1 in the variable")
    n, m = linear.coefficients(x)
    if m.is_constant and m.constant_value() < 0:
        m, n = -m, -n
    there, back = {name: (ring.gen(x) - n, m)}, {name: (m * ring.gen(x) + n, ring.constant(1))}
    if m.is_constant:
        return [terms(block, claim.after, there, back, context, claim, limits)]
    if not isinstance(claim.after, Or):
        raise claim.fail("two cases expected")
    cases = [exists(block.variables, conj((atom(m, rel), block.body))) for rel in (Relation.NE, Relation.EQ)]
    regular = next(part for part in claim.after.args if part != cases[1])
    middle = disj(cases)
    inner = terms(cases[0], regular, there, back, (), claim, limits, place=(0,))
    return [simplified(block, middle, context, claim, limits), inner]


def positioned(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Affine coordinates in place of the variables of a block, by one variable after the other."""
    there: dict[str, Quotient] = {}
    back: dict[str, Quotient] = {}
    for entry in only(claim, "values")[0].items():
        variable, listed = entry.row("variable", "coefficients")
        rows = [row.row("variable or 1", "rational number") for row in listed.items()]
        form = {name.text(): c.rational() for name, c in rows}
        name, lead = variable.text(), form.get(variable.text(), Fraction(0))
        if not lead:
            raise entry.fail("expected a form in the variable")
        value = _linear(form, {}, claim)
        there = {v: _at(q, {claim.ring.index[name]: value}) for v, q in there.items()}
        there.setdefault(name, value)
        inverse = {v: -c / lead for v, c in form.items()} | {name: 1 / lead}
        back[name] = _linear(inverse, back, claim)
    before, after = existential(claim)
    return [terms(before, after, there, back, context, claim, limits)]


def _linear(form: Mapping[str, Fraction], values: Mapping[str, Quotient], claim: Claim) -> Quotient:
    """A linear form, with "1" for the number in it, at quotients whose bottoms are numbers."""
    ring = claim.ring
    one = ring.constant(1)
    parts = {v: (one, one) if v == "1" else values.get(v, (ring.var(v), one)) for v in form}
    whole = lcm(*(c.denominator * parts[v][1].constant_value() for v, c in form.items()))
    top = sum(
        (
            p * int(c * Fraction(whole, q.constant_value()))
            for (p, q), c in zip(parts.values(), form.values(), strict=True)
        ),
        ring.constant(0),
    )
    return top, ring.constant(whole)


def distributed(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A block that goes into a disjunction."""
    return [simplified(claim.before, claim.after, (), claim, limits)]


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
    "degenerate truth set": degenerate_truth_set,
    "degree shift": shifted,
    "constant along directions": constant_along,
    "conditions on zeros that follow": zeros,
    "infinity first": infinity_first,
    "ranges that exclude each other": by_ranges,
    "sphere seen along a form": seen_along,
    "linear form as a variable": sheared,
    "linear form named": named,
    "mirror images of a convex set": mirrored,
    "affine coordinates": positioned,
    "disjuncts with equations apart": distributed,
    "roots by signs": roots_by_signs,
    "rotation of the axes": turned,
    "linear equation solved under a guard": guarded,
    PROJECTION: projected,
    "critical values of a universal block": decomposed,
    "comprehensive Gröbner system": counted,
}


def _from_normal(elaborator: Elaborator) -> Elaborator:
    """An existential block is one with its negations in the atoms, as the kernel's steps begin with it."""

    def made(claim: Claim, context: Context, limits: Limits) -> list[Json]:
        if isinstance(claim.before, Exists):
            claim = replace(claim, before=normal(claim.before), after=normal(claim.after))
        return elaborator(claim, context, limits)

    return made


ELABORATORS: Mapping[str, Elaborator] = {rule: _from_normal(elaborator) for rule, elaborator in _BY_RULE.items()}
