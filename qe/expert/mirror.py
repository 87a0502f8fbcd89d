"""Rule "mirror images of a convex set": a block at the fixed points of an exchange or change of signs of variables.

THEOREM. Let s be an involution that maps every variable in ``mirror`` to plus or minus one that the same quantifier
binds, and leaves the others alone. Let f be the same formula, up to the order of members, with s(v) for v, and for
all values of everything else let the moved variables of the block make f true on a convex set. Then ex v f iff f
holds at a fixed point of s: where f holds at v, it holds at s(v) and at the middle of both. (Quantifiers inside range
over the same values before and after s.) Negated variables are 0 there, exchanged ones plus or minus each other.
A set is convex that linear comparisons other than /= describe; intersections of convex sets and projections of them
are convex; and for fixed values of everything else a condition without the moved variables is true or false. A
universal block is the negation of an existential one.

Evidence: ``mirror``: [[name, image, 1 or -1], ...], every moved variable once.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeGuard

from qe.exact.ring import Poly
from qe.formula.build import atom, exists
from qe.formula.syntax import And, Atom, Atomic, Constant, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import map_atoms, subformulas
from qe.kernel.block import existential
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import mapped
from qe.proof.entry import Entry

Images = Mapping[int, Poly]


def check_mirror(claim: Claim, context: Context, limits: Limits) -> None:
    """The mirror is one, the body is convex and its own image, and the fixed points are put in."""
    evidence, ring = only(claim, "mirror")[0], claim.ring
    before, after = existential(claim)
    if not _is_block(before):
        raise claim.fail("expected a block")
    images = _images(evidence, before, claim)
    limits.tick()
    moved = frozenset(i for i in images if ring.names[i] in before.variables)
    if not moved:
        raise evidence.fail("no variable of the block moves")
    if not _is_convex(before.body, moved):
        raise claim.fail("not seen to be convex in the moved variables of the block")
    if _members(map_atoms(before.body, lambda a: _at(a, images, claim))) != _members(before.body):
        raise evidence.fail("the body is not its own mirror image")
    values = _values(images, before.variables, claim)
    rest = [name for name in before.variables if ring.index[name] not in values]
    about = [p for i, image in values.items() for p in (ring.gen(i), image)]
    if after != exists(rest, mapped(before.body, lambda a: _at(a, values, claim), about, claim)):
        raise claim.fail("not the block at the fixed points")


def _is_block(formula: Formula) -> TypeGuard[Exists]:
    return isinstance(formula, Exists)


def _images(evidence: Entry, block: Exists, claim: Claim) -> Images:
    """An involution within the variables of each quantifier; no name is bound twice, or both free and bound."""
    blocks = [f.variables for f in subformulas(block) if isinstance(f, Exists | ForAll)]
    names = [name for variables in blocks for name in variables]
    if len(set(names)) < len(names) or set(names) & set(block.free):
        raise claim.fail("a name is bound twice, or free and bound")
    found: dict[str, tuple[str, int]] = {}
    for entry in evidence.items():
        variable, mirrored, side = entry.row("variable", "variable", "1 or -1")
        name, image, sign = variable.text(), mirrored.text(), side.integer(-1)
        if sign not in (1, -1):
            raise side.fail("expected 1 or -1")
        if name in found or not any({name, image} <= set(variables) for variables in blocks):
            raise entry.fail("expected each variable once, with one that the same quantifier binds")
        found[name] = image, sign
    if any(found.get(image) != (name, sign) for name, (image, sign) in found.items()):
        raise evidence.fail("done twice, it does not leave the variables alone")
    ring = claim.ring
    return {ring.index[name]: ring.var(image) * sign for name, (image, sign) in found.items()}


def _values(images: Images, variables: tuple[str, ...], claim: Claim) -> Images:
    """0 for what is negated; of two that are exchanged, the first by the second."""
    values: dict[int, Poly] = {}
    for name in variables:
        i = claim.ring.index[name]
        image = images.get(i)
        if image is None or image == claim.ring.gen(i):
            continue
        if image == -claim.ring.gen(i):
            values[i] = claim.ring.constant(0)
        elif image.variables[0] not in values:
            values[i] = image
    return values


def _at(given: Atomic, images: Images, claim: Claim) -> Formula:
    if not isinstance(given, Atom):
        raise claim.fail("no mirror images of root atoms")
    return atom(given.poly.compose(dict(images)), given.relation)


def _is_convex(formula: Formula, moved: frozenset[int]) -> bool:
    """Whether the formula describes a convex set of the moved variables, by its form."""
    match formula:
        case Constant():
            return True
        case Atom(poly, relation):
            degree = max((sum(e[i] for i in moved) for e, _ in poly.terms()), default=0)
            return degree == 0 or (degree == 1 and relation is not Relation.NE)
        case And(args):
            return all(_is_convex(a, moved) for a in args)
        case Or(args):
            moving = [a for a in args if _moves(a, moved)]
            return len(moving) <= 1 and all(_is_convex(a, moved) for a in moving)
        case ForAll(_, body):
            return _is_convex(body, moved)
        case Exists(variables, body):
            ring = formula.ring
            own = frozenset() if ring is None else frozenset(ring.index[v] for v in variables if v in ring.index)
            return not _moves(body, moved) or _is_convex(body, moved | own)
    return False


def _moves(formula: Formula, moved: frozenset[int]) -> bool:
    """Whether a polynomial in the formula has a moved variable; True where that is not known."""
    for part in subformulas(formula):
        if isinstance(part, Atom):
            if any(part.poly.degree(i) for i in moved):
                return True
        elif not isinstance(part, Constant | And | Or | Exists | ForAll):
            return True
    return False


def _members(formula: Formula) -> object:
    """The formula as nested sets: equal where only the order of members differs."""
    match formula:
        case And(args) | Or(args):
            return type(formula).__name__, frozenset(_members(a) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            return type(formula).__name__, variables, _members(body)
    return formula
