"""The steps that preparation can take, each of which can be switched off."""

from __future__ import annotations

from enum import Enum


class StepKind(Enum):
    """Equivalence-preserving steps, cheapest first."""

    SIMPLIFY = "standard simplification"
    GATHERING = "nested blocks of one kind gathered"
    MINISCOPE = "independent parts and miniscoping"
    DEFINITION = "definition put in"
    LINEAR = "linear equation solved"
    GUARDED_LINEAR = "linear equation solved under a guard"
    DEGREE_SHIFT = "degree shift"
    BALLS = "two balls"
    SPHERE = "sphere seen along a form"
    HALF_PLANE = "roots in a half-plane"
    QUADRICS = "quadric in a quadric"
    CUBIC_INTERVAL = "cubic on an interval"
    CLOSED_FORM = "closed form"
    ZEROS = "conditions on zeros that follow"
    TAKES_VALUE = "value that is taken"
    SQUARE_ALONE = "square of a variable alone"
    RANGES = "ranges that exclude each other"
    GENERIC = "inequations that remove no interior"
    BOUNDARY = "boundary apart"
    TRANSLATION = "translation of the origin"
    ROTATION = "rotation of the axes"
    EXCHANGE = "two variables exchanged"
    SCALING = "homogeneous scaling"
    SHEAR = "linear form as a variable"
    MIRROR = "mirror images of a convex set"
    GROEBNER = "Groebner basis of the equations"
    CANCELLING = "multiple of an equation subtracted"
    FACTOR_SPLIT = "case split on factors"
    DISTRIBUTION = "disjuncts with equations apart"
    SQUARES = "signs by sums of squares"


ALL_STEPS = frozenset(StepKind)
EQUATION_STEPS = frozenset(
    {StepKind.DEFINITION, StepKind.LINEAR, StepKind.GUARDED_LINEAR, StepKind.GROEBNER, StepKind.CANCELLING}
)
SYMMETRY_STEPS = frozenset({StepKind.TRANSLATION, StepKind.ROTATION, StepKind.SCALING, StepKind.MIRROR, StepKind.SHEAR})
POINTWISE_STEPS = frozenset({StepKind.SIMPLIFY, StepKind.MINISCOPE, StepKind.GROEBNER, StepKind.FACTOR_SPLIT})
"""The steps that change no variable: equivalences of the matrix at every point."""
