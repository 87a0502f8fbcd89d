"""The rules of derivations, each with its checker. A rule that is not here proves nothing.

Other packages bring rules about their own objects: a package names each as an entry point of the group ``GROUP``. They
are of the second ring: ``--core`` does not know them.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points

from qe.expert.rules import EXPERT
from qe.kernel.primitives import PRIMITIVES
from qe.kernel.step import Check

GROUP = "bezier_qe.rules"


@cache
def brought(rule: str) -> Check | None:
    """The checker of the rule that an installed package brings under this name."""
    return next((point.load() for point in entry_points(group=GROUP, name=rule)), None)


class _Rules(dict[str, Check]):
    """Listed are those of ``qe``; a rule that an installed package brings is loaded when it is named."""

    def __missing__(self, rule: str) -> Check:
        if (check := brought(rule)) is None:
            raise KeyError(rule)
        return check

    def __contains__(self, rule: object) -> bool:
        return super().__contains__(rule) or (isinstance(rule, str) and brought(rule) is not None)

    def get(self, rule: str, default: Check | None = None) -> Check | None:  # type: ignore[override]
        """The checker, if there is one."""
        check = super().get(rule)
        return check or brought(rule) or default


RULES: Mapping[str, Check] = _Rules({**PRIMITIVES, **EXPERT})
