"""The planning methods, each by what the rest of the program asks of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from bezier.curves.curve import Smoothness
from bezier.curves.scalar import Vector
from bezier.plan import Clock, Plan
from bezier.problem import PlanMethod, Problem
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing

P = TypeVar("P", bound=Plan)
Section = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Claim:
    """What certificates show about a problem: the control points (None: there are none), how smooth the joins must be,
    the names of the curves, and a line for people about each thing that was checked."""

    lines: tuple[str, ...]
    points: Mapping[str, Vector] | None
    smoothness: Smoothness
    curves: tuple[str, ...] = ("P", "Q", "R")


@dataclass(frozen=True, slots=True, kw_only=True)
class Method(Generic[P]):
    """A planning method.

    ``make``: the plan. ``reason``: why there is no path, in one sentence. ``words``: its lines in the summary for
    people. ``entries``: its further entries in the summary as JSON. ``files``: its further data files, by name.
    ``draw``: writes the pictures into a folder. ``hats``: whether the paper writes its points with hats. ``template``
    and ``sections``: its page, and the values that the page shows beyond those of every method. ``claim``: what the
    certificates in a folder show, or ``CertificateRejected``.
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
    claim: Callable[[Problem, Certificate], Claim]


def method_of(choice: PlanMethod) -> Method[Any]:
    """The method of this name, loaded when it is needed."""
    match choice:
        case PlanMethod.QUADRATIC:
            from bezier.quadratic.method import QUADRATIC

            return QUADRATIC
        case PlanMethod.CUBIC:
            from bezier.cubic.method import CUBIC

            return CUBIC
        case PlanMethod.SINGLE:
            from bezier.single.method import SINGLE

            return SINGLE
