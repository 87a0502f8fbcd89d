"""The rules of derivations that the second ring decides, each with its checker: one line a rule."""

from __future__ import annotations

from collections.abc import Mapping

from qe.expert.constant_along import check_constant_along
from qe.expert.counted_solutions import check_counted_solutions
from qe.expert.critical_universal import check_critical_universal
from qe.expert.critical_values import check_critical_values
from qe.expert.degenerate_truth_set import check_degenerate_truth_set
from qe.expert.infinity_first import check_infinity_first
from qe.expert.mirror import check_mirror
from qe.expert.named_form import check_named_form
from qe.expert.ranges import check_ranges
from qe.expert.roots_by_signs import check_roots_by_signs
from qe.expert.roots_counted import check_roots_counted
from qe.expert.rotation import check_rotation
from qe.expert.shear import check_shear
from qe.expert.sphere import check_sphere
from qe.expert.symmetry import check_scaling
from qe.expert.zeros import check_zeros
from qe.kernel.step import Check

EXPERT: Mapping[str, Check] = {
    "comprehensive Gröbner system": check_counted_solutions,
    "conditions on zeros that follow": check_zeros,
    "constant along directions": check_constant_along,
    "critical values": check_critical_values,
    "critical values of a universal block": check_critical_universal,
    "degenerate truth set": check_degenerate_truth_set,
    "homogeneous scaling": check_scaling,
    "infinity first": check_infinity_first,
    "linear form as a variable": check_shear,
    "linear form named": check_named_form,
    "mirror images of a convex set": check_mirror,
    "ranges that exclude each other": check_ranges,
    "roots by signs": check_roots_by_signs,
    "roots counted": check_roots_counted,
    "rotation of the axes": check_rotation,
    "sphere seen along a form": check_sphere,
}
