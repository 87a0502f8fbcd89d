"""Coverings: what they find is what decompositions find; implicants are few and decide."""

import random
from itertools import pairwise

import pytest

import qe
from qe.decomposition.cover import Search, characterization
from qe.decomposition.implicant import implicant
from qe.decomposition.line import Cover
from qe.decomposition.parameters import parameter_cells
from qe.errors import BudgetExceeded, NotWellOriented
from qe.exact.ring import Ring, format_poly
from qe.exact.sample import Point
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.evaluate import truth_under
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Constant, Formula, Relation
from qe.formula.traverse import map_atoms, polynomials
from qe.io import formats
from qe.options import Budget
from tests.differential.generate import random_poly
from tests.tables import each

NAMES = ("x", "y", "z")


def search(text: str, order: str, quantifiers: str = "", **levels: frozenset[int]) -> Search:
    """The matrix; of the variables those before the quantifiers are free, and all are existential without any."""
    ring = Ring.of(tuple(order))
    kinds = [""] * (len(order) - len(quantifiers)) + list(quantifiers) if quantifiers else ["E"] * len(order)
    return Search(nnf(convert(formats.read(text, "text"), ring)), ring, kinds, Budget(), **levels)


def random_body(rng: random.Random, depth: int = 3) -> Formula:
    ring = Ring.of(NAMES[: rng.choice([2, 2, 3])])

    def part(depth: int) -> Formula:
        if depth == 0 or rng.random() < 0.1:
            return atom(random_poly(rng, ring, ring.names, rng.choice([1, 2, 2, 3])), rng.choice(list(Relation)))
        return (conj if rng.random() < 0.85 else disj)([part(depth - 1) for _ in range(2)])

    return nnf(part(depth))


@each(
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
)
@pytest.mark.parametrize("order", ["xy", "yx"])
def test_known_truths(text: str, holds: bool, order: str) -> None:
    assert search(text, order).run().truth is holds


@pytest.mark.parametrize("seed", range(120))
def test_coverings_and_decompositions_agree(seed: int) -> None:
    body = random_body(random.Random(seed))
    ring = body.ring
    if isinstance(body, Constant) or ring is None:
        return
    try:
        found = Search(body, ring, "E" * ring.size, Budget(None, 4000)).run()
    except (NotWellOriented, BudgetExceeded):
        return
    assert found.truth is qe.eliminate(exists(ring.names, body), method="cad", process=False).truth


def test_the_intervals_cover_the_line_and_none_is_superfluous() -> None:
    found = search("x^2 + y^2 < 1 and x*y > 1", "xy").run()
    assert found.truth is False
    first, last = found.intervals[0], found.intervals[-1]
    assert first.lower is None and last.upper is None
    assert all(left.upper is not None and right.lower is not None for left, right in pairwise(found.intervals))
    reasons = [i.known.reason for i in found.intervals]
    assert all(isinstance(reason, frozenset) or reason.point.depth == 1 for reason in reasons)


@each(
    ("x < y^2", "xy", "EA", True),
    ("x < y", "xy", "EA", False),
    ("x < y", "xy", "AE", True),
    ("y^2 = x", "xy", "AE", False),
    ("x^2 + y^2 = z^2", "xyz", "AAE", True),
    ("x*y = 1 or x = 0 and y = 1", "xy", "AE", True),
    ("x*z + y = 0 or y /= 0", "xyz", "AAE", True),
    ("x*y + z^2 > 0", "xyz", "EAA", False),
    ("y < x^2 or z > 0", "yxz", "EAE", True),
)
def test_alternation(text: str, order: str, quantifiers: str, holds: bool) -> None:
    assert search(text, order, quantifiers).run().truth is holds


def test_one_interval_is_known_where_one_value_decides() -> None:
    """For all x there is a y with y^2 < x only where x is positive: over a sample one interval of y is found."""
    found = search("y^2 < x or x <= 0", "xy", "AE").run()
    assert found.truth is True
    for interval in found.intervals:
        reason = interval.known.reason
        assert isinstance(reason, frozenset) or (reason.truth is True and len(reason.intervals) == 1)


def test_nobody_asks_what_holds_beside_values_of_the_first_block() -> None:
    (first,) = search("x < y^2", "xy", "EA").run().intervals
    assert first.is_bare and isinstance(first.known.reason, Cover) and not first.own


def test_cells_of_parameters() -> None:
    cover = search("x^2 + b*x + c = 0", "bcx", "E").run()
    assert cover.truth is None
    factors, cells = parameter_cells(cover, 2)
    assert [[format_poly(f) for f in level] for level in factors] == [[], ["-b^2 + 4*c"]]
    assert sorted((c.signs, c.truth) for c in cells) == [(("", "+"), False), (("", "-"), True), (("", "0"), True)]


def test_signs_of_derivatives_tell_cells_apart() -> None:
    """The largest root of x^3 - 3*x - a: the same signs stand on both sides of the other roots."""
    text = "y^3 - 3*y = a and y >= x"
    plain, whole, thom = (
        search(text, "axy", "E", whole=frozenset(levels[:1]), thom=frozenset(levels[1:]))
        for levels in ((), (1,), (1, 1))
    )
    counts = [len(parameter_cells(s.run(), 2)[1]) for s in (plain, whole, thom)]
    assert counts[0] <= counts[1] <= counts[2]
    over = next(i for i in thom.run().intervals if isinstance(i.known.reason, Cover)).known.reason
    assert isinstance(over, Cover)
    signs = [tuple(i.known.sample.sign(f) for f in i.own) for i in over.intervals]
    assert len({i.own for i in over.intervals}) == 1 and len(set(signs)) == len(signs)


def test_a_covering_depends_on_its_projection_only() -> None:
    """Over x = 0 the line is covered by x*y <= 1 alone, which has no roots there, until x is no longer 0."""
    body = search("x^2 + y^2 < 1 and x*y > 1", "xy")
    found = body._over(Point.of(body.ring, [0]), {})
    assert [format_poly(f) for f in characterization(found)] == ["x"]


def test_a_polynomial_that_is_zero_on_a_line_depends_on_its_coefficients() -> None:
    """Over x = y = 0 the equation holds for all z; over x = 0 and another y for none."""
    body = search("x*z + y = 0", "xyz", "A")
    found = body._over(Point.of(body.ring, [0, 0]), {})
    assert found.truth is True and not found.is_pinned
    assert {format_poly(f) for f in characterization(found)} == {"x", "y"}
    assert found.intervals[0].zero and not found.intervals[0].own


def test_a_polynomial_that_is_zero_on_a_line_and_has_lines_above_holds_over_the_point_only() -> None:
    body = search("t^2 = x*z + y and t > 0", "xyzt", "AE")
    found = body._over(Point.of(body.ring, [0, 0]), {})
    assert found.truth is False and found.is_pinned
    over = body._over(Point.of(body.ring, [0]), {})
    assert over.is_pinned and any(i.is_point and i.pinned for i in over.intervals)


def test_a_polynomial_that_is_zero_on_the_lines_over_a_curve_is_told() -> None:
    """z*u + y is zero over all (x, 0, 0), a line of samples that are no isolated points."""
    with pytest.raises(NotWellOriented, match="zero on a line"):
        search("y = 0 and z = 0 and t^2 = z*u + y and t > x^2", "xyzut", "EEEAE").run()


def test_the_limit_on_work_holds() -> None:
    body = search("x^2 + y^2 + z^2 < 1 and x*y*z > 1", "xyz")
    body.budget = Budget(None, 5)
    with pytest.raises(BudgetExceeded):
        body.run()


@pytest.mark.parametrize("seed", range(60))
def test_an_implicant_decides_the_formula_by_itself(seed: int) -> None:
    rng = random.Random(seed)
    body = random_body(rng, 4)
    signs = {p: rng.choice([-1, 0, 1]) for p in polynomials(body) if rng.random() < 0.8}
    truth = truth_under(body, signs.get)
    if truth is not None:
        chosen = implicant(body, signs, truth)
        assert all(a.poly in signs and a.relation.holds(signs[a.poly]) is truth for a in chosen)
        decided = map_atoms(body, lambda a: (TRUE if truth else FALSE) if a in chosen else a)
        assert decided == (TRUE if truth else FALSE)
