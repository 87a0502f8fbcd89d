"""Quantifier elimination over the reals: exact answers, regions and optima with certificates.

>>> import qe
>>> print(qe.eliminate("ex x. x^2 + b*x + c = 0").formula)
b^2 - 4*c >= 0
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from qe.errors import (
    BudgetExceeded,
    CertificateRejected,
    DegreeTooHigh,
    InputError,
    InternalError,
    NoTruthValue,
    NotWellOriented,
    ParseError,
    QEError,
    Unable,
)
from qe.options import Method, Stage

if TYPE_CHECKING:
    from qe.api import (
        Answer,
        Certificate,
        Guarantee,
        Status,
        check_witness,
        decide,
        eliminate,
        equivalent,
        find_instance,
        maximize,
        minimize,
        parametric_witnesses,
        region,
        verify,
    )
    from qe.certify.verdict import Verdict
    from qe.convex.optimum import Optimum
    from qe.elimination.vs.parametric import ParametricWitness
    from qe.exact.algebraic import RealAlgebraic
    from qe.io.expressions import Expression, Statement, exists, forall, variables
    from qe.io.sympy import Exists, ForAll
    from qe.io.z3_door import from_z3
    from qe.regions.region import Region

__version__ = "0.1.0"


_API = (
    "Answer",
    "Certificate",
    "Guarantee",
    "Status",
    "check_witness",
    "decide",
    "eliminate",
    "equivalent",
    "find_instance",
    "maximize",
    "minimize",
    "parametric_witnesses",
    "region",
    "verify",
)
_LATER = {
    **dict.fromkeys(_API, "qe.api"),
    **dict.fromkeys(("Expression", "Statement", "exists", "forall", "variables"), "qe.io.expressions"),
    "Exists": "qe.io.sympy",
    "ForAll": "qe.io.sympy",
    "from_z3": "qe.io.z3_door",
    "Optimum": "qe.convex.optimum",
    "ParametricWitness": "qe.elimination.vs.parametric",
    "RealAlgebraic": "qe.exact.algebraic",
    "Region": "qe.regions.region",
    "Verdict": "qe.certify.verdict",
}
"""Public names whose modules are loaded at first use: ``import qe`` alone loads neither FLINT nor the engine."""


def __getattr__(name: str) -> Any:
    """A public name from a module that is loaded at its first use (PEP 562)."""
    if name in ("api", "sympy"):
        return import_module(f"qe.{name}")
    if name not in _LATER:
        raise AttributeError(f"module 'qe' has no attribute {name!r}")
    found = globals()[name] = getattr(import_module(_LATER[name]), name)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


__all__ = [
    "Answer",
    "BudgetExceeded",
    "Certificate",
    "CertificateRejected",
    "DegreeTooHigh",
    "Exists",
    "Expression",
    "ForAll",
    "Guarantee",
    "InputError",
    "InternalError",
    "Method",
    "NoTruthValue",
    "NotWellOriented",
    "Optimum",
    "ParametricWitness",
    "ParseError",
    "QEError",
    "RealAlgebraic",
    "Region",
    "Stage",
    "Statement",
    "Status",
    "Unable",
    "Verdict",
    "check_witness",
    "decide",
    "eliminate",
    "equivalent",
    "exists",
    "find_instance",
    "forall",
    "from_z3",
    "maximize",
    "minimize",
    "parametric_witnesses",
    "region",
    "variables",
    "verify",
]
