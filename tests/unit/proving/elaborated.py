"""Steps of rules that are no primitives: why they are none of the kernel's."""

from typing import Any

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts
from qe.kernel.step import Claim
from qe.kernel.verdict import CRASHES
from qe.proof.entry import Entry
from qe.proving.elaborators import ELABORATORS, FRESH
from tests.unit.certify.claims import RING, formula, limits


def refused(rule: str, before: str | Formula, after: str | Formula, evidence: Any = None, given: str = "true") -> str:
    """Why a step is not one of the kernel; nothing where it is."""
    sides = [formula(side) if isinstance(side, str) else side for side in (before, after)]
    names = [name for side in sides for name in (side.ring.names if side.ring is not None else ())]
    ring = Ring.of(dict.fromkeys((*RING.names, *names, *FRESH)))
    context = tuple(convert(f, ring) for f in conjuncts(formula(given))) if given != "true" else ()
    left, right = (convert(side, ring) for side in sides)
    claim = Claim(rule, left, right, ring, Entry(evidence or {}, "evidence"), "step")
    try:
        steps: Any = ELABORATORS[rule](claim, context, limits())
        made = Claim("steps", left, right, ring, Entry({"steps": steps}, "evidence"), "step")
        RULES["steps"](made, context, limits())
    except (CertificateRejected, *CRASHES) as error:
        return str(error) or type(error).__name__
    return ""
