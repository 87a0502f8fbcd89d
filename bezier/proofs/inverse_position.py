"""Rule "joint positions": all joint positions of an arm at a point or at a pose.

The sentence (``sentence``): there are positions, one in each of the boxes, and all solutions of the equations of the
arm (``bezier.proofs.arm_sentences``) are these. Where joints can be chosen: every solution lies in the boxes of one of
the families, or of the positions beside them, each of which is the only one there; and for which angles of the chosen
joints the others can follow.

A point, three joints that turn or slide: ``bezier.proofs.three_joints``, an equation E in t, what the last joint is
told by, and perhaps a square root. ``roots``: intervals of t; the checker counts the roots of E in each (one) and
encloses the positions over it. Those over all listed roots have to be as many as there are in all, which Sturm's and
Tarski's theorems count over Q with square roots. With a ``rotation`` it is a pose: six joints with a spherical wrist,
listed in the same way, each position of the first three with those of the wrist; or three parallel axes, where square
roots alone tell all positions, in ``solutions`` (``bezier.proofs.inverse_pose``). Every position that was found has
to lie in one of the boxes, each of which holds one, and no two of which meet: so there are as many positions as
boxes, one in each. An empty list proves that there is none. Families have no box for their free joints, and list
which of these can be chosen and for exactly which values (``bezier.proofs.families``); ``count`` is null then. Where
the third joint can be chosen alone, ``marks`` stands for ``roots``: intervals of t around the places where a sign may
change.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from bezier.proofs.arm_rows import ArmChain, read_chain, read_circle, read_triple
from bezier.proofs.arm_sentences import ArmEquations, constant, ring_of, with_roots
from bezier.proofs.families import Listed, Position, ascending, read_listed
from bezier.proofs.inverse_pose import centre, parallel_axes, wrist
from bezier.proofs.square_roots import ZERO, Motion, Triple, back, image, is_motion
from bezier.proofs.three_joints import Positions, is_still
from qe.errors import Unable
from qe.expert.sentences import Sentence, stated
from qe.formula.build import conj, disj, forall, implies
from qe.formula.syntax import TRUE
from qe.kernel.step import Limits
from qe.options import Budget
from qe.proof.entry import Entry


def check_positions(whole: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails."""
    chain, place, pose, count, turn, roots, marks, solutions = _read(whole)
    budget = limits.budget
    if roots.value is not None:
        listed = _over_roots(chain, pose, positions_of(chain, place, pose, turn), roots, budget)
    elif marks.value is not None:
        family = positions_of(chain, place, pose, turn).family(marks, budget)
        result = [family] if pose is None else list(wrist(chain, pose, family, marks))
        listed = _matched([p for p in result if () not in p.chosen.values()], chain, solutions)
    elif pose is not None:
        listed = _matched(parallel_axes(chain, pose, whole, budget), chain, solutions)
    else:
        raise whole.fail("expected roots, marks or a rotation")
    if any(one.chosen for one in listed):
        if count.value is not None:
            raise count.fail("expected null: a joint can be chosen")
    elif len(listed) != count.integer():
        raise count.fail("not the number of solutions")
    if any(one.meets(other) for one, other in combinations(listed, 2)):
        raise whole.fail("two boxes meet")
    return sentence(whole)


def sentence(evidence: Entry) -> Sentence:
    """That there are positions in the boxes, and no others."""
    chain, place, pose, _, _, roots, _, solutions = _read(evidence)
    if pose is None:
        equations = ArmEquations.at_point(chain, [constant(c) for c in place])
    else:
        equations = ArmEquations.at_pose(chain, pose)
    lists = [solutions]
    if roots.value is not None:
        lists = [root.fields("low", "high", "solutions")[2] for root in roots.items()]
    listed = [read_listed(entry, chain.turns) for boxes in lists for entry in boxes.items()]
    if any(arcs is not None and not chain.turns[k] for one in listed for k, arcs in one.chosen.items()):
        raise evidence.fail("expected arcs of joints that turn")
    if not any(one.chosen for one in listed):
        ring = ring_of([equations], len(listed))
        whole = equations.exactly(ring, len(listed), [one.boxes for one in listed])
    else:
        ring = ring_of([equations], max(1, *(2 * len(arcs or ()) for one in listed for arcs in one.chosen.values())))
        somewhere = disj(equations.within(ring, one.boxes) for one in listed)
        parts = [forall(equations.variables(), implies(equations.hold(ring), somewhere))]
        for one in listed:
            own = equations.family(ring, one.boxes, one.chosen) if one.chosen else equations.only(ring, one.boxes)
            parts.append(own)
        whole = conj(parts)
    return with_roots(ring, [equations], whole), TRUE


def _read(evidence: Entry) -> tuple[ArmChain, Triple, Motion | None, Entry, Entry, Entry, Entry, Entry]:
    """The arm, the point, the pose if there is a rotation; count, turn, roots, marks, solutions."""
    rest = ("rotation", "turn", "roots", "marks", "solutions")
    arm, point, count, rotation, *others = evidence.fields("arm", "point", "count", optional=rest)
    chain, place, pose = read_chain(arm), read_triple(point), None
    if rotation.value is not None:
        a, b, c = (read_triple(row) for row in rotation.row("x", "y", "z"))
        pose = (a, b, c), place
        if not is_motion(pose):
            raise rotation.fail("expected the rows of a rotation")
    turn, roots, marks, solutions = others
    return chain, place, pose, count, turn, roots, marks, solutions


def positions_of(chain: ArmChain, place: Triple, pose: Motion | None, turn: Entry) -> Positions:
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
    counts = chain.turns[2] and not is_still(chain.turns, end)
    if not counts and turn.value is not None:
        raise turn.fail("expected null: the third joint slides, or the point is on its axis")
    return Positions.of(constants[:3], chain.turns[:3], end, place, read_circle(turn) if counts else None, turn)


def _over_roots(
    chain: ArmChain, pose: Motion | None, positions: Positions, roots: Entry, budget: Budget
) -> list[Listed]:
    result, last, total = list[Listed](), None, 0
    for entry in roots.items():
        budget.check()
        low, high, solutions = entry.fields("low", "high", "solutions")
        last = ascending(entry, low, high, last)
        here = list(positions.at_root(last, entry))
        total += len(here)
        if pose is not None:
            here = [whole for arm in here for whole in wrist(chain, pose, arm, entry)]
        result += _matched(here, chain, solutions)
    if total != positions.total(roots):
        raise roots.fail("not all roots with a solution are listed")
    return result


def _matched(positions: Sequence[Position], chain: ArmChain, solutions: Entry) -> list[Listed]:
    """What is listed, if each holds one of the positions, or families."""
    listed = [read_listed(entry, chain.turns) for entry in solutions.items()]
    if len(positions) != len(listed):
        raise solutions.fail("not the number of solutions")
    rest = list(listed)
    for position in positions:
        held = next((one for one in rest if one.holds(position)), None)
        if held is None:
            raise solutions.fail("a solution is not proved to lie in a box of its own")
        rest.remove(held)
    return listed


RULE = stated(check_positions)
