"""The page of ``bezier certify``: each quantity over time against its limit, with the place of its worst value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bezier.obstacles.survey import Finding
from bezier.pictures.mesh import Array
from bezier.pictures.obstacles import signed_distances
from bezier.pictures.picture import INK, PALE
from bezier.pictures.plot import framed, new_figure, svg_text
from bezier.report import html
from bezier.report.html import Card, Page, Section
from bezier.trajectories.along import WORDS, Along
from bezier.trajectories.limits import Outcome, Verdict, limited
from bezier.trajectories.links import Links
from bezier.trajectories.piecewise import Trajectory

SAMPLES = 2000
"""In a chart, at least; two more in each piece. They decide nothing."""
BAD = "#c0392b"


@dataclass(frozen=True)
class Quantity:
    """Samples of what is limited, its bounds, and its worst value (time, value); ``prefix``: how exact that is."""

    words: str
    times: Array
    values: Array
    bounds: tuple[float | None, float | None]
    worst: tuple[float, float]
    is_kept: bool
    prefix: str = ""

    @property
    def row(self) -> tuple[html.Text, ...]:
        """Its line in the table."""
        low, high = ("" if bound is None else f"{bound:.10g}" for bound in self.bounds)
        limit = f"at least {low}" if not high else high if not low or low == f"-{high}" else f"{low} to {high}"
        time, value = (f"{self.prefix}{number:.10g}" for number in self.worst)
        return self.words, limit, value, time, html.toned("kept" if self.is_kept else "EXCEEDED", self.is_kept)

    @property
    def chart(self) -> str:
        """Its drawing."""
        figure = new_figure(5.8, 3.2)
        axis = figure.add_axes((0.13, 0.17, 0.84, 0.72))
        axis.plot(self.times, self.values, color=INK, linewidth=1.3)
        for bound, side in zip(self.bounds, (-1, 1), strict=True):
            if bound is not None:
                axis.axhline(bound, color=PALE, linewidth=1, linestyle="--")
                beyond = side * self.values > side * bound
                axis.plot(self.times[beyond], self.values[beyond], ".", color=BAD, markersize=3)
        axis.plot(*self.worst, "o", color=INK if self.is_kept else BAD, markersize=6, fillstyle="none")
        framed(axis, "t (s)", title=self.words)
        return svg_text(figure)


def page(
    verdict: Verdict,
    lines: Sequence[str],
    file: str,
    findings: Sequence[Finding] = (),
    cards: Sequence[Card] = (),
    along: Along | None = None,
    links: Links | None = None,
) -> Page:
    """``lines``: what the command says; ``findings``: of each piece and each obstacle; ``cards``: more for the first
    line."""
    quantities = [_limited(verdict.trajectory, outcome) for outcome in verdict.outcomes]
    quantities += _clearances(verdict.trajectory, findings) if links is None else _distances_of(links)
    if along is not None:
        distance = _limited(along.verdict.trajectory, along.verdict.outcomes[0])
        quantities.append(replace(distance, words=WORDS, bounds=(None, float(along.within))))
    good = all(quantity.is_kept for quantity in quantities) and not verdict.breaking
    good = good and all(finding.is_clear for finding in findings) and (links is None or not links.touches)
    head = ("quantity", "limit", "worst value", "at t", "for all t")
    said = Section("verdict", "What is proved", html.bullets(lines), short="verdict")
    rows = html.table(head, [q.row for q in quantities], numbers=(1, 2, 3))
    table = Section("limits", "Limits", rows, short="limits")
    drawn = Section("charts", "Over time", html.figures([(q.chart, q.words) for q in quantities]), short="charts")
    note = "Charts and values after ≈ are samples in floating point; every verdict is exact and holds for all t."
    cards = [Card("verdict", "kept" if good else "refuted", html.tone(good)), *cards]
    if not verdict.is_kept:
        slower = "no slowing down repairs it" if verdict.factor is None else f"{float(verdict.factor):.8g}"
        cards.append(Card("times as slow", slower, note="kept then, proved"))
    return Page(title=f"Trajectory {file}", lead=lines[-1], sections=(said, table, drawn), footer=note, cards=cards)


def _limited(trajectory: Trajectory, outcome: Outcome) -> Quantity:
    limit = outcome.limit
    times, values = _samples(trajectory, [[limited(trajectory, limit, i)] for i in range(len(trajectory.pieces))])
    y, low = values[:, 0], -limit.high if limit.low is None else limit.low
    return Quantity(
        limit.words(trajectory.names),
        times,
        np.sqrt(np.maximum(y, 0)) if limit.axis is None else y,
        (None if limit.axis is None else float(low), float(limit.high)),
        (float(outcome.time(trajectory)), outcome.value),
        outcome.is_kept,
    )


def _clearances(trajectory: Trajectory, findings: Sequence[Finding]) -> Iterator[Quantity]:
    """The distance from each obstacle that is a body, negative inside, against its margin."""
    if not findings:
        return
    times, values = _samples(trajectory, trajectory.pieces)
    points = np.pad(values, ((0, 0), (0, 3 - values.shape[1])))
    for obstacle in {f.obstacle.name: f.obstacle for f in findings}.values():
        if obstacle.body is not None:
            kept = all(f.is_clear for f in findings if f.obstacle is obstacle)
            margin = float(obstacle.margin)
            yield _distance(obstacle.name, times, signed_distances(points, obstacle.body) + margin, margin, kept)


def _distances_of(links: Links) -> Iterator[Quantity]:
    """The distance of the nearest link from each obstacle that is a body, its margin included."""
    places = {k: _samples(frame, frame.pieces) for k, frame in links.frames.items()}
    shares = np.linspace(0, 1, 13)[:, None, None]
    for i, (name, body) in enumerate(links.bodies):
        if isinstance(body, tuple):
            continue
        numbers = [k for k, j in links.spans if j == i]
        points = [(1 - shares) * places[links.starts[k]][1] + shares * places[k][1] for k in numbers]
        away = [signed_distances(p.reshape(-1, 3), body).reshape(p.shape[:2]).min(axis=0) for p in points]
        times, kept = places[numbers[0]][0], not any(j == i for _, j in links.touches)
        yield _distance(name, times, np.min(away, axis=0), 0.0, kept)


def _distance(name: str, times: Array, distances: Array, margin: float, kept: bool) -> Quantity:
    nearest = int(distances.argmin())
    worst = float(times[nearest]), float(distances[nearest])
    return Quantity(f"distance from {name}", times, distances, (margin, None), worst, kept, "≈ ")


def _samples(trajectory: Trajectory, rows: Sequence[Sequence[Any]]) -> tuple[Array, Array]:
    """Times (n,), and the values of the polynomials of each piece there, (n, axes)."""
    count, times, values = SAMPLES // len(rows) + 2, [], []
    for row, start, length in zip(rows, trajectory.breaks, trajectory.lengths, strict=False):
        local = np.linspace(0, float(length), count)
        times.append(float(start) + local)
        values.append(np.stack([np.polynomial.polynomial.polyval(local, p.floats() or [0.0]) for p in row], axis=1))
    return np.concatenate(times), np.concatenate(values)
