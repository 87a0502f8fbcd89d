"""Quantifier elimination over the reals: exact answers, regions and optima with certificates.

>>> import qe
>>> print(qe.eliminate("ex x. x^2 + b*x + c = 0").formula)
b^2 - 4*c >= 0
"""

from __future__ import annotations

from qe.api import (
    Answer,
    Certificate,
    Guarantee,
    Optimum,
    Region,
    Status,
    Verdict,
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

__version__ = "0.1.0"

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
