"""Variable orders: what the heuristics prefer."""

from collections.abc import Sequence

import qe
from qe.decomposition.order import Candidate, brown_order, choose_order, greedy_order, preferred, sotd
from qe.exact.ring import Poly
from qe.formula.traverse import polynomials
from qe.io.text import read
from qe.options import Budget
from tests.tables import each


def _polys(text: str) -> list[Poly]:
    return polynomials(read(text))


@each(
    ("x^3 + y^2 + z = 0", ("x", "y", "z")),  # z has the lowest degree and is projected first
    ("x^2*y + y = 0 and x > 0", ("x", "y")),
    ("x*y^2 + x*z^2 + z = 0", ("z", "y", "x")),
    ("1 = 1", ("x", "y", "z")),
)
def test_brown(text: str, order: tuple[str, ...]) -> None:
    assert brown_order(_polys(text), sorted(order)) == order


def test_greedy_takes_the_smallest_projection_first_and_keeps_blocks() -> None:
    sizes = {"a": 3, "b": 1, "x": 5, "y": 2}
    base = _polys("a + b + x + y = 0")

    def project(polys: Sequence[Poly], name: str) -> list[Poly]:
        return [polys[0] ** sizes[name]]

    order = greedy_order(base, (("a", "b"), ("x", "y")), project)
    assert order == ("a", "b", "x", "y")
    sizes["x"], sizes["a"] = 1, 0
    assert greedy_order(base, (("a", "b"), ("x", "y")), project) == ("b", "a", "y", "x")


def test_sotd() -> None:
    assert sotd(_polys("x^2*y + 3*x + 5 = 0 and y > 0")) == 3 + 1 + 0 + 1


@each(((9, 4), True), ((9, 3), True), ((9, 5), False), ((10, 1), False), ((11, 4), False))
def test_an_order_is_changed_only_for_a_smaller_projection(other: tuple[int, int], taken: bool) -> None:
    usual, found = Candidate("brown", ("x",), 10, 4), Candidate("greedy", ("x",), *other)
    assert preferred(usual, found) is (found if taken else usual)


def test_a_disagreement_is_settled_and_explained() -> None:
    matrix = read("x^3 + a*x^2 + b*x + c = 0 and x > 0 and x < 1")
    order, reason = choose_order(matrix, (("a", "b", "c"), ("x",)), budget=Budget())
    assert order != (*brown_order(polynomials(matrix), "abc"), "x")
    assert reason.startswith("greedy (size of projection: brown ")


def test_a_heavy_trial_is_given_up() -> None:
    matrix = read("(a + b + c + d + x + y)^4 + x^7*a + y^7*b + c^2*d^2*x - y = 0 and (a - b*x + c*y + d)^5 > x*y")
    order, reason = choose_order(matrix, (("a", "b", "c", "d"), ("x", "y")), budget=Budget(60))
    assert reason == "brown (greedy is too heavy)"
    assert set(order[:4]) == set("abcd")


def test_with_little_work_left_nothing_is_tried() -> None:
    matrix = read("x^3 + a*x^2 + b*x + c = 0 and x > 0 and x < 1")
    order, reason = choose_order(matrix, (("a", "b", "c"), ("x",)), budget=Budget().part(100))
    assert order == (*brown_order(polynomials(matrix), "abc"), "x")
    assert reason == "brown (there is little work left)"


def test_an_order_that_is_asked_for_stays() -> None:
    found = qe.eliminate("ex x. x^3 + b*x^2 + c*x + d = 0 and x > 0", method="cad", order=("d", "c", "b"))
    (figures,) = found.stats["cad"]
    assert figures["order"] == ["d", "c", "b", "x"]
    assert figures["order by"] == "as written"
