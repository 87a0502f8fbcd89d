"""The matrix of a prenex formula, compiled so that knowing the signs of one level's factors shrinks it.

Nodes: ``True``, ``False``, a ``Test`` (a product of factors whose sign must lie in a set), or a ``Junction``
(conjunction or disjunction of nodes). ``specialise`` substitutes the signs of one level (Kleene evaluation,
Collins and Hong 1991, "partial CAD"); results are shared between cells with equal signs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from qe.errors import InternalError
from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or, Relation
from qe.formula.traverse import conjuncts, disjuncts

_ALL = frozenset((-1, 0, 1))


@dataclass(frozen=True, slots=True)
class Test:
    """sign(product of factor^multiplicity) ∈ ``allowed``; ``parts`` holds (level, index, odd multiplicity?)."""

    parts: tuple[tuple[int, int, bool], ...]
    allowed: frozenset[int]


@dataclass(frozen=True, slots=True)
class Junction:
    """Conjunction (``is_and``) or disjunction of at least two nodes."""

    is_and: bool
    args: tuple[Node, ...]


Node = bool | Test | Junction


def join(is_and: bool, args: Iterable[Node]) -> Node:
    """The conjunction or disjunction of nodes, with constants absorbed and duplicates removed."""
    kept: dict[Node, None] = {}
    for arg in args:
        if arg is (not is_and):
            return arg
        if arg is is_and:
            continue
        if isinstance(arg, Junction) and arg.is_and is is_and:
            kept.update(dict.fromkeys(arg.args))
        else:
            kept[arg] = None
    if not kept:
        return is_and
    return next(iter(kept)) if len(kept) == 1 else Junction(is_and, tuple(kept))


def compile_matrix(matrix: Formula, places: Mapping[Poly, tuple[int, int]]) -> Node:
    """The node of a quantifier-free formula without root atoms; ``places`` gives (level, index) of each factor."""
    match matrix:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return _test(poly, relation.signs, places)
        case And(args):
            return join(True, (compile_matrix(a, places) for a in args))
        case Or(args):
            return join(False, (compile_matrix(a, places) for a in args))
        case Not(arg):
            return negate(compile_matrix(arg, places))
    raise InternalError(f"not a quantifier-free Tarski formula: {type(matrix).__name__}")


def negate(node: Node) -> Node:
    """The node that is true exactly where this one is false."""
    if isinstance(node, bool):
        return not node
    if isinstance(node, Test):
        return Test(node.parts, _ALL - node.allowed)
    return join(not node.is_and, (negate(a) for a in node.args))


def _test(poly: Poly, signs: frozenset[int], places: Mapping[Poly, tuple[int, int]]) -> Node:
    unit, factors = poly.factors()
    allowed = signs if unit > 0 else frozenset(-s for s in signs)
    parts = tuple(sorted((*places[f], bool(e % 2)) for f, e in factors))
    return _settle(parts, allowed)


def _settle(parts: tuple[tuple[int, int, bool], ...], allowed: frozenset[int]) -> Node:
    if not parts:
        return 1 in allowed
    if not any(odd for _, _, odd in parts):
        if {0, 1} <= allowed:
            return True
        if not allowed & {0, 1}:
            return False
    if allowed == _ALL:
        return True
    return Test(parts, allowed) if allowed else False


def specialise(node: Node, level: int, signs: Mapping[int, int]) -> Node:
    """The node with the signs of factors of one level substituted (index -> sign; others stay open)."""
    if isinstance(node, bool):
        return node
    if isinstance(node, Junction):
        return join(node.is_and, (specialise(a, level, signs) for a in node.args))
    allowed, rest, changed = node.allowed, [], False
    for part in node.parts:
        sign = signs.get(part[1]) if part[0] == level else None
        if sign is None:
            rest.append(part)
            continue
        changed = True
        if sign == 0:
            return 0 in allowed
        if sign < 0 and part[2]:
            allowed = frozenset(-s for s in allowed)
    return _settle(tuple(rest), allowed) if changed else node


def mentioned(node: Node, level: int) -> set[int]:
    """The indices of the level's factors that a node still depends on."""
    if isinstance(node, bool):
        return set()
    if isinstance(node, Test):
        return {index for at, index, _ in node.parts if at == level}
    found: set[int] = set()
    for arg in node.args:
        found |= mentioned(arg, level)
    return found


def strengthened(matrix: Formula, implied: Iterable[Poly], places: Mapping[Poly, tuple[int, int]]) -> Formula:
    """The matrix with conditions of lower level that it implies and whose factors are in ``places``; equivalent.

    ``implied``: polynomials that are zero wherever the matrix holds. Rule Q: a*z^2 + b*z + c <= 0 with a constant a > 0
    implies b^2 - 4*a*c >= 0 (strictly for <; for =, >=); mirrored for a < 0. Where the discriminants are projection
    factors, they cost nothing, and cells where one is negative need no stack. For a disjunction, what the negated
    matrix implies is added negated.
    """
    dual = isinstance(matrix, Or)
    parts = [*(disjuncts(matrix) if dual else conjuncts(matrix))]
    parts += [atom(p, Relation.NE if dual else Relation.EQ) for p in implied]
    for part in parts:  # grows while it is read: implied atoms imply further ones
        if isinstance(part, Atom):
            found = _solvability(part, dual)
            if found is not None and found not in parts and all(f in places for f, _ in found.poly.factors()[1]):
                parts.append(found)
    if len(parts) == 1:
        return matrix
    return Or(tuple(parts)) if dual else And(tuple(parts))


def _solvability(found: Atom, dual: bool) -> Atom | None:
    """What the atom implies about the other variables; with ``dual``, what implies the atom."""
    poly, level = found.poly, found.poly.level
    if level < 1 or poly.degree(level) != 2:
        return None
    c, b, a = poly.coefficients(level)
    if not a.is_constant:
        return None
    relation = found.relation.negated if dual else found.relation
    facing = relation if a.constant_value() > 0 else relation.flipped
    if facing is Relation.LT:
        needed = Relation.GT
    elif facing in (Relation.LE, Relation.EQ):
        needed = Relation.GE
    else:
        return None
    condition = atom(b * b - 4 * (a * c), needed.negated if dual else needed)
    return condition if isinstance(condition, Atom) else None
