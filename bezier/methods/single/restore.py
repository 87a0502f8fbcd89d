"""The plan of Method 1 found again from a folder, without solving a linear program.

The programs are built from the problem, those of Method 1* with the cuts that the summary lists: each is a consequence
of the conditions for all t, whatever its parameter and plane (``cuts``). Their certificates hold the
points and the multipliers. The control points are those of ``path.json``; everything about them is proved again.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.curves.containment import Leaves
from bezier.curves.curve import Bezier
from bezier.input import stored
from bezier.input.task import Axis, Task, Values
from bezier.methods.control.optimal_path import restored
from bezier.methods.control.terms import member
from bezier.methods.single import plan
from bezier.methods.single.closed import NoCurve, ProvedCurve
from bezier.methods.single.cuts import Cut, CutKind, Model
from bezier.methods.single.program import Chosen, Solution, curve, dips, program
from bezier.paths.path import prove
from bezier.plans import Stated
from bezier.problem import Problem
from qe.convex.system import ConvexSystem
from qe.errors import CertificateRejected
from qe.proof.certificate import Certificate


def restore(problem: Problem, evidence: Certificate, stated: Stated) -> plan.SinglePlan:
    """The plan that the files of a folder prove. Raises ``CertificateRejected``."""
    given = plan.task_of(problem)
    chosen = tuple(_chosen(given, axis, plan.of_axis(axis.name), evidence) for axis in given.raised)
    printed = _printed(problem, given, chosen, evidence)
    closed, attainable = _closed(problem, given, printed, evidence, stated)
    fields = plan.known(problem, chosen, printed, closed)
    return plan.SinglePlan(
        **restored(fields, plan.labelled(fields)), pieces=_pieces(given, stated), attainable=attainable
    )


# --- linear programs -----------------------------------------------------------------------------------------------


def _chosen(given: Task, axis: Axis, label: str, evidence: Certificate) -> Chosen:
    """Problem (4) of an axis with the answer in its certificate."""
    return Chosen(axis, _outcome(program(given, axis), label, evidence))


def _outcome(program: ConvexSystem, label: str, evidence: Certificate) -> Solution:
    """The outcome in the certificate with this label, which has to be about this program."""
    payload: Any = member(evidence, label, "multipliers").evidence_for("multipliers")
    if payload["status"] not in ("optimal", "infeasible"):
        raise CertificateRejected(f"{label}: status", "expected an optimum or a contradiction")
    point, numbers = (_numbers(payload[key], label) for key in ("point", "multipliers"))
    if len(point) != len(program.names):
        raise CertificateRejected(f"{label}: point", f"expected {len(program.names)} numbers")
    outcome = Solution(program, point, numbers, payload["status"] == "optimal")
    expected: Any = outcome.certificate.evidence_for("multipliers")
    for key in expected:
        if payload.get(key) != expected[key]:
            raise CertificateRejected(f"{label}: {key}", "not the one of this problem")
    return outcome


def _numbers(rows: Any, label: str) -> Values:
    """Rational numbers as an optimum's certificate writes them."""
    if not all(len(row) == 1 for row in rows):
        raise CertificateRejected(label, "expected rational numbers")
    return tuple(stored.rational(row[0], label) for row in rows)


def _printed(problem: Problem, given: Task, chosen: tuple[Chosen, ...], evidence: Certificate) -> plan.Printed | None:
    """The curve of (4), and the other curve with the same sums that the certificates hold."""
    if not all(item.outcome.optimal for item in chosen):
        return None
    others = [_chosen(given, item.axis, plan.lowest_label(item.axis.name), evidence) for item in chosen]
    lower = {item.axis.name: item.values for item in others if item.values is not None}
    if len(lower) < len(others):
        raise CertificateRejected(plan.lowest_label(chosen[0].axis.name), "expected an optimum")
    return plan.printed_of(problem, given, chosen, lower)


# --- Method 1* -----------------------------------------------------------------------------------------------------


def _closed(
    problem: Problem, given: Task, printed: plan.Printed | None, evidence: Certificate, stated: Stated
) -> tuple[ProvedCurve | NoCurve | None, str]:
    """What Method 1* found, and its formula of all sums; (None, "") where it was not needed."""
    if printed is None or printed.holds:
        return None, ""
    model = Model.of(given, problem.workspace)
    listed = enumerate(stored.entry(stated.summary, "cuts", list, "summary.json: "))
    cuts = tuple(_cut(model, item, f"summary.json: cuts[{i}]") for i, item in listed)
    try:
        outcome = _outcome(model.plain_program(cuts), plan.CLOSED, evidence)
    except CertificateRejected as error:
        raise CertificateRejected(f"certificate.json and summary.json, cuts: {error.step}", error.reason) from None
    proof = outcome.certificate
    if not outcome.optimal:
        return NoCurve(cuts, proof, 0), ""
    entry = stored.entry(stated.summary, "closed", dict, "summary.json: ")
    rounds, attainable = entry.get("rounds"), entry.get("attainable")
    if type(rounds) is not int or rounds < 0 or not isinstance(attainable, str):
        raise CertificateRejected("summary.json: closed", "expected rounds and the attainable sums")
    drawn, values = certified_curve(problem, given, stated)
    return ProvedCurve(values, drawn, plan.sum_of(given, values), outcome.value, cuts, proof, rounds), attainable


def _cut(model: Model, stated: Any, place: str) -> Cut:
    """A cut of the summary, where it may stand: then its row follows from the conditions for all t."""
    if not isinstance(stated, dict) or stated.keys() != {"kind", "axis", "t", "plane"}:
        raise CertificateRejected(place, "expected kind, axis, t and plane")
    kind = next((kind for kind in CutKind if kind.value == stated["kind"]), None)
    t, plane = stored.rational(stated["t"], f"{place}.t"), stated["plane"]
    if kind is None or kind is CutKind.TANGENT or not isinstance(plane, list):
        raise CertificateRejected(place, "not a kind of cut, or not a list of numbers")
    cut = Cut(kind, t, stated["axis"], tuple(stored.rational(c, f"{place}.plane") for c in plane))
    low, high = model.task.times
    allowed = {
        CutKind.HEIGHT: cut.axis in [axis.name for axis in model.task.raised] and low <= t <= high and not cut.plane,
        CutKind.BALL: cut.axis == "" and 0 <= t <= 1 and len(cut.plane) == 1 + len(model.task.axes),
        CutKind.START: cut.axis == "" and t == 0 and not cut.plane and model.touches[0],
        CutKind.GOAL: cut.axis == "" and t == 1 and not cut.plane and model.touches[1],
    }
    if not allowed[kind]:
        raise CertificateRejected(place, f"no cut of the kind {kind.value} can be there")
    return cut


def certified_curve(problem: Problem, given: Task, stated: Stated) -> tuple[Bezier, dict[str, Values]]:
    """The curve of ``path.json``, which has to satisfy (4), to keep its heights and to stay in the workspace."""
    if stated.path is None:
        raise CertificateRejected("path.json", "missing, although a curve is claimed")
    points = stored.control_points(stated.path)
    if tuple(points) != tuple(f"{plan.NAME}{i}" for i in range(given.degree + 1)):
        raise CertificateRejected("path.json: points", f"expected {plan.NAME}0 to {plan.NAME}{given.degree}")
    if any(not isinstance(c, Fraction) for point in points.values() for c in point):
        raise CertificateRejected("path.json: points", "expected rational numbers")
    drawn = Bezier(tuple(points.values()))
    values: dict[str, Values] = {
        axis.name: tuple(map(Fraction, drawn.coordinate(1 + k)))
        for k, axis in enumerate(given.axes)
        if axis in given.raised
    }
    if drawn != curve(given, values):
        raise CertificateRejected("path.json: points", "x or a coordinate without a height is not equally spaced")
    for axis in given.raised:
        row = values[axis.name]
        low = all(row[i] >= given.lower_bound(axis, i) for i in range(1, given.degree))
        through = all(drawn.point(t)[1 + given.axes.index(axis)] == axis.height for t in given.times)
        if not low or not through or (row[0], row[-1]) != (axis.start, axis.goal):
            raise CertificateRejected("path.json: points", f"the {axis.name} coordinates do not satisfy (4)")
    for dip in dips(given, drawn):
        raise CertificateRejected("path.json: points", f"{dip.axis.name} is below the height at t = {dip.t}")
    for proof in prove({plan.NAME: drawn}, problem.workspace.conditions):
        if isinstance(proof.outcome, Leaves):
            raise CertificateRejected("path.json: points", f"the curve leaves the {proof.condition.name}")
    return drawn, values


def _pieces(given: Task, stated: Stated) -> dict[str, str]:
    """The formulas of the least sum for every height, as stated."""
    if given.degree > plan.PIECEWISE_DEGREE:
        return {}
    entries = stored.entry(stated.summary, "piecewise", dict, "summary.json: ")
    return {axis.name: stored.entry(entries, axis.name, str, "summary.json: piecewise.") for axis in given.raised}
