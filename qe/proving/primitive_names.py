"""The primitive by which steps of rules are checked that have no name of their own in certificates any more."""

from __future__ import annotations

from collections.abc import Mapping

SIGNS, STEPS, QUANTIFIERS, THEOREM, NO_EXCEPTION = "signs", "steps", "quantifiers", "theorem", "no exception"
PROJECTION = "projection"
"""The rule whose steps are too large for a decomposition wherever they are too large for steps of their own."""

BY_SIGNS = (
    "simplification",
    "standard simplification",
    "case split on factors",
    "boundary apart",
    "signs by sums of squares",
    "Groebner basis of the equations",
    "multiple of an equation subtracted",
    "Boolean search",
    "branch and bound",
)

PRIMITIVE_OF: Mapping[str, str] = {
    **dict.fromkeys(BY_SIGNS, SIGNS),
    "redundant part": NO_EXCEPTION,
    "constant": NO_EXCEPTION,
    "signs of factors": NO_EXCEPTION,
}
