"""Certificates of former releases of the kinds "branch", "inverse" and "motions", as derivations by one step.

What they held is the evidence of the step. Nothing here is trusted: what comes out is checked. Kept for one release.
"""

from __future__ import annotations

from bezier.arm.evidence import LIMITED, MOTIONS, POSITIONS
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry


def inverse(payload: Entry) -> Certificate:
    """All joint positions."""
    return POSITIONS.certificate(payload)


def branch(payload: Entry) -> Certificate:
    """That an arm follows curves."""
    return LIMITED.certificate(payload)


def motions(payload: Entry) -> Certificate:
    """All continuous motions."""
    return MOTIONS.certificate(payload)
