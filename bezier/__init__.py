"""Path planning with Bézier curves on top of the quantifier elimination engine ``qe``.

The package builds the formulas of Hatakeyama, Terui and Mikawa (SCSS 2024), hands them to ``qe`` and turns
the exact answers into proved paths, reports and pictures. It decides nothing by floating point.

>>> import bezier
>>> plan = bezier.plan(start=[-4, 0, 3], via=[[-2, 1, 3], [2, 1, 3]], goal=[4, 0, 3], radius=6)
>>> plan.certified, plan(1.5).tolist()
(True, [0.0, 1.0, 3.0])
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bezier.chains.plan import ChainPlan
    from bezier.interface.chain import chain
    from bezier.interface.function import plan
    from bezier.interface.planned import NoPath, Planned
    from bezier.interface.retiming import retime
    from bezier.interface.scene import route
    from bezier.interface.trajectory import certify
    from bezier.plans import Outcome
    from bezier.retiming.least_time import LeastTime
    from bezier.scenes.route import Blocked, Route
    from bezier.trajectories.command import Certified

_LATER = {
    "Blocked": "bezier.scenes.route",
    "Route": "bezier.scenes.route",
    "route": "bezier.interface.scene",
    "Certified": "bezier.trajectories.command",
    "certify": "bezier.interface.trajectory",
    "ChainPlan": "bezier.chains.plan",
    "chain": "bezier.interface.chain",
    "LeastTime": "bezier.retiming.least_time",
    "retime": "bezier.interface.retiming",
    "NoPath": "bezier.interface.planned",
    "Outcome": "bezier.plans",
    "Planned": "bezier.interface.planned",
    "plan": "bezier.interface.function",
}
"""Public names whose modules are loaded at first use."""


def __getattr__(name: str) -> Any:
    """A public name from a module that is loaded at its first use (PEP 562); ``Unable`` names a library it lacks."""
    if name not in _LATER:
        raise AttributeError(f"module 'bezier' has no attribute {name!r}")
    from qe.extras import wanted

    with wanted():
        result = globals()[name] = getattr(import_module(_LATER[name]), name)
    return result


def __dir__() -> list[str]:
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})


__all__ = [
    "Blocked",
    "Certified",
    "ChainPlan",
    "LeastTime",
    "NoPath",
    "Outcome",
    "Planned",
    "Route",
    "certify",
    "chain",
    "plan",
    "retime",
    "route",
]
