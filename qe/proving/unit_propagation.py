"""Clauses, and what follows from them by unit propagation.

THEOREM (Goldberg, Novikov 2003; "reverse unit propagation", Van Gelder 2008). If the clauses together with the
negations of the literals of c lead to a contradiction by unit propagation alone, then they imply c.

Literals are the integers v and -v for the variables v = 1, 2, ...
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence


class Clauses:
    """Clauses in the order in which they are added, each with two watched literals if it has as many (Moskewicz et
    al. 2001). ``tick`` is called between pieces of work."""

    def __init__(self, tick: Callable[[], None]) -> None:
        self.clauses: list[list[int]] = []
        self._units: list[int] = []
        self._watching: defaultdict[int, list[int]] = defaultdict(list)
        self._tick = tick

    def add(self, literals: Iterable[int]) -> None:
        """A further clause, which is known to hold."""
        clause, number = list(dict.fromkeys(literals)), len(self.clauses)
        self.clauses.append(clause)
        if len(clause) < 2:
            self._units.append(number)
        for literal in clause[:2] if len(clause) > 1 else ():
            self._watching[literal].append(number)

    def implying(self, clause: Sequence[int]) -> set[int] | None:
        """The numbers of clauses from which a clause follows by unit propagation; None where it does not follow so."""
        reasons: dict[int, int | None] = {}
        trail: list[int] = []
        for literal in clause:
            if literal in reasons:  # the clause holds in any case
                return set()
            if -literal not in reasons:
                reasons[-literal] = None
                trail.append(-literal)
        for number in self._units:
            conflict = self._assigned(self.clauses[number], number, reasons, trail)
            if conflict is not None:
                return self._used(conflict, reasons)
        at = 0
        while at < len(trail):
            self._tick()
            conflict = self._propagated(-trail[at], reasons, trail)
            if conflict is not None:
                return self._used(conflict, reasons)
            at += 1
        return None

    def _assigned(
        self, unit: Sequence[int], number: int, reasons: dict[int, int | None], trail: list[int]
    ) -> int | None:
        """The clause, if it is empty or its one literal is false; its literal is taken to be true otherwise."""
        if not unit or -unit[0] in reasons:
            return number
        if unit[0] not in reasons:
            reasons[unit[0]] = number
            trail.append(unit[0])
        return None

    def _propagated(self, false: int, reasons: dict[int, int | None], trail: list[int]) -> int | None:
        """All that follows from a literal being false; the number of a clause whose literals are all false."""
        watching: list[int] = self._watching[false]
        kept: list[int] = []
        for place, number in enumerate(watching):
            clause = self.clauses[number]
            if clause[0] == false:
                clause[0], clause[1] = clause[1], false
            first = clause[0]
            if first not in reasons:
                other = next((k for k in range(2, len(clause)) if -clause[k] not in reasons), None)
                if other is not None:
                    clause[1], clause[other] = clause[other], false
                    self._watching[clause[1]].append(number)
                    continue
                if -first in reasons:
                    self._watching[false] = [*kept, *watching[place:]]
                    return number
                reasons[first] = number
                trail.append(first)
            kept.append(number)
        self._watching[false] = kept
        return None

    def _used(self, conflict: int, reasons: dict[int, int | None]) -> set[int]:
        used: set[int] = set()
        pending = [conflict]
        while pending:
            number = pending.pop()
            if number in used:
                continue
            used.add(number)
            for literal in self.clauses[number]:
                reason = reasons.get(-literal)
                if reason is not None:
                    pending.append(reason)
        return used
