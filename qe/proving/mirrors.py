"""Blocks that are their own images under a change of places, in steps of the kernel: of a convex set with a point and
its image the middle of both is a solution; of variables that can be exchanged the least may be the first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import permutations

from qe.exact.ring import Poly
from qe.formula.build import conj, disj, exists, forall
from qe.formula.syntax import Atom, Exists, ForAll, Formula
from qe.formula.traverse import atoms, conjuncts
from qe.kernel.step import Claim, only
from qe.kernel.terms import Quotient, at_terms
from qe.proof.entry import Entry
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made
from qe.rules.ordered import least

Images = Mapping[str, Poly]


def mirrored(made: Made, after: Formula) -> None:
    """The middle of a solution and its image is a solution, and one that the mirror leaves alone."""
    before, ring = made.current, made.ring
    images = _images(only(made.claim, "mirror")[0], made.claim)
    block, wanted = (_gathered(f, images) for f in (before, after))
    made.moved(before, block)
    if not isinstance(block, Exists):
        raise made.claim.fail("a block expected")
    names, one, two = block.variables, ring.constant(1), ring.constant(2)
    here = {name: image for name, image in images.items() if name in names and image != ring.var(name)}
    centre = {name: (ring.var(name) + image, two) for name, image in here.items()}
    earlier = {name: [here[other] for other in list(here)[:k]] for k, name in enumerate(here)}  # of two exchanged
    gone = [name for name in here if not any(image.degree(ring.index[name]) for image in earlier[name])]
    fixed = {name: (here[name] if here[name] != -ring.var(name) else ring.constant(0), one) for name in gone}
    for part in conjuncts(block.body):
        if isinstance(part, ForAll) and {*part.free} & here.keys():
            _with_middle(made, part, images, here, centre)
    inner = made.current
    assert isinstance(inner, Exists)
    plain = [f for f in conjuncts(inner.body) if not isinstance(f, ForAll)]
    middle = exists(names, conj((inner.body, *(made.put(f, centre) for f in plain))))
    _follow(made, inner, middle, plain, here, centre)
    made.terms(middle, wanted, fixed, {name: centre[name] for name in here if name not in gone})


def _gathered(formula: Formula, images: Images) -> Formula:
    """A block with the variables of blocks among its parts that see what is moved."""
    names, body = (formula.variables, formula.body) if isinstance(formula, Exists) else ((), formula)
    parts = conjuncts(body)
    inner = [f for f in parts if isinstance(f, Exists)]
    names = (*names, *(v for f in inner for v in f.variables))
    return exists(names, conj(f.body if isinstance(f, Exists) else f for f in parts))


def _with_middle(made: Made, part: ForAll, images: Images, here: Images, centre: Mapping[str, Quotient]) -> None:
    """What holds for all values, at the image and in the middle, too."""
    there = {v: (images[v], made.ring.constant(1)) for v in part.variables if v in images}
    turned = ForAll(part.variables, made.put(part.body, here))
    both = forall(part.variables, conj((part.body, turned.body)))
    if turned != part:
        back = Made(made.claim, made.limits, both)
        back.moved(both, conj((part, turned)))
        back.terms(turned, part, there, there)
        made.back(part, both, back)
    middle = ForAll(part.variables, made.put(part.body, centre))
    all_three = forall(part.variables, conj((part.body, turned.body, middle.body)))
    _follow(made, both, all_three, [part.body], here, centre)
    made.moved(all_three, conj((part, turned, middle)))
    if turned != part:
        made.terms(turned, part, there, there)


def _follow(
    made: Made, before: Formula, after: Formula, parts: Sequence[Formula], here: Images, centre: Mapping[str, Quotient]
) -> None:
    """A polynomial of degree 1 has in the middle half the sum of its values at both points."""
    index, listed = made.ring.index, list[list[Term]]()
    for poly in dict.fromkeys(a.poly for f in parts for a in atoms(f) if isinstance(a, Atom)):
        image = poly.compose({index[v]: p for v, p in here.items()})
        if image != poly:
            value = at_terms(poly, {index[v]: q for v, q in centre.items()})
            twice = next((n for n in (1, 2) if (poly + image) * n == value * 2), None)
            listed.append([(twice or 1, ((poly, 1),)), (twice or 1, ((image, 1),)), (-2, ((value, 1),))])
    made.signs(before, after, identities(listed, made.ring))


def _images(entry: Entry, claim: Claim) -> Images:
    """What each moved variable is in the mirror."""
    images: dict[str, Poly] = {}
    for row in entry.items():
        variable, image, side = row.row("variable", "variable", "1 or -1")
        if not {variable.text(), image.text()} <= claim.ring.index.keys():
            raise row.fail("expected variables")
        images[variable.text()] = claim.ring.var(image.text()) * side.integer(-1)
    return images


def ordered(made: Made, after: Formula) -> None:
    """One of some variables is the least, and it changes places with the first."""
    ring, one = made.ring, made.ring.constant(1)
    for listed in only(made.claim, "exchanges")[0].items():
        block = made.current
        pairs = [[pair.row("variable", "variable") for pair in exchange.items()] for exchange in listed.items()]
        exchanges = [{one.text(): other.text() for one, other in exchange} for exchange in pairs]
        if not isinstance(block, Exists) or not exchanges or not all({*e} <= {*block.variables} for e in exchanges):
            raise listed.fail("expected exchanges of variables of a block")
        body, first = block.body, next(iter(exchanges[0]))
        case, *others = (
            exists(block.variables, conj((body, *least(body, exchanges, k)))) for k in range(len(exchanges) + 1)
        )
        names = [ring.var(v) for v in (first, *(e[first] for e in exchanges))]
        sums: list[list[Term]] = [
            [(1, ((p - q, 1),)) for p, q in ((a, b), (b, c), (c, a))] for a, b, c in permutations(names, 3)
        ]
        made.signs(block, disj((case, *others)), identities(sums, ring))
        for other, exchange in zip(others, exchanges, strict=True):
            there = {v: (ring.var(image), one) for v, image in exchange.items()}
            made.terms(other, case, there, there, EMPTY)
