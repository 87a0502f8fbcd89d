"""The steps that preparation can take, each of which can be switched off."""

from __future__ import annotations

from enum import Enum


class StepKind(Enum):
    """Equivalence-preserving steps, cheapest first."""

    SIMPLIFY = "standard simplification"
    MINISCOPE = "independent parts and miniscoping"
    LINEAR = "linear equation solved"
    GUARDED_LINEAR = "linear equation solved under a guard"
    DEGREE_SHIFT = "degree shift"
    GENERIC = "inequations that remove no interior"
    BOUNDARY = "boundary apart"
    TRANSLATION = "translation of the origin"
    SCALING = "homogeneous scaling"
    GROEBNER = "Groebner basis of the equations"
    FACTOR_SPLIT = "case split on factors"
    SUM_OF_SQUARES = "vanishing sum of squares split"


ALL_STEPS = frozenset(StepKind)
EQUATION_STEPS = frozenset({StepKind.LINEAR, StepKind.GUARDED_LINEAR, StepKind.GROEBNER})
