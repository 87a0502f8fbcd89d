"""The rules of derivations that the second ring decides, each with its checker: one line a rule."""

from __future__ import annotations

from collections.abc import Mapping

from qe.expert.classification import check_classification
from qe.expert.counted_solutions import check_counted_solutions
from qe.expert.critical_universal import check_critical_universal
from qe.expert.critical_values import check_critical_values
from qe.expert.optimum import check_multipliers
from qe.expert.roots_by_signs import check_roots_by_signs
from qe.expert.rotation import check_rotation
from qe.expert.sentences import stated
from qe.expert.solutions import check_solutions
from qe.kernel.step import Check

EXPERT: Mapping[str, Check] = {
    "classification": stated(check_classification),
    "comprehensive Gröbner system": check_counted_solutions,
    "critical values": check_critical_values,
    "critical values of a universal block": check_critical_universal,
    "multipliers": check_multipliers,
    "roots by signs": check_roots_by_signs,
    "rotation of the axes": check_rotation,
    "solutions": stated(check_solutions),
}
