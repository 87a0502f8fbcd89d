"""Rotations: a block that only looks at lengths and angles loses a variable for every free angle.

Let S be a skew-symmetric matrix over variables that are bound, each pair of variables that it joins by the same
quantifier, and X = sum of S_ij * (x_i * d/dx_j - x_j * d/dx_i), with X p = 0 for every atom's polynomial p; equations
of a conjunction may be taken together as the vanishing of the sum of their squares, and inequations of a disjunction as
its not vanishing.
THEOREM. The truth of the formula f inside the outermost block is the same at x and at exp(t*S) x, for all real t, where
the inner variables have been left out of x.
PROOF. p is constant along the curves exp(t*S) x, as its derivative there is X p = 0. S joins no variables of different
quantifiers, so exp(t*S) maps the values of every inner block onto themselves, whatever the values outside.
COROLLARY. Let S join two variables u, v of the outermost block to each other and to no others. Then exp(t*S) turns
their plane, some t makes v = 0 and u >= 0, and:  ex u, v, y f  iff  ex u, y (u >= 0 and f[v = 0]).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import TypeVar

from qe.exact.quadratic_form import echelon, solve_linear
from qe.exact.ring import Poly
from qe.exact.watch import IDLE
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import children, has_root_atoms, polynomials, subformulas

Key = TypeVar("Key")
Index = TypeVar("Index")
Terms = dict[Key, Fraction]
Pair = tuple[int, int]
Skew = Terms[Pair]
"""A skew-symmetric matrix by its entries above the diagonal."""
Image = Terms[tuple[int, ...]]
"""The terms of a polynomial: exponents with the coefficient."""

_TERMS = 1200  # terms in all polynomials together up to which rotations are looked for
_PAIRS = 400  # pairs of variables up to which they are looked for
_COMPONENT = 8  # terms of a polynomial that may be one component of a vector


@dataclass(frozen=True, slots=True)
class Turn:
    """``zero`` v may be set to 0 where ``half`` u >= 0, by the matrix ``skew``, with the entry 1 for them, which moves
    the variables ``moved`` of the block."""

    half: str
    zero: str
    moved: frozenset[str]
    skew: tuple[tuple[str, str, Fraction], ...]

    @property
    def proof(self) -> dict[str, object]:
        """What a checker needs."""
        return {"zero": self.zero, "half": self.half, "plane": self.skew}


def invariant_plane(
    variables: Sequence[str], body: Formula, wanted: Iterable[str], watch: Callable[[], object] = IDLE
) -> Turn | None:
    """A plane of the corollary in which a coordinate can be fixed.

    Planes with one of ``wanted`` go first, as u; then the ones that occur in most terms. None if there is no plane.
    """
    polys = polynomials(body)
    if not polys or has_root_atoms(body):
        return None
    if max(p.total_degree for p in polys) < 2 or sum(p.term_count() for p in polys) > _TERMS:
        return None
    for taken in dict.fromkeys((tuple(polys), tuple(dict.fromkeys(_sums(body))))):
        found = _plane(variables, body, taken, frozenset(wanted), watch)
        if found is not None:
            return found
    return None


def _sums(formula: Formula) -> Iterator[Poly]:
    """The polynomials of the atoms; those that look alike in equations side by side, as the components of a vector do,
    as one sum of squares, and so for inequations.
    """
    if isinstance(formula, And | Or):
        relation = Relation.EQ if isinstance(formula, And) else Relation.NE
        alike: dict[object, list[Poly]] = {}
        for arg in formula.args:
            if isinstance(arg, Atom) and arg.relation is relation and arg.poly.term_count() <= _COMPONENT:
                look = (arg.poly.total_degree, sorted(abs(c) for _, c in arg.poly.terms()))
                alike.setdefault(str(look), []).append(arg.poly)
            else:
                yield from _sums(arg)
        for group in alike.values():
            yield group[0] if len(group) == 1 else sum((p * p for p in group[1:]), group[0] * group[0])
    elif isinstance(formula, Atom):
        yield formula.poly
    else:
        for child in children(formula):
            yield from _sums(child)


def _plane(
    variables: Sequence[str],
    body: Formula,
    polys: Sequence[Poly],
    wanted: frozenset[str],
    watch: Callable[[], object],
) -> Turn | None:
    """``invariant_plane`` for given polynomials that the truth of the body depends on."""
    ring = polys[0].ring
    blocks = [tuple(variables), *(f.variables for f in subformulas(body) if isinstance(f, Exists | ForAll))]
    names = [name for block in blocks for name in block]
    if len(names) != len(set(names)) or set(names[len(variables) :]) & set(body.free):
        return None
    movable = _movable(polys, {ring.index[v] for v in names if v in ring.index})
    pairs = [
        pair
        for block in blocks
        for pair in combinations(sorted(ring.index[v] for v in block if ring.index.get(v) in movable), 2)
    ]
    if not pairs or len(pairs) > _PAIRS:
        return None
    outer = {ring.index[v] for v in variables if v in ring.index}
    favoured = {ring.index[v] for v in wanted}
    weight = {i: sum(p.degree(i) > 0 for p in polys) for i in outer}
    best: tuple[tuple[bool, int, int, int], Turn] | None = None
    for skew in rotations(polys, pairs, watch):
        moved = {i for pair in skew for i in pair}
        for i, j in skew:
            if i not in outer or sum(i in pair or j in pair for pair in skew) > 1:
                continue
            u, v = (j, i) if j in favoured or (i not in favoured and weight[i] > weight[j]) else (i, j)
            rank = (u in favoured, weight[u] + weight[v], -u, -v)
            if best is None or rank > best[0]:
                named = tuple((ring.names[a], ring.names[b], s / skew[i, j]) for (a, b), s in skew.items())
                best = rank, Turn(ring.names[u], ring.names[v], frozenset(ring.names[k] for k in moved & outer), named)
    return best and best[1]


def _movable(polys: Sequence[Poly], candidates: set[int]) -> set[int]:
    """Those of the candidates that occur and that a rotation may move, seen without its equations.

    X keeps the other variables and the degree in those that it moves. So it annihilates p only if it annihilates each
    part of p with the same other variables and the same degree; where such a part has one variable x_i of the
    candidates, X p = 0 says S_ij = 0 for all j: x_i stays where it is.
    """
    exponents = [[powers for powers, _ in p.sparse_terms()] for p in polys]
    movable = candidates & {i for p in polys for i in p.variables}
    while movable:
        lonely: set[int] = set()
        for listed in exponents:
            parts: dict[object, set[int]] = {}
            for powers in listed:
                inside = {i: k for i, k in powers if i in movable}
                if inside:
                    other = tuple(power for power in powers if power[0] not in inside)
                    parts.setdefault((other, sum(inside.values())), set()).update(inside)
            lonely.update(*(part for part in parts.values() if len(part) == 1))
        if not lonely:
            break
        movable -= lonely
    return movable


def rotations(polys: Sequence[Poly], pairs: Sequence[Pair], watch: Callable[[], object] = IDLE) -> list[Skew]:
    """A basis of the matrices on these pairs whose X annihilates all polynomials, in reduced echelon form: a rotation
    in few planes stands alone."""
    basis: list[Skew] = [{pair: Fraction(1)} for pair in pairs]
    for p in sorted(dict.fromkeys(polys), key=Poly.term_count):
        names = set(p.variables)
        moving = [skew for skew in basis if any(i in names or j in names for i, j in skew)]
        images: dict[Pair, Image] = {}
        for pair in dict.fromkeys(pair for skew in moving for pair in skew):
            watch()
            (i, j), ring = pair, p.ring
            turned = ring.gen(i) * p.derivative(j) - ring.gen(j) * p.derivative(i)
            images[pair] = {exponents: Fraction(c) for exponents, c in turned.terms()}
        basis = [skew for skew in basis if skew not in moving]
        basis += [_sum(dict(enumerate(moving)), r) for r in _relations([_sum(images, skew) for skew in moving])]
    columns = sorted(pairs)
    rows = echelon([[skew.get(pair, Fraction(0)) for pair in columns] for skew in basis])[0]
    return [{pair: c for pair, c in zip(columns, row, strict=True) if c} for row in rows]


def _relations(parts: Sequence[Image]) -> list[Terms[int]]:
    """A basis of the vectors r with sum of r_k * parts_k = 0."""
    keys = dict.fromkeys(key for part in parts for key in part)
    solved = solve_linear([[part.get(key, Fraction(0)) for part in parts] for key in keys], [0] * len(keys), len(parts))
    assert solved is not None
    return [{k: c for k, c in enumerate(vector) if c} for vector in solved.kernel]


def _sum(parts: Mapping[Index, Terms[Key]], factors: Terms[Index]) -> Terms[Key]:
    """The sum of multiples of the parts, without zeros."""
    total: Terms[Key] = {}
    for k, factor in factors.items():
        for key, c in parts[k].items():
            total[key] = total.get(key, Fraction(0)) + factor * c
    return {key: c for key, c in total.items() if c}
