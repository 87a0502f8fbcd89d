"""Whether start and goal of a scene can be joined, with proof of either answer.

FREE: a polygonal path; for each segment a sentence in one variable says that it is clear of all obstacles and in the
workspace for all t.

BLOCKED: walls, which are in obstacles or outside the workspace, and two closed sets U and V, unions of convex
polytopes, with start in U and goal in V. THEOREM. Where every point of the workspace is in a wall, in U or in V, and
none that is in no wall is in both, no path within what is free leads from start to goal. PROOF. A path is the image of an interval,
which is connected; its parts in U and in V are closed in it, disjoint, together all of it, and neither is empty.
All of this but where start and goal are is said in sentences, proved by the engine and checked by the kernel.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from math import lcm

import qe
from bezier.curves.scalar import subtract
from bezier.obstacles.obstacle import Constraint
from bezier.scenes.barrier import Wall, barrier
from bezier.scenes.cells import Cell, FreeCells, Point, Side, opposite, points_along
from bezier.scenes.outlines import outlines
from bezier.scenes.scene import Scene
from bezier.scenes.solid import Solid, directions
from qe.certify.claims import is_about
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate

HELD, COVERED = "the workspace is in the polytope around it", "every point of it is in a wall, in U or in V"
DISJOINT = "none beside the walls is in both"
NAMES = ("x", "y", "z")
PLANE_STEPS, SPACE_STEPS = (1, 2, 3), (0, 1, 2, 3)
"""How fine the polytopes around round bodies are, one after the other: see ``directions``."""


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
        return {f"segment {k}": _clear(self.scene, a, b) for k, (a, b) in enumerate(pairwise(self.points), start=1)}

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene and the corners alone. Raises ``qe.CertificateRejected``."""
        if self.points[0] != self.scene.start or self.points[-1] != self.scene.goal:
            raise CertificateRejected("path", "it does not lead from start to goal")
        verified(certificate or self.certificate, self.sentences)

    def to_json(self) -> dict[str, object]:
        """The corners as texts of exact numbers."""
        return {"status": "free", "points": [list(map(str, p)) for p in self.points]}

    def __str__(self) -> str:
        shown = " ".join("(" + ", ".join(map(str, p)) + ")" for p in self.points)
        return f"free: a path of {len(self.points) - 1} segments, clear of all obstacles\n{shown}"


@dataclass(frozen=True, slots=True)
class Blocked:
    """No path: ``walls``, in obstacles and outside the workspace, divide a polytope ``around`` it into ``start_side``
    and ``goal_side``, unions of closed polytopes; all empty where start or goal is not free, which ``reason`` says.

    A wall is a segment in the plane; in space a polytope in one obstacle.
    """

    scene: Scene
    around: Cell
    walls: tuple[Wall, ...] | tuple[Cell, ...]
    start_side: tuple[Cell, ...]
    goal_side: tuple[Cell, ...]
    reason: str
    certificate: Certificate | None

    blocked = True

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is proved of the walls and the two sides."""
        return dict(_separate(self))

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene, the walls and the two sides alone. Raises ``qe.CertificateRejected``."""
        scene = self.scene
        if any(scene.blocked_at(p) is not None for p in (scene.start, scene.goal)):
            return
        for side, point, name in ((self.start_side, scene.start, "start"), (self.goal_side, scene.goal, "goal")):
            if not any(cell.contains(point) for cell in side):
                raise CertificateRejected("sides", f"the {name} is not on its side")
        verified(certificate or self.certificate, self.sentences)

    def to_json(self) -> dict[str, object]:
        """The two sides by the corners of their polytopes; why there are none where start or goal is not free."""
        sides = {"start side": self.start_side, "goal side": self.goal_side}
        return {
            "status": "blocked",
            "reason": self.reason,
            **{k: [[list(map(str, c)) for c in cell.corners] for cell in side] for k, side in sides.items()},
        }

    def __str__(self) -> str:
        return f"blocked: {self.reason}"


def decided(scene: Scene, budget: Budget, *, proof: bool = True) -> Route | Blocked:
    """A path with proof, or the proof that there is none; the same without a certificate where no ``proof`` is wanted.

    The plane is decided completely, and polytopes in space. Raises ``Unable`` where a limit ends the work, and where in
    space only passages that are narrower than the finest polytopes around and within round bodies show are left.
    """
    for name, point in (("start", scene.start), ("goal", scene.goal)):
        why = scene.blocked_at(point)
        if why is not None:
            return Blocked(scene, Cell.box(scene.low, scene.high), (), (), (), f"the {name} is {why}", None)
    known = (_in_plane if scene.dimension == 2 else _in_space)(scene, budget)
    return replace(known, certificate=proved(known.sentences, budget)) if proof else known


def _in_plane(scene: Scene, budget: Budget) -> Route | Blocked:
    walls = barrier(scene)
    if walls:
        cells = [wall_cell(wall) for wall in walls]
        result: Route | Blocked | None = _separated(scene, Cell.box(scene.low, scene.high), cells, walls, budget)
    else:
        result = next(filter(None, (_joined(scene, fine, budget) for fine in PLANE_STEPS)), None)
    if result is None:
        raise Unable("undecided: a passage that only one point is wide, between a hole and the rim of the workspace")
    return result


def _in_space(scene: Scene, budget: Budget) -> Route | Blocked:
    is_round = any(not body.is_polytope for body in (*scene.solids, *scene.domain))
    for fine in SPACE_STEPS if is_round else (0,):
        normals = directions(3, fine)
        known: Route | Blocked | None = _joined(scene, fine, budget)
        if known is None:
            walls = tuple(cell for body in scene.obstacles if (cell := _within(body, normals)) is not None)
            sides = [side for part in scene.domain for side in part.around(normals)]
            domain = Cell.within(scene.low, scene.high, sides)
            assert domain is not None
            known = _separated(scene, domain, walls, walls, budget)
        if known is not None:
            return known
    raise Unable("undecided: a way may lead between round bodies, narrower than the polytopes around them show")


def _within(body: Solid, normals: Sequence[Point]) -> Cell | None:
    return body.cell() if body.is_polytope else body.inside(normals)


def _joined(scene: Scene, fine: int, budget: Budget) -> Route | None:
    """A path outside of polytopes around the obstacles."""
    free = FreeCells.of(*outlines(scene, fine), budget)
    start, goal = free.holding(scene.start), free.holding(scene.goal)
    if start is None or goal is None:
        return None
    before = free.reached(start)
    if goal not in before:
        return None
    points = points_along(free, free.way(before, goal), scene.start, scene.goal)
    return Route(scene, shortened(points, scene.solids), None)


def shortened(points: Sequence[Point], obstacles: Sequence[Solid]) -> tuple[Point, ...]:
    """A polygonal path with as few of these corners as are met by looking from each as far ahead as the way is free."""
    kept, at = [points[0]], 0
    while at < len(points) - 1:
        ahead = len(points) - 1
        while ahead > at + 1 and any(body.meets(points[at], points[ahead]) for body in obstacles):
            ahead -= 1
        kept.append(points[ahead])
        at = ahead
    return tuple(kept)


def wall_cell(wall: Wall) -> Cell:
    """The segment as a flat cell."""
    (a, b), along = (wall.start, wall.end), subtract(wall.end, wall.start)
    across = -along[1], along[0]
    level, first, last = (
        sum(x * y for x, y in zip(n, p, strict=True)) for n, p in ((across, a), (along, a), (along, b))
    )
    line = across, Fraction(level)
    sides = (along, Fraction(last)), opposite((along, Fraction(first))), line, opposite(line)
    return Cell.of(sides, (a, b), is_flat=True)


def _separated(
    scene: Scene, domain: Cell, cells: Sequence[Cell], walls: tuple[Wall, ...] | tuple[Cell, ...], budget: Budget
) -> Blocked | None:
    """Both sides of walls that separate start and goal."""
    free = FreeCells.of(domain, cells, budget)
    start, goal = free.holding(scene.start), free.holding(scene.goal)
    if start is None or goal is None:
        return None
    seen = free.reached(start)
    if goal in seen:
        return None
    one, other = (tuple(c for i, c in enumerate(free.cells) if (i in seen) is wanted) for wanted in (True, False))
    return Blocked(scene, domain, walls, one, other, "the obstacles and the domain separate start and goal", None)


def proved(sentences: dict[str, Formula], budget: Budget) -> Certificate:
    """A certificate with a member for each sentence. Raises ``Unable``."""
    members = []
    for label, sentence in sentences.items():
        budget.check("proof of the route")
        answer = qe.eliminate(sentence, check=True, timeout=budget.remaining(), process=False)
        if answer.truth is not True or answer.guarantee is not qe.Guarantee.CHECKED or answer.certificate is None:
            raise Unable(f"not proved: {label} ({answer.reason or answer.truth})")
        members.append((label, answer.certificate))
    return Certificate.bundle(members)


def verified(certificate: Certificate | None, sentences: dict[str, Formula]) -> None:
    """Whether the members are proofs of just these sentences. Raises ``CertificateRejected``."""
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
def _clear(scene: Scene, a: Point, b: Point) -> Formula:
    """For all t in [0, 1] the point of the segment is outside every obstacle, and in the workspace."""
    return _along(a, b, lambda at, scale: neg(_taken(scene, scene.solids, at, scale)))


def _taken(scene: Scene, bodies: Sequence[Solid], at: Sequence[Poly], scale: int = 1) -> Formula:
    """That a point is in one of the bodies or outside the workspace."""
    outside = (neg(_inside(part, at, scale)) for part in scene.domain)
    return disj((*outside, *(_inside(body, at, scale) for body in bodies)))


def _along(a: Point, b: Point, said: Callable[[Sequence[Poly], int], Formula]) -> Formula:
    """For all t in [0, 1] what is ``said`` of the point of a segment: its coordinates are polynomials over a number."""
    ring = Ring.of(("t",))
    t = ring.var("t")
    within = conj((atom(t, Relation.GE), atom(t - 1, Relation.LE)))
    scale = lcm(*(c.denominator for c in (*a, *b)))
    at = [int((q - p) * scale) * t + int(p * scale) for p, q in zip(a, b, strict=True)]
    return forall(("t",), nnf(disj((neg(within), said(at, scale)))))


def _separate(known: Blocked) -> Iterator[tuple[str, Formula]]:
    """The sentences about the two sides, one about each wall that is no obstacle itself, one about the workspace."""
    scene = known.scene
    names = NAMES[: scene.dimension]
    ring = Ring.of(names)
    at = [ring.var(n) for n in names]

    def every(formula: Formula) -> Formula:
        return forall(names, nnf(formula))

    cells = [wall_cell(w) if isinstance(w, Wall) else w for w in known.walls]
    u, v = (disj(_of_sides(cell.sides, at) for cell in side) for side in (known.start_side, known.goal_side))
    walls = disj(_of_sides(cell.sides, at) for cell in cells)
    around = _of_sides(known.around.sides, at)
    yield HELD, every(disj((neg(conj(_inside(part, at) for part in scene.domain)), around)))
    yield COVERED, every(disj((neg(around), walls, u, v)))
    yield DISJOINT, every(disj((neg(u), neg(v), walls)))
    for k, wall in enumerate(known.walls, start=1):
        if isinstance(wall, Wall):
            bodies = [scene.solids[i] for i in wall.bodies]
            yield f"wall {k}", _along(wall.start, wall.end, partial(_taken, scene, bodies))
        elif not any(body.is_polytope and body.sides == wall.sides for body in scene.obstacles):
            inside = (_inside(body, at) for body in scene.obstacles if not body.is_polytope)
            yield f"wall {k}", every(disj((neg(_of_sides(wall.sides, at)), *inside)))


def _inside(body: Solid, at: Sequence[Poly], scale: int = 1) -> Formula:
    """That the point with the coordinates ``at`` over ``scale`` is in a body."""
    return disj(conj(_holds(c, at, scale) for c in piece) for piece in body.pieces)


def _holds(condition: Constraint, at: Sequence[Poly], scale: int) -> Formula:
    """A condition at a point, times the power of ``scale`` that makes its coefficients whole."""
    whole = lcm(*(c.denominator for _, c in condition.terms))
    total, degree = at[0] * 0, condition.degree
    for exponents, c in condition.terms:
        term = at[0] ** 0 * int(c * whole * scale ** (degree - sum(exponents)))
        for power, coordinate in zip(exponents, at, strict=False):
            term = term * coordinate**power
        total = total + term
    return atom(total, condition.relation)


def _of_sides(sides: Sequence[Side], at: Sequence[Poly]) -> Formula:
    conditions = []
    for n, c in sides:
        whole = lcm(c.denominator, *(x.denominator for x in n))
        total = at[0] ** 0 * -int(c * whole)
        for x, coordinate in zip(n, at, strict=True):
            total = total + int(x * whole) * coordinate
        conditions.append(atom(total, Relation.LE))
    return conj(conditions)
