"""Variables measured in powers of one of them, or moved along with it: steps that change variables inside, too.

Nothing here is trusted: the kernel checks what comes out.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import lcm

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import TRUE, Atom, Exists, ForAll, Formula, Relation
from qe.formula.traverse import children, disjuncts, with_child
from qe.kernel.step import Claim, Context, only
from qe.kernel.terms import Quotient
from qe.proof.entry import Entry
from qe.proof.step import Place
from qe.proving.made import Made, solved
from qe.proving.shifts import lower

_SIDE = {1: Relation.GT, 0: Relation.EQ, -1: Relation.LT}


def scaled(made: Made, goal: Formula) -> None:
    """The cases of the sign of a variable, in each of which the others are measured in powers of it, or of its root."""
    claim, ring = made.claim, made.ring
    variable, weights, values, _ = only(claim, "variable", "weights", "values", optional=("theory",))
    block, name, x = claim.variable(variable)
    powers = moves(weights, name, claim)
    root = lcm(*(power.denominator for power in powers.values()))
    rest, one = [v for v in block.variables if v != name], ring.constant(1)
    cases = [(s, exists(block.variables, conj((atom(ring.gen(x), _SIDE[s]), block.body)))) for s in (1, 0, -1)]
    kept = [case for case in cases if case[0] in {entry.integer(-1) for entry in values.items()}]
    made.simplified(block, disj(case for _, case in kept))
    for s, case in kept:
        after, side = exists(rest, made.put(block.body, {name: ring.constant(s)})), s
        if made.current == TRUE or case not in disjuncts(made.current):  # another case has settled it
            continue
        if s == 0:
            made.step("linear equation solved", case, after, solved(Atom(ring.gen(x), Relation.EQ), name))
            continue
        body = block.body
        if s < 0 and root % 2 == 0:
            side, body = 1, made.put(body, {name: -ring.gen(x)})
            turned = exists(block.variables, conj((atom(ring.gen(x), _SIDE[1]), body)))
            made.terms(case, turned, {name: (-ring.gen(x), one)}, {name: (-ring.gen(x), one)})
            case = turned
        if root > 1:
            sign = atom(ring.gen(x), _SIDE[side])
            high = exists(block.variables, conj((sign, made.put(body, {name: ring.gen(x) ** root}))))
            assert isinstance(high, Exists)
            lowering = Made(claim, made.limits, high)
            lower(lowering, high, case, name, root)
            made.back(case, high, lowering)
            case = high
        unit, whole = ring.gen(x) * side, {v: int(power * root) for v, power in powers.items()}
        times = {v: _times(ring, v, unit, power) for v, power in whole.items()}
        back = {v: _times(ring, v, unit, -power) for v, power in whole.items()}
        known = (atom(ring.gen(x), _SIDE[side]),)
        moved = moved_inside(made, case, made.place(case), times, back, known, start=True)
        outer = {v: q for v, q in back.items() if v in rest}
        image = made.put(after.body if isinstance(after, Exists) and rest else after, outer)
        regular = exists(block.variables, conj((*known, image)))
        made.simplified(moved, regular)
        made.terms(regular, after, {name: (one * side, one)}, outer)


def translated(made: Made, goal: Formula) -> None:
    """A variable at 0, the others moved along; those bound inside first."""
    variable, weights = only(made.claim, "variable", "weights")
    (block, name, _), ring = made.claim.variable(variable), made.ring
    others = moves(weights, name, made.claim)
    there = {v: along(ring, v, by, name) for v, by in others.items()}
    back = {v: along(ring, v, -by, name) for v, by in others.items()}
    moved = moved_inside(made, block, (), there, back, (), start=True)
    rest = [v for v in block.variables if v != name]
    after = exists(rest, made.put(block.body, {name: ring.constant(0)}))
    outer = {v: q for v, q in back.items() if v in rest}
    made.terms(moved, after, {name: (ring.constant(0), ring.constant(1))}, outer, used=())


def moves(weights: Entry, name: str, claim: Claim) -> dict[str, Fraction]:
    """How the other variables move where this one moves by 1."""
    rows = [entry.row("name", "weight") for entry in weights.items()]
    by_name = {row[0].text(): row[1].rational() for row in rows}
    if not by_name.get(name) or not by_name.keys() <= claim.ring.index.keys():
        raise weights.fail(f"{name} does not move, or what moves is no variable")
    return {other: weight / by_name[name] for other, weight in by_name.items() if other != name}


def moved_inside(
    made: Made,
    formula: Formula,
    place: Place,
    there: Mapping[str, Quotient],
    back: Mapping[str, Quotient],
    known: Context,
    *,
    start: bool = False,
) -> Formula:
    """The formula at a place with these terms for the variables that quantifiers inside bind, by steps.

    ``start``: the outermost quantifier is left alone.
    """
    if isinstance(formula, Exists | ForAll) and not start and (names := set(formula.variables) & there.keys()):
        inner, outer = ({v: of[v] for v in sorted(names)} for of in (there, back))
        moved = made.put(formula, inner)
        made.terms(formula, moved, inner, outer, place=place, used=known)
        formula = moved
    for k, child in enumerate(children(formula)):
        changed = moved_inside(made, child, (*place, k), there, back, known)
        formula = formula if changed == child else with_child(formula, k, changed)
    return formula


def _times(ring: Ring, name: str, unit: Poly, power: int) -> Quotient:
    """name * unit^power, as a quotient."""
    return ring.var(name) * unit ** max(power, 0), unit ** max(-power, 0)


def along(ring: Ring, name: str, by: Fraction, variable: str) -> Quotient:
    """name + by * variable, as a quotient."""
    bottom = ring.constant(by.denominator)
    return ring.var(name) * bottom + ring.var(variable) * by.numerator, bottom
