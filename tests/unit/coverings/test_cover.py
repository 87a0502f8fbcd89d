"""Coverings: what they find is what decompositions find; implicants are few and false."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest

import qe
from qe.coverings.cover import Cover, Search, characterization
from qe.coverings.implicant import false_by, value
from qe.errors import BudgetExceeded, NotWellOriented
from qe.exact.ring import Ring, format_poly
from qe.exact.sample import Point
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Constant, Formula, Relation
from qe.io import formats
from qe.options import Budget
from tests.differential.generate import random_poly

NAMES = ("x", "y", "z")


def search(text: str, order: str) -> Search:
    ring = Ring.of(tuple(order))
    return Search(nnf(convert(formats.read(text, "text"), ring)), ring, Budget())


def random_body(rng: random.Random, depth: int = 3) -> Formula:
    ring = Ring.of(NAMES[: rng.choice([2, 2, 3])])

    def part(depth: int) -> Formula:
        if depth == 0 or rng.random() < 0.1:
            return atom(random_poly(rng, ring, ring.names, rng.choice([1, 2, 2, 3])), rng.choice(list(Relation)))
        return (conj if rng.random() < 0.85 else disj)([part(depth - 1) for _ in range(2)])

    return nnf(part(depth))


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("x^2 + y^2 < 1 and x*y > 1", False),
        ("x^2 + y^2 < 1 and x*y > 1/4", True),
        ("x^2 = 2 and y^2 = x and x*y > 3", False),
        ("x^2 = 2 and y^2 = x and x*y > 1", True),
        ("(x^2 - 2)*(y^2 - x) = 0 and x^2 + y^2 < 1 and y^3 > 1/2 and x > 1", False),
        ("x^2 + y^2 = 0 and x >= 0 and y >= 0", True),
        ("x^2 + y^2 < 0", False),
        ("x = y and y > x", False),
        ("10^40*x = 1 and 10^40*y = 1 and x < y", False),
        ("x > 10^20 and x < 10^20 + 1/10^20 and y^2 = x", True),
    ],
)
@pytest.mark.parametrize("order", ["xy", "yx"])
def test_known_truths(text: str, holds: bool, order: str) -> None:
    assert isinstance(search(text, order).run(), Point) is holds


@pytest.mark.parametrize("seed", range(120))
def test_coverings_and_decompositions_agree(seed: int) -> None:
    body = random_body(random.Random(seed))
    ring = body.ring
    if isinstance(body, Constant) or ring is None:
        return
    try:
        found = Search(body, ring, Budget(None, 4000)).run()
    except (NotWellOriented, BudgetExceeded):
        return
    truth = qe.eliminate(exists(ring.names, body), method="cad", process=False).truth
    assert isinstance(found, Point) is truth


def test_the_intervals_cover_the_line_and_none_is_superfluous() -> None:
    found = search("x^2 + y^2 < 1 and x*y > 1", "xy").run()
    assert isinstance(found, Cover)
    first, last = found.intervals[0], found.intervals[-1]
    assert first.lower is None and last.upper is None
    assert all(left.upper is not None and right.lower is not None for left, right in pairwise(found.intervals))
    assert all(isinstance(i.reason, frozenset) or i.reason.point.depth == 1 for i in found.intervals)


def test_a_covering_depends_on_its_projection_only() -> None:
    """Over x = 0 the line is covered by x*y <= 1 alone, which has no roots there, until x is no longer 0."""
    body = search("x^2 + y^2 < 1 and x*y > 1", "xy")
    found = body._over(Point.of(body.ring, [0]), {})
    assert isinstance(found, Cover)
    assert [format_poly(f) for f in characterization(found)] == ["x"]


def test_a_polynomial_that_is_zero_on_a_line_is_told() -> None:
    with pytest.raises(NotWellOriented, match="zero on the line"):
        search("x*z + y = 0 and x = 0 and y = 0 and z^2 < 0", "xyz").run()


def test_the_limit_on_work_holds() -> None:
    body = search("x^2 + y^2 + z^2 < 1 and x*y*z > 1", "xyz")
    body.budget = Budget(None, 5)
    with pytest.raises(BudgetExceeded):
        body.run()


@pytest.mark.parametrize("seed", range(60))
def test_an_implicant_makes_the_formula_false_by_itself(seed: int) -> None:
    rng = random.Random(seed)
    body = random_body(rng, 4)
    from qe.formula.traverse import atoms

    known = {a: rng.random() < 0.4 for a in atoms(body) if isinstance(a, Atom) and rng.random() < 0.8}
    if value(body, known) is False:
        chosen = false_by(body, known)
        assert chosen <= {a for a, truth in known.items() if not truth}
        assert value(body, dict.fromkeys(chosen, False)) is False
