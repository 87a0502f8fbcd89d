"""Questions whose derivations have the steps that a question made at random seldom has, for the search for an accepted
certificate of a false claim."""

from __future__ import annotations

import random
from collections.abc import Callable

from qe.engine.run import solve
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.syntax import Constant, Formula, Relation, RootAtom
from qe.io.text import read
from qe.options import Budget, Method, Options
from qe.proof.certificate import Certificate, Kind
from tests.certificates.derivations import CASES
from tests.certificates.test_false_steps import altered, formula, polynomial, simple
from tests.certificates.test_newer_rules import met, nested, solvable, turnable

RING = Ring.of(("a", "b", "c", "d", "s", "t", "x", "y", "z", "u", "v", "w"))
SECONDS = 2.0
WEAK = (Relation.LE, Relation.GE)


def _atom(rng: random.Random, poly: Poly, *relations: Relation) -> Formula:
    return atom(poly, rng.choice(relations or tuple(Relation)))


def sentence(rng: random.Random) -> Formula:
    """One block over two variables, all of them bound."""
    ring = Ring.of(("x", "y"))
    return exists(ring.names, conj(formula(rng, ring, 1) for _ in range(rng.randint(2, 4))))


def cases(rng: random.Random) -> Formula:
    """A sentence with many case distinctions between linear conditions, and few others."""
    ring = Ring.of(("x", "y", "z"))

    def line() -> Poly:
        return sum((ring.gen(i) * rng.choice((-1, 0, 1, 1)) for i in range(3)), ring.constant(rng.randint(-3, 3)))

    orders = (Relation.LT, Relation.GT, Relation.LE, Relation.GE)
    body = conj(disj(_atom(rng, line(), *orders) for _ in range(2)) for _ in range(14))
    return exists(ring.names, conj((body, _atom(rng, polynomial(rng, ring)))))


def system(rng: random.Random) -> Formula:
    """Equations that leave few points, and conditions."""
    ring = Ring.of(("x", "y"))
    equations = [_atom(rng, simple(rng, ring), Relation.EQ) for _ in range(2)]
    return exists(ring.names, conj((*equations, formula(rng, ring, 1))))


def discs(rng: random.Random) -> Formula:
    """An interval or a disc that moves, and one that stays."""
    if rng.random() < 0.5:
        ring = Ring.of(("a", "x"))
        a, x = ring.var("a"), ring.var("x")
        first, second = (x - a) ** 2 * rng.randint(1, 3) - rng.randint(1, 4), x**2 + x * rng.randint(-2, 2) - 3
        return exists(("x",), conj((atom(first, Relation.LE), atom(second, Relation.LE))))
    ring = Ring.of(("a", "b", "x", "y"))
    a, b, x, y = (ring.gen(i) for i in range(4))
    first, second = (x - a) ** 2 + (y - b) ** 2 - rng.randint(1, 4), x**2 + y**2 * rng.choice((1, 4)) - 4
    return exists(("x", "y"), conj((atom(first, Relation.LE), atom(second, Relation.LE))))


def balls(rng: random.Random) -> Formula:
    """Two balls, one of them somewhere."""
    ring = Ring.of(("a", "b", "x", "y"))
    a, b, x, y = (ring.gen(i) for i in range(4))
    radius = rng.choice((b, ring.constant(2), b * b))
    second = (x - a) ** 2 + (y - rng.choice((0, 1))) ** 2 - radius * radius
    parts = (_atom(rng, x**2 + y**2 - rng.randint(0, 4), *WEAK[:1]), atom(second, Relation.LE), atom(b, Relation.GE))
    return exists(("x", "y"), conj(parts))


def moving(rng: random.Random) -> Formula:
    """Polynomials in differences of the bound variables, sometimes homogeneous in all of them."""
    ring = Ring.of(("a", "x", "y", "z"))
    a, x, y, z = (ring.gen(i) for i in range(4))
    differences = (x - y, y - z) if rng.random() < 0.6 else (x, y)
    first, second = differences
    forms = [first * second - second**2, first + second * 2, first**2 - second**2 * a, second, first * a - second]
    parts = [_atom(rng, rng.choice(forms)) for _ in range(rng.randint(2, 3))]
    return exists(("x", "y", "z"), conj(parts))


def vanishing(rng: random.Random) -> Formula:
    """Sums of squares that vanish, vectors that do not, and polynomials that are no zero."""
    ring = Ring.of(("a", "b", "x", "y"))
    a, b, x, y = (ring.gen(i) for i in range(4))
    p, q = simple(rng, ring), simple(rng, ring)
    shape = rng.random()
    if shape < 0.3:
        return exists(("x", "y"), conj((_atom(rng, p * p + q * q, Relation.EQ, Relation.LE), formula(rng, ring, 1))))
    if shape < 0.6:
        some = disj((atom(x, Relation.NE), atom(y, Relation.NE)))
        return exists(("x", "y"), conj((some, atom(a * x + b * y, Relation.NE), _atom(rng, a * y - x))))
    return exists(("x", "y"), conj(_atom(rng, simple(rng, ring), Relation.NE) for _ in range(3)))


def guarded(rng: random.Random) -> Formula:
    """A linear equation whose coefficient may vanish."""
    ring, own = Ring.of(("a", "b", "x", "y")), Ring.of(("a", "b"))
    lead, rest = (simple(rng, own).convert(ring) for _ in range(2))
    return exists(("x", "y"), conj((atom(lead * ring.var("x") - rest, Relation.EQ), formula(rng, ring, 1))))


def rooted(rng: random.Random) -> Formula:
    """Comparisons with roots of polynomials."""
    ring = Ring.of(("a", "x"))
    poly = (ring.var("x") ** rng.choice((2, 3)) + simple(rng, ring)).normal()[1]
    if not poly.degree(1):
        return Constant(True)
    own = RootAtom("x", rng.choice(tuple(Relation)), poly, rng.choice((1, 2, -1)))
    return (exists if rng.random() < 0.7 else forall)(("x",), conj((own, formula(rng, ring, 1))))


def served(rng: random.Random) -> Formula:
    """For all parameters there is something that an equation gives."""
    ring, own = Ring.of(("a", "b", "x", "y")), Ring.of(("a", "b"))
    equations = [atom(ring.var(v) - simple(rng, own).convert(ring), Relation.EQ) for v in ("x", "y")]
    return forall(("a", "b"), exists(("x", "y"), conj((*equations, formula(rng, ring, 1)))))


def spanned(rng: random.Random) -> Formula:
    """Conditions for all points of an interval, often with a thin truth set, or none."""
    ring = Ring.of(("a", "b", "t"))
    a, b, t = (ring.gen(i) for i in range(3))
    p = (a * t + b * rng.choice((0, 1)) + rng.randint(-1, 1)) ** 2 - rng.choice((0, 0, 1)) * (t**2 + 1)
    outside = disj((atom(t, Relation.LT), atom(t - 1, Relation.GT)))
    return forall(("t",), disj((outside, atom(p, Relation.LE))))


def listed(rng: random.Random) -> Formula:
    """A question whose derivation has a certain rule (``derivations.CASES``), or one like it."""
    asked = read(rng.choice(list(CASES.values())))
    return asked if rng.random() < 0.5 else altered(rng, asked)


QUESTIONS: tuple[tuple[Callable[[random.Random], Formula], str], ...] = (
    (sentence, "coverings"),
    (cases, "auto"),
    (system, "cgs"),
    (discs, "critical"),
    (balls, "auto"),
    (moving, "auto"),
    (vanishing, "auto"),
    (guarded, "auto"),
    (rooted, "auto"),
    (served, "auto"),
    (spanned, "auto"),
    (nested, "auto"),
    (turnable, "auto"),
    (solvable, "auto"),
    (met, "auto"),
    (listed, "auto"),
    (listed, "auto"),
    (listed, "auto"),
)


def derivation_by_a_rule(rng: random.Random) -> Certificate | None:
    """The certificate of an answer to one of these questions, where it is a derivation."""
    make, method = rng.choice(QUESTIONS)
    asked = convert(make(rng), RING)
    if asked.is_quantifier_free:
        return None
    try:
        found = solve(asked, Options(method=Method(method), certify=True), Budget(SECONDS)).certificate
    except Unable:
        return None
    return found if found is not None and found.kind == Kind.DERIVATION else None
