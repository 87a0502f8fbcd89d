"""Equivalence-preserving preparation, with the way back for witnesses."""

from qe.prepare.pipeline import Prepared, prepare
from qe.prepare.simplify import simplify
from qe.prepare.step import ALL_STEPS, Step, StepKind

__all__ = ["ALL_STEPS", "Prepared", "Step", "StepKind", "prepare", "simplify"]
