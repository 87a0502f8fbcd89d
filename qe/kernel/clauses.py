"""Clauses about the signs of variables, and what follows from them and from lemmas by propagation.

A literal (v, s) says that the sign of variable v is in the set s (``signs``); a clause that one of its literals holds.

THEOREM. A clause of which all literals but one are excluded makes that one hold; a lemma cuts signs away. So if this
leaves a variable without a sign, the clauses and what was assumed cannot hold together. If these are the negations of
the literals of c, then c follows (Goldberg, Novikov 2003; "reverse unit propagation", Van Gelder 2008).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from qe.kernel.signs import ANY, Domains, Lemma

Literal = tuple[int, int]


class Clauses:
    """``domains``: the signs that are left to each variable. Every clause of several literals watches its first two
    (Moskewicz et al. 2001); ``tick`` is called between pieces of work."""

    def __init__(self, tick: Callable[[], None]) -> None:
        self.domains: Domains = []
        self.is_refuted = False
        self._watching: list[list[list[Literal]]] = []
        self._touching: list[list[Lemma]] = []
        self._changed: dict[int, None] = {}
        self._due: dict[Lemma, None] = {}
        self._tick = tick

    def new(self, signs: int) -> int:
        """A further variable, the sign of which is in the set."""
        self.domains.append(signs)
        self._watching.append([])
        self._touching.append([])
        return len(self.domains) - 1

    def learn(self, lemma: Lemma) -> None:
        """A lemma about the variables with the numbers of its polynomials."""
        self._due[lemma] = None
        for i in lemma.polynomials:
            self._touching[i].append(lemma)

    def add(self, literals: Iterable[Literal]) -> None:
        """A further clause, which is known to hold."""
        joined: dict[int, int] = {}
        for i, signs in literals:
            joined[i] = joined.get(i, 0) | signs
        clause = [(i, signs) for i, signs in joined.items() if self.domains[i] & signs]
        self.is_refuted |= not clause
        for i, signs in clause if len(clause) == 1 else ():
            self.domains[i] &= signs
            self._changed[i] = None
        for i, _ in clause[:2] if len(clause) > 1 else ():
            self._watching[i].append(clause)

    def implies(self, clause: Iterable[Literal]) -> bool:
        """Whether a clause follows by propagation."""
        return self.settled((i, ANY & ~signs) for i, signs in clause) is None

    def settled(self, assumed: Iterable[Literal] = ()) -> Domains | None:
        """The signs that propagation leaves where the literals hold; None for a contradiction."""
        if self._changed or self._due:
            changed, due, self._changed, self._due = self._changed, self._due, {}, {}
            self.is_refuted |= not self._propagated(self.domains, changed, due)
        if self.is_refuted:
            return None
        domains, changed = self.domains.copy(), {}
        for i, signs in assumed:
            domains[i] &= signs
            changed[i] = None
        return domains if self._propagated(domains, changed, {}) else None

    def _propagated(self, domains: Domains, changed: dict[int, None], due: dict[Lemma, None]) -> bool:
        """Whether all variables keep a sign; the clauses first, then the lemmas that are due."""
        while changed or due:
            self._tick()
            if changed:
                i = changed.popitem()[0]
                if not domains[i]:
                    return False
                due |= dict.fromkeys(self._touching[i])
                changed |= dict.fromkeys(self._forced(i, domains))
            else:
                changed |= dict.fromkeys(due.popitem()[0].cut(domains))
        return True

    def _forced(self, i: int, domains: Domains) -> Sequence[int]:
        """The variables about which clauses that watch variable i have only one literal left, which is made to hold."""
        watching, self._watching[i] = self._watching[i], []
        forced = []
        for clause in watching:
            k = 0 if clause[0][0] == i else 1
            if not domains[i] & clause[k][1]:
                clause[0], clause[1] = clause[1 - k], clause[k]
                other = next((n for n in range(2, len(clause)) if domains[clause[n][0]] & clause[n][1]), None)
                if other is not None:
                    clause[1], clause[other] = clause[other], clause[1]
                    self._watching[clause[1][0]].append(clause)
                    continue
                j, signs = clause[0]
                if domains[j] & ~signs:
                    domains[j] &= signs
                    forced.append(j)
            self._watching[i].append(clause)
        return forced
