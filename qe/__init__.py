"""Quantifier elimination over the reals: exact answers, regions and optima with certificates.

>>> import qe
>>> print(qe.eliminate("ex x. x^2 + b*x + c = 0").formula)
b^2 - 4*c >= 0
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qe.api import (
    Answer,
    Certificate,
    Guarantee,
    Region,
    Status,
    decide,
    eliminate,
    equivalent,
    find_instance,
    maximize,
    minimize,
    region,
    verify,
)
from qe.errors import (
    BudgetExceeded,
    CertificateRejected,
    DegreeTooHigh,
    InputError,
    InternalError,
    NotWellOriented,
    ParseError,
    QEError,
    Unable,
)
from qe.exact.algebraic import RealAlgebraic
from qe.io.sympy import Exists, ForAll
from qe.options import Method

if TYPE_CHECKING:
    from qe.certify.verdict import Verdict
    from qe.solution.optimum import Optimum

__version__ = "0.1.0"


def __getattr__(name: str) -> Any:
    """The result types of ``verify`` and ``minimize``, loaded with the modules that make them (PEP 562)."""
    if name == "Verdict":
        from qe.certify.verdict import Verdict

        return Verdict
    if name == "Optimum":
        from qe.solution.optimum import Optimum

        return Optimum
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
    "NotWellOriented",
    "Optimum",
    "ParseError",
    "QEError",
    "RealAlgebraic",
    "Region",
    "Status",
    "Unable",
    "Verdict",
    "decide",
    "eliminate",
    "equivalent",
    "find_instance",
    "maximize",
    "minimize",
    "region",
    "verify",
]
