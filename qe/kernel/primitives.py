"""The rules of derivations that the kernel decides, each with its checker: one line a rule."""

from __future__ import annotations

from collections.abc import Mapping

from qe.kernel.block import check_block
from qe.kernel.elimination_set import check_elimination_set
from qe.kernel.linear_equation import check_linear
from qe.kernel.nested import check_converse, check_no_exception, check_steps
from qe.kernel.open_block import check_inequations, check_open_block
from qe.kernel.parts import check_parts
from qe.kernel.quantifiers import check_quantifiers
from qe.kernel.root import check_root
from qe.kernel.step import Check
from qe.kernel.table import check_table
from qe.kernel.terms import check_terms
from qe.kernel.theorem import check_theorem
from qe.kernel.witness import check_instance

PRIMITIVES: Mapping[str, Check] = {
    # frame
    "steps": check_steps,
    "virtual substitution": check_steps,
    "equations taken apart": check_steps,
    "converse": check_converse,
    "no exception": check_no_exception,
    "parts": check_parts,
    "instance": check_instance,
    # signs
    "signs": check_block,
    # quantifiers
    "quantifiers": check_quantifiers,
    "renaming": check_quantifiers,
    "duality": check_quantifiers,
    "negation normal form": check_quantifiers,
    "independent parts and miniscoping": check_quantifiers,
    "nested blocks of one kind gathered": check_quantifiers,
    # terms, and roots that exist
    "terms": check_terms,
    "root": check_root,
    "linear equation solved": check_linear,
    # test points
    "elimination set": check_elimination_set,
    # cylinders
    "cells": check_table,
    "shorter": check_table,
    "covering": check_table,
    # open sets
    "inequations that remove no interior": check_inequations,
    "open block": check_open_block,
    # theorems
    "theorem": check_theorem,
}
