"""Section 1: what the paper says of its references [7], [8] and [11], on which its earlier work rests."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from fractions import Fraction

import sympy

import qe
from bezier.arm.evidence import certificates
from bezier.arm.inverse import solve
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import wrapped
from bezier.arm.reader import load_arm, natural_spline
from bezier.arm.study import study
from bezier.curves.curve import Smoothness, join
from bezier.motion.timelaw import Law, TimeLaw
from paper_repro.ask import eliminated
from paper_repro.claim import Evidence, Fact, Table, Verdict, claim
from qe.exact.ring import format_poly

FAMILY = ("a*x - b", "b*y - a", "c*x^2 - y", "c*y^2 - x")
"""A system with parameters a, b, c of the literature on comprehensive Gröbner systems (Kapur, Sun, Wang 2010)."""
STOPS = ((10, 40, 80), (60, 70, 120), (90, 20, 150), (40, 100, 20))
HIGH = ((-300, 0, 166), (-240, 180, 166), (240, 180, 166), (300, 0, 166))
"""Points that the arm reaches, mm. The spline through the first ones stays in its reach, the other one leaves it."""
TWO_LINKS = "c1^2 + s1^2 = 1 and c2^2 + s2^2 = 1 and x = 2*c1 + c2 and y = 2*s1 + s2"


@claim(
    key="reference-7",
    place="Section 1, second paragraph; reference [7]",
    title="One comprehensive Gröbner system serves all points",
    says="The inverse kinematics are computed more efficiently with comprehensive Gröbner systems [7]: no basis has to "
    "be computed again for another point.",
    verdict=Verdict.REPRODUCED,
    finding="The segments cover all parameters, and at every point the basis of its segment is the Gröbner basis "
    "there. [7] itself asks for elements of the given ideal (here: faithful) and calls them a comprehensive Gröbner "
    "basis. How much is saved for the arm is the claim on both methods below.",
    rests_on=("arm-two-methods",),
)
def comprehensive() -> Iterator[Evidence]:
    """The faithful system of a family with three parameters: every element is in the ideal for all parameters at once.
    At the 64 points with coordinates $-1, 0, 1, 2$ the basis of the system is compared with the one computed there;
    each point lies in one segment only."""
    found = qe.comprehensive_groebner(FAMILY, ["x", "y"], faithful=True)
    rows = [(str(found.condition(s)), ", ".join(map(format_poly, s.basis))) for s in found.segments]
    yield Table(("segment", "basis"), rows)
    names = sympy.symbols("x y a b c")
    basis = sympy.groebner([sympy.sympify(p.replace("^", "**")) for p in FAMILY], *names).exprs
    elements = [sympy.sympify(format_poly(p).replace("^", "**")) for s in found.segments for p in s.faithful or ()]
    inside = bool(elements) and all(sympy.reduced(p, basis, *names, order="lex")[1] == 0 for p in elements)
    yield Fact(f"the {len(elements)} faithful elements lie in the ideal (SymPy)", inside)
    points = list(itertools.product(range(-1, 3), repeat=3))
    same, once = [], []
    for point in points:
        values = dict(zip(found.parameters, point, strict=True))
        numbers = [_put(p, values) for p in FAMILY]
        (alone,) = qe.comprehensive_groebner(numbers, ["x", "y"]).segments
        same.append({str(p) for p in found.basis_at(point)} == {str(p) for p in alone.basis})
        here = " and ".join(f"{name} = {value}" for name, value in values.items())
        once.append(sum(qe.decide(f"ex a, b, c. {here} and ({found.condition(s)})") for s in found.segments) == 1)
    yield Fact(f"the bases agree at all {len(points)} points", all(same))
    yield Fact("each of them lies in exactly one segment", all(once))


def _put(polynomial: str, values: dict[str, int]) -> str:
    return "".join(f"({values[c]})" if c in values else c for c in polynomial)


@claim(
    key="reference-8",
    place="Section 1, second paragraph; reference [8]",
    title="Quantifier elimination by comprehensive Gröbner systems certifies that there are solutions",
    says="Real quantifier elimination based on comprehensive Gröbner systems (CGS-QE, [8]) certifies the existence of "
    "solutions of inverse kinematic problems.",
    verdict=Verdict.REPRODUCED,
    finding="The method is one of the engine's (cgs), with the signatures of trace forms instead of the characteristic "
    "polynomials of [8]. It gives the exact conditions, and the number of solutions as formulas. For the EV3 arm the "
    "existence is proved along whole paths in the claims on it below.",
    rests_on=("arm-four-solutions",),
)
def by_systems() -> Iterator[Evidence]:
    """The method alone eliminates the joints of an arm of two links of lengths 2 and 1, and the unknowns of two other
    systems; the answers must be equivalent to what is known. The numbers of solutions are compared at points."""
    links = f"ex c1, s1, c2, s2. {TWO_LINKS}"
    yield eliminated("two links reach $(x, y)$ exactly if", links, "1 <= x^2 + y^2 and x^2 + y^2 <= 9", "cgs")
    yield eliminated("a line meets the circle", "ex x, y. x^2 + y^2 = 1 and y = a*x + b", "b^2 <= a^2 + 1", "cgs")
    positive = "b < 0 or a < 0 and 4*a^3 + 27*b^2 <= 0"
    yield eliminated("a cubic has a positive root", "ex x. x^3 + a*x + b = 0 and x > 0", positive, "cgs")
    sides = [part.split(" = ") for part in TWO_LINKS.split(" and ")]
    counted = qe.real_root_classification([f"{a} - ({b})" for a, b in sides], ["c1", "s1", "c2", "s2"])
    places = (((0, 2), 2), ((3, 0), 1), ((1, 0), 1), ((2, 3), 0), ((Fraction(1, 2), 0), 0))
    right = all(counted.at(place) == n for place, n in places)
    yield Fact("two, one or no solutions inside, on and outside the borders", right)


@claim(
    key="reference-11",
    place="Section 1, third paragraph; reference [11]",
    title="Spline paths for the arm, with the least sum of joint changes",
    says="With cubic splines the end effector moves smoothly [11]; whether the arm can follow is tested by CGS-QE, "
    "and its joints are chosen by a shortest path that minimises the sum of joint changes.",
    verdict=Verdict.REPRODUCED,
    finding="All three, exactly: a natural cubic spline through four points joins $C^2$; the arm can follow it for "
    "every parameter, with certificates; the joint sequence has the least sum of all. And the extra test is needed: of "
    "another spline, whose four points can be reached, it gives the exact part that cannot.",
    rests_on=("spline-leaves",),
)
def spline_paths() -> Iterator[Evidence]:
    """The sequence of least change at six moments is compared with all $4^6$ sequences of joint positions. No points
    of [11] are published; these are our own."""
    arm = load_arm("ev3-120")
    inside, outside = (natural_spline([tuple(map(Fraction, p)) for p in stops]) for stops in (STOPS, HIGH))
    smooth = [join(a, b).smoothness for a, b in itertools.pairwise(inside)]
    yield Fact("the spans join $C^2$", all(s is Smoothness.C2 for s in smooth))
    spans = {f"span {k}": span for k, span in enumerate(inside, start=1)}
    plan = joint_plan(arm, spans, TimeLaw.of(Law.QUINTIC), Fraction(50), 6)
    accepted = all(qe.verify(c).accepted for _, c in certificates(plan.path))
    yield Fact("the arm can follow the whole spline in one motion, certificates accepted", plan.is_proved and accepted)
    assert plan.sequence is not None, "it is proved"
    layers = [
        [solution.angles for solution in solve(arm, inside[sample.curve].point(sample.s)).solutions]
        for sample in plan.sequence.samples
    ]
    turns = [[[_turn(a, b) for b in far] for a in near] for near, far in itertools.pairwise(layers)]
    sums = [
        sum(turn[i][j] for turn, (i, j) in zip(turns, itertools.pairwise(way), strict=True))
        for way in itertools.product(*(range(len(layer)) for layer in layers))
    ]
    change = plan.sequence.change
    yield Fact(f"{len(sums)} sequences: the least sum is {change:.6f} rad", abs(min(sums) - change) < 1e-9)
    reached = all(solve(arm, stop).is_reachable for stop in HIGH)
    yield Fact("the arm reaches all four points of the second spline", reached)
    stretches = study(arm, outside[0]).stretches
    rows = [(f"{float(s.low):.6f}", f"{float(s.high):.6f}", str(s.count)) for s in stretches]
    yield Table(("first span of the second spline, from s", "to s", "solutions"), rows)
    yield Fact("but not the spline between them", [s.count for s in stretches] == [2, 0, 2])


def _turn(start: Sequence[float | None], end: Sequence[float | None]) -> float:
    """The sum of the joint changes; no angle is free at these points."""
    return sum(abs(wrapped(b - a)) for a, b in zip(start, end, strict=True) if a is not None and b is not None)


CLAIMS = (comprehensive, by_systems, spline_paths)
