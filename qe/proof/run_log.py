"""The story of a run: what was prepared, chosen, given up and done, for ``stats`` and for people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


@dataclass(slots=True)
class RunLog:
    """``stats``: lists of entries by kind (``preparation``, ``plan``, ``vs``, ``cad``, ``switches``)."""

    stats: dict[str, object] = field(default_factory=dict)

    def note(self, kind: str, detail: object) -> None:
        """Add an entry of this kind."""
        entries = self.stats.setdefault(kind, [])
        assert isinstance(entries, list)
        entries.append(detail)


def explained(stats: Mapping[str, object]) -> str:
    """The story in sentences, one a line: what ``explain=True`` shows."""
    lines = []
    for entry in _entries(stats, "preparation"):
        lines += [f"prepared by {step}" for step in entry] if isinstance(entry, Sequence) else [str(entry)]
    lines += [f"planned {entry}" for entry in _entries(stats, "plan")]
    for entry in _entries(stats, "vs"):
        lines.append("substitution " + _figures(entry))
    for entry in _entries(stats, "cad"):
        lines.append("decomposition " + _figures(entry))
    for entry in _entries(stats, "critical"):
        lines.append("critical values " + _figures(entry))
    lines += [f"gave up {entry}" for entry in _entries(stats, "switches")]
    if "seconds" in stats:
        lines.append(f"took {stats['seconds']} s")
    return "\n".join(lines)


def _entries(stats: Mapping[str, object], kind: str) -> Sequence[object]:
    found = stats.get(kind, ())
    return found if isinstance(found, list) else ()


def _figures(entry: object) -> str:
    if not isinstance(entry, Mapping):
        return str(entry)
    return "; ".join(f"{name} {_plain(value)}" for name, value in entry.items())


def _plain(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value)) or "none"
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)
