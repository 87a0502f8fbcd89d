"""Where may Q1 lie? The region of the first inner control point in formula (7), three cubic curves with C2 joins.

The curves stay in the ball of radius r if their six inner control points do; Q2 is quantified, and the others follow
from Q1 and Q2. Run with ``python examples/region_of_cubic.py [picture.png]``.
"""

import sys

import qe

Q0, R0, R_SQUARED = (-3, 2), (2, 2), 27
AXES = "xy"


def in_ball(*coordinates: str) -> str:
    """The condition that a point lies in the ball."""
    return " + ".join(f"({c})^2" for c in coordinates) + f" <= {R_SQUARED}"


conditions = [
    in_ball(*(f"4*({a}) - 4*q1{c} + q2{c}" for a, c in zip(Q0, AXES))),  # P1
    in_ball(*(f"2*({a}) - q1{c}" for a, c in zip(Q0, AXES))),  # P2
    in_ball(*(f"q1{c}" for c in AXES)),
    in_ball(*(f"q2{c}" for c in AXES)),
    in_ball(*(f"2*({b}) - q2{c}" for b, c in zip(R0, AXES))),  # R1
    in_ball(*(f"q1{c} - 4*q2{c} + 4*({b})" for b, c in zip(R0, AXES))),  # R2
]
body = " and ".join(conditions)

region = qe.region(f"ex q2x, q2y. {body}", order=("q1x", "q1y"))
print("Q1 = Q0 is possible  ", region.contains({"q1x": Q0[0], "q1y": Q0[1]}))
print("q1x from, to         ", *map(str, region.bounds("q1x")))
print("bounds are proved    ", all(qe.verify(c).accepted for c in region.bounds("q1x").certificates))
print("formula              ", region.formula)
print("cells                ", len(region.cells), "certificate:", qe.verify(region.certificate))
if len(sys.argv) > 1:
    region.plot(sys.argv[1])

# A plan, one coordinate after the other, each from the exact interval that is left.
plans = qe.region(body, order=("q1x", "q1y", "q2x", "q2y"))
chosen: dict[str, object] = {}
for name in plans.order:
    (interval,) = plans.fibre(chosen)
    chosen[name] = interval.simplest()
    print(f"{name} from {interval.lower} to {interval.upper}: {chosen[name]}")
print("a point of the region", plans.contains(chosen))
