"""The rules of derivations, each with its checker: one line a rule. A rule that is not here proves nothing."""

from __future__ import annotations

from collections.abc import Mapping

from qe.certify.negation import check_negation
from qe.certify.renaming import check_renaming
from qe.certify.step import Check

RULES: Mapping[str, Check] = {
    "renaming": check_renaming,
    "duality": check_negation,
    "negation normal form": check_negation,
}
