"""Whether the links of an arm stay clear of obstacles for all t, or when and where one first meets one.

A link is the segment between the origins of neighbouring frames, those within one left out, unless both never move. The
origins are known as polynomials of the time, up to ``NEAR`` (``bezier.arm.tip``); bodies are wider by that.

THEOREM. Where a half-space holds a body, and the ends of a segment are not in it, the segment does not meet the body.
So on an interval of t it is enough that neither end is, which is a sentence about two curves. That the half-space holds
the body is exact code, which makes it from its normal alone.

A link also meets what is less than ``NEAR`` away, so the search ends: it halves intervals from left to right until a
plane across the shortest connection at their middle parts them, or a contact is at their left end.

That holds for convex bodies. For sets given by conditions see ``bezier.trajectories.sheets``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import groupby, pairwise
from typing import Any

from bezier.arm.model import Arm, JointKind
from bezier.arm.tip import frames_of, is_fixed
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import root_above
from bezier.curves.scalar import Vector, described, dot, subtract
from bezier.curves.sentences import CurveSentence, Said
from bezier.input import stored
from bezier.obstacles.bodies import Body, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, Piece, half_space, pieces_of
from bezier.obstacles.polyhedron import Point, nearest
from bezier.obstacles.survey import clearance_certificate, meeting
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.sheets import Conditions, Rectangle, Sheet, cover
from qe.errors import CertificateRejected, Unable
from qe.formula.syntax import FALSE, TRUE
from qe.proof.certificate import Certificate

NEAR = Fraction(1, 1 << 20)
"""How far (mm) the origins of frames may be from the polynomials that stand for them."""
SHORTEST = Fraction(1, 1 << 60)
"""Of an interval, as a part of a piece."""
FINE, DIGITS, BITS = 1 << 44, (10, 30, 60), 96
"""Denominator of places and shares that are tried; binary digits of normals, in turn; those of roots."""
ZERO, ONE, HALF = Fraction(0), Fraction(1), Fraction(1, 2)
Pair = tuple[int, int]
"""The number of a link, which is that of the frame at its end, and of a body."""


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """On this part of a piece no end of the link is in the half-space with this ``normal`` around a body."""

    piece: int
    low: Fraction
    high: Fraction
    normal: Point


@dataclass(frozen=True, slots=True)
class Touch:
    """At ``t`` in [0, 1] of a piece the point that divides the link in this ``share`` is at most ``NEAR`` from the
    body, which the link has not met before."""

    piece: int
    t: Fraction
    share: Fraction


@dataclass(frozen=True)
class Links:
    """``starts``: the frame at the beginning of each link. ``spans``: of each link and body, up to the end or to where
    they meet, which ``touches`` says."""

    starts: Mapping[int, int]
    frames: Mapping[int, Trajectory]
    bodies: tuple[tuple[str, Body | Conditions], ...]
    spans: Mapping[Pair, tuple[Span | Rectangle, ...]]
    touches: Mapping[Pair, Touch]

    @staticmethod
    def of(arm: Arm, joints: Trajectory, bodies: Sequence[tuple[str, Body | Conditions]]) -> Links:
        """Everything decided. Raises ``Unable``."""
        starts = {k: start for start, k in pairwise(arm.ends) if _moves(arm, start, k)}
        used = sorted({*starts, *starts.values()})
        frames = dict(zip(used, frames_of(arm, joints, NEAR, used), strict=True))
        spans, touches = dict[Pair, tuple[Span | Rectangle, ...]](), dict[Pair, Touch]()
        found = Links(starts, frames, tuple(bodies), spans, touches)
        for k, start in starts.items():
            part = cache(partial(_part, frames[start], frames[k]))
            for i, (_, body) in enumerate(bodies):
                count = len(frames[k].pieces)
                steps = list(found._along(k, body) if isinstance(body, tuple) else _followed(part, body, count))
                spans[k, i] = tuple(s for s in steps if not isinstance(s, Touch))
                if isinstance(steps[-1], Touch):
                    touches[k, i] = steps[-1]
        return found

    def _along(self, k: int, conditions: Conditions) -> Iterator[Rectangle | Touch]:
        """Rectangles on which a link is clear of a set, up to where it meets that. Raises ``Unable``."""
        for piece in range(len(self.frames[k].pieces)):
            for step in self._sheets[k, piece].followed(conditions, piece):
                if not isinstance(step, Rectangle):
                    yield Touch(piece, *step)
                    return
                yield step

    @cached_property
    def _sheets(self) -> dict[Pair, Sheet]:
        """The points of each link in each piece."""
        ends = {k: [frame.curve(piece) for piece in range(len(frame.pieces))] for k, frame in self.frames.items()}
        pairs = ((k, zip(ends[start], ends[k], strict=True)) for k, start in self.starts.items())
        return {(k, piece): Sheet(pair, NEAR) for k, listed in pairs for piece, pair in enumerate(listed)}

    def time(self, pair: Pair) -> Fraction:
        """When a link meets a body."""
        touch, frame = self.touches[pair], self.frames[pair[0]]
        return frame.breaks[touch.piece] + frame.lengths[touch.piece] * touch.t

    def through(self, pair: Pair) -> Bezier:
        """The curve of the point of the link that meets a body."""
        touch = self.touches[pair]
        ends = [self.frames[k].curve(touch.piece) for k in (self.starts[pair[0]], pair[0])]
        points = (end.elevate(max(e.degree for e in ends)).points for end in ends)
        return Bezier(tuple(_between(a, b, touch.share) for a, b in zip(*points, strict=True)))

    # --- proof ------------------------------------------------------------------------------------------------
    def _clear(self) -> Iterator[tuple[str, Bezier, Obstacle]]:
        """Of each origin and interval: a label, the curve, and the half-spaces that it is not in."""
        spans = ((pair, s) for pair, listed in self.spans.items() for s in listed if isinstance(s, Span))
        ends = ((k, pair, s) for pair, s in spans for k in (self.starts[pair[0]], pair[0]))
        listed = sorted((k, s.piece, s.low, s.high, pair, s.normal) for k, pair, s in ends)
        for (k, piece, low, high), group in groupby(listed, key=lambda entry: entry[:4]):
            entries = [entry[4:] for entry in group]
            said = "; ".join(f"{link} {i} {' '.join(map(str, normal))}" for (link, i), normal in entries)
            label = f"frame {k}, piece {piece} from {low} to {high}: {said}"
            sides = [(normal, _level(self._body(i), normal)) for (_, i), normal in entries]
            pieces = (Piece((half_space(n, level),)) for n, level in dict.fromkeys(sides) if level is not None)
            if any(level is None for _, level in sides):
                raise CertificateRejected(label, "no half-space with this normal holds the body")
            where = Obstacle(label, ObstacleKind.FORMULA, tuple(pieces))
            yield label, self.frames[k].curve(piece).segment(low, high), where

    def _body(self, i: int) -> Body:
        body = self.bodies[i][1]
        assert not isinstance(body, tuple)
        return body

    def _rectangles(self) -> Iterator[tuple[str, Sheet, Conditions, Rectangle]]:
        """Of each rectangle: a label, and what is said of it."""
        for (k, i), listed in self.spans.items():
            body = self.bodies[i][1]
            for part in listed:
                if isinstance(part, Rectangle) and isinstance(body, tuple):
                    place = f"piece {part.piece} from {part.low} to {part.high}, share {part.first} to {part.last}"
                    yield f"link {k}, {i}, {place}", self._sheets[k, part.piece], body, part

    def _touching(self) -> Iterator[tuple[str, CurveSentence, Fraction]]:
        """That links meet bodies, each at a time."""
        for pair, touch in self.touches.items():
            body = self.bodies[pair[1]][1]
            if isinstance(body, tuple):
                sheet = self._sheets[pair[0], touch.piece]
                pieces = sheet.around(body, (sheet.point(touch.t, touch.share),), 2)
            else:
                pieces = tuple(p.constraints for p in pieces_of(replace(body, radius=body.radius + NEAR)))
            systems = [[(dict(c.terms), c.relation) for c in piece] for piece in pieces]
            label = f"link {pair[0]} meets {pair[1]} in piece {touch.piece} at {touch.t}, share {touch.share}"
            yield label, CurveSentence(self.through(pair), systems, between=(touch.t, touch.t)), touch.t

    def members(self) -> Iterator[tuple[str, Certificate]]:
        """The proof. Raises ``Unable``."""
        for label, curve, where in self._clear():
            if (proof := clearance_certificate(curve, where)) is None:
                raise Unable("an interval has no certificate")
            yield label, proof
        yield from ((label, sheet.refuted(body, part)) for label, sheet, body, part in self._rectangles())
        yield from ((label, sentence.holds_at(t)) for label, sentence, t in self._touching())

    def stated(self, labels: Sequence[str]) -> list[Said]:
        """What a certificate with these labels has to say so that it proves this; nothing is searched for. Raises
        ``CertificateRejected``."""
        read = replace(self, spans=self._read(labels))
        for pair, spans in read.spans.items():
            count, touch = len(self.frames[pair[0]].pieces), self.touches.get(pair)
            for piece in range(count if touch is None else touch.piece + 1):
                end = ONE if touch is None or touch.piece > piece else touch.t
                whole = (Rectangle(s.piece, s.low, s.high) if isinstance(s, Span) else s for s in spans)
                if not cover([part for part in whole if part.piece == piece], end):
                    raise CertificateRejected(f"link {pair[0]}", "its intervals do not cover the time")
        said = list[Said]()
        for label, curve, where in read._clear():
            if (sentence := meeting(curve, where)) is None:
                raise CertificateRejected(label, "a polynomial along it has too high a degree")
            said.append((label, sentence.formula, FALSE))
        said += ((label, sheet.sentence(body, part), FALSE) for label, sheet, body, part in read._rectangles())
        return [*said, *((label, sentence.formula, TRUE) for label, sentence, _ in self._touching())]

    def _read(self, labels: Sequence[str]) -> dict[Pair, tuple[Span | Rectangle, ...]]:
        """The spans that labels state, of the ends of links, and the rectangles."""
        spans = dict.fromkeys(self.spans, tuple[Span | Rectangle, ...]())
        for label in dict.fromkeys(labels):
            for pair, part in _parts(label):
                is_known = pair in spans and isinstance(self.bodies[pair[1]][1], tuple) is isinstance(part, Rectangle)
                if not (is_known and 0 <= part.low < part.high <= 1 and part.piece < len(self.frames[pair[0]].pieces)):
                    raise CertificateRejected(label, "no part of a piece, link, body or normal")
                if isinstance(part, Rectangle) or label.startswith(f"frame {pair[0]},"):
                    spans[pair] += (part,)
        return spans

    # --- words ------------------------------------------------------------------------------------------------
    @property
    def lines(self) -> list[str]:
        """What is proved."""
        if not self.touches:
            return [f"links, the segments between origins of frames: clear of all obstacles, {len(self.spans)} pairs"]
        result = []
        for pair in sorted(self.touches, key=self.time):
            place = ", ".join(f"{float(c):.6g}" for c in self.through(pair).point(self.touches[pair].t))
            name, body = self.bodies[pair[1]]
            near = 10 * NEAR if isinstance(body, tuple) else 3 * NEAR
            said = f"link {pair[0]}: meets {name} (within {float(near):.1g} mm)"
            result.append(f"{said}, first at the time {float(self.time(pair)):.10g}, at ({place})")
        return result

    def to_json(self) -> list[dict[str, Any]]:
        """Each link and obstacle, with exact times."""
        times = {pair: described(self.time(pair)) for pair in self.touches}
        return [{"link": k, "obstacle": self.bodies[i][0], "first contact": times.get((k, i))} for k, i in self.spans]


def _parts(label: str) -> Iterator[tuple[Pair, Span | Rectangle]]:
    """What a label states of links and bodies. Raises ``CertificateRejected``."""
    on_link = r"link (\d{1,3}), (\d{1,3}), piece (\d{1,6}) from (\S+) to (\S+), share (\S+) to (\S+)"
    if matched := re.fullmatch(on_link, label):
        low, high, first, last = (stored.rational(text, label) for text in matched.groups()[3:])
        if not 0 <= first < last <= 1:
            raise CertificateRejected(label, "no part of a link")
        yield (int(matched[1]), int(matched[2])), Rectangle(int(matched[3]), low, high, first, last)
    elif matched := re.fullmatch(r"frame \d{1,3}, piece (\d{1,6}) from (\S+) to (\S+): (.*)", label):
        low, high = (stored.rational(text, label) for text in matched.groups()[1:3])
        for row in (stored.row(entry, label) for entry in matched[4].split("; ")):
            if len(row) != 5 or not any(row[2:]):
                raise CertificateRejected(label, "no part of a piece, link, body or normal")
            yield (int(row[0]), int(row[1])), Span(int(matched[1]), low, high, row[2:])


def _moves(arm: Arm, start: int, end: int) -> bool:
    """Whether the link between two frames has a length, and an end that moves."""
    rows = arm.rows[start:end]
    slides = any(row.joint is not None and row.joint.motion is JointKind.PRISMATIC for row in rows)
    return (slides or any(row.a or row.d for row in rows)) and not (is_fixed(arm, start) and is_fixed(arm, end))


def _part(first: Trajectory, last: Trajectory, piece: int, low: Fraction, high: Fraction) -> tuple[Bezier, Bezier]:
    return first.curve(piece).segment(low, high), last.curve(piece).segment(low, high)


def _followed(part: Callable[..., tuple[Bezier, Bezier]], body: Body, pieces: int) -> Iterator[Span | Touch]:
    """Intervals on which half-spaces part a link and a body, up to where they meet. Raises ``Unable``."""
    todo = [(piece, ZERO, ONE) for piece in reversed(range(pieces))]
    normal: Point | None = None
    while todo:
        piece, low, high = todo.pop()
        ends = part(piece, low, high)
        points = [p for curve in ends for p in curve.points]
        if normal is None or not _is_beyond(body, normal, points):  # the last one often does
            proposed = _normals(body, *(curve.point(HALF) for curve in ends))
            normal = next((n for n in proposed if _is_beyond(body, n, points)), None)
        if normal is not None:
            yield Span(piece, low, high, normal)
            continue
        share, away = _connection(body, *(curve.points[0] for curve in ends))
        if dot(away, away) <= (body.radius + NEAR / 2) ** 2:
            yield Touch(piece, low, share)
            return
        if high - low < SHORTEST:
            raise Unable("a link and an obstacle: neither apart nor together")
        middle = (low + high) / 2
        todo += [(piece, middle, high), (piece, low, middle)]


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
    level = _level(body, normal)
    return level is not None and all(dot(normal, p) > level for p in points)
