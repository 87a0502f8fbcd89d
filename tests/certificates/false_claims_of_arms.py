"""Certificates about arms and about systems of equations, made at random, and what shows that a claim of theirs is
false: sines and cosines in floats, Newton's method, and the solutions and the motions found once more."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from math import cos, hypot, pi, sin
from typing import Any

import qe
from bezier.arm.continuous import continuous_motions
from bezier.arm.evidence import LIMITED, motions_certificate
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.reader import load_arm, read_arm
from bezier.curves.curve import Bezier
from qe.certify.verify import verify
from qe.errors import QEError, Unable
from qe.exact.algebraic import real_roots
from qe.exact.polynomial_system import solve_system
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Relation
from qe.groebner.evidence import solutions_certificate
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, formula_from_json
from tests.attacks.formulas import simple
from tests.certificates.false_claims import number
from tests.certificates.mutation import evidence_in
from tests.certificates.restated import is_stated

Data = dict[str, Any]
Vector = list[float]


# --- systems of equations -----------------------------------------------------------------------------
def solutions(rng: random.Random) -> Certificate | None:
    """Two equations in two variables, with conditions."""
    ring = Ring.of(("x", "y"))
    equations = [simple(rng, ring) * rng.choice((1, simple(rng, ring))) for _ in range(2)]
    relations = (Relation.GT, Relation.GE, Relation.NE)
    conditions = [(simple(rng, ring), rng.choice(relations)) for _ in range(rng.randint(0, 2))]
    if any(p.is_constant for p in (*equations, *(g for g, _ in conditions))):
        return None
    try:
        return solutions_certificate(equations, conditions, variables=range(2))
    except (PositiveDimensional, Unable):
        return None


def other_solutions(rng: random.Random, data: Data) -> bool:
    """Whether the list of solutions is another than that which is found, or the sentence another than of the list."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    ring = Ring.of(payload["order"])
    equations = [Entry(text, "").polynomial(ring) for text in payload["equations"]]
    conditions = [(Entry(text, "").polynomial(ring), Relation(sign)) for text, sign in payload["conditions"]]
    try:
        zeros = solve_system(equations, variables=range(ring.size))
    except PositiveDimensional:
        return False
    true = [
        [float(z.values[name].to_algebraic()) for name in ring.names]
        for z in zeros
        if all(r.holds(z.sign(g)) for g, r in conditions)
    ]
    if len(true) != len(payload["solutions"]):
        return True
    claimed = [[number(v, s["field"]) for v in s["values"]] for s in payload["solutions"]]
    return any(min(hypot(*(a - b for a, b in zip(c, t))) for t in true) > 1e-3 for c in claimed)


# --- the end point of an arm, in floats ----------------------------------------------------------------
def _angle(given: Any) -> tuple[float, float]:
    if isinstance(given, int):
        return cos(given * pi / 12), sin(given * pi / 12)
    return float(Fraction(given[0])), float(Fraction(given[1]))


def end_point(arm: Data, joints: Sequence[float]) -> Vector:
    """The end point: every row turns and slides along z, and along x."""
    values = iter(joints)
    moves: list[Callable[[Vector], Vector]] = []
    for row in arm["rows"]:
        q = next(values) if row["joint"] else 0.0
        (c, s), d = _angle(row["theta"]), float(Fraction(row["d"]))
        if row["joint"] == "revolute":
            c, s = c * cos(q) - s * sin(q), s * cos(q) + c * sin(q)
        elif row["joint"] == "prismatic":
            d += q
        (u, v), a = _angle(row["alpha"]), float(Fraction(row["a"]))
        along, across = partial(_along, c, s, d), partial(_across, u, v, a)
        moves += [across, along] if arm["convention"] == "modified" else [along, across]
    place = [0.0, 0.0, 0.0]
    for move in reversed(moves):
        place = move(place)
    return place


def _along(c: float, s: float, d: float, p: Vector) -> Vector:
    return [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] + d]


def _across(u: float, v: float, a: float, p: Vector) -> Vector:
    return [p[0] + a, u * p[1] - v * p[2], v * p[1] + u * p[2]]


def _newton(arm: Data, goal: Sequence[float], start: Sequence[float]) -> Vector | None:
    """Joint values near ``start`` with this end point."""
    q = list(start)
    for _ in range(25):
        here = end_point(arm, q)
        f = [a - b for a, b in zip(here, goal)]
        if hypot(*f) < 1e-10:
            return q
        columns = []
        for k in range(3):
            moved = [v + (1e-6 if i == k else 0.0) for i, v in enumerate(q)]
            columns.append([(a - b) / 1e-6 for a, b in zip(end_point(arm, moved), here)])
        whole = _determinant(columns)
        if abs(whole) < 1e-12:
            return None
        q = [v - _determinant([f if i == k else c for i, c in enumerate(columns)]) / whole for k, v in enumerate(q)]
    return None


def _determinant(m: Sequence[Sequence[float]]) -> float:
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


# --- branches ----------------------------------------------------------------------------------------
def branch(rng: random.Random) -> Certificate | None:
    """An arm of three joints that follows a line for a while, in one to three pieces."""
    rows = [
        {
            "a": str(rng.choice((0, 1, 1, 2))),
            "alpha": rng.choice((0, 6, 6, 4, ["3/5", "4/5"])),
            "d": str(rng.choice((0, 0, 1, 2))),
            "theta": rng.choice((0, 0, 6, ["3/5", "-4/5"])),
            "joint": rng.choice(("revolute", "revolute", "prismatic")),
        }
        for _ in range(3)
    ]
    arm = {"convention": rng.choice(("modified", "standard")), "rows": [*rows, {**rows[0], "joint": None}]}
    q = [rng.uniform(-2, 2) for _ in range(3)]
    start = [Fraction(round(v * 64), 64) for v in end_point(arm, q)]
    end = [v + Fraction(rng.randint(-6, 6), 64) for v in start]
    count = rng.randint(1, 3)
    pieces = []
    for low, high in pairwise(Fraction(k, count) for k in range(count + 1)):
        ends = []
        for s in (low, high):
            found = _newton(arm, [float(a + (b - a) * s) for a, b in zip(start, end)], q)
            if found is None:
                return None
            q = found
            ends.append([Fraction(round(v * 2**20), 2**20) for v in q])
        pieces.append(
            {
                "curve": 0,
                "low": str(low),
                "high": str(high),
                "centre": [str((a + b) / 2) for a, b in zip(*ends)],
                "slope": [str((b - a) / (high - low)) for a, b in zip(*ends)],
                "radius": [rng.choice(("1/8", "1/20", "1/50"))] * 3,
            }
        )
    curves = [[[str(v) for v in point] for point in (start, end)]]
    limits = [rng.choice((None, [str(Fraction(round((v + d) * 64), 64)) for d in (-1 / 8, 1 / 8)])) for v in q]
    payload: Any = {"arm": arm, "curves": curves, "limits": limits, "pieces": pieces}
    certificate = LIMITED.certificate(Entry(payload, "evidence"))
    return certificate if verify(certificate).accepted else None


def leaves_the_branch(rng: random.Random, data: Data) -> bool:
    """Whether a box holds no solution or several, or neighbouring ones different ones, or a joint breaks its limits."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    before: Vector | None = None
    for piece in payload["pieces"]:
        low, high = Fraction(piece["low"]), Fraction(piece["high"])
        for s in (low, (low + high) / 2, high):
            found = _in_box(payload["arm"], _on_curve(payload["curves"][piece["curve"]], s), piece, s)
            if found is None or (s == low and before is not None and hypot(*_minus(found, before)) > 1e-5):
                return True
            ends = zip(found, payload["limits"])
            if any(e is not None and not Fraction(e[0]) - 1e-6 < v < Fraction(e[1]) + 1e-6 for v, e in ends):
                return True
            before = found
    return False


def _on_curve(points: list[list[str]], t: Fraction) -> Vector:
    row = [[Fraction(c) for c in point] for point in points]
    while len(row) > 1:
        row = [[(1 - t) * a + t * b for a, b in zip(p, q, strict=True)] for p, q in pairwise(row)]
    return [float(v) for v in row[0]]


def _minus(left: Sequence[float], right: Sequence[float]) -> Vector:
    return [a - b for a, b in zip(left, right, strict=True)]


def _in_box(arm: Data, goal: Sequence[float], piece: Data, s: Fraction) -> Vector | None:
    """The one solution in a box, from several starting points; None where there is none, or more than one."""
    middle = (Fraction(piece["low"]) + Fraction(piece["high"])) / 2
    centre = [float(Fraction(c) + Fraction(v) * (s - middle)) for c, v in zip(piece["centre"], piece["slope"])]
    radius = [float(Fraction(r)) for r in piece["radius"]]
    found: list[Vector] = []
    for corner in ((0, 0, 0), *product((-0.7, 0.7), repeat=3)):
        q = _newton(arm, goal, [c + r * k for c, r, k in zip(centre, radius, corner)])
        if q is not None and all(abs(d) <= r * (1 + 1e-9) for d, r in zip(_minus(q, centre), radius)):
            found += [q] if all(hypot(*_minus(q, other)) > 1e-5 for other in found) else []
    return found[0] if len(found) == 1 else None


# --- joint positions at a point -------------------------------------------------------------------------
def inverse(rng: random.Random) -> Certificate | None:
    """The positions of the joints of an arm at a point."""
    arm = load_arm(rng.choice(("ev3-120", "shoulder-3r")))
    point = [Fraction(rng.randint(-200, 260), rng.choice((1, 1, 2, 7))) for _ in range(3)]
    try:
        return inverse_certificate(solve(arm, point))
    except Unable:
        return None


def other_positions(rng: random.Random, data: Data) -> bool:
    """Whether the boxes do not hold one solution each, of those that are found once more for the rows as they are."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    if any(d != 1 for c in payload["point"] for _, d in c):
        return False
    point = [sum((Fraction(q) for q, _ in c), Fraction(0)) for c in payload["point"]]
    boxes = [box for root in payload["roots"] for box in root["solutions"]]
    try:
        found = solve(read_arm(toml_of(payload["arm"])), point)
    except QEError:
        return False
    if found.count is None or found.count != payload["count"] or found.count != len(boxes):
        return found.count is not None
    true = [[v for angle in s.angles if angle is not None for v in (cos(angle), sin(angle))] for s in found.solutions]
    return any(sum(_holds(box, values) for values in true) != 1 for box in boxes)


def _holds(box: Any, values: Vector) -> bool:
    ends = [[float(Fraction(end)) for end in interval] for joint in box for interval in joint]
    return all(low - 1e-7 <= v <= high + 1e-7 for (low, high), v in zip(ends, values, strict=True))


def toml_of(arm: Data) -> str:
    """The text of an arm as a certificate holds it."""
    return "\n".join(_lines(arm))


def _lines(arm: Data) -> Iterator[str]:
    yield f'convention = "{arm["convention"]}"'
    for k, row in enumerate(arm["rows"]):
        yield "[[row]]"
        if row["joint"]:
            yield f'joint = "t{k}"'
            yield f'kind = "{row["joint"]}"'
        for name in ("a", "d"):
            yield f'{name} = "{row[name]}"'
        for name in ("alpha", "theta"):
            angle = row[name]
            yield (
                f'{name} = "{angle}*pi/12"'
                if isinstance(angle, int)
                else f'{name} = {{cos = "{angle[0]}", sin = "{angle[1]}"}}'
            )


MILLIMETRES = (-100, -30, -20, -10, 0, 0, 10, 20, 30, 50, 100)
HEIGHTS = (70, 100, 100, 130, 200)


def motions(rng: random.Random) -> Certificate | None:
    """One or two short curves near the axis and the inner borders."""
    arm = load_arm(rng.choice(("ev3-120", "shoulder-3r", "shoulder-3r", "cylindrical")))
    point = _point(rng)
    curves = {}
    for k in range(rng.choice((1, 1, 2))):
        points = [point, *(_point(rng) for _ in range(rng.choice((1, 1, 2))))]
        curves[str(k)], point = Bezier.of(points), points[-1]
    try:
        found = continuous_motions(arm, curves)
        return None if found is None else motions_certificate(found)
    except Unable:
        return None


def _point(rng: random.Random) -> tuple[int, int, int]:
    return rng.choice(MILLIMETRES), rng.choice(MILLIMETRES), rng.choice(HEIGHTS)


def other_motions(rng: random.Random, data: Data) -> bool:
    """Whether the numbers are others than those of the motions that are found."""
    if not is_stated(data):
        return True
    payload: Any = evidence_in(data)
    curves = {str(k): Bezier.of([tuple(map(Fraction, p)) for p in c]) for k, c in enumerate(payload["curves"])}
    ends = list(curves.values())
    if any(a.points[-1] != b.points[0] for a, b in pairwise(ends)):
        return True
    try:
        found = continuous_motions(read_arm(toml_of(payload["arm"])), curves)
    except QEError:
        return False
    if found is None:
        return False
    solutions = [len(arcs.labels) for arcs in found.arcs]
    through = [len(junction.passes) for junction in found.junctions]
    return bool([payload[key] for key in ("solutions", "through", "motions")] != [solutions, through, found.count])


GRID = tuple(Fraction(k, 2) for k in range(-6, 7))


def classification(rng: random.Random) -> Certificate | None:
    """A quadratic or cubic equation in x with one or two parameters, sometimes with a condition."""
    lead = rng.choice(("x^2", "x^3", "a*x^2"))
    middle = rng.choice(("a*x", "b*x", "2*x", "-x"))
    rest = rng.choice(("b", "1", "-a", "a - 1"))
    positive = [rng.choice(("x", "x - 1", "a + x"))] if lead == "x^2" and rng.random() < 0.3 else []
    try:
        found = qe.real_root_classification(
            [f"{lead} + {middle} + {rest}"], "x", positive=positive, process=False, check=True
        )
    except qe.Unable:
        return None
    return found.certificate


def other_numbers(rng: random.Random, data: Data) -> bool:
    """Whether at some point another class holds than that with the number of solutions there."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    if payload["constants"] or len(payload["variables"]) != 1 or len(payload["polynomials"]) != 1:
        return False
    names, (x,) = payload["parameters"], payload["variables"]
    ring, outer = Ring.of((*names, x)), Ring.of(names)
    poly = Entry(payload["polynomials"][0], "").polynomial(ring)
    sides = {key: [Entry(p, "").polynomial(ring) for p in payload[key]] for key in ("positive", "equal", "nonzero")}
    classes = [(count, formula_from_json(Entry(f, ""), outer)) for count, f in payload["classes"]]
    for _ in range(40):
        point = [rng.choice(GRID) for _ in names]
        here = dict(zip(names, point, strict=True))
        if any(_at(p, point) for p in sides["equal"]) or not all(_at(p, point) for p in sides["nonzero"]):
            continue
        holding = [count for count, f in classes if holds_at(f, here)]
        try:
            if holding != [_count(poly, sides["positive"], point)]:
                return True
        except ValueError:
            continue
    return False


def _at(poly: Poly, point: list[Fraction]) -> Poly:
    for k, value in enumerate(point):
        poly = poly.at_rational(k, value)
    return poly


def _count(poly: Poly, positive: list[Poly], point: list[Fraction]) -> int | None:
    """The number of roots at which the conditions hold; None where every number is one."""
    line = _at(poly, point)
    if not line:
        return None
    roots = [] if line.is_constant else real_roots(line.to_univariate(len(point)))
    return sum(all(_value(g, float(root), point) > 0 for g in positive) for root in roots)


def _value(poly: Poly, root: float, point: list[Fraction]) -> float:
    """The value at a root, about. ``ValueError`` where it may be 0."""
    coefficients = [int(c) for c in _at(poly, point).to_univariate(len(point)).coeffs()]
    value = sum(c * root**k for k, c in enumerate(coefficients))
    if abs(value) < 1e-6:
        raise ValueError("its sign is not clear")
    return value
