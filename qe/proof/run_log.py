"""The log of a run: steps taken, methods chosen and given up, in their order. Statistics are counted from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from qe.formula.syntax import TRUE, Formula
from qe.proof.step import Step


@dataclass(frozen=True, slots=True)
class Choice:
    """A method was chosen for a block."""

    method: str
    variables: tuple[str, ...]
    reason: str

    def __str__(self) -> str:
        return f"{self.method} for {', '.join(self.variables)}: {self.reason}" if self.variables else self.reason


@dataclass(frozen=True, slots=True)
class Switch:
    """Something was given up."""

    what: str
    reason: str

    def __str__(self) -> str:
        return f"{self.what}: {self.reason}"


@dataclass(frozen=True, slots=True)
class Work:
    """What a part of the work cost: ``method`` and its figures."""

    method: str
    figures: Mapping[str, object]


Entry = Step | Choice | Switch | Work


@dataclass(slots=True, repr=False)
class RunLog:
    """Entries in order. Nothing in the engine reads them back: they are for people, derivations and statistics."""

    entries: list[Entry] = field(default_factory=list)
    seconds: float | None = None

    def step(
        self,
        rule: str,
        before: Formula,
        after: Formula,
        *,
        context: Formula = TRUE,
        evidence: Mapping[str, object] | None = None,
    ) -> Formula:
        """Record that ``before`` <-> ``after`` under ``context``; returns ``after``."""
        if before != after:
            self.entries.append(Step(rule, before, after, context, evidence or {}))
        return after

    def choice(self, method: str, variables: tuple[str, ...], reason: str, mark: int | None = None) -> None:
        """Record why a method was chosen; with ``mark`` before what it did since then."""
        self.entries.insert(len(self.entries) if mark is None else mark, Choice(method, variables, reason))

    def switch(self, what: str, reason: object) -> None:
        """Record why something was given up."""
        self.entries.append(Switch(what, str(reason)))

    def work(self, method: str, figures: Mapping[str, object]) -> None:
        """Record what a method did, in figures."""
        self.entries.append(Work(method, figures))

    def mark(self) -> int:
        """A place to which ``forget_steps`` goes back."""
        return len(self.entries)

    def forget_steps(self, mark: int) -> tuple[Step, ...]:
        """Leave out the steps since a mark: the attempt was given up. Choices, switches and figures stay.

        The steps are returned, for ``take_up``.
        """
        left_out = tuple(e for e in self.entries[mark:] if isinstance(e, Step))
        self.entries[mark:] = [e for e in self.entries[mark:] if not isinstance(e, Step)]
        return left_out

    def take_up(self, steps: tuple[Step, ...]) -> None:
        """Record steps that were left out: the attempt that gave them is taken after all."""
        self.entries.extend(steps)

    def __repr__(self) -> str:
        return f"RunLog({len(self.entries)} entries)"

    def steps(self, mark: int = 0) -> Iterator[Step]:
        """The steps in order, since a mark."""
        return (e for e in self.entries[mark:] if isinstance(e, Step))

    def stats(self) -> dict[str, object]:
        """Lists by kind: ``preparation``, ``plan`` (choices), figures by method, ``switches``; and ``seconds``."""
        found: dict[str, object] = {}

        def add(kind: str, entry: object) -> None:
            entries = found.setdefault(kind, [])
            assert isinstance(entries, list)
            entries.append(entry)

        for entry in self.entries:
            match entry:
                case Step(rule, evidence=evidence) if evidence.get("detail"):
                    add("preparation", f"{rule}: {evidence['detail']}")
                case Choice():
                    add("plan", str(entry))
                case Switch():
                    add("switches", str(entry))
                case Work(method, figures):
                    add(method, figures)
        if self.seconds is not None:
            found["seconds"] = self.seconds
        return found
