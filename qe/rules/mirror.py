"""A block that is its own mirror image and convex in what the mirror moves: only the fixed points need be looked at.

THEOREM. Let s exchange or negate variables, s(s(v)) = v: of a block ``ex v`` over f, and of quantifiers inside f, each
among its own variables. Let f be the same with s(v) for v, and for every v let the values of the moved variables of the
block that make f true be a convex set. Then ``ex v f`` iff f holds at some v with s(v) = v: where f holds at v it holds
at the image, and at the point in the middle, which s leaves alone. So negated variables are 0, and of two that are
exchanged one is plus or minus the other.

Convex are: conditions without the moved variables; comparisons but /= of polynomials of degree 1 in them;
conjunctions of convex conditions; disjunctions of which one part has moved variables, and is convex; ``all x. g`` for
convex g; and ``ex x. g`` where g is convex in x and the moved variables.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import chain, combinations, product

from qe.exact.ring import Poly
from qe.formula.build import atom, exists, forall
from qe.formula.features import is_short
from qe.formula.normal import nnf
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms, bound_variables, polynomials
from qe.rules.block_context import BlockContext
from qe.rules.change import Change
from qe.rules.lift import Solve
from qe.rules.step import StepKind

_VARIABLES, _TERMS = 10, 300
"""Up to so many bound variables, and terms in all atoms together, mirrors are looked for."""

Mirror = Mapping[str, tuple[str, int]]
"""Where every moved variable goes, with a sign."""


def at_fixed_points(formula: Exists | ForAll, context: BlockContext) -> tuple[Formula, list[Solve]]:
    """The block at the fixed points of all mirrors that are found, and the values of the variables that went."""
    rules: list[Solve] = []
    current: Formula = formula
    while StepKind.MIRROR in context.enabled and isinstance(current, type(formula)):
        context.budget.check("prepare")
        universal = isinstance(current, ForAll)
        body = nnf(current.body, negate=True) if universal else current.body
        mirror = next(_mirrors(current.variables, body, context.watch), None)
        if mirror is None:
            break
        change = Change(fixed(mirror, current.variables, next(atoms(body)).poly))
        rest = [v for v in current.variables if v not in change.values]
        after = (forall if universal else exists)(rest, change.image(current.body))
        moved = [[name, *image] for name, image in mirror.items()]
        context.step(StepKind.MIRROR.value, current, after, ", ".join(change.values), {"mirror": moved})
        rules += change.lifts
        current = after
    return current, rules


def fixed(mirror: Mirror, variables: Sequence[str], known: Poly) -> dict[str, Poly]:
    """What the fixed points have for variables of the block; ``known`` has the ring."""
    ring, values = known.ring, dict[str, Poly]()
    for name in variables:
        image, sign = mirror.get(name, (name, 1))
        if image == name and sign < 0:
            values[name] = ring.constant(0)
        elif image != name and image not in values:
            values[name] = ring.var(image) * sign
    return values


def _mirrors(variables: Sequence[str], body: Formula, watch: Callable[[], object]) -> Iterator[Mirror]:
    """The mirrors that leave the body alone, where it is convex."""
    inner = bound_variables(body)
    if isinstance(body, Constant) or len(variables) + len(inner) > _VARIABLES or {*inner} & {*variables, *body.free}:
        return
    single = [v for v in variables if v in body.free and is_convex(body, frozenset((v,)))]
    if not single or not is_short(body, _TERMS):
        return
    same = _shape(body, {})
    pairs = product(combinations(single, 2), (1, -1))
    exchanges = ({one: (other, sign), other: (one, sign)} for (one, other), sign in pairs)
    for mirror in chain(_sign_changes(single, inner, polynomials(body)), exchanges):
        watch()
        moved = frozenset(mirror) & frozenset(variables)
        if is_convex(body, moved) and _shape(body, mirror) == same:
            yield mirror


def _sign_changes(single: Sequence[str], inner: Sequence[str], polys: Sequence[Poly]) -> Iterator[Mirror]:
    """Those that map every polynomial to plus or minus one of them."""
    index, names = polys[0].ring.index, (*single, *inner)
    spread = [[(sum(1 << i for i, e in exps if e % 2), exps, c) for exps, c in p.sparse_terms()] for p in polys]
    known = {frozenset((exps, c) for _, exps, c in terms) for terms in spread}
    known |= {frozenset((exps, -c) for _, exps, c in terms) for terms in spread}
    for count in range(1, len(names) + 1):
        for chosen in combinations(names, count):
            mask = sum(1 << index[name] for name in chosen)
            images = (
                frozenset((e, -c if (odd & mask).bit_count() % 2 else c) for odd, e, c in terms) for terms in spread
            )
            if chosen[0] in single and all(image in known for image in images):
                yield {name: (name, -1) for name in chosen}


def is_convex(formula: Formula, moved: Collection[str]) -> bool:
    """Whether the values of these variables that make the formula true are seen to be a convex set."""
    if not set(moved) & set(formula.free):
        return True
    match formula:
        case Atom(poly, relation):
            places = [poly.ring.index[name] for name in moved if name in poly.ring.index]
            return relation is not Relation.NE and all(
                sum(e for i, e in exps if i in places) <= 1 for exps, _ in poly.sparse_terms()
            )
        case And(args):
            return all(is_convex(a, moved) for a in args)
        case Or(args):
            moving = [a for a in args if set(moved) & set(a.free)]
            return len(moving) == 1 and is_convex(moving[0], moved)
        case ForAll(_, body):
            return is_convex(body, moved)
        case Exists(variables, body):
            return is_convex(body, {*moved, *variables})
    return False


Shape = tuple[str, object]


def _shape(formula: Formula, mirror: Mirror) -> Shape:
    """The image of a formula, as it is up to the order of its parts."""
    match formula:
        case Atom(poly, relation):
            ring = poly.ring
            places = {ring.index[v]: ring.var(image) * sign for v, (image, sign) in mirror.items() if v in ring.index}
            image = atom(poly.compose(places), relation) if places else formula
            return "atom", image
        case And(args) | Or(args):
            return type(formula).__name__, frozenset(_shape(a, mirror) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            return f"{type(formula).__name__} {variables}", _shape(body, mirror)
    return "other", formula
