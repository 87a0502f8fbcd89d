"""The first screen of a plan: the moving path in its scene, with what matters about it beside it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import brief, decimal_text
from bezier.motion.motion import in_time
from bezier.plans import Outcome, Plan
from bezier.report import html
from bezier.report.html import Card, Text
from bezier.report.parts import GIVEN
from qe.errors import Unable

if TYPE_CHECKING:
    from bezier.motion.track import Track
    from bezier.pictures.picture import Drawing, RegionPicture

RESULTS = {
    Outcome.SOLVED: "path found",
    Outcome.NEAR_OPTIMAL: "path found, near the optimum",
    Outcome.INFEASIBLE: "no path exists",
    Outcome.BLOCKED: "no path found: an obstacle is in the way",
    Outcome.TOO_FAST: "a limit of the motion is not kept",
    Outcome.OUT_OF_REACH: "the arm cannot follow the path",
}
DRAWING = ("pictures", "report")
"""The steps that are no part of solving."""
CURVES = {"P": "first curve", "Q": "second curve", "R": "third curve"}


def cards(plan: Plan) -> list[Card]:
    """Whether it is proved, and length, clearance, least time and curvature where the problem has them."""
    proved = "proved, and accepted by the checker" if plan.certified else "NOT everything is proved"
    result = [Card("result", RESULTS[plan.outcome], html.tone(plan.outcome.is_success), proved)]
    if plan.path is None:
        result.append(Card("radius", f"{float(plan.problem.workspace.radius_squared) ** 0.5:.6g} mm"))
    if plan.quality is not None:
        result.append(Card("length", f"{plan.quality.length.shown()} mm"))
    if plan.findings:
        result.append(_clearance(plan))
    if plan.quality is not None:
        result += [*_motion(plan), _curvature(plan.quality.curvature)]
    if plan.radius_rule is not None and plan.path is not None:
        result.append(Card("the radius forces", f"a stop at {' and '.join(plan.radius_rule.forced)}", "bad"))
    if plan.heights is not None and plan.heights.strip is not None:
        kept, strip = plan.heights.hold, plan.heights.strip
        said = "kept on all curves" if kept else "not kept on all curves"
        result.append(Card(f"heights for {brief(strip.low)} ≤ x ≤ {brief(strip.high)}", said, html.tone(kept)))
    return [*result, computed(plan.seconds, duration)]


def computed(seconds: Mapping[str, float], duration: Callable[[float], str]) -> Card:
    """The time that it took, by steps."""
    drawing = sum(s for name, s in seconds.items() if name in DRAWING)
    solving = sum(seconds.values()) - drawing
    return Card("computed in", f"{duration(solving)} solving", note=f"{duration(drawing)} drawing" if drawing else "")


def _clearance(plan: Plan) -> Card:
    label, distances = "least distance to an obstacle", [finding.distance for finding in plan.findings]
    known = [d for d in distances if d is not None]
    if not all(finding.is_clear for finding in plan.findings):
        return Card(label, "an obstacle is met", "bad")
    if not known or len(known) < len(distances):
        return Card(label, "clear, proved", "good", "no distance from an obstacle given by a formula")
    nearest = min(known, key=lambda d: d.low)
    return Card(label, f"{nearest.shown()} mm", "good", "clear for all t, proved")


def _motion(plan: Plan) -> list[Card]:
    assert plan.quality is not None
    motion = plan.quality.motion
    if motion is None:
        return []
    is_given = motion.timing.duration is not None
    kept = motion.keeps_limits
    limits = "" if not motion.timing.limits else "limits kept at all times, proved" if kept else "limits NOT kept"
    label = "duration asked for" if is_given else "least time"
    tone = "" if not motion.timing.limits else html.tone(kept)
    return [
        Card(
            label,
            f"{decimal_text(motion.duration, 6)} s",
            tone,
            f"{motion.timing.law.value} law; {limits}".rstrip("; ") + motion.bound_in_words,
        )
    ]


def _curvature(worst: Enclosure | None) -> Card:
    if worst is None:
        return Card("largest curvature", "none: the path is one point")
    if worst.high is None:
        return Card("largest curvature", "unbounded: a cusp", "bad")
    radius = f"radius at least {float(1 / worst.high) * (1 - 1e-5):.5g} mm" if worst.high else ""
    return Card("largest curvature", f"{worst.shown()} per mm", note=radius)


def duration(seconds: float) -> str:
    """Seconds or milliseconds."""
    return f"{seconds * 1e3:.1f} ms" if seconds < 1 else f"{seconds:.2f} s"


# --- the scene --------------------------------------------------------------------------------------------
def picture(plan: Plan, drawing: Drawing | None, arm: Mapping[str, Any] | None) -> Markup | None:
    """The moving path with its legend; None without drawings."""
    if drawing is None:
        return None
    from bezier.pictures import scene
    from bezier.pictures.picture import numbers

    given = dict(zip(GIVEN, numbers(list(plan.problem.named_points.values())), strict=True))
    timed = plan.quality is not None and plan.quality.motion is not None
    data = scene.path_scene(drawing.picture, _track(plan), timed=timed, given=given)
    legend = [
        (CURVES.get(c.name, "the path"), f"var(--{c.name.lower()})" if c.name in CURVES else c.colour)
        for c in drawing.picture.curves
    ]
    if len(legend) == 1:
        legend = [("the path", legend[0][1])]
    legend += [(obstacle.name, obstacle.colour) for obstacle in drawing.picture.obstacles]
    if arm is not None:
        data = scene.with_arm(data, arm)
        legend.append(("the arm", "var(--ink)"))
    what = f"{RESULTS[plan.outcome]}: {words(plan)}"
    return scene_box(scene.text(data), what, "path.png", legend, moving=data["motion"] is not None or arm is not None)


def words(plan: Plan) -> str:
    """The scene in words, for those who do not see it."""
    count = 0 if plan.path is None else len(plan.path.curves)
    curves = "the given points" if not count else "one Bézier curve" if count == 1 else f"{count} Bézier curves"
    inside = "a half ball" if plan.problem.workspace.kind.value == "hemisphere" else "a ball"
    obstacles = len(plan.problem.obstacles)
    around = f", with {obstacles} obstacle{'s' * (obstacles > 1)}" if obstacles else ""
    return f"{curves} inside {inside}{around}, seen in space"


def scene_box(
    data: str, words: str, still: str, legend: Iterable[tuple[str, str]], *, moving: bool, said: Text = ""
) -> Markup:
    """A turnable picture; ``still``: the file shown where there is no script; ``legend``: names with colours."""
    items = Markup("").join(Markup('<li><i style="background:{}"></i>{}</li>').format(c, name) for name, c in legend)
    play = Markup(
        '<div class="play"><button type="button">Pause</button>'
        '<input type="range" min="0" max="1" value="0" step="1" aria-label="time along the path">'
        '<output aria-live="off"></output></div>'
    )
    image = '<noscript><img src="{}" alt="{}" style="max-width:100%"></noscript>'
    fallback = Markup(image).format(still, words) if still else ""
    return Markup(
        '<figure class="scene" data-scene>'
        '<div class="tools"><button type="button" data-zoom="1.25" aria-label="nearer">+</button>'
        '<button type="button" data-zoom="0.8" aria-label="farther">−</button></div>'
        '<canvas role="img" tabindex="0" aria-label="{words}">{words}</canvas>'
        "{fallback}{play}"
        '<ul class="legend" aria-label="legend">{items}</ul>'
        "<figcaption>{said}"
        "<span class='hint'>Turn it by dragging or with the arrow keys; + and − zoom.</span></figcaption>"
        '<script type="application/json">{data}</script></figure>'
    ).format(
        words=words,
        fallback=fallback,
        play=play if moving else "",
        items=items,
        data=Markup(data),
        said=said + Markup(". ") if said else "",
    )


def region_box(region: RegionPicture, words: str, said: Text = "", seen_as: RegionPicture | None = None) -> Markup:
    """A region in space with its boundary surfaces by colour; ``said``: below it; ``seen_as``: for the same view."""
    from bezier.pictures import scene

    data = scene.text(scene.region_scene(region, seen_as))
    return scene_box(data, words, "region.png", scene.region_legend(region), moving=False, said=said)


def _track(plan: Plan) -> Track | None:
    """The motion along the path; None where there is none in floating point."""
    if plan.path is None:
        return None
    from bezier.motion.track import Track

    try:
        return Track.of(in_time(plan.path, None if plan.quality is None else plan.quality.motion))
    except Unable:
        return None
