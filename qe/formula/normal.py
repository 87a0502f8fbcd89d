"""Normal forms: negation normal form, bound variables renamed apart, prenex form."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import StrEnum
from typing import assert_never

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, map_children, neg, root_atom
from qe.formula.syntax import And, Atom, Atomic, Constant, Exists, ForAll, Formula, Not, Or, Quantified, RootAtom
from qe.formula.traverse import children, clashes, map_atoms, subformulas


class Quantifier(StrEnum):
    """The kind of a quantifier block; the values are those of ``CellTable.quantifiers``."""

    EXISTS = "E"
    FORALL = "A"

    @property
    def dual(self) -> Quantifier:
        """The other quantifier: not Q x. f is Q' x. not f."""
        return Quantifier.FORALL if self is Quantifier.EXISTS else Quantifier.EXISTS


PrefixBlock = tuple[Quantifier, tuple[str, ...]]


def nnf(formula: Formula, *, negate: bool = False) -> Formula:
    """The negation normal form of ``formula`` (of its negation with ``negate``).

    Equivalent over R; ``Not`` remains only in front of a ``RootAtom``, whose negation is not a root atom
    because it is false where the root does not exist. A formula of that form is returned itself.
    """
    if formula.is_normal and not negate:
        return formula
    match formula:
        case Not(arg):
            return nnf(arg, negate=not negate)
        case And(args) | Or(args):
            join = conj if isinstance(formula, And) is not negate else disj
            return join([nnf(arg, negate=negate) for arg in args])
        case Exists(variables, body) | ForAll(variables, body):
            quantify = exists if isinstance(formula, Exists) is not negate else forall
            return quantify(variables, nnf(body, negate=negate))
        case Constant() | Atom() | RootAtom():
            return neg(formula) if negate else formula
        case _:
            assert_never(formula)


def rename_apart(formula: Formula, avoid: Iterable[str] = ()) -> Formula:
    """An equivalent formula in which every quantifier binds a name of its own, none of them free or one to ``avoid``.

    The first quantifier of a name keeps it, later ones get ``x_1``, ``x_2``, …, which enlarge the ring (at the
    end, so free variables keep their places). A quantified variable that does not occur in its body is dropped,
    which is sound because R is not empty.
    """
    ring = formula.ring
    if ring is None:
        return matrix_of(formula)
    renaming = _Renaming(ring, (*formula.free, *avoid))
    names = renaming.plan(formula)
    return renaming.apply(formula, names, {})


def without_clashes(formula: Formula) -> Formula:
    """As ``rename_apart``; a formula in which no quantifier binds a name that it sees stays as it is."""
    return rename_apart(formula) if clashes(formula) else formula


def matrix_of(formula: Formula) -> Formula:
    """The formula without its quantifiers: what they bind is free then, and without atoms nothing is lost."""
    return matrix_of(formula.body) if isinstance(formula, Quantified) else map_children(formula, matrix_of)


class _Renaming:
    """First ``plan`` chooses the names, quantifiers in preorder; then ``apply`` rebuilds in the final ring."""

    def __init__(self, ring: Ring, free: Iterable[str]) -> None:
        self.ring = ring
        self.used = set(free)
        self.reserved = self.used.union(ring.names)
        self.fresh: list[str] = []
        self.target = ring
        self.polys: dict[tuple[Poly, tuple[str, ...]], Poly] = {}

    def plan(self, formula: Formula) -> list[str]:
        """The new names of all bound variables, in the order in which ``apply`` will ask for them."""
        chosen: list[str] = []
        for part in subformulas(formula):
            if isinstance(part, Exists | ForAll):
                free = frozenset(part.body.free)
                chosen += [self._choose(name) if name in free else "" for name in part.variables]
        self.target = Ring.of([*self.ring.names, *self.fresh]) if self.fresh else self.ring
        chosen.reverse()
        return chosen

    def _choose(self, name: str) -> str:
        if name not in self.used:
            self.used.add(name)
            return name
        k = 1
        while f"{name}_{k}" in self.reserved:
            k += 1
        fresh = f"{name}_{k}"
        self.reserved.add(fresh)
        self.fresh.append(fresh)
        return fresh

    def apply(self, formula: Formula, names: list[str], scope: Mapping[str, str]) -> Formula:
        match formula:
            case Atom(poly, relation):
                moved = self._poly(poly, scope)
                return formula if moved is poly else atom(moved, relation)
            case RootAtom(variable, relation, poly, k):
                moved, name = self._poly(poly, scope), scope.get(variable, variable)
                return formula if moved is poly and name == variable else root_atom(name, relation, moved, k)
            case Exists(variables, body) | ForAll(variables, body):
                bound = [(name, names.pop()) for name in variables]
                quantify = exists if isinstance(formula, Exists) else forall
                inner = self.apply(body, names, {**scope, **{old: new for old, new in bound if new not in ("", old)}})
                return quantify([new for _, new in bound if new], inner)
            case And() | Or() | Not() | Constant():
                parts = [self.apply(part, names, scope) for part in children(formula)][::-1]  # each takes its names
                return map_children(formula, lambda part: parts.pop())
            case _:
                assert_never(formula)

    def _poly(self, poly: Poly, scope: Mapping[str, str]) -> Poly:
        if not scope and self.target is self.ring:
            return poly
        present = tuple(scope.get(self.ring.names[i], self.ring.names[i]) for i in poly.variables)
        key = (poly, present)
        stored = self.polys.get(key)
        if stored is None:
            stored = self.polys[key] = _renamed(poly, self.target, dict(zip(poly.variables, present)))
        return stored


def _renamed(poly: Poly, target: Ring, names: Mapping[int, str]) -> Poly:
    """The polynomial with variable i called ``names[i]``, in the ring ``target``."""
    moved: dict[tuple[int, ...], int] = {}
    for exponents, coefficient in poly.terms():
        vector = [0] * target.size
        for i, name in names.items():
            vector[target.index[name]] = exponents[i]
        moved[tuple(vector)] = coefficient
    return target.from_terms(moved)


def rename(formula: Formula, names: Mapping[str, str]) -> Formula:
    """A quantifier-free formula with variables renamed; the new names must not be in use.

    The ring keeps its order: the new name stands where the old one stood.
    """
    ring = formula.ring
    if ring is None or not names:
        return formula
    target = Ring.of([names.get(name, name) for name in ring.names])
    where = {i: names.get(name, name) for i, name in enumerate(ring.names)}

    def change(atomic: Atomic) -> Formula:
        poly = _renamed(atomic.poly, target, where)
        if isinstance(atomic, RootAtom):
            return root_atom(names.get(atomic.variable, atomic.variable), atomic.relation, poly, atomic.k)
        return atom(poly, atomic.relation)

    return map_atoms(formula, change)


def prenex(formula: Formula) -> tuple[tuple[PrefixBlock, ...], Formula]:
    """(prefix, matrix): equivalent to ``formula``, matrix quantifier-free and in negation normal form.

    Bound variables are renamed apart first, so every quantifier may move outwards past ``and`` and ``or`` (its
    variable is not free next to it, and R is not empty). Among all ways to order the moves the number of blocks is
    least: with the kind of the outermost block fixed, putting every quantifier into the first block that is open
    to it is optimal by induction on depth; both kinds are tried. Blocks alternate.
    """
    renamed = rename_apart(nnf(formula))
    if isinstance(renamed, Constant):
        return (), renamed
    prefix = min((_blocks(renamed, first) for first in Quantifier), key=len)
    return prefix, matrix_of(renamed)


def _blocks(formula: Formula, first: Quantifier) -> tuple[PrefixBlock, ...]:
    names: list[list[str]] = []

    def place(part: Formula, level: int) -> None:
        if isinstance(part, Exists | ForAll):
            kind = Quantifier.EXISTS if isinstance(part, Exists) else Quantifier.FORALL
            level += kind is not (first if level % 2 == 0 else first.dual)
            while len(names) <= level:
                names.append([])
            names[level].extend(part.variables)
        for child in children(part):
            place(child, level)

    place(formula, 0)
    kinds = [first if i % 2 == 0 else first.dual for i in range(len(names))]
    return tuple((kind, tuple(block)) for kind, block in zip(kinds, names) if block)


def close(prefix: Iterable[PrefixBlock], matrix: Formula) -> Formula:
    """The prenex formula with this prefix and matrix; the inverse of taking it apart."""
    for kind, names in reversed(list(prefix)):
        matrix = (exists if kind is Quantifier.EXISTS else forall)(names, matrix)
    return matrix
