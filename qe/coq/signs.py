"""Trees of cases on signs, each of which ends in a contradiction: what ``closes`` of ``primitives.v`` checks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from qe.errors import Unable
from qe.exact.ring import Poly
from qe.formula.build import exists
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Or, Relation
from qe.kernel.negation import negation
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, PRODUCT, SQUARE, ZERO, sign_bit
from qe.truth import Truth, conjunction, disjunction

MOST_NODES = 2_000
Identity = tuple[tuple[int, tuple[tuple[int, int], ...]], ...]
"""Coefficients, each with numbers of polynomials and their exponents: the sum is 0."""

_MEETS = {r: sum({-1: NEGATIVE, 0: ZERO, 1: POSITIVE}[s] for s in r.signs) for r in Relation}


@dataclass(frozen=True, slots=True)
class _Unit:
    """A polynomial has one of these signs, or a quantified formula this truth; anything else closes by ``leaf``."""

    key: Poly | Formula
    signs: int
    leaf: str


class Tree:
    """The search for one tree; ``polys`` may get further members, which the tree names by their number."""

    def __init__(self, formulas: Iterable[Formula], polys: list[Poly], identities: Sequence[Identity]) -> None:
        self.formulas, self.polys, self.identities = list(formulas), polys, identities
        self.number = {p: k for k, p in enumerate(polys)}
        self.nodes = 0
        self.quantified: dict[str, Formula] = {}

    def text(self) -> str:
        """The tree. ``Unable`` where there is none, or it would be too large."""
        return self._closed({})

    def _closed(self, known: dict[Poly | Formula, int]) -> str:
        """Units are split off one after the other; then there are cases."""
        self.nodes += 1
        if self.nodes > MOST_NODES:
            raise Unable("too many cases of signs for Coq")
        known, opened = dict(known), list[_Unit]()
        while isinstance(found := self._next(known), _Unit):
            opened.append(found)
            known[found.key] = known.get(found.key, ANY) & found.signs
        for unit in reversed(opened):
            found = self._split(unit.key, unit.signs, found, unit.leaf)
        return found

    def _cases(self, key: Poly | Formula, known: dict[Poly | Formula, int]) -> str:
        """One of the signs that are possible, and the others."""
        now = _now(known, key)
        sign = next(s for s in (ZERO, NEGATIVE, POSITIVE) if now & s and now != s)
        first = self._closed({**known, key: sign})
        return self._split(key, sign, first, self._closed({**known, key: now & ~sign}))

    def _split(self, key: Poly | Formula, signs: int, inside: str, outside: str) -> str:
        if isinstance(key, Poly):
            if key not in self.number:
                self.number[key] = len(self.polys)
                self.polys.append(key)
            return f"(Sp {self.number[key]} {signs} {inside} {outside})"
        mark = next((m for m, f in self.quantified.items() if f == key), f"@{len(self.quantified)}@")
        self.quantified[mark] = key
        return f"(Sf {mark} {inside} {outside})" if signs == POSITIVE else f"(Sf {mark} {outside} {inside})"

    def _next(self, known: dict[Poly | Formula, int]) -> _Unit | str:
        """A contradiction, a sign that follows, or the tree of cases."""
        pending, cases = list(self.formulas), list[list[Formula]]()
        while pending:
            f = pending.pop()
            if isinstance(f, And):
                pending += f.args
            elif isinstance(f, Or):
                parts = [a for a in f.args if self._truth(a, known) is not False]
                if len(parts) <= 1:
                    pending += parts or [Constant(False)]
                elif not any(self._truth(a, known) for a in parts):
                    cases.append(parts)
            elif isinstance(f, Constant):
                if not f.value:
                    return "Clash"
            else:
                key, signs = _literal(f)
                if not _now(known, key) & signs:
                    return "Clash"
                if _now(known, key) & ~signs:
                    return _Unit(key, signs, "Clash")
        for k, identity in enumerate(self.identities):
            unit = self._cut(k, identity, known)
            if unit is not None:
                return unit
        for parts in sorted(cases, key=len):
            for f in _literals(parts):
                key, _ = _literal(f)
                if _now(known, key) not in (NEGATIVE, ZERO, POSITIVE):
                    return self._cases(key, known)
        for identity in self.identities:
            for i in dict.fromkeys(i for _, powers in identity for i, _ in powers):
                if known.get(self.polys[i], ANY) not in (NEGATIVE, ZERO, POSITIVE):
                    return self._cases(self.polys[i], known)
        raise Unable("the signs that the lemmas allow do not exclude that it is wrong")

    def _cut(self, k: int, identity: Identity, known: dict[Poly | Formula, int]) -> _Unit | str | None:
        """What an identity says of a sign."""
        signs = [_times(c, [(known.get(self.polys[i], ANY), e) for i, e in powers]) for c, powers in identity]
        before, after = [ZERO], [ZERO]
        for s in signs:
            before.append(_sum(before[-1], s))
        for s in reversed(signs):
            after.append(_sum(after[-1], s))
        if not before[-1] & ZERO:
            return f"(By {k})"
        for j, (c, powers) in enumerate(identity):
            rest = _sum(before[j], after[len(signs) - 1 - j])
            for i, _ in powers:
                now = known.get(self.polys[i], ANY)
                if now in (NEGATIVE, ZERO, POSITIVE):
                    continue
                kept = 0
                for s in _SIGNS:
                    factors = [(s if n == i else known.get(self.polys[n], ANY), e) for n, e in powers]
                    if now & s and _sum(rest, _times(c, factors)) & ZERO:
                        kept |= s
                if kept != now:
                    return _Unit(self.polys[i], kept, f"(By {k})")
        return None

    def _truth(self, f: Formula, known: dict[Poly | Formula, int]) -> Truth:
        """What the signs that are possible say of a formula."""
        match f:
            case Constant(value):
                return value
            case And(args):
                return conjunction(self._truth(a, known) for a in args)
            case Or(args):
                return disjunction(self._truth(a, known) for a in args)
        key, signs = _literal(f)
        now = _now(known, key)
        return None if now & signs and now & ~signs else bool(now & signs)


def _now(known: Mapping[Poly | Formula, int], key: Poly | Formula) -> int:
    """The signs that are possible."""
    return known.get(key, ANY if isinstance(key, Poly) else NEGATIVE | POSITIVE)


_SIGNS = (NEGATIVE, ZERO, POSITIVE)


def _literal(f: Formula) -> tuple[Poly | Formula, int]:
    """A polynomial and signs, or an existential formula and whether it holds (as positive or negative)."""
    match f:
        case Atom(poly, relation):
            return poly, _MEETS[relation]
        case Exists():
            return exists(f.variables, f.body), POSITIVE
        case ForAll():
            return negation(f), NEGATIVE
    raise Unable("only comparisons and quantifiers can be written for Coq")


def _literals(parts: Iterable[Formula]) -> Iterator[Formula]:
    for f in parts:
        if isinstance(f, And | Or):
            yield from _literals(f.args)
        elif not isinstance(f, Constant):
            yield f


def _sum(a: int, b: int) -> int:
    found = (a | b) & (NEGATIVE | POSITIVE)
    if (a & b & ZERO) or (a & NEGATIVE and b & POSITIVE) or (a & POSITIVE and b & NEGATIVE):
        found |= ZERO
    return found


def _times(c: int, factors: Iterable[tuple[int, int]]) -> int:
    return reduce(lambda a, f: PRODUCT[a][f[0] if f[1] % 2 else SQUARE[f[0]]], factors, sign_bit(c))
