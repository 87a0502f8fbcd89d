"""Whether the test points meet every place where a formula can turn true (see ``elimination_set``)."""

from __future__ import annotations

from collections.abc import Iterator

from qe.certify.elimination_points import Tried, implies, is_free_of
from qe.certify.step import Limits
from qe.certify.turning_points import Turn, inside, turns, vanishing
from qe.certify.virtual_substitution import TestPoint
from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import disjuncts

Around = tuple[Formula, ...]
NONE: frozenset[Poly] = frozenset()


def mixed(finite: Formula) -> bool:
    """Whether a conjunct with finitely many solutions has more than equations joined by "or" in it."""
    return any(isinstance(a, And) for a in disjuncts(finite))


class Cover:
    """The points that are tried for variable x. ``around``: what holds beside a formula; ``under``: conditions given."""

    def __init__(self, x: int, tried: tuple[Tried, ...], limits: Limits) -> None:
        self.x, self.tried, self.limits = x, tried, limits
        self.missing = ""
        self._by_point: dict[TestPoint, list[int]] = {}
        for k, t in enumerate(tried):
            if t.point is not None:
                self._by_point.setdefault(t.point, []).append(k)

    def far(self, body: Formula, side: int, under: Around) -> bool:
        """Whether the end is tried at which a component of the solutions may have no first place."""
        return self.meets(Turn(TestPoint((), 0, -side), under), body, len(self.tried))

    def meets(self, turn: Turn, formula: Formula, before: int) -> bool:
        """Whether one of the first points is tried there, with a guard and a formula that hold if these do."""
        known = conj((*turn.conditions, formula))
        for k in self._by_point.get(turn.point, ()):
            if k < before and implies(known, conj((self.tried[k].guard, self.tried[k].formula))):
                return True
        self.missing = f"a place where {formula} can turn true"
        return False

    def ends(
        self, formula: Formula, around: Around, side: int, under: Around = (), omit: frozenset[Poly] = NONE
    ) -> bool:
        """Whether all places are met where the formula can turn true on the way from one side.

        Not asked for: the roots of the quadratics ``omit``.
        """
        self.limits.tick()
        if is_free_of(formula, self.x):
            return True
        match formula:
            case Atom():
                return all(
                    self.meets(Turn(t.point, (*t.conditions, *under)), conj((*around, formula)), len(self.tried))
                    for t in self._turns(formula, side, omit)
                )
            case Or(args):
                return all(self.ends(a, around, side, under, omit) for a in args)
            case And(args):
                return self._ends_of_finite(args, around, side, under, omit) or all(
                    self.ends(a, (*around, *args[:k], *args[k + 1 :]), side, under, omit) for k, a in enumerate(args)
                )
        raise CertificateRejected("", f"an and/or combination of atoms expected, {formula} found")

    def _turns(self, given: Atom, side: int, omit: frozenset[Poly]) -> list[Turn]:
        found = turns(given, self.x, side)
        if found is None:
            raise CertificateRejected("", f"the degree of the variable is too high in {given}")
        if omit.isdisjoint(f for f, _ in inside(given.poly, self.x)):
            return found
        return [t for t in found if len(t.point.coefficients) == 2]

    def _ends_of_finite(
        self, args: tuple[Formula, ...], around: Around, side: int, under: Around, omit: frozenset[Poly]
    ) -> bool:
        """The Gauss case: one conjunct has finitely many solutions, unless it degenerates."""
        for k, arg in enumerate(args):
            for degenerate in self.finite(arg, (*around, *args[:k], *args[k + 1 :])):
                if degenerate == FALSE or all(
                    self.ends(other, (*around, *args[:j], *args[j + 1 :]), side, (*under, degenerate), omit)
                    for j, other in enumerate(args)
                    if j != k or mixed(arg)
                ):
                    return True
        return False

    def finite(self, formula: Formula, around: Around) -> Iterator[Formula]:
        """The conditions outside which the formula has finitely many solutions, all of which are met."""
        match formula:
            case Atom(poly, Relation.EQ) if poly.degree(self.x):
                if all(self.meets(t, conj((*around, formula)), len(self.tried)) for t in self._turns(formula, 1, NONE)):
                    yield vanishing(poly, self.x)
            case Or(args):
                found = [next(self.finite(a, around), None) for a in args]
                parts = [f for f in found if f is not None]
                if len(parts) == len(args):
                    yield disj(parts)
            case And(args):
                for k, arg in enumerate(args):
                    yield from self.finite(arg, (*around, *args[:k], *args[k + 1 :]))

    def check_settled(self, k: int) -> None:
        """That the atoms taken at the root itself for point k can vanish there only where another point was tried."""
        point, formula = self.tried[k].point, self.tried[k].formula
        assert point is not None
        for atom in self.tried[k].settled:
            assert isinstance(atom, Atom)
            for turn in self._turns(atom, point.shift, NONE):
                if not self.meets(Turn(turn.point, (*turn.conditions, self.tried[k].guard)), formula, k):
                    raise CertificateRejected("", f"{atom} may vanish at a point where it is taken for settled")
