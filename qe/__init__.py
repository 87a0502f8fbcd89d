"""Quantifier elimination over the reals: exact answers, regions and optima with certificates.

>>> import qe
>>> print(qe.eliminate("ex x. x^2 + b*x + c = 0").formula)
b^2 - 4*c >= 0
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

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
from qe.exact.algebraic import RealAlgebraic
from qe.options import Method, Stage

if TYPE_CHECKING:
    from qe.certify.verdict import Verdict
    from qe.io.sympy import Exists, ForAll
    from qe.solution.optimum import Optimum
    from qe.solution.parametric import ParametricWitness
    from qe.solution.region import Region

__version__ = "0.1.0"


_LATER = {
    "Exists": "qe.io.sympy",
    "ForAll": "qe.io.sympy",
    "Optimum": "qe.solution.optimum",
    "ParametricWitness": "qe.solution.parametric",
    "Region": "qe.solution.region",
    "Verdict": "qe.certify.verdict",
}
"""Public names whose modules are loaded at first use, to keep ``import qe`` short."""


def __getattr__(name: str) -> Any:
    """A public name from a module that is loaded at its first use (PEP 562)."""
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'qe' has no attribute {name!r}")


__all__ = [
    "Answer",
    "BudgetExceeded",
    "Certificate",
    "CertificateRejected",
    "DegreeTooHigh",
    "Exists",
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
    "Status",
    "Unable",
    "Verdict",
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
]
