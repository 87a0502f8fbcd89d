"""Absorption and complementary merging between the compound members of one level."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from qe.formula.build import conj, disj
from qe.formula.syntax import And, Atom, Constant, Formula, Or
from qe.formula.traverse import atoms
from qe.simplifier.facts import key_of

_MEMBERS = 60  # more members than this are left alone

Level = Callable[[tuple[Formula, ...], bool], Formula]


def absorb(members: list[Formula], conjunctive: bool, level: Level) -> list[Formula]:
    """Members of a disjunction (conjunction) with (A) or (A and B) = A, and (A and p) or (A and q) = A and r
    where ``p or q`` is one atom or a constant, or has fewer atoms than p and q where these are disjunctions. ``level``
    simplifies such a pair.
    """
    if not 1 < len(members) <= _MEMBERS:
        return members
    inner = Or if conjunctive else And
    sets: dict[Formula, frozenset[Formula]] = {m: frozenset(m.args) for m in members if isinstance(m, inner)}
    if len(sets) < 2:
        return members
    members = list(dict.fromkeys(members))  # what follows tells them apart by identity
    kept = [m for m in members if m not in sets or not any(o != m and s < sets[m] for o, s in sets.items())]
    merged = _merge_pair(kept, sets, disj if conjunctive else conj, lambda parts: level(parts, conjunctive))
    return absorb(merged, conjunctive, level) if merged is not None else kept


def _merge_pair(
    members: list[Formula],
    sets: dict[Formula, frozenset[Formula]],
    build: Callable[[Iterable[Formula]], Formula],
    join: Callable[[tuple[Formula, ...]], Formula],
) -> list[Formula] | None:
    """The members with one mergeable pair replaced, or None."""
    seen: dict[tuple[object, ...], tuple[Formula, Formula]] = {}
    for member in members:
        if member not in sets:
            continue
        for part in member.args:  # type: ignore[union-attr]
            if not isinstance(part, Atom | And | Or):
                continue
            rest = sets[member] - {part}
            slot = (key_of(part.poly)[0] if isinstance(part, Atom) else None, rest)
            earlier = seen.get(slot)
            if earlier is None:
                seen[slot] = (member, part)
                continue
            union = join((earlier[1], part))
            atomic = isinstance(part, Atom)
            is_less = sum(1 for _ in atoms(union)) < sum(1 for one in (earlier[1], part) for _ in atoms(one))
            if not isinstance(union, Atom | Constant) and (atomic or not is_less):
                continue
            ordered = [p for p in member.args if p is not part and p in rest]  # type: ignore[union-attr]
            if not isinstance(union, Constant):
                ordered.append(union)
            replacement = build(ordered)
            return [replacement if m is earlier[0] else m for m in members if m is not member]
    return None
