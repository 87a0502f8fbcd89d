"""What is said of a question that is not answered as a whole is true, and true, false and open cover the space."""

from fractions import Fraction
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.api.eliminate import eliminate
from qe.engine.anytime import partly
from qe.engine.run import solve
from qe.errors import BudgetExceeded
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io.text import read
from qe.options import Budget, Options
from qe.processes.limits import Limits
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("a", "b", "x", "y"))
POINTS = [dict(zip("ab", map(Fraction, p), strict=True)) for p in product((-3, -1, 0, Fraction(1, 2), 1, 4), repeat=2)]
HARD = "ex x, y. x^3 + a*x*y + b = 0 and y^3 + b*x = a and x > 0 and x^5*y + a*y^4 < b"

ATOMS = st.builds(atom, polynomials(RING, max_degree=2, max_terms=3), st.sampled_from(tuple(Relation)))
BLOCKS = st.builds(
    lambda kind, join, parts: kind(("x", "y"), join(parts)),
    st.sampled_from([exists, forall]),
    st.sampled_from([conj, disj]),
    st.lists(ATOMS, min_size=1, max_size=3),
)


def partial_of(formula: Formula, work: int) -> tuple[Formula, Formula, Formula]:
    found = partly(formula, Options(), Budget(work=work), Limits())
    return found.proved_true, found.proved_false, found.open


@settings(max_examples=40)
@given(st.lists(BLOCKS, min_size=1, max_size=2), st.sampled_from([disj, conj]), st.sampled_from([2, 30, 120, 500]))
def test_parts_are_right_and_cover_the_space(blocks: list[Formula], join: object, work: int) -> None:
    question = join(blocks)  # type: ignore[operator]
    true, false, rest = partial_of(question, work)
    try:
        answer = solve(question, Options(), Budget(work=100_000)).formula
    except BudgetExceeded:
        return
    for point in POINTS:
        held = [holds_at(part, point) for part in (true, false, rest)]
        assert held.count(True) == 1
        if held[0] or held[1]:
            assert holds_at(answer, point) is held[0]


@each(("ex x, y. x^2 + y^2 <= 1 and a*x + b*y^2 >= 2", 200), ("all x, y. x^4 + y^4 + a*x*y + b > 0", 120))
def test_decided_cells_are_described(text: str, work: int) -> None:
    """Something is proved, something is open, and more work leaves nothing open."""
    question = read(text)
    true, false, rest = partial_of(question, work)
    assert disj((true, false)) != FALSE and rest != FALSE
    answer = solve(question, Options(), Budget()).formula
    for point in POINTS:
        assert not holds_at(true, point) or holds_at(answer, point)
        assert not holds_at(false, point) or not holds_at(answer, point)
    true, false, rest = partial_of(question, 100 * work)
    assert not any(holds_at(rest, point) for point in POINTS)
    assert all(holds_at(true, point) is holds_at(answer, point) for point in POINTS)


def test_a_solved_disjunct_is_handed_over() -> None:
    """One disjunct is easy, the other is not answered in the time: what is known of the first is said."""
    for seconds in (1.5, 6, 24):  # the more, the busier the machine is
        answer = eliminate(f"(ex z. z < 0 and z^2 = a) or ({HARD})", timeout=seconds, anytime=True)
        if answer.formula is not None or (answer.partial is not None and answer.partial.proved_true != FALSE):
            break
    if answer.formula is None:  # else the machine is fast
        assert answer.reason and answer.partial is not None
        assert str(answer.partial.proved_true).startswith("a > 0")
        assert holds_at(answer.partial.open, {"a": Fraction(-1), "b": Fraction(0)})


def test_an_answer_is_whole_and_parts_are_given_on_request_only() -> None:
    assert eliminate("ex x. x^2 = a", timeout=60, anytime=True).partial is None
    assert eliminate(HARD, timeout=0.2).partial is None
    nothing = eliminate(HARD, timeout=0.2, anytime=True)
    assert nothing.formula is None and nothing.partial is not None


def test_without_any_work_all_is_open() -> None:
    assert partial_of(read("ex x, y. x^2 + y^2 <= 1 and a*x + b*y^2 >= 2"), 1) == (FALSE, FALSE, TRUE)
