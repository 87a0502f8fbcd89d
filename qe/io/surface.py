"""What readers build before names are resolved: the one language of terms and formulas, as written, with positions;
``qe.io.lowering`` says what they mean.

``at`` is an offset into the text (-1: unknown). Lists are filled while parsing and not changed later.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, get_args

from qe.errors import InputError
from qe.formula.relation import Relation

if TYPE_CHECKING:
    from qe.exact.algebraic import RealAlgebraic

MAX_DEPTH = 120
"""Nesting of brackets, operators and quantifiers that readers accept; all later code may recurse on it."""

FUNCTIONS = {"abs": (1, 1), "sign": (1, 1), "sqrt": (1, 1), "cbrt": (1, 1), "min": (1, 1000), "max": (1, 1000)}
"""The functions of terms, each with the least and the greatest number of its arguments."""

Fail: TypeAlias = Callable[[str, int], InputError]
Meet: TypeAlias = Callable[[str, int], None]
"""Called with every free occurrence of a name and its offset; may raise."""


class Number(NamedTuple):
    """An exact rational number."""

    value: Fraction | int


class Algebraic(NamedTuple):
    """A real algebraic number."""

    value: RealAlgebraic
    at: int


class Name(NamedTuple):
    """A variable."""

    name: str
    at: int


class Polynomial(NamedTuple):
    """Coefficients, none of them zero, by the names that are multiplied: sorted, each as often as its power."""

    terms: dict[tuple[str, ...], Fraction | int]


class Sum(NamedTuple):
    """A sum of at least two parts."""

    parts: list[Term]


class Product(NamedTuple):
    """``left * right``."""

    left: Term
    right: Term
    at: int


class Quotient(NamedTuple):
    """``left / right``."""

    left: Term
    right: Term
    at: int


class Power(NamedTuple):
    """``base ^ exponent``."""

    base: Term
    exponent: Term
    at: int


class Minus(NamedTuple):
    """``-part``."""

    part: Term


class Root(NamedTuple):
    """The ``number``-th root of ``poly`` in ``variable`` (None: the other side of the comparison)."""

    number: Term
    poly: Term
    variable: str | None
    at: int


class Apply(NamedTuple):
    """A function of ``FUNCTIONS`` and its arguments."""

    function: str
    arguments: list[Term]
    at: int


class Choice(NamedTuple):
    """``if condition then then else other``; undefined instead of ``other`` where that is None."""

    condition: Node
    then: Term
    other: Term | None
    at: int


class Infinity(NamedTuple):
    """A bound that is none: the whole side of a comparison, perhaps with a sign."""

    at: int


class Comparison(NamedTuple):
    """``sides[0] relations[0] sides[1] relations[1] sides[2] …``, read as a conjunction."""

    sides: list[Term]
    relations: list[Relation]
    at: int


class Truth(NamedTuple):
    """``true`` or ``false``."""

    value: bool


class Every(NamedTuple):
    """A conjunction."""

    parts: list[Node]


class Some(NamedTuple):
    """A disjunction."""

    parts: list[Node]


class Negation(NamedTuple):
    """``not part``."""

    part: Node


class Implication(NamedTuple):
    """``left -> right``."""

    left: Node
    right: Node


class Equivalence(NamedTuple):
    """``left <-> right``."""

    left: Node
    right: Node


class Quantification(NamedTuple):
    """``all names. body`` or ``ex names. body``."""

    universal: bool
    names: list[str]
    body: Node


class Quantity(NamedTuple):
    """How many values satisfy the body (``qe.formula.quantity``); ``kind`` is one of ``QUANTITIES``."""

    kind: str
    number: int
    name: str
    body: Node
    at: int


QUANTITIES = {"F": "infinitely many", "G": "all but finitely many", "C": "connected", "X": "exactly", "L": "at least"}


Term: TypeAlias = (
    Number | Algebraic | Name | Polynomial | Sum | Product | Quotient | Power | Minus | Root | Apply | Choice | Infinity
)
Node: TypeAlias = Comparison | Truth | Every | Some | Negation | Implication | Equivalence | Quantification | Quantity
Part: TypeAlias = Term | Node
TERMS, NODES = frozenset(get_args(Term)), frozenset(get_args(Node))
"""Their classes: whether one is among them is known faster than whether something is an instance."""


def unplaced(message: str, _: int) -> InputError:
    """The error about what stands in no text."""
    return InputError(message)


def connected(name: str, parts: list[Node]) -> Node | None:
    """What a connective makes of these parts; None for one of another name, or another number of parts."""
    match name, parts:
        case "And", _:
            return Every(parts)
        case "Or", _:
            return Some(parts)
        case "Not", [part]:
            return Negation(part)
        case "Implies", [*conditions, conclusion]:
            return reduce(lambda result, part: Implication(part, result), reversed(conditions), conclusion)
        case "Equivalent", [first, *rest]:
            return Every([Equivalence(first, part) for part in rest])
        case "Xor", [first, *rest]:
            return reduce(lambda result, part: Negation(Equivalence(result, part)), rest, first)
        case "ITE", [condition, then, other]:
            return Every([Implication(condition, then), Some([condition, other])])
    return None
