"""Whether start and goal of a scene can be joined, with proof of either answer.

FREE: a polygonal path; for each segment a sentence in one variable says that it is clear of all obstacles for all t.
Where there are balls the path is looked for between boxes around them, in finer and finer slices.

BLOCKED: two sets U and V, unions of open boxes, with start in U and goal in V. THEOREM. Where every free point is in U
or V and none in both, no path within what is free leads from start to goal. PROOF. A path is the image of an interval,
which is connected; its parts in U and in V are open in it, disjoint, together all of it, and neither is empty.
The two sentences about all points are proved by the engine and checked by the kernel; the strict inequalities of U and
V are what makes them open. Balls count as boxes in them: that these lie in the ball, which is convex, is seen at their
corners.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from math import lcm

import qe
from bezier.scenes.cells import CellGrid, Open, segments, shortened, way
from bezier.scenes.scene import Point, Scene, Solid, SolidBall, SolidBox
from qe.certify.claims import is_about
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate

COVERED, DISJOINT = "every free point is in U or V", "no free point is in both"


@dataclass(frozen=True, slots=True)
class Route:
    """A polygonal path through free points, ``points`` its corners, with its proof."""

    scene: Scene
    points: tuple[Point, ...]
    certificate: Certificate | None

    blocked = False

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is proved of each segment."""
        return _clear(self.scene, self.points)

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene and the corners alone. Raises ``qe.CertificateRejected``."""
        if self.points[0] != self.scene.start or self.points[-1] != self.scene.goal:
            raise CertificateRejected("path", "it does not lead from start to goal")
        _verified(certificate or self.certificate, self.sentences)

    def to_json(self) -> dict[str, object]:
        """The corners as texts of exact numbers."""
        return {"status": "free", "points": [list(map(str, p)) for p in self.points]}

    def __str__(self) -> str:
        shown = " ".join("(" + ", ".join(map(str, p)) + ")" for p in self.points)
        return f"free: a path of {len(self.points) - 1} segments, clear of all obstacles\n{shown}"


@dataclass(frozen=True, slots=True)
class Blocked:
    """No path: the free points fall apart into those in ``start_side`` and in ``goal_side``, unions of open boxes; both
    empty where start or goal is not free, which ``reason`` says."""

    scene: Scene
    start_side: tuple[Open, ...]
    goal_side: tuple[Open, ...]
    reason: str
    certificate: Certificate | None
    walls: tuple[SolidBox, ...] = ()
    """Boxes within the obstacles, which separate them."""

    blocked = True

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is proved of the two sides."""
        return _apart(self.scene, self.walls, self.start_side, self.goal_side)

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene and the two sides alone. Raises ``qe.CertificateRejected``."""
        scene = self.scene
        if any(scene.blocked_at(p) is not None for p in (scene.start, scene.goal)):
            return
        for side, point, name in ((self.start_side, scene.start, "start"), (self.goal_side, scene.goal, "goal")):
            if not any(_inside(box, point) for box in side):
                raise CertificateRejected("sides", f"the {name} is not on its side")
        if not all(any(_holds(body, wall) for body in scene.obstacles) for wall in self.walls):
            raise CertificateRejected("walls", "one is not within an obstacle")
        _verified(certificate or self.certificate, self.sentences)

    def to_json(self) -> dict[str, object]:
        """The two sides as open boxes, and why there are none where start or goal is not free."""
        sides = {"start side": self.start_side, "goal side": self.goal_side}
        return {
            "status": "blocked",
            "reason": self.reason,
            **{k: [[list(map(str, c)) for c in box] for box in side] for k, side in sides.items()},
        }

    def __str__(self) -> str:
        return f"blocked: {self.reason}"


PLANE_STEPS, SPACE_STEPS = (2, 4, 8, 16, 32, 64), (2, 3, 4, 6)
"""Into how many slices balls are divided, one after the other, where there are any."""


def decided(scene: Scene, budget: Budget, *, proof: bool = True) -> Route | Blocked:
    """A path with proof, or the proof that there is none; the same without a certificate where no ``proof`` is wanted.

    Raises ``Unable`` where a limit ends the work, and where only passages between balls that are narrower than the
    finest slices are left.
    """
    for name, point in (("start", scene.start), ("goal", scene.goal)):
        why = scene.blocked_at(point)
        if why is not None:
            return Blocked(scene, (), (), f"the {name} is {why}", None)
    balls = [body.radius for body in scene.obstacles if isinstance(body, SolidBall)]
    every = (PLANE_STEPS if scene.dimension == 2 else SPACE_STEPS) if balls else (1,)
    for steps in every:
        known = _joined(scene, steps, budget) or _separated(scene, steps, budget)
        if known is not None:
            return replace(known, certificate=_proved(known.sentences, budget)) if proof else known
    widest = 2 * max(balls) / every[-1]
    raise Unable(f"undecided: a way may lead between balls through less than {widest}, the width of a slice")


def _joined(scene: Scene, steps: int, budget: Budget) -> Route | None:
    """A path outside of boxes around the obstacles."""
    boxes = [box for body in scene.obstacles for box in body.outer(steps)]
    if any(box.contains(p) for box in boxes for p in (scene.start, scene.goal)):
        return None
    cells = CellGrid.of(scene, boxes)
    start, goal = cells.place(scene.start), cells.place(scene.goal)
    seen, before = cells.reached(start, budget)
    if not seen[goal]:
        return None
    corners = shortened([cells.sample(p) for p in way(before, start, goal)], scene.obstacles)
    return Route(scene, corners, None)


def _separated(scene: Scene, steps: int, budget: Budget) -> Blocked | None:
    """Boxes within the obstacles that separate start and goal."""
    walls = tuple(box for body in scene.obstacles for box in body.inner(steps))
    cells = CellGrid.of(scene, walls)
    seen, _ = cells.reached(cells.place(scene.start), budget)
    if seen[cells.place(scene.goal)]:
        return None
    sides = cells.boxes(seen), cells.boxes(cells.free & ~seen)
    return Blocked(scene, *sides, "the obstacles and the domain separate start and goal", None, walls)


def _holds(body: Solid, box: SolidBox) -> bool:
    """Whether a convex body has all corners of a box, and so the box."""
    return all(body.contains(corner) for corner in product(*zip(box.low, box.high, strict=True)))


def _proved(sentences: dict[str, Formula], budget: Budget) -> Certificate:
    members = []
    for label, sentence in sentences.items():
        budget.check("proof of the route")
        answer = qe.eliminate(sentence, check=True, timeout=budget.remaining(), process=False)
        if answer.truth is not True or answer.guarantee is not qe.Guarantee.CHECKED or answer.certificate is None:
            raise Unable(f"not proved: {label} ({answer.reason or answer.truth})")
        members.append((label, answer.certificate))
    return Certificate.bundle(members)


def _verified(certificate: Certificate | None, sentences: dict[str, Formula]) -> None:
    """Whether the members are proofs of just these sentences."""
    if certificate is None:
        raise CertificateRejected("members", "there is no certificate")
    members = certificate.payload if isinstance(certificate.payload, tuple) else ()
    if [m.label for m in members] != list(sentences):
        raise CertificateRejected("members", f"expected {', '.join(sentences)}")
    for member, sentence in zip(members, sentences.values(), strict=True):
        verdict = qe.verify(member.certificate, formula=sentence)
        if not verdict.accepted or is_about(member.certificate, sentence) != TRUE:
            raise CertificateRejected(member.label, verdict.reason or "it does not say that the sentence is true")


# --- sentences ---------------------------------------------------------------------------------------
def _clear(scene: Scene, points: Sequence[Point]) -> dict[str, Formula]:
    """For each segment: for all t in [0, 1] it is outside every obstacle, and in the domain, which is convex."""
    ring = Ring.of(("t",))
    t, sentences = ring.var("t"), dict[str, Formula]()
    within = conj((atom(t, Relation.GE), atom(t - 1, Relation.LE)))
    for k, (a, b) in enumerate(segments(points), start=1):
        scale = lcm(*(c.denominator for c in (*a, *b)))
        at = [int((q - p) * scale) * t + int(p * scale) for p, q in zip(a, b, strict=True)]
        outside = conj(_outside(body, at, scale) for body in scene.obstacles)
        inside = neg(_outside(scene.domain, at, scale))
        sentences[f"segment {k}"] = forall(("t",), nnf(disj((neg(within), conj((outside, inside))))))
    return sentences


def _apart(scene: Scene, walls: Iterable[SolidBox], one: Iterable[Open], other: Iterable[Open]) -> dict[str, Formula]:
    names = ("x", "y", "z")[: scene.dimension]
    ring = Ring.of(names)
    at = [ring.var(n) for n in names]
    blocked = disj((_outside(scene.domain, at), *(neg(_outside(wall, at)) for wall in walls)))
    u, v = (disj(_within(box, at) for box in side) for side in (one, other))
    return {
        COVERED: forall(names, nnf(disj((blocked, u, v)))),
        DISJOINT: forall(names, nnf(disj((blocked, neg(u), neg(v))))),
    }


def _against(poly: Poly, number: Fraction, relation: Relation, scale: int = 1) -> Formula:
    """The polynomial over ``scale`` compared with a number."""
    bound = number * scale
    return atom(bound.denominator * poly - bound.numerator, relation)


def _outside(body: Solid, at: Sequence[Poly], scale: int = 1) -> Formula:
    """That the point with the coordinates ``at`` over ``scale`` is not in a body."""
    if isinstance(body, SolidBall):
        whole = lcm(body.radius.denominator, *(c.denominator for c in body.centre))
        parts = [whole * p - int(c * scale * whole) for p, c in zip(at, body.centre, strict=True)]
        square = sum((p * p for p in parts[1:]), parts[0] * parts[0])
        return atom(square - int((body.radius * scale * whole) ** 2), Relation.GT)
    below = (_against(p, a, Relation.LT, scale) for p, a in zip(at, body.low, strict=True))
    above = (_against(p, b, Relation.GT, scale) for p, b in zip(at, body.high, strict=True))
    return disj((*below, *above))


def _within(box: Open, at: Sequence[Poly]) -> Formula:
    above = (_against(p, a, Relation.GT) for p, a in zip(at, box[0], strict=True))
    below = (_against(p, b, Relation.LT) for p, b in zip(at, box[1], strict=True))
    return conj((*above, *below))


def _inside(box: Open, point: Point) -> bool:
    return all(a < c < b for a, c, b in zip(box[0], point, box[1], strict=True))
