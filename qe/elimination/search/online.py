"""The theory of linear bounds at work inside a SAT solver: contradictions at once, and what follows from bounds.

Nieuwenhuis, Oliveras, Tinelli 2006 (DPLL(T) with theory propagation); Fazekas, Niemetz, Preiner, Kirchweger, Szeider,
Biere 2023 (the interface, IPASIR-UP). What is found this way are clauses that hold at all real points, and perhaps a
point: nothing rests on the solver having been told of the right things at the right time.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from types import TracebackType

from qe.elimination.search.linear_theories import Differences, Forms

Literals = list[int]


LinearTheory = Differences | Forms


class Propagator:
    """What the SAT solver calls. The theories hear of literals that are ``needed`` only. ``last``: gives clauses
    against a whole assignment, none where it is a solution; ``prefer`` is called before decisions.

    ``lemmas``: the clauses that the solver was told. ``failure``: an error while it called, which ends its work.
    ``keeps_errors``: whether this is inside such a call, where errors become the failure.
    """

    is_lazy = False

    def __init__(
        self,
        theories: Sequence[LinearTheory],
        needed: Container[int],
        check: Callable[[], None],
        last: Callable[[Sequence[int]], list[Literals]],
        prefer: Callable[[], None] = lambda: None,
    ) -> None:
        self.theories, self.needed = theories, needed
        self.check, self.last, self.prefer = check, last, prefer
        self.lemmas: list[Literals] = []
        self.failure: BaseException | None = None
        self.keeps_errors = False
        self._told: list[int] = []
        self._true: set[int] = set()
        self._fixed: list[int] = []
        self._next = 0
        self._levels: list[int] = []
        self._marks: list[list[int]] = []
        self._clauses: list[Literals] = []
        self._implied: list[int] = []
        self._reasons: dict[int, Callable[[], Literals]] = {}
        self._refuted = False

    def __enter__(self) -> None:
        self.keeps_errors = True

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool:
        """Keep an error: it must not go through the code of the solver."""
        self.keeps_errors = False
        self.failure = error or self.failure
        return True

    # --- what the solver tells --------------------------------------------------------------------------
    def on_assignment(self, literal: int, fixed: bool = False) -> None:
        """A literal has become true."""
        if fixed:
            self._fixed.append(literal)
        if literal not in self._true:
            self._true.add(literal)
            self._told.append(literal)

    def on_new_level(self) -> None:
        """A decision follows."""
        self._levels.append(len(self._told))

    def on_backtrack(self, level: int) -> None:
        """What was assigned after this level is undone, but not what is fixed."""
        if level >= len(self._levels):
            return
        count = self._levels[level]
        self._true.difference_update(self._told[count:])
        del self._told[count:], self._levels[level:]
        if self._next > count:
            for theory, mark in zip(self.theories, self._marks[count], strict=True):
                theory.back(mark)
            self._next = count
            del self._marks[count:]
        self._refuted = False
        for literal in self._fixed:
            if literal not in self._true:
                self._true.add(literal)
                self._told.append(literal)

    # --- what the solver asks ---------------------------------------------------------------------------
    def decide(self) -> int:
        """No wish which literal is next; ``prefer`` may say which way."""
        if self.failure is None:
            with self:
                self.prefer()
        return 0

    def propagate(self) -> Literals:
        """Literals that follow from those told."""
        if self.failure is None:
            with self:
                return self._propagated()
        return []

    def provide_reason(self, literal: int) -> Literals:
        """The clause by which a literal followed."""
        return self._lemma([literal, *(-r for r in self._reasons[literal]())])

    def check_model(self, model: Sequence[int]) -> bool:
        """Whether an assignment of all variables is a solution."""
        if self._clauses or self.failure is not None:
            return False
        with self:
            conflicts = self.last(model)
            self._clauses += map(self._lemma, conflicts)
            return not conflicts
        return False

    def has_clause(self) -> bool:
        """Whether there is a clause to be added; after a failure the empty one, which ends the search."""
        return bool(self._clauses) or self.failure is not None

    def add_clause(self) -> Literals:
        """The clause."""
        return [] if self.failure is not None else self._clauses.pop()

    # --- within -------------------------------------------------------------------------------------------
    def _lemma(self, clause: Literals) -> Literals:
        self.lemmas.append(clause)
        return clause

    def _propagated(self) -> Literals:
        if self._refuted or self._next == len(self._told):
            return []
        self.check()
        marks = [theory.mark() for theory in self.theories]
        while self._next < len(self._told):
            literal = self._told[self._next]
            self._marks.append(marks)
            self._next += 1
            if literal in self.needed:  # others change nothing
                if any(self._against(theory.tell(literal)) for theory in self.theories):
                    return []
                marks = [theory.mark() for theory in self.theories]
        if any(self._against(theory.settle()) for theory in self.theories):
            return []
        implied = dict[int, None]()
        for theory in self.theories:
            for literal, reasons in theory.implied():
                if literal not in self._true and literal not in implied:
                    self._reasons[literal] = reasons
                    implied[literal] = None
        if not self._levels:  # the solver asks for no reasons of what holds in any case
            for literal in implied:
                self.provide_reason(literal)
        return list(implied)

    def _against(self, conflict: Literals | None) -> bool:
        """Whether there is a contradiction; the solver is told of it."""
        if conflict is None:
            return False
        self._clauses.append(self._lemma([-r for r in conflict]))
        self._refuted = True
        return True
