"""What a formula looks like, for the planner: counts, degrees and shape, nothing that needs algebra."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from qe.exact.ring import Poly, Ring
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.formula.traverse import atoms, children, free_variables, ring_of


class Shape(Enum):
    """The Boolean shape of a formula without its quantifiers."""

    CONSTANT = "constant"
    ATOM = "atom"
    CONJUNCTION = "conjunction of atoms"
    DISJUNCTION = "disjunction of atoms"
    MIXED = "mixed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Features:
    """Counts and flags of one formula.

    ``free``, ``bound``: the variables (bound ones in order of quantification, without repetition). ``blocks``:
    numbers of variables of the quantifier blocks, outermost first, of a prenex formula; None otherwise.
    ``alternations``: changes of quantifier along the deepest path. ``degrees``: for every variable the largest
    degree over all polynomials; ``linear_in``/``quadratic_in``: bound variables of degree at most 1/2 everywhere.
    ``equations``: variables that occur in a top-level conjunct ``p = 0`` (below the quantifiers).
    ``max_bits``: bits of the largest coefficient.
    """

    free: tuple[str, ...]
    bound: tuple[str, ...]
    blocks: tuple[int, ...] | None
    alternations: int
    outermost_universal: bool | None
    degrees: Mapping[str, int]
    occurrences: Mapping[str, int]
    linear_in: frozenset[str]
    quadratic_in: frozenset[str]
    atoms: int
    polynomials: int
    total_degree: int
    max_terms: int
    max_bits: int
    relations: Mapping[Relation, int]
    root_atoms: int
    equations: int
    shape: Shape
    nodes: int
    depth: int

    @property
    def is_sentence(self) -> bool:
        """Whether no variable is free."""
        return not self.free

    @property
    def is_quantifier_free(self) -> bool:
        """Whether no variable is bound."""
        return not self.bound and self.blocks == ()

    @property
    def one_block(self) -> bool:
        """Whether all quantifiers form one outer block of one kind."""
        return self.blocks is not None and len(self.blocks) == 1

    @property
    def max_bound_degree(self) -> int:
        """The largest degree in a quantified variable."""
        return max((self.degrees[name] for name in self.bound), default=0)

    @property
    def all_strict(self) -> bool:
        """Whether only <, > and /= occur and nothing is negated away from that (atoms carry negations)."""
        return not self.root_atoms and all(relation.is_strict for relation in self.relations)


def features(formula: Formula) -> Features:
    """The features of a formula, in one pass over its atoms."""
    found = list(atoms(formula))
    polys = list(dict.fromkeys(a.poly for a in found))
    ring = ring_of(formula)
    degrees = _degrees(ring, polys)
    bound = tuple(dict.fromkeys(_bound(formula)))
    return Features(
        free=free_variables(formula),
        bound=bound,
        blocks=_prenex_blocks(formula),
        alternations=_alternations(formula, None),
        outermost_universal=isinstance(formula, ForAll) if isinstance(formula, Exists | ForAll) else None,
        degrees={**dict.fromkeys(bound, 0), **degrees},
        occurrences=_occurrences(found),
        linear_in=frozenset(v for v in bound if degrees.get(v, 0) <= 1),
        quadratic_in=frozenset(v for v in bound if degrees.get(v, 0) <= 2),
        atoms=len(found),
        polynomials=len(polys),
        total_degree=max((p.total_degree for p in polys), default=0),
        max_terms=max((p.term_count() for p in polys), default=0),
        max_bits=max((abs(c).bit_length() for p in polys for _, c in p.terms()), default=0),
        relations=Counter(a.relation for a in found),
        root_atoms=sum(isinstance(a, RootAtom) for a in found),
        equations=_equations(formula),
        shape=_shape(formula),
        nodes=_nodes(formula),
        depth=_depth(formula),
    )


def _degrees(ring: Ring | None, polys: list[Poly]) -> dict[str, int]:
    if ring is None:
        return {}
    return {name: max((p.degrees[i] for p in polys), default=0) for i, name in enumerate(ring.names)}


def _occurrences(found: list[Atom | RootAtom]) -> dict[str, int]:
    """For every variable the number of atoms that contain it."""
    return Counter(a.poly.ring.names[i] for a in found for i in a.poly.variables)


def _bound(formula: Formula) -> list[str]:
    own = list(formula.variables) if isinstance(formula, Exists | ForAll) else []
    return own + [name for child in children(formula) for name in _bound(child)]


def _has_quantifier(formula: Formula) -> bool:
    return isinstance(formula, Exists | ForAll) or any(_has_quantifier(child) for child in children(formula))


def _prenex_blocks(formula: Formula) -> tuple[int, ...] | None:
    blocks: list[int] = []
    while isinstance(formula, Exists | ForAll):
        blocks.append(len(formula.variables))
        formula = formula.body
    return None if _has_quantifier(formula) else tuple(blocks)


def _alternations(formula: Formula, around: bool | None) -> int:
    """Changes of quantifier along the deepest path, negations counted as they turn quantifiers round."""
    if isinstance(formula, Not):
        return _alternations(formula.arg, None if around is None else not around)
    own = 0
    if isinstance(formula, Exists | ForAll):
        kind = isinstance(formula, ForAll)
        own, around = int(around is not None and around is not kind), kind
    return own + max((_alternations(child, around) for child in children(formula)), default=0)


def _matrix(formula: Formula) -> Formula:
    while isinstance(formula, Exists | ForAll):
        formula = formula.body
    return formula


def _equations(formula: Formula) -> int:
    matrix = _matrix(formula)
    parts = matrix.args if isinstance(matrix, And) else (matrix,)
    return sum(isinstance(part, Atom) and part.relation is Relation.EQ for part in parts)


def _shape(formula: Formula) -> Shape:
    matrix = _matrix(formula)
    match matrix:
        case Constant():
            return Shape.CONSTANT
        case Atom() | RootAtom():
            return Shape.ATOM
        case And(args) if all(isinstance(arg, Atom | RootAtom) for arg in args):
            return Shape.CONJUNCTION
        case Or(args) if all(isinstance(arg, Atom | RootAtom) for arg in args):
            return Shape.DISJUNCTION
    return Shape.MIXED


def _nodes(formula: Formula) -> int:
    return 1 + sum(_nodes(child) for child in children(formula))


def _depth(formula: Formula) -> int:
    return 1 + max((_depth(child) for child in children(formula)), default=0)
