"""The rules of derivations that the second ring decides, each with its checker: one line a rule."""

from __future__ import annotations

from collections.abc import Mapping

from qe.expert.classification import check_classification
from qe.expert.critical_values import check_critical_values
from qe.expert.optimum import check_multipliers
from qe.expert.rotation import check_rotation
from qe.expert.sentences import stated
from qe.expert.solutions import check_solutions
from qe.kernel.step import Check

EXPERT: Mapping[str, Check] = {
    "classification": stated(check_classification),
    "critical values": check_critical_values,
    "multipliers": check_multipliers,
    "rotation of the axes": check_rotation,
    "solutions": stated(check_solutions),
}
