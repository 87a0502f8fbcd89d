"""Whether the test points meet every place where a formula can turn true (see ``elimination_set``)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import disjuncts
from qe.kernel.elimination_points import Tried, implies, is_free_of
from qe.kernel.step import Limits
from qe.kernel.turning_points import Turn, inside, turns, vanishing
from qe.kernel.virtual_substitution import TestPoint

Around = tuple[Formula, ...]
NONE: frozenset[Poly] = frozenset()


def mixed(finite: Formula) -> bool:
    """Whether a conjunct with finitely many solutions has more than equations joined by "or" in it."""
    return any(isinstance(a, And) for a in disjuncts(finite))


Met = tuple[int, Formula]
"""A test point that is used, by its number, and the conditions under which it is."""


class Cover:
    """The points that are tried for variable x in ``original``.

    ``around``: what holds beside a formula; ``under``: conditions that are given. Found is what is used, or None.
    """

    def __init__(self, x: int, original: Formula, tried: Sequence[Tried], limits: Limits) -> None:
        self.x, self.original, self.tried, self.limits = x, original, tuple(tried), limits
        self.missing = ""
        self._by_point: dict[TestPoint | None, list[int]] = {}
        for k, t in enumerate(tried):
            self._by_point.setdefault(t.point, []).append(k)

    def far(self, body: Formula, side: int, under: Around) -> list[Met] | None:
        """The end at which a component of the solutions may have no first place."""
        return self.meets(Turn(TestPoint((), 0, -side), under), body)

    def meets(self, turn: Turn, formula: Formula, before: int | None = None) -> list[Met] | None:
        """One of the points (of the first ones) there, with a guard and a formula that hold if these do."""
        known = conj((*turn.conditions, formula))
        for k in self.there(turn.point):
            if (before is None or k < before) and implies(known, conj((self.tried[k].guard, self.tried[k].formula))):
                return [(k, conj(turn.conditions))]
        self.missing = f"a place where {formula} can turn true"
        return self.kept(turn.conditions)

    def there(self, point: TestPoint | None) -> list[int]:
        """The numbers of the points at a place (None: where all x stay quantified)."""
        return self._by_point.get(point, [])

    def kept(self, under: Around) -> list[Met] | None:
        """Where these conditions hold, the problem itself is kept as one of the points."""
        known = conj((*under, self.original))
        for k in self.there(None):
            if implies(known, conj((self.tried[k].guard, self.tried[k].formula))):
                return [(k, conj(under))]
        return None

    def ends(
        self, formula: Formula, around: Around, side: int, under: Around = (), omit: frozenset[Poly] = NONE
    ) -> list[Met] | None:
        """What meets all places where the formula can turn true on the way from one side.

        Not asked for: the roots of the quadratics ``omit``.
        """
        self.limits.tick()
        if is_free_of(formula, self.x):
            return []
        match formula:
            case Atom():
                return _all(
                    self.meets(Turn(t.point, (*t.conditions, *under)), conj((*around, formula)))
                    for t in self._turns(formula, side, omit)
                )
            case Or(args):
                return _all(self.ends(a, around, side, under, omit) for a in args)
            case And(args):
                finite = self._ends_of_finite(args, around, side, under, omit)
                return (
                    finite
                    if finite is not None
                    else _all(self.ends(a, (*around, *rest), side, under, omit) for a, rest in _each(args))
                )
        raise CertificateRejected("", f"an and/or combination of atoms expected, {formula} found")

    def _turns(self, given: Atom, side: int, omit: frozenset[Poly] = NONE) -> list[Turn]:
        found = turns(given, self.x, side)
        if found is None:
            raise CertificateRejected("", f"the degree of the variable is too high in {given}")
        if omit.isdisjoint(f for f, _ in inside(given.poly, self.x)):
            return found
        return [t for t in found if len(t.point.coefficients) == 2]

    def _ends_of_finite(
        self, args: Around, around: Around, side: int, under: Around, omit: frozenset[Poly]
    ) -> list[Met] | None:
        """The Gauss case: one conjunct has finitely many solutions, unless it degenerates."""
        for arg, rest in _each(args):
            for used, degenerate in self.finite(arg, (*around, *rest)):
                if degenerate == FALSE:
                    return used
                left = self.kept((*under, degenerate))
                if left is None:
                    left = _all(
                        self.ends(other, (*around, *beside), side, (*under, degenerate), omit)
                        for other, beside in _each(args)
                        if other != arg or mixed(arg)
                    )
                if left is not None:
                    return [*used, *left]
        return None

    def finite(self, formula: Formula, around: Around) -> Iterator[tuple[list[Met], Formula]]:
        """What meets all solutions, and the condition outside which there are finitely many."""
        match formula:
            case Atom(poly, Relation.EQ) if poly.degree(self.x) and turns(formula, self.x, 1) is not None:
                used = _all(self.meets(t, conj((*around, formula))) for t in self._turns(formula, 1))
                if used is not None:
                    yield used, vanishing(poly, self.x)
            case Or(args):
                found = [next(self.finite(a, around), None) for a in args]
                if None not in found:
                    yield [m for f in found if f for m in f[0]], disj(f[1] for f in found if f)
            case And(args):
                for arg, rest in _each(args):
                    yield from self.finite(arg, (*around, *rest))

    def check_settled(self, k: int) -> None:
        """That the atoms taken at the root itself for point k can vanish there only where another point was tried."""
        point, formula = self.tried[k].point, self.tried[k].formula
        assert point is not None
        for atom in self.tried[k].settled:
            assert isinstance(atom, Atom)
            for turn in self._turns(atom, point.shift):
                if self.meets(Turn(turn.point, (*turn.conditions, self.tried[k].guard)), formula, k) is None:
                    raise CertificateRejected("", f"{atom} may vanish at a point where it is taken for settled")


def _each(args: Around) -> Iterator[tuple[Formula, Around]]:
    """Every argument with the others."""
    return ((arg, args[:k] + args[k + 1 :]) for k, arg in enumerate(args))


def _all(parts: Iterable[list[Met] | None]) -> list[Met] | None:
    found: list[Met] = []
    for part in parts:
        if part is None:
            return None
        found += part
    return found
