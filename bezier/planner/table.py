"""The planning methods, each by what the rest of the program asks of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from bezier.methods.control.stored import Stated
from bezier.plan import Clock, Plan
from bezier.problem import PlanMethod, Problem
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing

P = TypeVar("P", bound=Plan)
Section = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Restored(Generic[P]):
    """A plan found again from a folder, before obstacles and quality, and a line about each thing that was checked.

    ``plan``: its certificate is the one that the folder has to have; what only planning needs is left out.
    """

    plan: P
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Method(Generic[P]):
    """A planning method.

    ``make``: the plan. ``reason``: why there is no path, in one sentence. ``words``: its lines in the summary for
    people. ``entries``: its further entries in the summary as JSON. ``files``: its further data files, by name.
    ``draw``: writes the pictures into a folder. ``hats``: whether the paper writes its points with hats. ``template``
    and ``sections``: its page, and the values that the page shows beyond those of every method. ``restore``: the plan
    that the certificates in a folder prove, without any search; ``CertificateRejected`` where they are not about the
    problem.
    """

    make: Callable[[Problem, Clock], P]
    reason: Callable[[P], str]
    words: Callable[[P], list[str]]
    entries: Callable[[P], dict[str, Any]]
    files: Callable[[P], dict[str, str]]
    draw: Callable[[P, FilePath], Drawing]
    hats: bool
    template: str
    sections: Callable[[P], Section]
    restore: Callable[[Problem, Certificate, Stated], Restored[P]]


def method_of(choice: PlanMethod) -> Method[Any]:
    """The method of this name, loaded when it is needed."""
    match choice:
        case PlanMethod.QUADRATIC:
            from bezier.methods.quadratic.method import QUADRATIC

            return QUADRATIC
        case PlanMethod.CUBIC:
            from bezier.methods.cubic.method import CUBIC

            return CUBIC
        case PlanMethod.SINGLE:
            from bezier.methods.single.method import SINGLE

            return SINGLE
