"""Certificates of former releases of the kinds "branch", "inverse" and "motions", as derivations by one step.

What they held is the evidence of the step. Nothing here is trusted: what comes out is checked. Kept for one release.
"""

from __future__ import annotations

from bezier.arm.evidence import LIMITED, MOTIONS, POSITIONS

inverse, branch, motions = (rule.certificate for rule in (POSITIONS, LIMITED, MOTIONS))
