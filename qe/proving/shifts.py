"""Degree shift in steps of the kernel: x^k gets a name, and the root that is x is known to exist."""

from __future__ import annotations

from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.kernel.open_block import generic
from qe.kernel.step import only
from qe.proof.certificate import written
from qe.proof.entry import Json
from qe.proving.made import Made, equal
from qe.rules.degree_shift import lowered, values


def shifted(made: Made, after: Formula) -> None:
    """A variable for its power."""
    variable, exponent, *_ = only(made.claim, "variable", "exponent", optional=("theory",))
    block, name, _ = made.claim.variable(variable)
    lower(made, block, after, name, exponent.integer(2))


def low(body: Formula, x: int, power: int) -> Formula:
    """The formula with x for x^k, and what it is known to be beside that: not negative, positive if the set is open."""
    if power == 1 or body.ring is None:
        return body
    gen = body.ring.gen(x)
    strict = all(a.relation.is_strict for a in atoms(body) if a.poly.degree(x))
    return conj((lowered(body, x, power), values(gen, power, strict=strict)))


def lower_first(made: Made, block: Exists, name: str, power: int) -> Exists:
    """Steps from a block to that over ``low``; where its solutions are open, 0 is not the only one."""
    ring, x = made.ring, made.ring.index[name]
    after, whole = low(block.body, x, power), exists(block.variables, block.body)
    positive, weak = atom(ring.gen(x), Relation.GT), atom(ring.gen(x), Relation.GE)
    if power % 2 == 0 and positive in conjuncts(after) and positive not in conjuncts(block.body):
        inner = Exists((name,), block.body)
        plain = exists((name,), generic(inner))
        regular = exists((name,), conj((block.body, atom(ring.gen(x), Relation.NE))))
        nested = Exists(tuple(v for v in block.variables if v != name), inner) if len(block.variables) > 1 else inner
        made.moved(block, nested)
        made.derived(
            inner,
            regular,
            [
                written(OPEN, (), inner, plain, (), {}),
                written("converse", (), plain, regular, (), {"steps": [written(OPEN, (), regular, plain, (), {})]}),
            ],
        )
        whole = exists(block.variables, conj((block.body, atom(ring.gen(x), Relation.NE))))
        made.moved(made.current, whole)
    assert isinstance(whole, Exists)
    least = exists(block.variables, conj((lowered(whole.body, x, power), weak if power % 2 == 0 else TRUE)))
    lower(made, whole, least, name, power)
    smaller = exists(block.variables, after)
    made.simplified(least, smaller)
    assert isinstance(smaller, Exists)
    return smaller


def raised(made: Made, block: Exists, name: str, power: int) -> list[Json]:
    """Steps from what the block becomes by ``lower_first`` back to it."""
    lowering = Made(made.claim, made.limits, block)
    smaller = lower_first(lowering, block, name, power)
    made.simplified(made.current, smaller)
    made.back(smaller, block, lowering)
    return made.steps


OPEN = "inequations that remove no interior"


def lower(made: Made, block: Exists, low: Formula, name: str, power: int) -> None:
    """Steps from ``ex x f(x^k)`` to ``ex x g(x)``: g says that x >= 0 if k is even, and x > 0 where f has x itself."""
    ring, y = made.ring, made.fresh()
    x, place = ring.gen(ring.index[name]), ring.var(y)
    if not isinstance(low, Exists) or name not in low.variables:
        raise made.claim.fail("a block with the variable expected")
    at_y = made.put(low.body, {name: place})
    signs = {a.relation for a in atoms(block.body) if isinstance(a, Atom) and a.poly == x}
    bound = atom(x, Relation.GE) if power % 2 == 0 and signs & {Relation.GT, Relation.GE} else TRUE
    equation = equal(place, x**power)
    image = exists(block.variables, conj((bound, made.put(at_y, {y: x**power}))))
    names = [y if v == name else v for v in low.variables]
    whole = exists((*names, name), conj((equation, bound, at_y)))
    root = Exists((name,), conj((equation, bound)))
    below = exists(names, conj((root, at_y)))
    made.simplified(block, image)
    made.named(image, whole, y, equation)
    made.moved(whole, below)
    made.root(root, None if power % 2 else ring.constant(0))
    made.moved(exists(names, at_y), low)
