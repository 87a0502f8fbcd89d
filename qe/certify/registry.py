"""The rules of derivations, each with its checker: one line a rule. A rule that is not here proves nothing."""

from __future__ import annotations

from collections.abc import Mapping

from qe.certify.alternatives import check_alternatives
from qe.certify.block import check_block
from qe.certify.boolean_search import check_boolean_search
from qe.certify.constant_along import check_constant_along
from qe.certify.counted_solutions import check_counted_solutions
from qe.certify.covering import check_covering
from qe.certify.critical_universal import check_critical_universal
from qe.certify.critical_values import check_critical_values
from qe.certify.degenerate_truth_set import check_degenerate_truth_set
from qe.certify.degree_shift import check_degree_shift
from qe.certify.elimination_set import check_elimination_set
from qe.certify.independent_parts import check_independent_parts
from qe.certify.inequations import check_inequations, check_only_nonzero
from qe.certify.infinity_first import check_infinity_first
from qe.certify.linear_equation import check_guarded_linear, check_linear
from qe.certify.mirror import check_mirror
from qe.certify.named_form import check_named_form
from qe.certify.open_block import check_open_block
from qe.certify.ranges import check_ranges
from qe.certify.roots_by_signs import check_roots_by_signs
from qe.certify.roots_counted import check_roots_counted
from qe.certify.rotation import check_rotation
from qe.certify.sentence import check_sentence
from qe.certify.shear import check_shear
from qe.certify.sphere import check_sphere
from qe.certify.step import Check
from qe.certify.symmetry import check_scaling
from qe.certify.table import check_table
from qe.certify.zeros import check_zeros
from qe.kernel.nested import check_converse, check_no_exception, check_steps
from qe.kernel.quantifiers import check_quantifiers
from qe.kernel.root import check_root
from qe.kernel.terms import check_terms
from qe.kernel.theorem import check_theorem

RULES: Mapping[str, Check] = {
    "quantifiers": check_quantifiers,
    "steps": check_steps,
    "converse": check_converse,
    "no exception": check_no_exception,
    "renaming": check_quantifiers,
    "roots counted": check_roots_counted,
    "duality": check_quantifiers,
    "negation normal form": check_quantifiers,
    "simplification": check_block,
    "standard simplification": check_block,
    "case split on factors": check_block,
    "boundary apart": check_block,
    "signs by sums of squares": check_block,
    "Groebner basis of the equations": check_block,
    "multiple of an equation subtracted": check_block,
    "sphere seen along a form": check_sphere,
    "theorem": check_theorem,
    "terms": check_terms,
    "root": check_root,
    "ranges that exclude each other": check_ranges,
    "conditions on zeros that follow": check_zeros,
    "independent parts and miniscoping": check_quantifiers,
    "linear equation solved": check_linear,
    "linear equation solved under a guard": check_guarded_linear,
    "degree shift": check_degree_shift,
    "homogeneous scaling": check_scaling,
    "rotation of the axes": check_rotation,
    "linear form as a variable": check_shear,
    "linear form named": check_named_form,
    "mirror images of a convex set": check_mirror,
    "nested blocks of one kind gathered": check_quantifiers,
    "equations taken apart": check_steps,
    "inequations that remove no interior": check_inequations,
    "virtual substitution": check_steps,
    "critical values": check_critical_values,
    "critical values of a universal block": check_critical_universal,
    "constant along directions": check_constant_along,
    "degenerate truth set": check_degenerate_truth_set,
    "elimination set": check_elimination_set,
    "alternatives": check_alternatives,
    "independent parts": check_independent_parts,
    "infinity first": check_infinity_first,
    "roots by signs": check_roots_by_signs,
    "open block": check_open_block,
    "instance": check_sentence,
    "cells": check_table,
    "shorter": check_table,
    "covering": check_covering,
    "Boolean search": check_boolean_search,
    "convex": check_sentence,
    "point or multipliers": check_sentence,
    "comprehensive Gröbner system": check_counted_solutions,
    # nothing makes these any more; older certificates have them
    "only asked to be no root": check_only_nonzero,
    "vanishing sum of squares split": check_block,
}
