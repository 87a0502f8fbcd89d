"""The rules of derivations, each with its checker. A rule that is not here proves nothing.

Other packages bring rules about their own objects: a package names each as an entry point of the group ``GROUP``. They
are of the second ring: ``--core`` does not know them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING

from qe.kernel.primitives import PRIMITIVES
from qe.kernel.step import Check

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "bezier_qe.rules"


@cache
def _entry_points() -> dict[str, EntryPoint]:
    from importlib.metadata import entry_points

    return {point.name: point for point in entry_points(group=GROUP)}


@cache
def brought(rule: str) -> Check | None:
    """The checker of the rule that an installed package brings under this name."""
    point = _entry_points().get(rule)
    return None if point is None else point.load()


@cache
def _expert() -> Mapping[str, Check]:
    """The second ring, loaded where the first has no such rule."""
    from qe.expert.rules import EXPERT

    return EXPERT


class _Rules(Mapping[str, Check]):
    """Listed are those of ``qe``; a rule that an installed package brings is loaded when it is named."""

    def __getitem__(self, rule: str) -> Check:
        check = PRIMITIVES.get(rule) or _expert().get(rule) or brought(rule)
        if check is None:
            raise KeyError(rule)
        return check

    def __iter__(self) -> Iterator[str]:
        yield from PRIMITIVES
        yield from _expert()

    def __len__(self) -> int:
        return len(PRIMITIVES) + len(_expert())


RULES: Mapping[str, Check] = _Rules()
