"""The page of ``bezier certify``: each limited quantity over time against its limit, with the place of its peak."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from bezier.pictures.picture import GRID, INK, PALE
from bezier.pictures.plot import new_figure, svg_text
from bezier.report import html
from bezier.report.html import Card, Page, Section
from bezier.trajectories.limits import Outcome, Verdict, limited

SAMPLES = 2000
"""In a chart, at least; two more in each piece. They decide nothing."""
BAD = "#c0392b"


def page(verdict: Verdict, lines: Sequence[str], file: str, *, clear: bool, cards: Sequence[Card] = ()) -> Page:
    """``lines``: what the command says; ``clear``: whether no obstacle is touched; ``cards``: more
    for the first line."""
    good = verdict.is_kept and clear
    names = verdict.trajectory.names
    charts = [(_chart(verdict, outcome), outcome.limit.words(names)) for outcome in verdict.outcomes]
    rows = [
        (
            outcome.limit.words(names),
            f"{float(outcome.limit.high):.10g}",
            f"{outcome.value:.10g}",
            f"{float(outcome.time(verdict.trajectory)):.10g}",
            html.toned("kept" if outcome.is_kept else "EXCEEDED", outcome.is_kept),
        )
        for outcome in verdict.outcomes
    ]
    head = ("quantity", "limit", "worst value", "at t", "for all t")
    said = Section("verdict", "What is proved", html.bullets(lines), short="verdict")
    table = Section("limits", "Limits", html.table(head, rows, numbers=(1, 2, 3)), short="limits")
    drawn = Section("charts", "Over time", html.figures(charts), short="charts")
    note = "Charts are samples in floating point; every verdict is exact and holds for all t."
    cards = [Card("verdict", "kept" if good else "refuted", html.tone(good)), *cards]
    if not verdict.is_kept:
        slower = "no slowing down repairs it" if verdict.factor is None else f"{float(verdict.factor):.8g}"
        cards.append(Card("times as slow", slower, note="kept then, proved"))
    return Page(title=f"Trajectory {file}", lead=lines[-1], sections=(said, table, drawn), footer=note, cards=cards)


def _chart(verdict: Verdict, outcome: Outcome) -> str:
    trajectory, limit = verdict.trajectory, outcome.limit
    polys = limited(trajectory.derivative(limit.order), limit)
    count = SAMPLES // len(polys) + 2
    times, values = list[Any](), list[Any]()
    for p, start, length in zip(polys, trajectory.breaks, trajectory.lengths, strict=False):
        local = np.linspace(0, float(length), count)
        times.append(float(start) + local)
        values.append(np.polynomial.polynomial.polyval(local, p.floats() or [0.0]))
    t, y = np.concatenate(times), np.concatenate(values)
    y = np.sqrt(np.maximum(y, 0)) if limit.axis is None else y
    figure = new_figure(5.8, 3.2)
    axis = figure.add_axes((0.13, 0.17, 0.84, 0.72))
    axis.plot(t, y, color=INK, linewidth=1.3)
    high = float(limit.high)
    low = None if limit.axis is None else -high if limit.low is None else float(limit.low)
    for bound in (high, low):
        if bound is not None:
            axis.axhline(bound, color=PALE, linewidth=1, linestyle="--")
    sign = 1 if limit.axis is None else outcome.peak.sign
    beyond = sign * y > sign * (high if sign > 0 or low is None else low)
    axis.plot(t[beyond], y[beyond], ".", color=BAD, markersize=3)
    colour = INK if outcome.is_kept else BAD
    axis.plot([float(outcome.time(trajectory))], [outcome.value], "o", color=colour, markersize=6, fillstyle="none")
    axis.set_title(limit.words(trajectory.names), fontsize=10, color=INK)
    axis.set_xlabel("t")
    axis.grid(color=GRID, linewidth=0.6)
    return svg_text(figure)
