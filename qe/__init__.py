"""Quantifier elimination over the reals: exact answers, regions and optima with certificates.

>>> import qe
>>> print(qe.eliminate("ex x. x^2 + b*x + c = 0").formula)
b^2 - 4*c >= 0
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qe.errors import (
    BudgetExceeded,
    CertificateRejected,
    DegreeTooHigh,
    DoubtfulInput,
    InputError,
    InternalError,
    NoTruthValue,
    NotWellOriented,
    ParseError,
    QEError,
    Unable,
)
from qe.options import Method, Projection, Stage
from qe.services import Service, provide

if TYPE_CHECKING:
    from qe.api.decide import check_witness, decide, equivalent, find_instance
    from qe.api.eliminate import eliminate, region, simplify, verify
    from qe.api.groebner import comprehensive_groebner, real_root_classification
    from qe.api.optimum import Extremes, maximize, minimize, optimum
    from qe.api.solve import find, find_instances, parametric_witnesses, reduce, solve, witnesses
    from qe.api.solver import Solver
    from qe.convex.optimum import Optimum
    from qe.elimination.vs.parametric import ParametricWitness
    from qe.exact.algebraic import RealAlgebraic
    from qe.groebner.counting import RealRootClassification
    from qe.groebner.system import ComprehensiveGroebnerSystem
    from qe.io.expressions import Expression, Statement, exists, forall, variables
    from qe.io.smtlib import from_z3
    from qe.io.sympy import Exists, ForAll
    from qe.kernel.verdict import Verdict
    from qe.optimization.global_optimum import GlobalOptimum
    from qe.optimization.parametric_optimum import ParametricOptimum
    from qe.proof.answer import Answer, Guarantee, Status
    from qe.proof.certificate import Certificate
    from qe.regions.region import Region
    from qe.regions.solutions import Solutions

__version__ = "0.2.0"


_ELSEWHERE = {
    **dict.fromkeys(("Answer", "Guarantee", "Status"), "qe.proof.answer"),
    "Certificate": "qe.proof.certificate",
    "ComprehensiveGroebnerSystem": "qe.groebner.system",
    "RealRootClassification": "qe.groebner.counting",
    **dict.fromkeys(("comprehensive_groebner", "real_root_classification"), "qe.api.groebner"),
    **dict.fromkeys(("check_witness", "decide", "equivalent", "find_instance"), "qe.api.decide"),
    **dict.fromkeys(("Extremes", "maximize", "minimize", "optimum"), "qe.api.optimum"),
    **dict.fromkeys(("find", "find_instances", "parametric_witnesses", "reduce", "solve", "witnesses"), "qe.api.solve"),
    **dict.fromkeys(("Exists", "ForAll"), "qe.io.sympy"),
    "GlobalOptimum": "qe.optimization.global_optimum",
    **dict.fromkeys(("Expression", "Statement", "exists", "forall", "variables"), "qe.io.expressions"),
    "from_z3": "qe.io.smtlib",
    "Optimum": "qe.convex.optimum",
    "ParametricOptimum": "qe.optimization.parametric_optimum",
    "ParametricWitness": "qe.elimination.vs.parametric",
    "RealAlgebraic": "qe.exact.algebraic",
    "Region": "qe.regions.region",
    "Solver": "qe.api.solver",
    "Solutions": "qe.regions.solutions",
    "Verdict": "qe.kernel.verdict",
}
"""Where public names stand that are neither here nor in ``qe.api.eliminate``.

All are loaded at first use: ``import qe`` alone loads neither FLINT nor the engine.
"""


def __getattr__(name: str) -> Any:
    """A public name from a module that is loaded at its first use (PEP 562)."""
    if name == "api":
        return import_module("qe.api.eliminate")
    if name == "sympy":
        return import_module("qe.sympy")
    if name not in __all__:
        is_module = name in {path.stem for path in Path(__file__).parent.iterdir()}
        raise AttributeError(f"module 'qe' has no attribute {name!r}{'' if is_module else _nearest(name)}", name=name)
    found = globals()[name] = getattr(import_module(_ELSEWHERE.get(name, "qe.api.eliminate")), name)
    return found


def _nearest(name: str) -> str:
    """The nearest name that there is."""
    from difflib import get_close_matches

    near = get_close_matches(name, __all__, 1)
    return f"; did you mean {near[0]!r}?" if near else ""


provide(
    {
        Service.CONNECTED: lambda: import_module("qe.io.expressions").connected,
        Service.SUBSTITUTED: lambda: import_module("qe.io.expressions").substituted,
        Service.COMPARISON: lambda: import_module("qe.formula.comparison"),
        Service.WRITTEN: lambda: import_module("qe.io.formats").write,
        Service.SYMPY: lambda: import_module("qe.io.sympy").sympy_form,
        Service.REGION: lambda: import_module("qe.api.eliminate").region,
        Service.REGION_OPERATORS: lambda: import_module("qe.api.region_operators"),
        Service.PARTIAL_PICTURE: lambda: import_module("qe.regions.partial_picture").plotted,
        Service.TRUSTS: lambda: import_module("qe.certify.trusts").trusts,
        Service.THEOREM: lambda: import_module("qe.certify.theorems").theorem_of,
    }
)


def __dir__() -> list[str]:
    return sorted((*__all__, *(name for name in globals() if name.startswith("__")), "api", "sympy"))


__all__ = [
    "Answer",
    "BudgetExceeded",
    "Certificate",
    "CertificateRejected",
    "ComprehensiveGroebnerSystem",
    "DegreeTooHigh",
    "DoubtfulInput",
    "Exists",
    "Expression",
    "Extremes",
    "ForAll",
    "GlobalOptimum",
    "Guarantee",
    "InputError",
    "InternalError",
    "Method",
    "NoTruthValue",
    "NotWellOriented",
    "Optimum",
    "ParametricOptimum",
    "ParametricWitness",
    "ParseError",
    "Projection",
    "QEError",
    "RealAlgebraic",
    "RealRootClassification",
    "Region",
    "Solutions",
    "Solver",
    "Stage",
    "Statement",
    "Status",
    "Unable",
    "Verdict",
    "check_witness",
    "comprehensive_groebner",
    "decide",
    "eliminate",
    "equivalent",
    "exists",
    "find",
    "find_instance",
    "find_instances",
    "forall",
    "from_z3",
    "maximize",
    "minimize",
    "optimum",
    "parametric_witnesses",
    "real_root_classification",
    "reduce",
    "region",
    "simplify",
    "solve",
    "variables",
    "verify",
    "witnesses",
]
