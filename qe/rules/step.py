"""The steps that preparation can take, each of which can be switched off."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

from qe.options import Stage


class StepKind(Enum):
    """Equivalence-preserving steps, cheapest first: the rule's name, and the stages without which it is not taken."""

    stages: frozenset[Stage]

    def __new__(cls, rule: str, *stages: Stage) -> StepKind:
        kind = object.__new__(cls)
        kind._value_ = rule
        kind.stages = frozenset(stages)
        return kind

    SIMPLIFY = "standard simplification"
    GATHERING = "nested blocks of one kind gathered", Stage.GATHERING
    MINISCOPE = "independent parts and miniscoping", Stage.MINISCOPING
    DEFINITION = "definition substituted", Stage.EQUATIONS
    LINEAR = "linear equation solved", Stage.EQUATIONS
    GUARDED_LINEAR = "linear equation solved under a guard", Stage.EQUATIONS
    DEGREE_SHIFT = "degree shift", Stage.SHIFT
    BALLS = "two balls", Stage.BALLS
    SPHERE = "sphere seen along a form", Stage.BALLS
    HALF_PLANE = "roots in a half-plane", Stage.STABILITY
    QUADRICS = "quadric in a quadric", Stage.QUADRICS
    CUBIC_INTERVAL = "cubic on an interval", Stage.CUBIC
    CLOSED_FORM = "closed form", Stage.FORMS
    ZEROS = "conditions on zeros that follow", Stage.ZEROS
    TAKES_VALUE = "value that is taken", Stage.VALUES
    SQUARE_ALONE = "square of a variable alone", Stage.VALUES
    RANGES = "ranges that exclude each other", Stage.RANGES
    GENERIC = "inequations that remove no interior", Stage.GENERIC
    BOUNDARY = "boundary apart", Stage.GENERIC
    POSITION = "affine coordinates", Stage.POSITION
    TRANSLATION = "translation of the origin", Stage.SYMMETRY
    ROTATION = "rotation of the axes", Stage.SYMMETRY
    EXCHANGE = "two variables exchanged", Stage.EXCHANGE
    SCALING = "homogeneous scaling", Stage.SYMMETRY
    MIRROR = "mirror images of a convex set", Stage.SYMMETRY
    GROEBNER = "Groebner basis of the equations", Stage.EQUATIONS
    CANCELLING = "multiple of an equation subtracted", Stage.CANCELLING, Stage.EQUATIONS
    FACTOR_SPLIT = "case split on factors", Stage.SPLITTING
    DISTRIBUTION = "disjuncts with equations apart", Stage.DISTRIBUTION
    SQUARES = "signs by sums of squares", Stage.SQUARES


ALL_STEPS = frozenset(StepKind)
POINTWISE_STEPS = frozenset({StepKind.SIMPLIFY, StepKind.MINISCOPE, StepKind.GROEBNER, StepKind.FACTOR_SPLIT})
"""The steps that change no variable: equivalences of the matrix at every point."""


def steps_without(stages: Iterable[Stage]) -> frozenset[StepKind]:
    """The steps that belong to none of the stages."""
    return frozenset(kind for kind in StepKind if kind.stages.isdisjoint(stages))
