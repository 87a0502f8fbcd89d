"""Solutions near infinity in steps of the kernel: where one of the two ends is a solution, there is one."""

from __future__ import annotations

from qe.formula.build import conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula, Not
from qe.formula.traverse import atoms, conjuncts, disjuncts
from qe.kernel.negation import negation
from qe.kernel.step import only, outside
from qe.kernel.virtual_substitution import TestPoint, put
from qe.proof.entry import Json, formula_from_json
from qe.proving.expansions import monomials
from qe.proving.lemma_list import identities
from qe.proving.made import Made, by_signs


def infinity_first(made: Made, after: Formula) -> None:
    """Either end where it is a solution, and what remains in cases of a sign."""
    variable, cases, parts = only(made.claim, "variable", "cases", "parts")
    before, name, ring, limits = made.current, variable.text(), made.ring, made.limits
    first, *others = parts.items()
    listed = [formula_from_json(entry, ring) for entry in cases.items()]
    if not isinstance(before, Exists) or before.variables != (name,) or len(listed) != len(others):
        raise variable.fail("expected the one variable of a block, and steps for each case")
    made.known = outside(made.known, (name,))
    ends = {side: put(before.body, ring.index[name], TestPoint((), 0, side)) for side in (-1, 1)}
    far = disj(ends.values())
    rest = exists((name,), conj((before.body, negation(far))))
    split = disj((*(exists((name,), conj((end, before.body))) for end in ends.values()), rest))
    made.simplified(before, split)
    made.moved(split, disj((*(conj((end, before)) for end in ends.values()), rest)))
    for side, end in ends.items():
        if end != FALSE and conj((end, before)) in disjuncts(made.current):
            _taken(made, before, name, side, end)
    near = limits.replay(first, far, made.known, ring)
    if far not in (near, FALSE):
        made.derived(far, near, first.value)
    left = exists((name,), conj((before.body, negation(near))))
    if left != rest:
        made.moved(rest, exists((name,), And((*conjuncts(before.body), Not(far)))))
        made.derived(far, near, first.value)
        made.moved(exists((name,), And((*conjuncts(before.body), Not(near)))), left)
    starts = [exists((name,), conj((before.body, negation(near), case))) for case in listed]
    if left != FALSE:
        made.simplified(left, disj(starts))
    for start, steps in zip(starts, others, strict=True):
        end = limits.replay(steps, start, made.known, ring)
        if start in disjuncts(made.current):
            made.derived(start, end, steps.value)


def _taken(made: Made, block: Exists, name: str, side: int, end: Formula) -> None:
    """The block is true where the body is near an end of the line, of which the test point there tells."""
    known = tuple(f for f in conjuncts(end) if f != TRUE)
    point: Json = {"coefficients": [], "branch": 0, "shift": side}
    tried: Json = {"point": point, "guard": True, "formula": None, "settled": []}
    steps: list[Json] = [by_signs(made.claim, made.limits, end, TRUE, known)] if known else []
    evidence: dict[str, Json] = {"variable": name, "side": 1, "quadratics": []}
    made.step("elimination set", block, TRUE, {**evidence, "points": [tried], "parts": [steps]}, known)


def zeros(made: Made, after: Formula) -> None:
    """Which variables are 0 decides the terms of the polynomials, one by one."""
    only(made.claim)
    before = made.current
    polys = dict.fromkeys(a.poly for side in (before, after) for a in atoms(side) if isinstance(a, Atom))
    lemmas = identities(([(-1, ((poly, 1),)), *monomials(poly)] for poly in polys), made.ring)
    made.signs(before, after, lemmas, made.known)
