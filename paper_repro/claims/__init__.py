"""All claims of the paper, in its order. How they are shown is no business of theirs."""

from paper_repro.claim import Claim
from paper_repro.claims import (
    arm,
    arm_points,
    cited,
    conclusions,
    cubic,
    cubic_existence,
    cubic_region,
    curves,
    heights,
    introduction,
    joins,
    method_one,
    method_one_gaps,
    quadratic,
    quadratic_gaps,
    workspace,
)

CLAIMS: tuple[Claim, ...] = (
    *introduction.CLAIMS,
    *cited.CLAIMS,
    *workspace.CLAIMS,
    *curves.CLAIMS,
    *heights.CLAIMS,
    *method_one.CLAIMS,
    *method_one_gaps.CLAIMS,
    *joins.CLAIMS,
    *cubic.CLAIMS,
    *cubic_existence.CLAIMS,
    *cubic_region.CLAIMS,
    *quadratic.CLAIMS,
    *quadratic_gaps.CLAIMS,
    *conclusions.CLAIMS,
    *arm.CLAIMS,
    *arm_points.CLAIMS,
)
