"""Kleene's three-valued truth: ``True``, ``False`` and ``None`` for "not known yet"."""

from __future__ import annotations

from collections.abc import Iterable

Truth = bool | None


def conjunction(values: Iterable[Truth]) -> Truth:
    """False if any value is False, True if all are True, otherwise unknown. Stops early."""
    result: Truth = True
    for value in values:
        if value is False:
            return False
        if value is None:
            result = None
    return result


def disjunction(values: Iterable[Truth]) -> Truth:
    """True if any value is True, False if all are False, otherwise unknown. Stops early."""
    return negation(conjunction(map(negation, values)))


def negation(value: Truth) -> Truth:
    """The Kleene negation."""
    return None if value is None else not value
