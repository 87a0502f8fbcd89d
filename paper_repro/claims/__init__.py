"""All claims of the paper, in its order."""

from paper_repro.claim import Claim
from paper_repro.claims import (
    conclusions,
    cubic,
    curves,
    introduction,
    joins,
    method_one,
    quadratic,
    quadratic_gaps,
    workspace,
)

CLAIMS: tuple[Claim, ...] = (
    *introduction.CLAIMS,
    *workspace.CLAIMS,
    *curves.CLAIMS,
    *method_one.CLAIMS,
    *joins.CLAIMS,
    *cubic.CLAIMS,
    *quadratic.CLAIMS,
    *quadratic_gaps.CLAIMS,
    *conclusions.CLAIMS,
)
