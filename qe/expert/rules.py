"""The rules of derivations that the second ring decides, each with its checker: one line a rule."""

from __future__ import annotations

from collections.abc import Mapping

from qe.expert.counted_solutions import check_counted_solutions
from qe.expert.critical_universal import check_critical_universal
from qe.expert.critical_values import check_critical_values
from qe.expert.roots_by_signs import check_roots_by_signs
from qe.expert.rotation import check_rotation
from qe.kernel.step import Check

EXPERT: Mapping[str, Check] = {
    "comprehensive Gröbner system": check_counted_solutions,
    "critical values": check_critical_values,
    "critical values of a universal block": check_critical_universal,
    "roots by signs": check_roots_by_signs,
    "rotation of the axes": check_rotation,
}
