"""The problem and the curves that a folder states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bezier.curves.curve import Bezier
from bezier.input.stored import control_points, entry
from bezier.problem import Problem, from_json
from qe.errors import CertificateRejected, InputError


def stated_problem(found: Mapping[str, Any], file: str) -> Problem:
    """The problem that a table read from a file states."""
    try:
        return from_json(found, "problem")
    except InputError as error:
        raise CertificateRejected(file, str(error)) from None


def stored_path(found: Mapping[str, Any]) -> tuple[Problem, dict[str, Bezier]]:
    """The problem and the curves in the table of a ``path.json``."""
    points = control_points(found)
    curves = {}
    for name, row in entry(found, "curves", dict, "path.json: ").items():
        if not isinstance(row, list) or not row or not all(isinstance(p, str) and p in points for p in row):
            raise CertificateRejected(f"path.json: curves.{name}", "expected names of control points")
        curves[name] = Bezier.of([points[p] for p in row])
    return stated_problem(entry(found, "problem", dict, "path.json: "), "path.json"), curves
