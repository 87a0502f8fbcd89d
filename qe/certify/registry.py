"""The rules of derivations, each with its checker. A rule that is not here proves nothing.

Other packages bring rules about their own objects: a package names each as an entry point of the group ``GROUP``. They
are of the second ring: ``--core`` does not know them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from qe.expert.rules import EXPERT
from qe.kernel.primitives import PRIMITIVES
from qe.kernel.step import Check

GROUP = "bezier_qe.rules"


@cache
def _entry_points() -> dict[str, EntryPoint]:
    return {point.name: point for point in entry_points(group=GROUP)}


@cache
def brought(rule: str) -> Check | None:
    """The checker of the rule that an installed package brings under this name."""
    point = _entry_points().get(rule)
    return None if point is None else point.load()


class _Rules(Mapping[str, Check]):
    """Listed are those of ``qe``; a rule that an installed package brings is loaded when it is named."""

    def __init__(self, listed: Mapping[str, Check]) -> None:
        self._listed = listed

    def __getitem__(self, rule: str) -> Check:
        check = self._listed.get(rule) or brought(rule)
        if check is None:
            raise KeyError(rule)
        return check

    def __iter__(self) -> Iterator[str]:
        return iter(self._listed)

    def __len__(self) -> int:
        return len(self._listed)


RULES: Mapping[str, Check] = _Rules({**PRIMITIVES, **EXPERT})
