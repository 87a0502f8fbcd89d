"""Checker for certificates of kind "inverse": all joint positions of an arm at a point or at a pose.

A point, three joints that turn or slide: ``qe.certify.three_joints``, an equation E in t, what the last joint is told
by, and perhaps a square root. ``roots``: intervals of t; the checker counts the roots of E in each (one) and encloses
the positions over it. Those over all listed roots have to be as many as there are in all, which Sturm's and Tarski's
theorems count over Q with square roots. With a ``rotation`` it is a pose: six joints with a spherical wrist, listed in
the same way, each position of the first three with those of the wrist; or three parallel axes, where square roots alone
tell all positions, in ``solutions`` (``qe.certify.inverse_pose``). Every position that was found has to lie in one of
the boxes, each of which holds one, and no two of which meet: so there are as many positions as boxes, one in each. An
empty list proves that there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from qe.certify.arithmetic.motions import Motion, Triple, back, image, is_motion
from qe.certify.arithmetic.nested_roots import Joint
from qe.certify.arithmetic.square_roots import ZERO, Interval
from qe.certify.arm_rows import Box, Chain, read_box, read_chain, read_circle, read_number, read_triple
from qe.certify.inverse_pose import centre, parallel_axes, wrist
from qe.certify.three_joints import Positions
from qe.errors import Unable
from qe.options import Budget
from qe.proof.entry import Entry, Json


def check_inverse(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    whole, budget = Entry(payload, "payload"), budget or Budget()
    if "roots" in payload:
        arm, point, turn, count, roots, rotation = whole.fields(
            "arm", "point", "turn", "count", "roots", optional=("rotation",)
        )
        chain = read_chain(arm)
        pose = _pose(rotation, read_triple(point)) if "rotation" in payload else None
        positions = _positions(chain, read_triple(point), pose, turn)
        boxes = _over_roots(chain, pose, positions, roots, budget)
    else:
        arm, point, rotation, count, solutions = whole.fields("arm", "point", "rotation", "count", "solutions")
        chain = read_chain(arm)
        found = parallel_axes(chain, _pose(rotation, read_triple(point)), whole, budget)
        boxes = _matched(found, [read_box(box, chain.turns) for box in solutions.items()], solutions)
    if len(boxes) != count.integer():
        raise count.fail("not the number of solutions")
    for one, other in combinations(boxes, 2):
        if all(max(a[0], b[0]) <= min(a[1], b[1]) for a, b in zip(one, other, strict=True)):
            raise whole.fail("two boxes meet")


def _pose(rotation: Entry, place: Triple) -> Motion:
    rows = [read_triple(row) for row in rotation.items()]
    if len(rows) != 3 or not is_motion(pose := ((rows[0], rows[1], rows[2]), place)):
        raise rotation.fail("expected the rows of a rotation")
    return pose


def _positions(chain: Chain, place: Triple, pose: Motion | None, turn: Entry) -> Positions:
    """Of the first three joints, which bring the end point or the centre of the wrist to its place."""
    constants = chain.constants
    if pose is None:
        if len(chain.turns) != 3:
            raise turn.fail("expected an arm with three joints")
        end = constants[3][1]
    else:
        heights = centre(chain)
        if heights is None:
            raise Unable("the last three axes do not meet in one point")
        end = image(constants[3], (ZERO, ZERO, heights[0]))
        place = image(pose, image(back(constants[6]), (ZERO, ZERO, heights[1])))
    if not chain.turns[2] and turn.value is not None:
        raise turn.fail("expected null: the third joint slides")
    return Positions.of(constants[:3], chain.turns, end, place, read_circle(turn) if chain.turns[2] else None, turn)


def _over_roots(chain: Chain, pose: Motion | None, positions: Positions, roots: Entry, budget: Budget) -> list[Box]:
    boxes, last, listed = list[Box](), list[Interval](), 0
    for entry in roots.items():
        budget.check()
        low, high, solutions = entry.fields("low", "high", "solutions")
        between = read_number(low), read_number(high)
        if not between[0] < between[1] or (last and between[0] <= last[-1][1]):
            raise entry.fail("expected intervals in ascending order")
        last.append(between)
        found = list(positions.at_root(between, entry))
        listed += len(found)
        if pose is not None:
            found = [[*arm, *rest] for arm in found for rest in wrist(chain, pose, arm, entry)]
        boxes += _matched(found, [read_box(box, chain.turns) for box in solutions.items()], solutions)
    if listed != positions.total():
        raise roots.fail("not all roots with a solution are listed")
    return boxes


def _matched(found: Sequence[Sequence[Joint]], boxes: list[Box], entry: Entry) -> list[Box]:
    """The boxes, if each of them holds one of the positions."""
    if len(found) != len(boxes):
        raise entry.fail("not the number of solutions")
    left = list(boxes)
    for position in found:
        ends = [part for joint in position for part in joint.intervals()]
        held = [box for box in left if all(a <= c and d <= b for (a, b), (c, d) in zip(box, ends, strict=True))]
        if not held:
            raise entry.fail("a solution is not proved to lie in a box of its own")
        left.remove(held[0])
    return boxes
