"""``report.html``: the page of a plan as a list of sections, the same for every method."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from bezier.curves.containment import Argument, Inside
from bezier.curves.curve import Smoothness
from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import brief, decimal_text, is_zero
from bezier.motion.motion import Motion
from bezier.obstacles import survey
from bezier.obstacles.clearance import Clear
from bezier.paths import heights
from bezier.paths.path import Path, Proof, speed_at_joins
from bezier.plans import Method, Outcome, Plan
from bezier.report import first, html, joints, mathml, parts
from bezier.report.first import duration
from bezier.report.html import Page, Section, Text, toned
from bezier.report.parts import SMOOTHNESS, decimal_point, derivation_link, shown

if TYPE_CHECKING:
    from bezier.pictures.picture import Drawing


TESTS = {
    Argument.POLYGON: "control polygon (all control points satisfy it, and the set is convex)",
    Argument.BERNSTEIN: "Bernstein coefficients of the distance to the boundary, all ≥ 0 after bisection",
    Argument.ROOTS: "square-free part of the distance to the boundary: it touches zero but does not cross",
}
CLAIMS = {
    "elimination": "The formula is equivalent to the conditions with the dependent points substituted",
    "path": "Every curve stays in the workspace, by its Bernstein coefficients",
    "clearance": "Every curve stays clear of every obstacle, by Bernstein coefficients",
}
CHECKER, FIELD = "independent checker (qe.verify)", "exact arithmetic in the number field of the coordinates"


# --- why it holds -----------------------------------------------------------------------------------------
def path(plan: Plan, drawing: Drawing | None) -> Section | None:
    """Why the whole path stays in the workspace, how smooth it is, and its heights."""
    if plan.path is None:
        return None
    head = ("curve", "condition", "result", "proved by")
    content: list[Text] = [html.table(head, map(_proof, plan.path.proofs))]
    if plan.path.joins:
        content += [html.heading("Joins"), _joins(plan.path)]
    result = heights.summary_lines(plan.heights) if plan.heights else []
    if result and plan.heights is not None:
        said = result[0].replace("heights: ", "").replace(">=", "≥").replace("<=", "≤")
        content += [html.heading("The heights to keep"), html.paragraph(f"{said}.", html.tone(plan.heights.hold))]
        content.append(html.bullets(f"{line}." for line in result[1:]))
    content.append(html.figures(drawing.views if drawing else ()))
    return Section("path", "The whole path stays in the workspace", html.joined(*content), short="path")


def _proof(proof: Proof) -> tuple[Text, ...]:
    name, known = curve_name(proof.curve), {"ball": "‖·‖ ≤ r", "floor": "z ≥ 0"}
    condition = known.get(proof.condition.name, proof.condition.name)
    if isinstance(proof.outcome, Inside):
        return name, condition, toned("for all t in [0, 1]", True), TESTS[proof.outcome.test]
    return name, condition, toned(f"leaves, e.g. at t = {brief(proof.outcome.t)}", False), "exact evaluation there"


def curve_name(name: str) -> Text:
    """A curve as a function of t."""
    return shown(mathml.name(name) + "<mo>(</mo><mi>t</mi><mo>)</mo>")


def _joins(whole_path: Path) -> Text:
    speeds, rows = speed_at_joins(whole_path), []
    for item in whole_path.joins:
        at = whole_path.curves[item.second].points[0]
        label = next(name for name in ("Q0", "R0") if whole_path.points[name] == at)
        velocity, jump = speeds.get(f"{item.first}-{item.second}"), item.join.jumps[2]
        stops = "" if item.join.same_direction else ", but it stops there"
        change = "none" if all(map(is_zero, jump)) else decimal_point(jump, 6)
        proved, speed = SMOOTHNESS[item.join.smoothness] + stops, decimal_point(velocity, 6) if velocity else ""
        rows.append((shown(mathml.name(label)), proved, speed, change))
    head = ("at", "proved exactly", "velocity there (mm per unit of time)", "jump of the second derivative")
    return html.table(head, rows)


def obstacles(plan: Plan, drawing: Drawing | None) -> Section | None:
    """Each curve and each obstacle, and what was tried."""
    if not plan.findings:
        return None
    content: list[Text] = []
    if plan.outcome is Outcome.BLOCKED:
        said = "No path was found: every one that was tried meets an obstacle. A path may exist all the same."
        content.append(html.paragraph(html.strong(said), "bad"))
    said = (
        "Each whole curve against each obstacle, enlarged by its margin: proved clear for all t, or the first contact."
    )
    head = ("curve", "obstacle", "result", "least distance (mm)", "proved by")
    content += [html.paragraph(said), html.table(head, map(_finding, plan.findings))]
    content.append(html.figures(drawing.clearance if drawing else (), wide=True))
    if len(plan.attempts) > 1:
        rows = [(a.what, toned(a.detail, a.outcome is not None and a.outcome.is_success)) for a in plan.attempts]
        content += [html.heading("What was tried"), html.table(("problem", "result"), rows)]
    return Section("obstacles", "Obstacles", html.joined(*content))


def _finding(finding: survey.Finding) -> tuple[Text, ...]:
    outcome = finding.outcome
    distance = "" if finding.distance is None else between(finding.distance)
    first = (curve_name(finding.name), finding.obstacle.name)
    if isinstance(outcome, Clear):
        return (*first, toned("clear for all t", True), distance, outcome.argument.value)
    how = "enters" if outcome.enters else "touches"
    where = f"{how}: first at t = {survey.parameter(outcome)}, {survey.place(outcome)}"
    return (*first, toned(where, False), distance, "roots of the conditions along the curve")


def certificates(plan: Plan, claims: Mapping[str, str]) -> Section:
    """What was checked by whom; ``claims``: what each certificate of the method says."""
    words = {**CLAIMS, **claims}
    rows: list[tuple[Text, Text, Text]] = []
    for name, verdict in plan.checks.items():
        result = "accepted" if verdict.accepted else f"rejected at {verdict.step}: {verdict.reason}"
        rows.append((words.get(name, name), CHECKER, toned(result, verdict.accepted)))
    for name in plan.derivations:
        said = html.joined(f"The elimination of {name}:", derivation_link(plan, name))
        rows.append((said, CHECKER, toned("accepted", True)))
    for name, why in plan.unproved.items():
        rows.append((f"The elimination of {name}, step by step", "nobody", toned(f"not checked: {why}", None)))
    if plan.path is not None:
        inside = plan.path.is_inside
        claim = "The whole path stays in the workspace (see the proofs above)"
        rows.append((claim, FIELD, toned("proved" if inside else "refuted", inside)))
    if plan.path is not None and plan.path.joins:
        smooth = plan.path.smoothness
        claim = f"Both joins are {'C²' if smooth is Smoothness.C2 else 'C¹'}"
        good = smooth >= Smoothness.C1
        rows.append((claim, FIELD, toned("proved" if good else "refuted", good)))
    files = Markup(
        "The certificates are in <code>certificate.json</code>; <code>qe check certificate.json</code> verifies them"
        " again with code that shares nothing with the code that made them, and <code>bezier check</code> on this"
        " folder also proves the path again."
    )
    content = html.joined(html.table(("claim", "checked by", "result"), rows), html.note(files))
    return Section("certified", "What was certified, and how", content, short="certificates")


# --- details ----------------------------------------------------------------------------------------------
def quality(plan: Plan, drawing: Drawing | None) -> Section | None:
    """Lengths, curvatures and the motion in time."""
    if plan.quality is None:
        return None
    bends = plan.quality.curvatures
    rows = [
        (curve_name(name), between(length), "one point" if (bend := bends[name]) is None else between(bend))
        for name, length in plan.quality.lengths.items()
    ]
    content: list[Text] = [
        html.paragraph(f"Rigorous bounds, rounded outwards. The whole path is {between(plan.quality.length)} mm long.")
    ]
    content.append(html.table(("curve", "length (mm)", "largest curvature (1/mm)"), rows))
    if plan.quality.motion is not None:
        content += _motion(plan.quality.motion)
    return Section("quality", "Length, curvature and motion", html.joined(*content), short="quality")


def between(value: Enclosure) -> str:
    """Both ends, rounded outwards; one number where they are equal."""
    if not value.is_bounded:
        return "unbounded (cusp)"
    ends = value.to_json(8)
    return ends["low"] if ends["low"] == ends["high"] else f"{ends['low']} … {ends['high']}"


def _motion(motion: Motion) -> list[Text]:
    words = {"max_speed": ("speed", "mm/s"), "max_acceleration": ("acceleration", "mm/s²")}
    rows = []
    for key, value in motion.largest.items():
        (what, unit), limit, kept = words[key], motion.timing.limits.get(key), motion.kept.get(key, False)
        result = "no limit" if limit is None else toned("kept at all times" if kept else "EXCEEDED", kept)
        most = "" if limit is None else f"{decimal_text(limit, 8)} {unit}"
        rows.append((f"largest {what}", f"{between(value)} {unit}", most, result))
    title = f"Motion: {motion.timing.law.value} law, {decimal_text(motion.duration, 8)} s{motion.bound_in_words}"
    return [html.heading(title), html.table(("", "over the whole time", "limit", "result"), rows)]


def timings(seconds: Mapping[str, float], reported: str = "") -> Section:
    """One row per step, with a bar of its length."""
    longest = max(seconds.values(), default=0.0) or 1.0
    bar = Markup('<div class="bar" style="width:{}%"></div>')
    rows = [(name, duration(s), bar.format(round(100 * s / longest, 1))) for name, s in seconds.items()]
    content = html.joined(html.table((), rows, numbers=(1,)), html.note(reported) if reported else None)
    return Section("timings", "Timings", content)


def problem(plan: Plan, given: Text) -> Section:
    """The given points, the workspace, and what was noticed about them."""
    workspace, radius = plan.problem.workspace, f"{float(plan.problem.workspace.radius_squared) ** 0.5:.8g}"
    where = "the upper half (z ≥ 0) of the ball" if workspace.kind.value == "hemisphere" else "the ball"
    exact = "" if radius == workspace.radius_text else f" (exactly {workspace.radius_text})"
    largest = ", the maximum of the norms" if plan.problem.radius_is_auto else ""
    notes: list[Any] = [html.note(f"Note: {note}.") for note in (*plan.problem.notes, *plan.remarks)]
    said = html.paragraph(f"Workspace: {where} about the origin of radius r = {radius} mm{exact}{largest}.")
    return Section("problem", "The problem", html.joined(given, said, *notes))


PAPER = (
    "Method: R. Hatakeyama, A. Terui, M. Mikawa, “Towards Trajectory Planning of a Robot Manipulator with Computer"
    " Algebra using Bézier Curves for Obstacle Avoidance”, SCSS 2024"
)


def render(plan: Plan, method: Method[Any], drawing: Drawing | None) -> str:
    """The page of a plan by this method. Without ``drawing`` there are no pictures."""
    page = html.document(page_of(plan, method, drawing))
    return page if plan.hatted_names else mathml.without_hats(page)


def page_of(plan: Plan, method: Method[Any], drawing: Drawing | None) -> Page:
    """The page: the scene with what matters, why it holds, and the details."""
    story = method.story(plan, drawing)
    arm = joints.moving(plan.joints)
    file = FilePath(plan.problem.source).name
    why: list[Section | None] = [
        story.none,
        path(plan, drawing),
        obstacles(plan, drawing),
        certificates(plan, story.claims),
    ]
    details = [
        problem(plan, parts.given(plan.problem.named_points, story.given)),
        *story.sections,
        quality(plan, drawing),
        None if plan.joints is None else joints.section(plan.joints),
        timings(plan.seconds, story.reported),
    ]
    footer = f"{PAPER}, section {story.place}. Made by bezier-qe {html.package_version()} from {file}."
    return Page(
        title=f"{file.removesuffix('.toml').replace('_', ' ')}: {first.RESULTS[plan.outcome]}",
        lead=_lead(plan, story.kind),
        cards=first.cards(plan),
        first=first.picture(plan, drawing, arm),
        sections=[section for section in (*why, *details) if section is not None],
        footer=footer,
    )


def _lead(plan: Plan, kind: str) -> str:
    """What was asked and found, in a sentence."""
    result = "" if plan.outcome is Outcome.INFEASIBLE else f"{kind} "
    ends = " to ".join(parts.decimal_point(p, 5) for p in (plan.problem.start, plan.problem.goal))
    obstacles = len(plan.problem.obstacles)
    around = f" around {obstacles} obstacle{'s' * (obstacles > 1)}" if obstacles else ""
    where = "half ball" if plan.problem.workspace.kind.value == "hemisphere" else "ball"
    radius = f"{float(plan.problem.workspace.radius_squared) ** 0.5:.6g}"
    return f"{result}from {ends}{around}, in the {where} of radius {radius} mm".strip()
