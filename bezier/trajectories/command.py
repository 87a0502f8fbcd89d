"""``bezier certify``: a trajectory of any origin against limits and a scene, for all t."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import qe
from bezier.arm.model import Arm
from bezier.arm.tip import tip_of
from bezier.curves.sentences import verified
from bezier.input import stored
from bezier.input.numbers import describe
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.clearance import Contact
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, Piece
from bezier.scenes.route import proved
from bezier.scenes.scene import Scene, load_table, read_scene
from bezier.scenes.sentences import beyond, surfaces
from bezier.trajectories.along import Along, arm_limits, load_path
from bezier.trajectories.evidence import members, stated
from bezier.trajectories.limits import Limit, Verdict, decided, in_words, to_json
from bezier.trajectories.links import NEAR, Links
from bezier.trajectories.piecewise import QUANTITIES, Trajectory
from bezier.trajectories.readers import load
from qe.errors import InputError, Unable
from qe.options import Budget
from qe.processes.channel import Channel

KEYS = (*QUANTITIES, *(f"{name}_norm" for name in QUANTITIES[1:]))


def limits_of(table: Table, axes: int) -> list[Limit]:
    """A table with ``velocity``, ``acceleration``, ``jerk``: one number, or a list of one for each axis;
    ``velocity_norm``, ...; and ``position``: a pair, or a list of one for each axis. Raises ``InputError``."""
    table.only(KEYS)
    listed = list[Limit]()
    for order, key in enumerate(QUANTITIES):
        raw = table.values.get(key)
        if raw is not None and not order:
            listed += (Limit(0, axis, high, low) for axis, (low, high) in enumerate(_pairs(table, raw, axes)))
        elif isinstance(raw, list):
            if len(raw) != axes:
                raise table.error(key, f"a number, or one for each of {axes} axes", describe(raw))
            parts = replace(table, values={f"{key}[{k}]": item for k, item in enumerate(raw)})
            listed += (Limit(order, k, parts.positive(f"{key}[{k}]")) for k in range(axes))
        elif raw is not None:
            listed += (Limit(order, axis, table.positive(key)) for axis in range(axes))
        if f"{key}_norm" in table.values:
            listed.append(Limit(order, None, table.positive(f"{key}_norm")))
    return listed


def _pairs(table: Table, raw: object, axes: int) -> list[tuple[Fraction, Fraction]]:
    listed = raw if isinstance(raw, list) and raw and isinstance(raw[0], list) else [raw] * axes
    if len(listed) != axes or not all(isinstance(pair, list) and len(pair) == 2 for pair in listed):
        raise table.error("position", f"a pair, or a pair for each of {axes} axes", describe(raw))
    pairs = [table.as_point(f"position[{k}]", pair, 2) for k, pair in enumerate(listed)]
    for low, high in pairs:
        if low > high:
            raise table.error("position", "the lower limit first", f"{low} before {high}")
    return [(low, high) for low, high in pairs]


def scene_of(table: Table, moving: Trajectory) -> Scene:
    """The scene of a table for a moving point; its ``start`` and ``goal`` are those of the point.
    Where vectors of obstacles have three entries it is in space, and the plane at the height 0. Raises ``InputError``.
    """
    if len(moving.names) not in (2, 3):
        raise InputError(f"--scene: expected a trajectory of 2 or 3 axes, found {len(moving.names)}")
    keys = ("centre", "low", "normal", "start")
    vectors = (entry.values.get(key) for entry in table.tables("obstacle") for key in keys)
    size = 3 if any(isinstance(v, list) and len(v) == 3 for v in vectors) else len(moving.names)
    ends = ((row, t) for row, t in ((moving.pieces[0], Fraction(0)), (moving.pieces[-1], moving.lengths[-1])))
    start, goal = ((*(p(t) for p in row), Fraction(0))[:size] for row, t in ends)
    return read_scene(table, (start, goal))


def in_the_way(scene: Scene, axes: int) -> tuple[list[Obstacle], list[Limit]]:
    """What is not free: a workspace that is a box gives limits of position, another one all that is outside."""
    obstacles, sides = [body.obstacle for body in scene.bodies], [side for part in scene.domain for side in part.sides]
    is_box = all(part.is_polytope for part in scene.domain) and all(sum(map(bool, n)) == 1 for n, _ in sides)
    if is_box and scene.dimension == axes:
        ends = enumerate(zip(scene.low, scene.high, strict=True)) if sides else ()
        return obstacles, [Limit(0, k, high, low) for k, (low, high) in ends]
    return [*obstacles, *outside(scene)], []


def outside(scene: Scene) -> list[Obstacle]:
    """What is outside of a workspace, if there is one."""
    pieces = tuple(map(Piece, beyond(scene)))
    return [Obstacle("the outside of the workspace", ObstacleKind.FORMULA, pieces)] if pieces else []


def certify(
    channel: Channel,
    file: Path,
    limits: Path | None,
    scene: Path | None,
    interpolation: str | None,
    tolerance: Fraction,
    *,
    robot: Arm | None = None,
    along: Path | None = None,
    within: Fraction = Fraction(0),
    evidence: bool = False,
    against: Path | None = None,
    page: bool = False,
) -> tuple[dict[str, Any], list[str], str, str]:
    """What to print, as data and as lines, the certificate's text where ``evidence`` is wanted, and the page with a
    chart of each quantity.

    ``against``: a certificate that is checked. Raises ``InputError``, ``Unable``, and ``CertificateRejected`` for that
    certificate.
    """
    trajectory = load(file, interpolation)
    listed = [] if limits is None else limits_of(Table.load(limits), len(trajectory.names))
    table = None if scene is None else load_table(scene)
    path = None if along is None else load_path(along, trajectory)
    try:
        judged = Certified.of(trajectory, listed, table, tolerance, robot, path, within)
        data, lines = judged.to_json(), judged.lines
    except OverflowError:
        raise InputError(f"{file}: expected quantities of usual size, found one beyond 10^308") from None
    if against is not None:
        judged.check(stored.certificate(against))
        lines.append("the certificate proves it: accepted")
    proof = judged.certificate.to_json() if evidence else ""
    return data, lines, proof, judged.page(file.name) if page else ""


@dataclass(frozen=True)
class Certified:
    """What is decided about a trajectory: its limits (``verdict``), each obstacle against each piece (``findings``;
    None where no ``scene`` was asked about), and its distance from a path (``along``)."""

    verdict: Verdict
    findings: tuple[survey.Finding, ...] | None
    along: Along | None = None
    scene: Scene | None = None
    links: Links | None = None
    """Of an arm in a scene, in place of findings."""

    @staticmethod
    def of(
        trajectory: Trajectory,
        limits: Sequence[Limit],
        table: Table | None,
        tolerance: Fraction,
        robot: Arm | None = None,
        path: Trajectory | None = None,
        within: Fraction = Fraction(0),
    ) -> Certified:
        """Everything decided, exactly; with a ``robot`` also the limits of its joints. ``table``: of a scene. Raises
        ``InputError`` and ``Unable``, and ``OverflowError`` for numbers beyond floats."""
        if robot is not None:
            limits = [*limits, *arm_limits(robot, trajectory)]
        scene, findings, links = None, None, None
        if table is not None and robot is not None:
            scene = scene_of(table, tip_of(robot, trajectory, NEAR))
            bodies = sorted(scene.bodies, key=lambda b: b.is_open)
            listed = [(b.name, b.pieces if b.body is None or b.is_open else b.body) for b in bodies]
            listed += ((o.name, tuple(p.constraints for p in o.pieces)) for o in outside(scene))
            links = Links.of(robot, trajectory, listed, sum(not b.is_open for b in bodies))
        elif table is not None:
            scene = scene_of(table, trajectory)
            obstacles, inside = in_the_way(scene, len(trajectory.names))
            limits = [*limits, *inside]
            curves = {f"piece {i + 1}": trajectory.curve(i) for i in range(len(trajectory.pieces))}
            findings = survey.survey(curves, obstacles, distances=False)
        near = None if path is None else Along.of(trajectory, path, within, robot)
        return Certified(decided(trajectory, limits, tolerance), findings, near, scene, links)

    @property
    def kept(self) -> bool:
        """Whether all limits hold, and the trajectory is clear of all obstacles and near the path, for all t."""
        return self.verdict.is_kept and self.clear and (self.along is None or self.along.is_kept)

    @property
    def clear(self) -> bool:
        """Whether no obstacle is met at any time."""
        return not survey.contacts(self.findings or ()) and (self.links is None or not self.links.touches)

    @property
    def slower_by(self) -> Fraction | None:
        """A factor of slowing down with which all limits are kept, proved, within 1e-6 of the least; 1 where they are
        kept as it is; None where going slower does not repair it."""
        return self.verdict.factor

    @property
    def lines(self) -> list[str]:
        """A line for each limit, each contact, and what follows."""
        lines, contacts = in_words(self.verdict), survey.contacts(self.findings or ())
        moved = self.verdict.trajectory
        times = {f"piece {i}": span for i, span in enumerate(zip(moved.breaks, moved.lengths, strict=False), start=1)}
        for f in contacts:
            start, length = times[f.name]
            time = start + length * sum(f.outcome.t) / 2 if isinstance(f.outcome, Contact) else start
            lines.append(f"{survey.in_words(f)}, at the time {float(time):.10g}")
        if self.findings and not contacts:
            lines.append(f"clear of all obstacles for all t: {len(self.findings)} pairs of pieces and obstacles")
        lines += [] if self.links is None else self.links.lines
        return lines if self.along is None else [*lines, self.along.line]

    def __str__(self) -> str:
        return "\n".join(self.lines)

    @property
    def certificate(self) -> qe.Certificate:
        """The proof of all that is said of limits, obstacles and a path; ``qe.verify`` checks it. Raises ``qe.Unable``
        where there is none: for what is not continuous, for instance."""
        verdict, near = self.verdict, () if self.along is None else self.along.members()
        links = () if self.links is None else self.links.members()
        return qe.Certificate.bundle([*(members(verdict) if verdict.outcomes else ()), *near, *links, *self._scene()])

    def check(self, certificate: qe.Certificate) -> None:
        """Whether a certificate proves just this. Raises ``CertificateRejected``."""
        said = [] if self.along is None else self.along.stated()
        if self.links is not None and isinstance(certificate.payload, tuple):
            said += self.links.stated([m.label for m in certificate.payload])
        verified(certificate, [*(stated(self.verdict) if self.verdict.outcomes else ()), *said], self._scene())

    def _scene(self) -> list[tuple[str, qe.Certificate]]:
        parts = [] if self.scene is None else proved(dict(surfaces(self.scene)), Budget())
        listed = survey.certificates(self.findings or ())
        if len(listed) < len(self.findings or ()):
            raise Unable("an obstacle has no certificate: touched at an irrational time, or of too high a degree")
        return [*listed, *parts]

    def page(self, title: str = "trajectory") -> str:
        """An HTML page with a chart of each quantity, and of each distance, over time."""
        from bezier.report.html import document
        from bezier.report.trajectory import page

        return document(page(self.verdict, self.lines, title, self.findings or (), along=self.along, links=self.links))

    def to_json(self) -> dict[str, Any]:
        """Everything, with exact numbers."""
        data = to_json(self.verdict)
        if self.findings is not None:
            data["scene"] = [survey.to_json(f) for f in self.findings]
        if self.links is not None:
            data["links"] = self.links.to_json()
        if self.along is not None:
            data["along"] = self.along.to_json()
        data["kept"] = self.kept
        return data
