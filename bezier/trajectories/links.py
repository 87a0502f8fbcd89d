"""Whether the links of an arm stay clear of obstacles for all t, or when and where one first meets one.

A link is the segment between the origins of neighbouring frames, those within one omitted, unless both never move. The
origins are known as polynomials of the time, up to ``NEAR`` (``bezier.arm.tip``), so that its points are a sheet: see
``bezier.trajectories.sheets``, also for obstacles that are given by conditions.

In place of a convex body stands a half-space that holds it. That it does is exact code, which makes it from its normal
alone. A link also meets a body that is less than four times ``NEAR`` away, so the search ends: it halves intervals of t
until a plane across the shortest connection at their middle parts them, or a contact is at their left end.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import pairwise, product
from typing import Any

from bezier.arm.model import Arm, JointKind
from bezier.arm.tip import frames_of, is_fixed
from bezier.curves.enclosure import root_above
from bezier.curves.scalar import Vector, described, dot, subtract
from bezier.curves.sentences import CurveSentence, Said
from bezier.input import stored
from bezier.obstacles.bodies import Body, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import half_space, pieces_of
from bezier.obstacles.polyhedron import Point, nearest
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.sheets import Conditions, Rectangle, Sheet, cover
from qe.errors import CertificateRejected
from qe.formula.syntax import FALSE, TRUE
from qe.proof.certificate import Certificate

NEAR = Fraction(1, 1 << 20)
"""How far (mm) the origins of frames may be from the polynomials that stand for them."""
FINE, DIGITS, BITS = 1 << 44, (10, 30, 60), 96
"""Denominator of places and shares that are tried; binary digits of normals, in turn; those of roots."""
PLACE = r"link (\S+), (\S+), piece (\S+) from (\S+) to (\S+), share (\S+) to (\S+): (.*)"
ZERO, ONE = Fraction(0), Fraction(1)
Pair = tuple[int, int]
"""The number of a link, which is that of the frame at its end, and of a body."""


@dataclass(frozen=True, slots=True)
class Touch:
    """At ``t`` in [0, 1] of a piece the point that divides the link in this ``share`` is as good as in the body, which
    the link has not met before."""

    piece: int
    t: Fraction
    share: Fraction


@dataclass(frozen=True)
class Links:
    """``starts``: the frame at the beginning of each link. ``bodies``: the ``obstacles``, and then what is outside of a
    domain. ``spans``: of each link and body, up to the end or to where they meet, which ``touches`` says."""

    starts: Mapping[int, int]
    frames: Mapping[int, Trajectory]
    bodies: tuple[tuple[str, Body | Conditions], ...]
    obstacles: int
    spans: Mapping[Pair, tuple[Rectangle, ...]]
    touches: Mapping[Pair, Touch]

    @staticmethod
    def of(arm: Arm, joints: Trajectory, bodies: Sequence[tuple[str, Body | Conditions]], obstacles: int) -> Links:
        """Everything decided. Raises ``Unable``."""
        starts = {k: start for start, k in pairwise(arm.ends) if _moves(arm, start, k)}
        used = sorted({*starts, *starts.values()})
        frames = dict(zip(used, frames_of(arm, joints, NEAR, used), strict=True))
        spans, touches = dict[Pair, tuple[Rectangle, ...]](), dict[Pair, Touch]()
        found = Links(starts, frames, tuple(bodies), obstacles, spans, touches)
        for k, i in product(starts, range(len(bodies))):
            steps = list(found._followed(k, i))
            spans[k, i] = tuple(step for step in steps if isinstance(step, Rectangle))
            if isinstance(steps[-1], Touch):
                touches[k, i] = steps[-1]
        return found

    def _followed(self, k: int, i: int) -> Iterator[Rectangle | Touch]:
        """Rectangles on which a link is clear of a body, up to where it meets that. Raises ``Unable``."""
        body = self.bodies[i][1]
        for piece in range(len(self.frames[k].pieces)):
            sheet = self.sheets[k, piece]
            if isinstance(body, tuple):
                judge, touched = partial(sheet.judged, body), partial(sheet.touched, body)
            else:
                judge, touched = partial(_parted, sheet, body), partial(_touched, sheet, body)
            for step in sheet.followed(piece, judge, touched):
                if not isinstance(step, Rectangle):
                    yield Touch(piece, *step)
                    return
                yield step

    @cached_property
    def sheets(self) -> dict[Pair, Sheet]:
        """The points of each link in each piece."""
        ends = {k: [frame.curve(piece) for piece in range(len(frame.pieces))] for k, frame in self.frames.items()}
        pairs = ((k, zip(ends[start], ends[k], strict=True)) for k, start in self.starts.items())
        return {(k, piece): Sheet(pair, NEAR) for k, listed in pairs for piece, pair in enumerate(listed)}

    def time(self, pair: Pair) -> Fraction:
        """When a link meets a body."""
        touch, frame = self.touches[pair], self.frames[pair[0]]
        return frame.breaks[touch.piece] + frame.lengths[touch.piece] * touch.t

    # --- proof ------------------------------------------------------------------------------------------------
    def _clear(self) -> Iterator[tuple[str, Sheet, Conditions, Rectangle]]:
        """Of each rectangle: a label, and what its points are not in."""
        for (k, i), listed in self.spans.items():
            body = self.bodies[i][1]
            for part in listed:
                place = f"piece {part.piece} from {part.low} to {part.high}, share {part.first} to {part.last}"
                label = f"link {k}, {i}, {place}: {' '.join(map(str, part.normal))}"
                level = None if isinstance(body, tuple) else _level(body, part.normal)
                if level is None and not isinstance(body, tuple):
                    raise CertificateRejected(label, "no half-space with this normal holds the body")
                held = body if isinstance(body, tuple) else ((half_space(part.normal, level or ZERO),),)
                sheet = self.sheets[k, part.piece]
                yield label, sheet, sheet.widened(held, part), part

    def _touching(self) -> Iterator[tuple[str, CurveSentence, Fraction]]:
        """That links meet bodies, each at a time."""
        for pair, touch in self.touches.items():
            sheet, body = self.sheets[pair[0], touch.piece], self.bodies[pair[1]][1]
            if isinstance(body, tuple):
                pieces = sheet.around(body, (sheet.through(touch.share).point(touch.t),), 2)
            else:
                pieces = tuple(p.constraints for p in pieces_of(replace(body, radius=body.radius + 5 * NEAR)))
            systems = [[(dict(c.terms), c.relation) for c in piece] for piece in pieces]
            label = f"link {pair[0]} meets {pair[1]} in piece {touch.piece} at {touch.t}, share {touch.share}"
            yield label, CurveSentence(sheet.through(touch.share), systems, between=(touch.t, touch.t)), touch.t

    def members(self) -> Iterator[tuple[str, Certificate]]:
        """The proof. Raises ``Unable``."""
        yield from ((label, sheet.refuted(held, part)) for label, sheet, held, part in self._clear())
        yield from ((label, sentence.holds_at(t)) for label, sentence, t in self._touching())

    def stated(self, labels: Sequence[str]) -> list[Said]:
        """What a certificate with these labels has to say so that it proves this; nothing is searched for. Raises
        ``CertificateRejected``."""
        read = replace(self, spans=self._read(labels))
        for pair, spans in read.spans.items():
            count, touch = len(self.frames[pair[0]].pieces), self.touches.get(pair)
            for piece in range(count if touch is None else touch.piece + 1):
                end = ONE if touch is None or touch.piece > piece else touch.t
                if not cover([part for part in spans if part.piece == piece], end):
                    raise CertificateRejected(f"link {pair[0]}", "its intervals do not cover the time")
        said = [(label, sheet.sentence(held, part), FALSE) for label, sheet, held, part in read._clear()]
        return [*said, *((label, sentence.formula, TRUE) for label, sentence, _ in self._touching())]

    def _read(self, labels: Sequence[str]) -> dict[Pair, tuple[Rectangle, ...]]:
        """The rectangles that labels state. Raises ``CertificateRejected``."""
        spans = dict.fromkeys(self.spans, tuple[Rectangle, ...]())
        for label in dict.fromkeys(labels):
            matched = re.fullmatch(PLACE, label)
            if matched is None:
                continue
            k, i, piece, *ends = (stored.rational(text, label) for text in matched.groups()[:7])
            normal = stored.row(matched[8], label)
            pair, part = (int(k), int(i)), Rectangle(int(piece), ends[0], ends[1], ends[2], ends[3], normal)
            is_known = pair in spans and part.piece in range(len(self.frames[pair[0]].pieces))
            is_known = is_known and 0 <= part.low < part.high <= 1 and 0 <= part.first < part.last <= 1
            size = 0 if is_known and isinstance(self.bodies[pair[1]][1], tuple) else 3
            if not is_known or len(part.normal) != size or (size and not any(part.normal)):
                raise CertificateRejected(label, "no part of a piece, link, body or normal")
            spans[pair] += (part,)
        return spans

    # --- words ------------------------------------------------------------------------------------------------
    @property
    def lines(self) -> list[str]:
        """What is proved."""
        contacts, said = sorted(self.touches, key=self.time), "links, the segments between origins of frames:"
        result, pairs = list[str](), [pair for pair in self.spans if pair[1] < self.obstacles]
        if self.obstacles < len(self.bodies) and all(i < self.obstacles for _, i in contacts):
            result.append(f"{said} inside the domain for all t")
        if pairs and all(i >= self.obstacles for _, i in contacts):
            result.append(f"{said} clear of all obstacles, {len(pairs)} pairs")
        for pair in contacts:
            touch = self.touches[pair]
            point = self.sheets[pair[0], touch.piece].through(touch.share).point(touch.t)
            place, name = ", ".join(f"{float(c):.6g}" for c in point), self.bodies[pair[1]][0]
            when = f"first at the time {float(self.time(pair)):.10g}, at ({place})"
            result.append(f"link {pair[0]}: meets {name} (within {float(10 * NEAR):.1g} mm), {when}")
        return result

    def to_json(self) -> list[dict[str, Any]]:
        """Each link and obstacle, with exact times."""
        times = {pair: described(self.time(pair)) for pair in self.touches}
        return [{"link": k, "obstacle": self.bodies[i][0], "first contact": times.get((k, i))} for k, i in self.spans]


def _moves(arm: Arm, start: int, end: int) -> bool:
    """Whether the link between two frames has a length, and an end that moves."""
    rows = arm.rows[start:end]
    slides = any(row.joint is not None and row.joint.motion is JointKind.PRISMATIC for row in rows)
    return (slides or any(row.a or row.d for row in rows)) and not (is_fixed(arm, start) and is_fixed(arm, end))


def _parted(sheet: Sheet, body: Body, part: Rectangle) -> Rectangle | bool:
    """With the normal of a half-space that parts the link and a body on an interval, if there is one."""
    points, middle = sheet.corners(part), (part.low + part.high) / 2
    proposed = _normals(body, *(end.point(middle) for end in sheet.ends))
    return next((replace(part, normal=n) for n in proposed if _is_beyond(body, n, points)), False)


def _touched(sheet: Sheet, body: Body, t: Fraction, shares: Sequence[Fraction]) -> Fraction | None:
    """Where the link is as good as in a body."""
    share, away = _connection(body, *(end.point(t) for end in sheet.ends))
    return share if dot(away, away) <= (body.radius + 4 * NEAR) ** 2 else None


def _normals(body: Body, a: Vector, b: Vector) -> Iterator[Point]:
    """Across the shortest connection of a segment with a body, in whole numbers of more and more digits."""
    if isinstance(body, HalfSpaceBody):
        yield body.normal
        return
    away = _connection(body, a, b)[1]
    if most := max(map(abs, away)):
        yield from (tuple(Fraction(round(c * 2**digits / most)) for c in away) for digits in DIGITS)


def _connection(body: Body, a: Vector, b: Vector) -> tuple[Fraction, Point]:
    """About the shortest: where it divides a segment, and the vector to there from a point of the core."""
    a, b = (tuple(Fraction(round(c * FINE), FINE) for c in p) for p in (a, b))
    leg, low, high = subtract(b, a), ZERO, ONE
    if isinstance(body, Rounded):
        q = nearest(body.core.corners, (a, b))[0]
        low = min(max(Fraction(dot(subtract(q, a), leg)) / (dot(leg, leg) or 1), ZERO), ONE)
    else:  # along the segment the distance is convex
        while high - low > Fraction(1, FINE):
            p = _between(a, b, (low + high) / 2)
            ahead = dot(subtract(p, body.nearest(p)), leg) > 0
            low, high = (low, (low + high) / 2) if ahead else ((low + high) / 2, high)
        q = body.nearest(_between(a, b, low))
    share = Fraction(round(low * FINE), FINE)
    return share, subtract(_between(a, b, share), q)


def _between(a: Vector, b: Vector, share: Fraction) -> Point:
    return tuple(x + share * (y - x) for x, y in zip(a, b, strict=True))


def _level(body: Body, normal: Point) -> Fraction | None:
    """Of the half-space with this normal that holds a body and nearly touches it; None where there is none."""
    level = body.support(normal)
    return None if level is None else level + body.radius * root_above(Fraction(dot(normal, normal)), BITS)


def _is_beyond(body: Body, normal: Point, points: Sequence[Vector]) -> bool:
    """Whether points are beyond the half-space, with what the origins may be off to spare."""
    level = _level(body, normal)
    return level is not None and all(dot(normal, p) > level + 2 * NEAR * sum(map(abs, normal)) for p in points)
