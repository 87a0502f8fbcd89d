"""First-order formulas over the ordered field of the reals: a frozen syntax tree.

Semantics is the standard one over R. Every ``Atom`` of one formula has its polynomial in one common
``Ring``; quantifiers bind variables by name. Build formulas with ``qe.formula.build``, which keeps
the invariants stated on each class; these constructors do not simplify.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, dataclass_transform

from qe.errors import InternalError
from qe.exact.ring import Poly, Ring
from qe.formula.notation import Level, Notation, bracketed, chain, comparison
from qe.formula.operators import Connected, Substituting
from qe.formula.relation import Relation as Relation
from qe.formula.text import text_notation
from qe.services import SymPyForm

LONGEST = 300
"""Characters of a formula in its ``repr`` and those of values that have one."""

NO_NAMES = frozenset[str]()


class FormulaNode(Connected, Substituting, SymPyForm):
    """Base class of all nodes; ``str()`` prints the text syntax.

    ``ring``, ``free``, ``bound``, ``is_quantifier_free``, ``is_normal`` and the hash are worked out when they are first
    asked for and then kept. They are no part of what a node is equal to, of its ``repr`` or of its pickle.
    """

    __slots__ = ("_hash", "bound", "free", "is_normal", "is_quantifier_free", "ring")
    __match_args__: ClassVar[tuple[str, ...]] = ()
    _hash: int
    bound: frozenset[str]
    """The names that quantifiers in the formula bind."""
    free: tuple[str, ...]
    """The names that occur free, in ring order."""
    is_normal: bool
    """Whether it is in negation normal form: nothing is negated but root atoms."""
    is_quantifier_free: bool
    """Whether no quantifier occurs."""
    ring: Ring | None
    """The common ring of the atoms, or None for a formula without atoms."""

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """A slot that is still empty."""
            if name not in FormulaNode.__slots__:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            value = getattr(self, f"_find_{name}")()
            object.__setattr__(self, name, value)
            return value

    def __hash__(self) -> int:
        return self._hash

    def _find__hash(self) -> int:
        return hash((self.__class__.__name__, *[getattr(self, name) for name in self.__match_args__]))

    def _find_ring(self) -> Ring | None:
        return None

    def _find_free(self) -> tuple[str, ...]:
        return ()

    def _find_is_quantifier_free(self) -> bool:
        return True

    def _find_bound(self) -> frozenset[str]:
        return NO_NAMES

    def _find_is_normal(self) -> bool:
        return True

    def __str__(self) -> str:
        return self.written(text_notation(self.free, self.bound))

    def __repr__(self) -> str:
        return f"Formula({self.brief()})"

    def brief(self) -> str:
        """As ``str``, cut off after ``LONGEST`` characters."""
        text = str(self)
        return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        """The text in a line format, with no more brackets than reading it back needs.

        ``level``: the construct around it; ``last``: nothing follows, so that a quantifier may stay open.
        """
        raise TypeError(f"not a formula: {self!r}")


Kind = TypeVar("Kind", bound="FormulaNode")


@dataclass_transform(frozen_default=True)
def _node(kind: type[Kind]) -> type[Kind]:
    """A frozen dataclass whose hash is the one that a formula keeps."""
    made = dataclass(frozen=True, slots=True, repr=False)(kind)
    made.__hash__ = FormulaNode.__hash__  # type: ignore[method-assign]
    return made


@_node
class Constant(FormulaNode):
    """TRUE or FALSE."""

    value: bool

    def __repr__(self) -> str:
        return "TRUE" if self.value else "FALSE"

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return notation.true if self.value else notation.false


TRUE, FALSE = Constant(True), Constant(False)


@_node
class Atom(FormulaNode):
    """``poly relation 0``. Invariant: poly is non-constant, primitive, with positive leading coefficient."""

    poly: Poly
    relation: Relation

    def _find_ring(self) -> Ring | None:
        return self.poly.ring

    def _find_free(self) -> tuple[str, ...]:
        names = self.poly.ring.names
        return tuple([names[i] for i in self.poly.variables])

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return comparison(self.poly, self.relation, notation)


@_node
class RootAtom(FormulaNode):
    """``variable relation root_k(poly)``: the k-th smallest distinct real root of ``poly`` in ``variable``.

    ``k`` counts from 1; negative k counts from the largest (-1). The atom is false where fewer than |k| real
    roots exist, whatever the relation, and where poly vanishes identically in ``variable``. Because of that
    convention its negation is not a root atom again (Brown 1999, extended Tarski formulas).
    """

    variable: str
    relation: Relation
    poly: Poly
    k: int

    def _find_ring(self) -> Ring | None:
        return self.poly.ring

    def _find_free(self) -> tuple[str, ...]:
        names, occurring = self.poly.ring.names, self.poly.variables
        return tuple([name for i, name in enumerate(names) if i in occurring or name == self.variable])

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return notation.root(self.variable, self.relation, self.poly, self.k)


@_node
class Connective(FormulaNode):
    """Two or more formulas joined by one connective. Raises ``InternalError`` for parts over different rings."""

    args: tuple[Formula, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "ring", self._find_ring())

    def _find_ring(self) -> Ring | None:
        ring = None
        for arg in self.args:
            if (other := arg.ring) is not ring and other is not None:
                if ring is not None:
                    raise InternalError(f"a formula over two rings: {ring!r} and {other!r}")
                ring = other
        return ring

    def _find_free(self) -> tuple[str, ...]:
        return _together(self.ring, self.args)

    def _find_is_quantifier_free(self) -> bool:
        return all(arg.is_quantifier_free for arg in self.args)

    def _find_bound(self) -> frozenset[str]:
        return NO_NAMES if self.is_quantifier_free else NO_NAMES.union(*(arg.bound for arg in self.args))

    def _find_is_normal(self) -> bool:
        return all(arg.is_normal for arg in self.args)


@_node
class And(Connective):
    """Conjunction. Invariant (builders): at least two arguments, none an And or a Constant."""

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return chain(self.args, Level.AND, level, last, notation)


@_node
class Or(Connective):
    """Disjunction. Invariant (builders): at least two arguments, none an Or or a Constant."""

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return chain(self.args, Level.OR, level, last, notation)


@_node
class Not(FormulaNode):
    """Negation."""

    arg: Formula

    def _find_ring(self) -> Ring | None:
        return self.arg.ring

    def _find_free(self) -> tuple[str, ...]:
        return self.arg.free

    def _find_is_quantifier_free(self) -> bool:
        return self.arg.is_quantifier_free

    def _find_bound(self) -> frozenset[str]:
        return self.arg.bound

    def _find_is_normal(self) -> bool:
        return isinstance(self.arg, RootAtom)

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        if isinstance(self.arg, RootAtom) or notation.strict:
            return notation.negation + bracketed(self.arg, notation.brackets, notation)
        return notation.negation + self.arg.written(notation, Level.NOT, last)


@_node
class Quantified(FormulaNode):
    """A block of one kind of quantifier over a body."""

    variables: tuple[str, ...]
    body: Formula

    def _find_ring(self) -> Ring | None:
        return self.body.ring

    def _find_free(self) -> tuple[str, ...]:
        bound = set(self.variables)
        return tuple([name for name in self.body.free if name not in bound])

    def _find_is_quantifier_free(self) -> bool:
        return False

    def _find_bound(self) -> frozenset[str]:
        return self.body.bound.union(self.variables)

    def _find_is_normal(self) -> bool:
        return self.body.is_normal

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        prefix = notation.quantifier(isinstance(self, ForAll), self.variables)
        if notation.scope is not None:
            return prefix + bracketed(self.body, notation.scope, notation)
        if not last:
            return bracketed(self, notation.brackets, notation)
        return prefix + self.body.written(notation)


@_node
class Exists(Quantified):
    """There are real values of ``variables`` such that ``body``."""


@_node
class ForAll(Quantified):
    """For all real values of ``variables``, ``body``."""


Atomic = Atom | RootAtom
"""The kinds of atomic formulas."""

Formula = Atomic | Constant | And | Or | Not | Exists | ForAll
"""All kinds of nodes: a ``match`` that ends with ``assert_never`` is one that mypy holds against this list."""


def _together(ring: Ring | None, parts: tuple[Formula, ...]) -> tuple[str, ...]:
    """The free variables of all parts, in the order of their ring."""
    if ring is None:
        return ()
    names: set[str] = set()
    for part in parts:
        names.update(part.free)
    return tuple(sorted(names, key=ring.index.__getitem__))
