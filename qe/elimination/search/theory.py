"""Whether atoms can hold together: linear bounds of monomials first, then the engine on parts that share variables.

Every answer comes with a reason: a point, or atoms of which it is proved that they cannot hold together. Where the
bounds of monomials can hold together, the point is tried at which the variables have their values.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from qe.convex.exact_basis import Refutation
from qe.convex.linear_point import solved
from qe.convex.linear_rows import LinearRows
from qe.elimination.search.monomial_bounds import MonomialBounds
from qe.errors import Unable
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.build import conj, exists
from qe.formula.syntax import FALSE, Atom, Formula
from qe.formula.traverse import connected
from qe.options import Budget
from qe.rules.lift import holds_at
from qe.simplifier.simplify import simplify

Decide = Callable[[Formula, Budget], Values | None]
"""Values of the variables of an existential sentence, or None where it is false; raises ``Unable``."""

_TRIALS = 5
"""Smaller sets of atoms that the engine is asked about to shorten a reason."""
_TRIAL_WORK = 300

_MOST = 400
"""Atoms that share variables, at most, for the engine to be asked about them again and again."""

_AT_ONCE = 20
"""Reasons against one choice, at most: the more there are, the fewer choices are made."""

_GATHERED = 24
"""Atoms that are gathered one by one for a reason, at most."""


class Theory:
    """Asked about one conjunction after another over one ring; what was refuted or found is remembered. ``at_once``:
    all atoms are linear, without inequations, and so many that floats find what exact numbers then confirm."""

    at_once = False

    def __init__(self, ring: Ring, decide: Decide, budget: Budget) -> None:
        self.ring, self.decide, self.budget = ring, decide, budget
        self.bounds = MonomialBounds(ring)
        self.known: dict[frozenset[Atom], Values | None] = {}

    def look(self, atoms: Sequence[Atom]) -> Values | list[list[Atom]]:
        """Values for the variables of the atoms, or sets of them each of which cannot hold together."""
        if self.at_once:
            return self._rows(atoms)
        conflicts = self._linear(atoms)
        if conflicts:
            return conflicts
        point: Values = dict(self.bounds.point())
        if all(holds_at(a, point) for a in atoms):
            return dict(point)
        values: Values = dict(point)
        for _, group in connected(atoms, lambda a: frozenset(a.free))[1]:
            part = [a for a in group if isinstance(a, Atom)]
            found = self._gathered(part, point)
            if isinstance(found, list):
                return [self._reason(found)]
            values |= found
        return values

    def _rows(self, atoms: Sequence[Atom]) -> Values | list[list[Atom]]:
        system = LinearRows.of(atoms)
        outcome = solved(system, self.budget)
        if isinstance(outcome, Refutation):
            return [[atoms[i] for i in outcome.weights]]
        return dict(zip(system.names, outcome))

    def _linear(self, atoms: Sequence[Atom]) -> list[list[Atom]]:
        """Sets of atoms whose linear bounds contradict each other, until none is left: from conflicts without a common
        atom, each atom as weak as may be."""
        rest = list(atoms)
        conflicts: list[list[Atom]] = []
        while len(conflicts) < _AT_ONCE:
            conflict = self.bounds.conflict(rest, lambda: self.budget.check("search: bounds"))
            if conflict is None:
                break
            conflicts.append(self.bounds.weakened())
            rest = [a for a in rest if a not in conflict]
        return conflicts

    def _gathered(self, part: list[Atom], point: Values) -> Values | list[Atom]:
        """Values for the atoms, or some that cannot hold together, gathered one by one: always one that fails at a
        point where all those before hold, with as few new variables as can be; all where that takes too long."""
        taken: list[Atom] = []
        names: set[str] = set()
        values = point
        for _ in range(min(_GATHERED, len(part))):
            failing = [a for a in part if not holds_at(a, values)]
            if not failing:
                return {name: values[name] for a in part for name in a.free}
            best = min(failing, key=lambda a: (len(set(a.free) - names), len(a.free), a.poly.total_degree))
            taken.append(best)
            names.update(best.free)
            try:
                found = self._part(frozenset(taken), _TRIAL_WORK)
            except Unable:
                self.budget.check("search: reason")
                break
            if found is None:
                return taken
            values = {**point, **found}
        everything = self._part(frozenset(part))
        return part if everything is None else everything

    def _part(self, part: frozenset[Atom], work: int | None = None) -> Values | None:
        """Values that make the atoms true, or None; raises ``Unable``."""
        if part not in self.known:
            if len(part) > _MOST:
                raise Unable(f"{len(part)} conditions share variables")
            self.budget.check("search: theory")
            self.budget.spend(len(part) ** 2)
            body = conj(sorted(part, key=str))
            self.known[part] = self.decide(exists(body.free, body), self.budget.part(work))
        return self.known[part]

    def _reason(self, part: list[Atom]) -> list[Atom]:
        """Fewer of the atoms that cannot hold together."""

        def contradict(atoms: Sequence[Atom]) -> bool:
            return simplify(conj(atoms), watch=self.budget.check) == FALSE

        if contradict(part):
            return _without_needless(part, contradict)
        trials = 0

        def refuted(atoms: Sequence[Atom]) -> bool:
            nonlocal trials
            trials += 1
            if trials > _TRIALS:
                return False
            try:
                return self._part(frozenset(atoms), _TRIAL_WORK) is None
            except Unable:
                self.budget.check("search: reason")
                return False

        return _without_needless(part, refuted)


def _without_needless(atoms: list[Atom], refuted: Callable[[Sequence[Atom]], bool]) -> list[Atom]:
    """Atoms left out, many at a time as long as that works, while the rest stays refuted."""
    size = len(atoms) // 2
    while size:
        at = 0
        while at < len(atoms):
            rest = atoms[:at] + atoms[at + size :]
            if rest and refuted(rest):
                atoms = rest
            else:
                at += size
        size //= 2
    return atoms
