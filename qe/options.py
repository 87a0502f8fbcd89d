"""Frozen options, and the budget (time, work) with cancellation that is passed into every step."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from typing import Protocol, TypeVar

from qe.errors import BudgetExceeded
from qe.progress import Event, Listener, silent

VERIFY_SECONDS = 60.0
"""The limit of a verification for which the caller gives none."""

NOTE_SECONDS = 0.1
"""Progress is reported at most once in so many seconds."""


class Method(Enum):
    """Elimination methods that a caller can ask for; ``AUTO`` lets the planner choose."""

    AUTO = "auto"
    VS = "vs"
    CAD = "cad"
    CRITICAL = "critical"
    CONVEX = "convex"
    WITNESS = "witness"
    CGS = "cgs"
    COVERINGS = "coverings"
    ROOTS = "roots"


class Projection(Enum):
    """Projection operators of the cylindrical algebraic decomposition (``qe.decomposition.operators``).

    Where one does not apply, Lazard's takes over.
    """

    BROWN_MCCALLUM = "brown-mccallum"
    LAZARD = "lazard"
    MCCALLUM = "mccallum"


class Stage(Enum):
    """Stages of the engine that can be left out, to measure what each gains; the answers stay equivalent.

    Every rule of preparation but simplification, and every method but decomposition, which takes what all others
    leave, belongs to one.

    ``EQUATIONS``: linear equations and Gröbner bases before anything else. ``SUBSTITUTION``: virtual substitution.
    ``CUBIC``: the same with roots of cubics, and the signs of cubics on intervals.
    ``CONSTRAINTS``: projection and lifting restricted by equational constraints. ``PARTIAL``: stacks are left as
    soon as their truth is known. ``OPEN``: sectors only where all atoms are strict. ``MCCALLUM``: Brown–McCallum's
    or McCallum's before Lazard. ``ORDER``: the variable order is chosen, not taken as written. ``POSITION``: bound
    variables get coordinates in which the polynomials are short. ``SYMMETRY``: variables
    are taken from a block by translations, rotations and scalings that leave its truth alone. ``GATHERING``: nested
    blocks of one kind are prepared as one. ``DISTRIBUTION``: disjuncts with equations are solved apart. ``VALUES``:
    atoms that some value of a variable meets, whatever the rest is, are dropped, and squares of variables that one
    atom alone looks at. ``ZEROS``: conditions on which variables vanish are dropped where they follow from the others.
    ``BALLS``: whether two balls meet is a closed form, and a sphere seen along one direction a segment.
    ``STABILITY``: whether a polynomial given by its real and imaginary part has roots in a half-plane is another.
    ``QUADRICS``: whether one quadric lies in another is a question about one multiplier.
    ``FORMS``: other closed forms, which are theorems of ``qe.theorems``.
    ``RANGES``: conditions that ranges of variables exclude are refuted.
    ``SAMPLES``: sentences of inequalities are tried at points. ``SEARCH``: sentences with many cases are
    searched by a SAT solver. ``BRANCHING``: sentences between bounds are refuted piece by piece.
    ``SQUARES``: signs that sums of squares prove. ``MINISCOPING``: quantifiers are moved inwards, independent parts
    apart. ``EXCHANGE``: the sum and product of two variables that can be exchanged stand for them. ``SHIFT``: x^k is
    named x. ``GENERIC``: inequations that remove no interior are dropped. ``CANCELLING``: multiples of equations are
    subtracted. ``SPLITTING``: an equation that factors gives cases. ``INFINITY``, ``CRITICAL``, ``CONVEX``, ``CGS``,
    ``WITNESS``: truth at infinity first; critical values; convex optimisation; comprehensive Gröbner systems;
    polynomial witnesses. ``ROOTS``: one polynomial of degree 3 or more by signs of Hermite's forms. ``NAMING``: a
    linear form that curved conditions look at gets a name. ``REDUNDANT``: parts of an answer that make no difference
    are dropped. ``SHORTENING``: a last look for a shorter or constant answer, these parts included.
    """

    EQUATIONS = "equations"
    SUBSTITUTION = "substitution"
    CUBIC = "cubic"
    CONSTRAINTS = "constraints"
    PARTIAL = "partial"
    OPEN = "open"
    MCCALLUM = "mccallum"
    ORDER = "order"
    POSITION = "position"
    SYMMETRY = "symmetry"
    GATHERING = "gathering"
    DISTRIBUTION = "distribution"
    VALUES = "values"
    ZEROS = "zeros"
    BALLS = "balls"
    STABILITY = "stability"
    QUADRICS = "quadrics"
    FORMS = "forms"
    RANGES = "ranges"
    SAMPLES = "samples"
    SEARCH = "search"
    BRANCHING = "branching"
    SQUARES = "squares"
    MINISCOPING = "miniscoping"
    EXCHANGE = "exchange"
    SHIFT = "shift"
    GENERIC = "generic"
    CANCELLING = "cancelling"
    SPLITTING = "splitting"
    INFINITY = "infinity"
    ROOTS = "roots"
    NAMING = "naming"
    CRITICAL = "critical"
    CONVEX = "convex"
    CGS = "cgs"
    WITNESS = "witness"
    REDUNDANT = "redundant"
    SHORTENING = "shortening"


@dataclass(slots=True)
class Handover:
    """What ``Budget.check`` does once ``time.monotonic()`` has passed ``due``: ``move()``, which may set another time.

    ``qe.processes.execution`` moves long work to another process by it.
    """

    due: float
    move: Callable[[], None]

    def __call__(self) -> None:
        self.due = math.inf
        self.move()


@dataclass(frozen=True, slots=True)
class Cluster:
    """Processes that help: so many ``workers`` on this machine, or those of the scheduler at an ``address``."""

    workers: int = 0
    address: str | None = None


Result = TypeVar("Result", covariant=True)


class Call(Protocol[Result]):
    """A call without arguments that can be pickled."""

    def __call__(self) -> Result: ...


class Helpers(Protocol):
    """Processes, here or on other machines, that do parts of the work. ``width``: how many."""

    width: int

    def ready(self) -> bool:
        """Whether they run. They are started next to the work when that has taken long; nothing waits for them."""
        ...

    def results(self, calls: Iterable[Call[Result]], check: Callable[[], None]) -> Iterator[Result]:
        """The results in the order of the calls, which are taken a few ahead; ``check`` is called while waiting.

        What a call raises is raised in its place.
        """
        ...


def lost(value: object) -> None:
    """Keeps nothing."""


class Budget:
    """Soft limits, checked between FLINT calls: ``check`` raises ``BudgetExceeded``.

    ``seconds`` counts from construction. ``work`` bounds what ``spend`` gets: one unit is a cell of a decomposition,
    or about the time of one; unlike seconds it is the same on every machine, so what depends on it is too.
    A budget for a part of the work (``share``, ``part``) sees the deadline, the limit on work and the cancellation of
    the budget that it came from, and has its ``helpers``. ``keep`` stores what the work has found, in case that a
    limit ends it before it is done: then that is its result.
    """

    __slots__ = (
        "_cancelled",
        "_last_note",
        "deadline",
        "handover",
        "helpers",
        "keep",
        "listener",
        "parent",
        "used",
        "work",
    )

    def __init__(
        self,
        seconds: float | None = None,
        work: int | None = None,
        listener: Listener = silent,
        parent: Budget | None = None,
        handover: Handover | None = None,
        keep: Callable[[object], None] = lost,
    ) -> None:
        self.deadline = None if seconds is None else time.monotonic() + seconds
        self.work, self.used, self.listener, self.parent = work, 0, listener, parent
        self.handover: Handover | None = handover if parent is None else parent.handover
        self.helpers: Helpers | None = None if parent is None else parent.helpers
        self.keep: Callable[[object], None] = keep
        self._cancelled, self._last_note = False, 0.0

    def cancel(self) -> None:
        """Make the next ``check`` raise; safe to call from another thread."""
        self._cancelled = True

    def remaining(self) -> float | None:
        """Seconds left, or None without a time limit."""
        return None if self.deadline is None else self.deadline - time.monotonic()

    def time_left(self, phase: str) -> float | None:
        """As ``remaining``, and more than 0: a limit for a part. Raises ``BudgetExceeded`` where nothing is left."""
        self.check(phase)
        left = self.remaining()
        return None if left is None else max(left, 0.001)

    def share(self, fraction: float) -> Budget:
        """A budget for a part of the work: at most ``fraction`` of the time that remains."""
        left = self.remaining()
        return Budget(None if left is None else max(0.0, left * fraction), None, self.listener, self)

    def part(self, work: int | None) -> Budget:
        """A budget for a part of the work: at most so many units."""
        return Budget(self.remaining(), work, self.listener, self)

    def left(self) -> int | None:
        """Units of work left, or None without a limit on it."""
        own = None if self.work is None else self.work - self.used
        above = None if self.parent is None else self.parent.left()
        return above if own is None else own if above is None else min(own, above)

    @property
    def is_limited(self) -> bool:
        """Whether there is a limit on work, here or in the budgets this one is a part of."""
        return self.work is not None or (self.parent is not None and self.parent.is_limited)

    def spend(self, units: int) -> None:
        """Count units of work, here and in the budgets this one is a part of."""
        budget: Budget | None = self
        while budget is not None:
            budget.used += units
            budget = budget.parent

    def check(self, phase: str = "work", done: int = 0, total: int | None = None) -> None:
        """Report progress (at most ten times a second) and raise ``BudgetExceeded`` past a limit."""
        now = time.monotonic()
        if self.handover is not None and now > self.handover.due:
            self.handover()
        if self.deadline is not None and now > self.deadline:
            raise BudgetExceeded(f"time limit reached while doing: {phase}", limit="time")
        budget: Budget | None = self
        while budget is not None:
            if budget._cancelled:
                raise BudgetExceeded("cancelled", limit="cancel")
            if budget.work is not None and budget.used > budget.work:
                raise BudgetExceeded(f"limit of {budget.work} units of work reached", limit="work")
            budget = budget.parent
        if now - self._last_note > NOTE_SECONDS:
            self._last_note = now
            self.listener(Event(phase, done, total))


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What a caller can set; every public function takes these as keywords."""

    method: Method = Method.AUTO
    projection: Projection = Projection.BROWN_MCCALLUM
    order: tuple[str, ...] | None = None
    root_atoms: bool = False
    without: frozenset[Stage] = frozenset()
    certify: bool = False

    def with_(self, **changes: object) -> Options:
        """A copy with some fields replaced."""
        return replace(self, **changes)  # type: ignore[arg-type]
