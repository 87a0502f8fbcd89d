"""Whether start and goal of a scene can be joined, with proof of either answer.

FREE: a polygonal path, or a chain of Bézier curves; for each segment or curve the sentence is refuted that for some t
its point is in an obstacle or outside the workspace.

BLOCKED: walls, which are in obstacles or outside the workspace, and two closed sets U and V, unions of convex
polytopes, with start in U and goal in V. THEOREM. Where every point of the workspace is in a wall, in U or in V, and
none that is in no wall is in both, no path within what is free leads from start to goal. PROOF. A path is the image of
an interval, which is connected; its parts in U and in V are closed in it, disjoint, together all of it, and neither is
empty. All of this but where start and goal are is said in sentences, proved by the engine and checked by the kernel.

BLOCKED, where formulas are curves or surfaces: polynomials of them, up to signs, all positive at one of start and goal
and one negative at the other. THEOREM. Where all zeros of the least of them in the workspace are in the way, no path is
free. PROOF. Along one the least is continuous, and would have a zero in between. That is a zero of one of them where
no other is negative: a sentence for each.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice, pairwise, product
from math import ceil

import qe
from bezier.curves.enclosure import root_above
from bezier.curves.scalar import dot, sign, subtract
from bezier.curves.sentences import said_of, verified
from bezier.input import stored
from bezier.obstacles.obstacle import Constraint
from bezier.obstacles.survey import clearance_certificate, meeting
from bezier.scenes.barrier import Wall, barrier, longer
from bezier.scenes.bound import LengthBound, least_length
from bezier.scenes.cells import Cell, FreeCells, Point, points_along
from bezier.scenes.region import decomposed, lines_through, seen_from
from bezier.scenes.scene import Scene
from bezier.scenes.sentences import Curve, cell_of, coordinates, covering, every, in_the_way, of_sides, surfaces, taken
from bezier.scenes.shortest import chains
from bezier.scenes.solid import Solid, directions, in_space
from qe import arguments
from qe.errors import BudgetExceeded, CertificateRejected, InputError, Unable
from qe.formula.build import atom, conj, disj, neg
from qe.formula.syntax import FALSE, Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate

CURVE, MOST_POINTS = "curve", 6
"""How labels about curves begin; control points of one."""
DIVIDED, DIVIDING = "where the polynomial is zero, and no other one negative, is in the way", 5.0
"""What is said of a divider; seconds in which it has to be proved."""
DISJOINT = "none beside the walls is on both sides"
PLANE_STEPS, SPACE_STEPS, MOST_WAYS = (1, 2, 3), (0, 1, 2, 3), 64
"""How fine the polytopes around round bodies are, one after the other: see ``directions``."""


@dataclass(frozen=True, slots=True)
class Route:
    """A path through free points with its proof: Bézier ``curves`` by their control points, segments where these are
    two. ``bound``: where a short path was asked for, what proves that none is shorter than ``at_least``."""

    scene: Scene
    curves: tuple[Curve, ...]
    certificate: Certificate | None
    bound: LengthBound | None = None

    blocked = False

    @property
    def points(self) -> tuple[Point, ...]:
        """The ends of the curves, from start to goal."""
        return (*(curve[0] for curve in self.curves), self.curves[-1][-1])

    @property
    def length(self) -> Fraction:
        """That of all control polygons, rounded up: the path is not longer."""
        legs = (subtract(b, a) for curve in self.curves for a, b in pairwise(curve))
        return sum((root_above(Fraction(dot(leg, leg)), 40) for leg in legs), Fraction(0))

    @property
    def at_least(self) -> Fraction | None:
        """No path from start to goal is shorter; None where no short path was asked for."""
        return None if self.bound is None else self.bound.value

    @property
    def longer(self) -> Fraction:
        """By what share the path may be longer than the shortest, as far as a bound shows."""
        return self.length / self.at_least - 1 if self.at_least else Fraction(0)

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is proved of surfaces, and of the length."""
        said = dict(surfaces(self.scene))
        return said if self.bound is None else said | self.bound.sentences

    @property
    def refuted(self) -> dict[str, Formula]:
        """What is refuted of each curve: that a point of it is not free."""
        said = map(meeting, map(in_space, self.curves), in_the_way(self.scene, self.curves))
        listed = dict(zip(_labels(self.curves), said, strict=True))
        if None in listed.values():
            raise CertificateRejected(CURVE, "a polynomial along it has too high a degree")
        return {label: s.formula for label, s in listed.items() if s is not None}

    @staticmethod
    def read(scene: Scene, certificate: Certificate) -> Route | None:
        """The path that the labels of a certificate state; None where they state none. Raises
        ``CertificateRejected``."""
        labels = [m.label for m in certificate.payload] if isinstance(certificate.payload, tuple) else []
        texts = (label.partition(": ") for label in labels if label.startswith(CURVE))
        curves = [tuple(stored.row(point, at) for point in text.split("; ")) for at, _, text in texts]
        if any(len(curve) not in range(2, MOST_POINTS + 1) for curve in curves):
            raise CertificateRejected(CURVE, f"expected 2 to {MOST_POINTS} control points")
        if any(len(point) != scene.dimension for curve in curves for point in curve):
            raise CertificateRejected(CURVE, f"expected {scene.dimension} coordinates")
        bound = LengthBound.read(scene, labels)
        return Route(scene, tuple(curves), certificate, bound) if curves else None

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene and the corners alone. Raises ``qe.CertificateRejected``."""
        if self.points[0] != self.scene.start or self.points[-1] != self.scene.goal:
            raise CertificateRejected("path", "it does not lead from start to goal")
        if any(a[-1] != b[0] for a, b in pairwise(self.curves)):
            raise CertificateRejected("path", "it jumps")
        if self.bound is not None and self.bound.scene != self.scene:
            raise CertificateRejected("length", "the bound is about another scene")
        verified(certificate or self.certificate, [*said_of(self.refuted, FALSE), *said_of(self.sentences)])

    def to_json(self) -> dict[str, object]:
        """The corners as texts of exact numbers, control points where it is curved; lengths as floats."""
        data: dict[str, object] = {"status": "free", "points": [list(map(str, p)) for p in self.points]}
        if self.is_curved:
            data["curves"] = [[list(map(str, p)) for p in curve] for curve in self.curves]
        data["length"] = float(self.length)
        return data if self.bound is None else data | {"no path is shorter than": float(self.at_least or 0)}

    @property
    def is_curved(self) -> bool:
        """Whether it has more than segments."""
        return any(len(curve) > 2 for curve in self.curves)

    def __str__(self) -> str:
        kind = ("curve" if self.is_curved else "segment") + "s" * (len(self.curves) > 1)
        lines = [f"free: a path of {len(self.curves)} {kind}, clear of all obstacles"]
        if self.bound is None:
            lines.append(" ".join("(" + ", ".join(map(str, p)) + ")" for p in self.points))
        else:
            least, more = float(self.at_least or 0), ceil(10000 * self.longer) / 100
            shorter = f"no path is shorter than {least:.6g} (gap {more:g}%)"
            lines.append(f"length at most {float(self.length):.6g}; {shorter}")
        return "\n".join(lines)


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
    divider: tuple[Constraint, ...] = ()
    """The least of their polynomials has no zero that is free, and other signs at start and goal; without walls."""

    blocked = True

    @property
    def sentences(self) -> dict[str, Formula]:
        """What is proved of the walls and the two sides."""
        at = coordinates(self.scene)
        if self.divider:
            said, bodies = dict[str, Formula](), self.scene.bodies
            # in the curve or surface of which of the polynomials each piece of a body lies, if in any
            thin = [
                [{d for d in self.divider if {d.terms, d.negated.terms} <= {c.terms for c in p}} for p in b.pieces]
                for b in bodies
            ]
            for k, c in enumerate(self.divider, start=1):
                beyond = (replace(other, strict=False).negated.formula(at) for other in self.divider if other != c)
                # other curves meet one in points, and so cover nothing of it
                is_curve = any(c in d for own in thin for d in own)
                near = [
                    b for b, own in zip(bodies, thin, strict=True) if not is_curve or any(c in d or not d for d in own)
                ]
                zero = taken(self.scene, near, at, 1)
                said[f"{DIVIDED} ({k})"] = every(at, disj((neg(atom(c.poly(at), Relation.EQ)), *beyond, zero)))
            return said | dict(surfaces(self.scene))
        walls = (cell_of(wall) for wall in self.walls)
        both = conj(disj(of_sides(cell.sides, at) for cell in side) for side in (self.start_side, self.goal_side))
        apart = every(at, disj((neg(both), *(of_sides(cell.sides, at) for cell in walls))))
        sides = (*self.start_side, *self.goal_side)
        cover = dict(covering(self.scene, self.around, self.walls, sides))
        return cover | {DISJOINT: apart} | dict(surfaces(self.scene))

    def check(self, certificate: Certificate | None = None) -> None:
        """Verify again, by the scene, the walls and the two sides alone. Raises ``qe.CertificateRejected``."""
        scene = self.scene
        if any(scene.blocked_at(p) is not None for p in (scene.start, scene.goal)):
            return
        if self.divider and not _divides(self.divider, scene):
            raise CertificateRejected("sides", "start and goal are on one side of the zeros")
        for side, point in ((self.start_side, scene.start), (self.goal_side, scene.goal)):
            if not self.divider and not any(cell.contains(point) for cell in side):
                raise CertificateRejected("sides", "start or goal is not on its side")
        verified(certificate or self.certificate, said_of(self.sentences))

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


@dataclass(frozen=True, slots=True)
class Wish:
    """A short path: the degree of its curves (1: segments) and how many derivatives are continuous. ``gap``: other ways
    are tried, MOST_WAYS at most, until the path is proved to be longer than the shortest by no more than this share."""

    degree: int = 3
    continuity: int = 1
    gap: Fraction | None = None

    def __post_init__(self) -> None:
        if self.degree not in range(1, 6) or self.continuity not in range(3):
            raise InputError(f"expected degree 1 to 5 and continuity 0 to 2, found {self.degree} and {self.continuity}")
        if 1 < self.degree <= self.continuity:
            raise InputError(f"continuity: expected one below the degree {self.degree}, found {self.continuity}")

    @staticmethod
    def of(degree: int, continuity: int, gap: object) -> Wish:
        """With a gap that is a number, or has a percent sign."""
        part, unit = (gap[:-1], 100) if isinstance(gap, str) and gap.endswith("%") else (gap, 1)
        try:
            value = None if gap is None else arguments.rational(part, "gap") / unit
        except InputError:
            value = Fraction(-1)
        if value is not None and value < 0:
            raise InputError(f"gap: expected a share such as 5% or 0.05, found {arguments.shown(gap)}")
        return Wish(degree, continuity, value)


def decided(scene: Scene, budget: Budget, *, proof: bool = True, wish: Wish | None = None) -> Route | Blocked:
    """A path with proof, or the proof that there is none; the same without a certificate where no ``proof`` is wanted.
    With a ``wish`` the path is short, and a bound for all paths is proved, too.

    The plane is decided completely, and polytopes in space. Raises ``Unable`` where a limit ends the work, and where in
    space only passages that are narrower than the finest polytopes around and within round bodies show are left.
    """
    for name, point in (("start", scene.start), ("goal", scene.goal)):
        why = scene.blocked_at(point)
        if why is not None:
            return Blocked(scene, Cell.box(scene.low, scene.high), (), (), (), f"the {name} is {why}", None)
    known = _divided(scene, budget) or _by_cells(scene, budget)
    known, proofs = _shortest(known, wish, budget) if wish is not None and isinstance(known, Route) else (known, [])
    if not proof:
        return known
    clear = [*cleared(known, budget)] if isinstance(known, Route) else []
    other = {k: sentence for k, sentence in known.sentences.items() if k not in dict(proofs)}
    return replace(known, certificate=Certificate.bundle([*clear, *proved(other, budget), *proofs]))


def checked(scene: Scene, certificate: Certificate) -> Route | Blocked:
    """What a certificate proves about a scene: the path that it states, or that there is none, whose two sides are
    found again. Raises ``CertificateRejected``."""
    known = Route.read(scene, certificate) or decided(scene, Budget(), proof=False)
    known.check(certificate)
    return replace(known, certificate=certificate)


def _labels(curves: Sequence[Curve]) -> list[str]:
    """Of the members about curves: their control points."""
    texts = ("; ".join(" ".join(map(str, point)) for point in curve) for curve in curves)
    return [f"{CURVE} {k}: {text}" for k, text in enumerate(texts, start=1)]


def _shortest(known: Route, wish: Wish, budget: Budget) -> tuple[Route, list[tuple[str, Certificate]]]:
    """A short path in place of one that is known, which stays where passages are too narrow for floating point."""
    scene, is_plane, short = known.scene, known.scene.dimension == 2, list[Route]()
    if scene.start == scene.goal:
        return replace(known, bound=LengthBound(scene)), []
    bound, proofs = least_length(scene, budget)
    for fine in (2, 1):
        parts = decomposed(scene, fine, budget, Fraction(1, 32 if is_plane else 4))
        found = chains(scene, parts.domain, parts.free, wish.degree, min(wish.continuity, wish.degree - 1))
        for curves in filter(None, islice(found, 1 if wish.gap is None else MOST_WAYS)):
            if wish.degree == 1:
                corners = (curves[0][0], *(curve[-1] for curve in curves))
                curves = tuple(pairwise(shortened(corners, scene.bodies)))
            short.append(replace(known, curves=curves, bound=bound))
            if wish.gap is not None and short[-1].longer <= wish.gap:
                break
        if short:
            break
    return min(short, key=lambda route: route.length, default=replace(known, bound=bound)), proofs


def _divides(conditions: Sequence[Constraint], scene: Scene) -> bool:
    """Whether all polynomials are positive at one of start and goal, and one is negative at the other."""
    ends = [min(sign(c.value((*point, 0)[:3])) for c in conditions) for point in (scene.start, scene.goal)]
    return min(ends) < 0 < max(ends)


def _divided(scene: Scene, budget: Budget, lines: Iterable[Constraint | None] = (None,)) -> Blocked | None:
    """By the polynomials that are seen from start or goal, with one of the lines, where the engine soon proves it."""
    ends = (scene.start, scene.goal) if scene.formulas else ()
    seen = [seen_from(scene, point) for point in ends]
    for line, (point, listed) in product(lines, zip(ends, seen, strict=True)):
        sides = [] if line is None else [replace(c, strict=False) for c in (line, line.negated)]
        chosen = (*listed, *(c for c in sides if c.value((*point, 0)[:3]) > 0))
        limit = Budget(DIVIDING)
        if chosen and _divides(chosen, scene):
            budget.check("sides of formulas")
            around, reason = Cell.box(scene.low, scene.high), "curves or surfaces of formulas separate start and goal"
            known = Blocked(scene, around, (), (), (), reason, None, chosen)
            if all(_is_true(said, limit) for said in known.sentences.values()):
                return known
    return None


def _by_cells(scene: Scene, budget: Budget) -> Route | Blocked:
    try:
        return (_in_plane if scene.dimension == 2 else _in_space)(scene, budget)
    except BudgetExceeded:
        raise
    except Unable:
        known = _divided(scene, budget, lines_through(scene, budget)) if scene.dimension == 2 else None
        if known is None:
            raise
        return known


def _is_true(said: Formula, limit: Budget) -> bool:
    remaining = limit.remaining() or 0
    return remaining > 0 and qe.eliminate(said, timeout=remaining, process=False).truth is True


def _in_plane(scene: Scene, budget: Budget) -> Route | Blocked:
    walls = barrier(scene)
    for fine in () if walls else PLANE_STEPS:
        parts = decomposed(scene, fine, budget)
        if (known := _joined(scene, parts.free)) is not None:
            return known
        if scene.formulas and (walls := barrier(parts.within)):
            owners = [dict.fromkeys(n for i in w.bodies for n in parts.numbers[i]) for w in walls]
            walls = longer(scene, tuple(replace(w, bodies=tuple(o)) for w, o in zip(walls, owners, strict=True)))
            break
    cells = list(map(cell_of, walls))
    result = _separated(scene, Cell.box(scene.low, scene.high), cells, walls, budget) if walls else None
    if result is None:
        raise Unable("undecided: a passage that only one point is wide, between a hole and the rim of the workspace")
    return result


def _in_space(scene: Scene, budget: Budget) -> Route | Blocked:
    is_round = scene.formulas or any(not body.is_polytope for body in (*scene.solids, *scene.domain))
    for fine in SPACE_STEPS if is_round else (0,):
        normals = directions(3, fine)
        parts = decomposed(scene, fine, budget)
        known: Route | Blocked | None = _joined(scene, parts.free)
        if known is None:
            walls = tuple(cell for body in parts.within.solids if (cell := body.inside(normals)) is not None)
            sides = [side for part in scene.domain for side in part.around(normals)]
            domain = Cell.within(scene.low, scene.high, sides)
            assert domain is not None
            known = _separated(scene, domain, walls, walls, budget)
        if known is not None:
            return known
    raise Unable("undecided: a way may lead between round bodies, narrower than the polytopes around them show")


def _joined(scene: Scene, free: FreeCells) -> Route | None:
    """A path through free cells."""
    start, goal = free.holding(scene.start), free.holding(scene.goal)
    if start is None or goal is None:
        return None
    before = free.reached(start)
    if goal not in before:
        return None
    points = shortened(points_along(free, free.way(before, goal), scene.start, scene.goal), scene.bodies)
    return Route(scene, tuple(pairwise(_simpler(points, scene))), None)


def _simpler(points: Sequence[Point], scene: Scene) -> list[Point]:
    """The corners with shorter numbers, as far as the path stays clear."""
    result = list(points)
    for k in range(1, len(result) - 1):
        for unit in (4, 10, 100, 1000, 10**5, 10**7):
            near = tuple(Fraction(round(c * unit), unit) for c in result[k])
            legs = (result[k - 1], near), (near, result[k + 1])
            inside = all(part.contains(near) for part in scene.domain)
            if inside and not any(body.meets(*leg) for body in scene.bodies for leg in legs):
                result[k] = near
                break
    return result


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


def cleared(known: Route, budget: Budget) -> Iterator[tuple[str, Certificate]]:
    """The proof that a curve is free, one after the other. Raises ``Unable``."""
    wholes = in_the_way(known.scene, known.curves)
    for label, curve, whole in zip(_labels(known.curves), known.curves, wholes, strict=True):
        budget.check("proof of the route")
        try:
            certificate = clearance_certificate(in_space(curve), whole)
        except InputError:
            certificate = None
        if certificate is None:
            raise Unable(f"not proved: {label}")
        yield label, certificate


def proved(sentences: dict[str, Formula], budget: Budget) -> list[tuple[str, Certificate]]:
    """A certificate for each sentence. Raises ``Unable``."""
    members = []
    for label, sentence in sentences.items():
        budget.check("proof of the route")
        answer = qe.eliminate(sentence, check=True, timeout=budget.remaining(), process=False)
        if answer.truth is not True or answer.guarantee is not qe.Guarantee.CHECKED or answer.certificate is None:
            raise Unable(f"not proved: {label} ({answer.reason or answer.truth})")
        members.append((label, answer.certificate))
    return members
