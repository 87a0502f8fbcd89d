"""Projections cut out of space against those by Fourier's elimination; cones against the half-spaces that made them."""

import random
from fractions import Fraction
from itertools import combinations

import pytest

from experiments.suites.linear import projection
from qe.convex import shadow as module
from qe.convex.cone import Cone, dot
from qe.convex.polyhedron import HalfSpace, Polyhedron
from qe.convex.shadow import shadow
from qe.exact.linear_bounds import LinearBounds
from qe.io.text import read


def nothing():
    return None


def random_row(rng, size, strict=False):
    row = {j: rng.choice([-3, -2, -1, 1, 2, 3, 10**9]) for j in rng.sample(range(size), rng.randint(1, min(3, size)))}
    return HalfSpace.of(row, Fraction(rng.randint(-6, 4), rng.choice([1, 1, 2, 10**9])), strict)


def random_polyhedron(rng):
    """Empty, flat, unbounded and half open ones among them."""
    size = rng.randint(2, 6)
    halves = [random_row(rng, size, strict=rng.random() < 0.3) for _ in range(rng.randint(1, 9))]
    if rng.random() < 0.3:
        h = rng.choice(halves)
        halves.append(HalfSpace(tuple((j, -c) for j, c in h.normal), -h.constant, rng.random() < 0.2))
    equations = tuple(random_row(rng, size) for _ in range(rng.choice([0, 0, 0, 1])))
    return Polyhedron(size, equations, tuple(halves)), rng.sample(range(size), rng.randint(1, size - 1))


def implies(polyhedron, other):
    rows = list(other.halves)
    for e in other.equations:
        rows += [e, HalfSpace(tuple((j, -c) for j, c in e.normal), -e.constant, False)]
    for row in rows:
        beyond = HalfSpace(tuple((j, -c) for j, c in row.normal), -row.constant, not row.strict)
        together = Polyhedron(polyhedron.size, polyhedron.equations, (*polyhedron.halves, beyond))
        if together.irredundant(nothing) is not None:
            return False
    return True


def both(monkeypatch, polyhedron, columns):
    shadows = []
    for growth in (-(10**9), 10**9):
        monkeypatch.setattr(module, "_GROWTH", growth)
        shadows.append(shadow(polyhedron, columns, nothing))
    return shadows


def test_cut_out_or_eliminated_the_shadow_is_the_same(monkeypatch):
    rng, empty = random.Random(11), 0
    for _ in range(250):
        cut_out, eliminated = both(monkeypatch, *random_polyhedron(rng))
        if cut_out is None or eliminated is None:
            assert cut_out is None and eliminated is None
            empty += 1
        else:
            assert implies(cut_out, eliminated) and implies(eliminated, cut_out)
    assert 20 < empty < 200


def test_a_corner_that_does_not_belong_to_a_shadow(monkeypatch):
    """x + y < 2 bounds no side of the square, and is needed all the same."""
    rows = [({0: 1}, -1, False), ({1: 1}, -1, False), ({0: 1, 1: 1, 2: 1}, -2, False), ({2: -1}, 0, True)]
    polyhedron = Polyhedron(3, (), tuple(HalfSpace.of(*row) for row in rows))
    for projected in both(monkeypatch, polyhedron, [2]):
        assert HalfSpace.of({0: 1, 1: 1}, -2, True) in projected.halves and len(projected.halves) == 3


@pytest.mark.parametrize("wrong", [lambda self: [], lambda self: [(i, Fraction(i)) for i in range(2)]])
def test_a_contradiction_that_is_none_gives_no_wrong_shadow(monkeypatch, wrong):
    monkeypatch.setattr(LinearBounds, "contradiction", wrong)
    monkeypatch.setattr(module, "_GROWTH", -(10**9))
    polyhedron = Polyhedron(2, (), (HalfSpace.of({0: 1, 1: 1}, 0, False), HalfSpace.of({0: 1, 1: -1}, 0, False)))
    with pytest.raises(ArithmeticError):
        shadow(polyhedron, [1], nothing)


def test_generators_of_a_cone_are_its_extreme_rays():
    rng = random.Random(12)
    for _ in range(100):
        size, cone = rng.randint(2, 4), None
        cuts = [tuple(rng.randint(-2, 2) for _ in range(size)) for _ in range(rng.randint(1, 6))]
        cone = Cone(size)
        for cut in cuts:
            cone.cut(cut)
        for v in cone.generators():
            assert any(v) and all(dot(cut, v) <= 0 for cut in cuts)
        for u, v in combinations(cone.rays, 2):
            assert u != v
        for point in (tuple(rng.randint(-3, 3) for _ in range(size)) for _ in range(20)):
            assert all(dot(cut, point) <= 0 for cut in cuts) is generated(cone, point)


def generated(cone, point):
    """Whether a point is a sum of nonnegative multiples of the generators."""
    bounds = LinearBounds()
    weights = []
    for _ in cone.generators():
        weights.append(bounds.variable())
        bounds.at_least(weights[-1], Fraction(0), strict=False, reason=None)
    for k, value in enumerate(point):
        row = {w: v[k] for w, v in zip(weights, cone.generators(), strict=True) if v[k]}
        if not row:
            if value:
                return False
            continue
        x = bounds.form(row)
        if bounds.at_least(x, Fraction(value), strict=False, reason=None) or bounds.at_most(
            x, Fraction(value), strict=False, reason=None
        ):
            return False
    return bounds.conflict(nothing) is None


def test_ten_variables_less():
    """In an order of few products elimination alone came to thousands of rows."""
    import qe

    answer = qe.eliminate(read(projection(10)), process=False, timeout=60)
    assert answer.formula.is_quantifier_free and 30 < str(answer.formula).count("and") < 50
