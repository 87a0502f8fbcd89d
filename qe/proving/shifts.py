"""Degree shift in steps of the kernel: x^k gets a name, and the root that is x is known to exist."""

from __future__ import annotations

from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, conjuncts, map_atoms
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Json
from qe.proving.made import Made, equal


def shifted(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """A variable for its power."""
    variable, exponent, *_ = only(claim, "variable", "exponent", optional=("theory",))
    block, name, _ = claim.variable(variable)
    made = Made(claim, limits, block, context)
    lower(made, block, claim.after, name, exponent.integer(2))
    return made.finished(claim.after)


def lower(made: Made, block: Exists, low: Formula, name: str, power: int) -> None:
    """Steps from ``ex x f(x^k)`` to ``ex x g(x)``: g says that x >= 0 if k is even, and x > 0 where f has x itself."""
    ring, y = made.ring, made.fresh()
    x, place = ring.gen(ring.index[name]), ring.var(y)
    if not isinstance(low, Exists) or name not in low.variables:
        raise made.claim.fail("a block with the variable expected")
    at_y = map_atoms(low.body, lambda a: _put(a, made, {ring.index[name]: place}))
    signs = {a.relation for a in atoms(block.body) if isinstance(a, Atom) and a.poly == x}
    bound = atom(x, Relation.GE) if power % 2 == 0 and signs & {Relation.GT, Relation.GE} else TRUE
    equation = equal(place, x**power)
    image = exists(block.variables, conj((bound, map_atoms(at_y, lambda a: _put(a, made, {ring.index[y]: x**power})))))
    names = [y if v == name else v for v in low.variables]
    whole = exists((*names, name), conj((equation, bound, at_y)))
    root = Exists((name,), conj((equation, bound)))
    below = exists(names, conj((root, at_y)))
    made.simplified(block, image)
    made.named(image, whole, y, equation)
    made.moved(whole, below)
    made.root(root, None if power % 2 else ring.constant(0))
    made.moved(exists(names, at_y), low)


def _put(found: Atom | RootAtom, made: Made, by: dict[int, object]) -> Formula:
    if isinstance(found, RootAtom):
        raise made.claim.fail("no degree shift in root atoms")
    return atom(found.poly.compose(by), found.relation)  # type: ignore[arg-type]
