"""Boolean search: points that hold, refutations that others confirm, reasons that suffice, the solver absent."""

import signal
import sys
from collections.abc import Sequence
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.protocol import Context, Outcome
from qe.elimination.search import method
from qe.elimination.search.clauses import Clauses
from qe.elimination.search.guided import guided
from qe.elimination.search.linear_forms import over_monomials
from qe.elimination.search.linear_theories import Forms, said
from qe.elimination.search.method import BooleanSearch, Refuted, found_point
from qe.elimination.search.monomial_bounds import MonomialBounds
from qe.elimination.search.online import Propagator
from qe.elimination.search.theory import Theory
from qe.engine.conditions import CASES_FROM, LINEAR_VARIABLES, hopeless_cases, many_cases
from qe.engine.run import solve
from qe.engine.strategy import Scope, attempts
from qe.errors import BudgetExceeded, Unable
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Or, Relation
from qe.io.text import read
from qe.options import Budget, Options, Stage
from qe.proof.run_log import RunLog
from qe.rules.lift import holds_at
from tests.tables import each

pytest.importorskip("pysat")

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.var(name) for name in RING.names)
LINEAR = [X, X - 1, X - 2, Y + X, Y + X - 1, 2 * Y + 2 * X + 3, Z - X, Z - Y - 1, Z]
CURVED = [X * Y - 1, X * X + Y * Y - 2, X * X - Y, Z * X + 1, Y * Y + 1, X * X * X - Z]
ATOMS = st.builds(atom, st.sampled_from(LINEAR + CURVED), st.sampled_from(list(Relation)))
FORMULAS = st.recursive(
    ATOMS, lambda f: st.one_of(*(st.lists(f, min_size=2, max_size=3).map(join) for join in (conj, disj))), max_leaves=14
)
WITHOUT = Options(without=frozenset({Stage.SEARCH}))


def decide(sentence: Formula, options: Options, budget: Budget) -> Outcome:
    return solve(sentence, WITHOUT, budget)


def values(sentence: Formula, budget: Budget) -> Values | None:
    found = decide(sentence, WITHOUT, budget)
    assert found.formula == FALSE or found.witness is not None
    return found.witness


def context() -> Context:
    return Context(Options(), Budget(60), RunLog(), decide)


@settings(max_examples=35, deadline=None)
@given(st.lists(FORMULAS, min_size=1, max_size=4).map(conj))
def test_the_search_decides_what_other_methods_decide(body: Formula) -> None:
    found = found_point(nnf(body), context())
    sentence = exists(body.free, body)
    if isinstance(found, Refuted):
        assert decide(sentence, WITHOUT, Budget(60)).formula == FALSE
    else:
        assert holds_at(body, found)


@settings(max_examples=35, deadline=None)
@given(st.lists(ATOMS.filter(lambda a: isinstance(a, Atom)), min_size=1, max_size=8, unique=True))
def test_a_reason_is_a_part_that_cannot_hold(chosen: Sequence[Atom]) -> None:
    found = Theory(RING, values, Budget(60)).look(chosen)
    if isinstance(found, dict):
        assert all(holds_at(a, found) for a in chosen)
    else:
        assert found
        for reason in found:
            assert set(reason) <= set(chosen)
            assert decide(exists(RING.names, conj(reason)), WITHOUT, Budget(60)).formula == FALSE


def test_one_choice_gives_a_reason_for_each_of_its_contradictions() -> None:
    parts = [Atom(p, r) for v in (X, Y, Z) for p, r in ((v - 1, Relation.GT), (v, Relation.LT))]
    found = Theory(RING, values, Budget(60)).look(parts)
    assert isinstance(found, list)
    assert sorted(map(len, found)) == [2, 2, 2]
    assert len({a for reason in found for a in reason}) == 6


def test_a_reason_among_many_curved_conditions_is_short() -> None:
    """x > 0, y < 0 and x*y > 0 beside conditions that the engine would have to look at, too."""
    text = "x > 0 and y < 0 and x*y > z^2 and z > x and z < 4 + y^2 and z^2 < 9 + x and y > -7 and x^2 + y^2 < 40"
    body = read(text)
    assert isinstance(body, And)
    assert body.ring is not None
    found = Theory(body.ring, values, Budget(60)).look([a for a in body.args if isinstance(a, Atom)])
    assert isinstance(found, list)
    assert all(len(reason) <= 4 for reason in found)


@given(st.lists(st.sampled_from(LINEAR).map(lambda p: atom(p, Relation.GE)), min_size=1, unique=True))
def test_signs_are_those_at_the_point_of_the_bounds(chosen: Sequence[Atom]) -> None:
    bounds = MonomialBounds(RING)
    for poly in LINEAR:
        bounds.sign(poly)
    assert bounds.conflict(chosen, lambda: None) is None
    point = bounds.point()
    for poly in LINEAR:
        assert Relation.EQ.holds(bounds.sign(poly)) == holds_at(atom(poly, Relation.EQ), point)
        assert Relation.GT.holds(bounds.sign(poly)) == holds_at(atom(poly, Relation.GT), point)


DIFFERENCES = [X - Y, X - Y - 1, Y - Z + 2, 2 * Z - 2 * X - 1, X - 3, Y, Z - X + 1]
LINEAR_ATOMS = st.builds(atom, st.sampled_from(LINEAR + DIFFERENCES), st.sampled_from(list(Relation)))
LINEAR_FORMULAS = st.recursive(
    LINEAR_ATOMS, lambda f: st.lists(f, min_size=2, max_size=3).flatmap(lambda g: st.sampled_from((conj(g), disj(g))))
)


@settings(max_examples=15, deadline=None)
@given(st.lists(LINEAR_FORMULAS, min_size=3, max_size=8).map(conj).filter(lambda f: f.ring is not None))
def test_what_the_guided_solver_learns_holds_at_all_points(body: Formula) -> None:
    clauses = Clauses(nnf(body))
    found = guided(clauses, Theory(RING, values, Budget(60)))
    if isinstance(found, dict):
        assert holds_at(body, found)
        return
    says = clauses.says()
    for lemma in found:
        refuted = conj(says[-literal] for literal in lemma)
        assert decide(exists(RING.names, refuted), WITHOUT, Budget(60)).formula == FALSE
    assert decide(exists(RING.names, body), WITHOUT, Budget(60)).formula == FALSE


def test_a_solver_that_was_told_of_nothing_does_not_decide() -> None:
    """Where the guided solver finds no lemma, the clauses are searched all the same."""
    with pytest.MonkeyPatch.context() as m:
        m.setattr(method, "guided", lambda clauses, theory: [])
        for text, truth in (("x < y and (y < z or y < z - 1) and (z < x or x > 9)", True), ("x < y and y < x", False)):
            assert isinstance(found_point(nnf(read(text)), context()), Refuted) is not truth


def test_an_error_while_the_solver_calls_ends_the_search() -> None:
    """No exception can go through the solver's code; it is kept until the solver has ended."""

    class Stop(BaseException):
        pass

    def stop(self: Theory, atoms: Sequence[Atom]) -> Values:
        raise Stop

    body = nnf(read("(x < y or y < z) and (z < x or x*y > 1)"))
    with pytest.MonkeyPatch.context() as m:
        m.setattr(Theory, "look", stop)
        with pytest.raises(Stop):
            found_point(body, context())
    with pytest.raises(BudgetExceeded):
        found_point(body, Context(Options(), Budget(60, work=0), RunLog(), decide))


@each("on_assignment", "on_new_level", "propagate", "check_model", "has_clause")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGALRM])
def test_a_signal_in_any_call_of_the_solver_ends_the_search(call: str, number: signal.Signals) -> None:
    """Ctrl-C was lost where it came in a call that only takes note of something: the search went on to its end."""

    class Rung(Exception):
        pass

    def ring(number: int, frame: object) -> None:
        raise Rung

    own, rung = getattr(Propagator, call), []

    def interrupted(self: Propagator, *given: Any) -> Any:
        if not rung:
            rung.append(number)
            signal.raise_signal(number)
        return own(self, *given)

    before = signal.signal(number, ring)
    try:
        with pytest.MonkeyPatch.context() as m:
            m.setattr(Propagator, call, interrupted)
            with pytest.raises(Rung):
                found_point(nnf(read("(x < y or y < z) and (z < x or x > 9) and (y > 1 or z > 2)")), context())
        assert rung and signal.getsignal(number) is ring
    finally:
        signal.signal(number, before)


def test_linear_sentences_with_cases_are_for_the_search_alone() -> None:
    def linear(count: int) -> Block:
        names = [f"v{k}" for k in range(count)]
        cases = " and ".join(f"({a} + 1 < {b} or {b} + 1 < {a})" for a, b in zip(names, names[1:] + names[:1]))
        found = Block.of(read(f"ex {', '.join(names)}. {cases}"))
        assert isinstance(found, Block)
        return found

    assert hopeless_cases(linear(CASES_FROM), Options()) is not None
    assert many_cases(linear(CASES_FROM), Options()) is None
    assert hopeless_cases(linear(LINEAR_VARIABLES), Options()) is not None
    assert hopeless_cases(linear(LINEAR_VARIABLES - 1), Options()) is None


@settings(max_examples=35, deadline=None)
@given(FORMULAS, st.integers(-1, 1))
def test_what_is_chosen_from_a_model_makes_the_formula_true(body: Formula, sign: int) -> None:
    from pysat.solvers import Solver

    clauses = Clauses(body)
    with Solver(name="cadical153", bootstrap_with=clauses.clauses) as solver:
        if not solver.solve():
            assert all(not holds_at(body, dict(zip(RING.names, p))) for p in product((-1, 0, 1, 2), repeat=3))
            return
        chosen = clauses.chosen(solver.get_model(), lambda poly: sign)
    taken = {(a.poly, sign) for a in chosen for sign in (-1, 0, 1) if sign in a.relation.signs}

    def follows(f: Formula) -> bool:
        match f:
            case Atom(poly, relation):
                mine = [a for a in chosen if a.poly == poly]
                return any(a.relation.signs <= relation.signs for a in mine)
            case And(args):
                return all(map(follows, args))
            case Or(args):
                return any(map(follows, args))
        return f == TRUE

    assert isinstance(body, Constant) or (taken and follows(body))


def test_bounds_of_one_form_are_in_order() -> None:
    low, high = over_monomials(2 * X + 2 * Y - 1), over_monomials(-X - Y + 3)
    assert low.direction == high.direction
    assert (low.bound < high.bound, low.scale > 0, high.scale > 0) == (True, True, False)


def many(count: int, last: str) -> Formula:
    cases = [f"(x > {k} or y > {k} or x + y*z > {2 * k})" for k in range(1, count + 1)]
    return read(f"ex x, y, z. {' and '.join(cases)} and {last}")


SMALL = "x + y < 2 and x - y < 1 and y - x < 1"  # so x and y are at most 3/2, which no simplification sees


@each(("x - y < 1 and x + y > 50", True), (f"{SMALL} and z = 1", False), (f"{SMALL} and z = 40 - y", True))
def test_many_choices(last: str, truth: bool) -> None:
    sentence = many(14, last)
    answer = qe.eliminate(sentence, timeout=120)
    assert answer.truth is truth
    assert [plan.split()[0] for plan in answer.stats["plan"]] == ["search"]
    if truth:
        assert isinstance(sentence, Exists) and answer.witness is not None
        assert holds_at(sentence.body, answer.witness)


def test_a_universal_sentence_is_searched_for_a_counterexample() -> None:
    sentence = many(14, "x < 1 and y < 1 and z = 1")
    assert isinstance(sentence, Exists)
    dual = ForAll(sentence.variables, nnf(sentence.body, negate=True))
    assert many_cases(Block(dual.variables, dual.body, universal=True), Options()) is not None
    found = BooleanSearch().run(Block(dual.variables, dual.body, universal=True), context())
    assert found is not None and found.formula == TRUE


def test_few_cases_among_many_linear_conditions_are_not_gone_through_one_by_one() -> None:
    """Symptom: weights of twelve things, half of them taken or not, took a second of preparation, case by case."""
    names = [f"x{k}" for k in range(6)]
    cases = " and ".join(f"({v} = 0 or {v} = 1)" for v in names[::2])
    total = " + ".join(f"{k + 2}*{v}" for k, v in enumerate(names))
    question = f"ex {', '.join(names)}. {cases} and {total} = 9 and 2*x1 + x3 > 3 and x5 > 0 and x1 < 1 and x3 >= 0"
    answer = qe.eliminate(question, check=True)
    assert (answer.truth, answer.unchecked_steps) == (True, ())
    assert [plan.split()[0] for plan in answer.stats["plan"]] == ["search"]


def test_few_cases_are_for_others() -> None:
    sentence = many(14, "x < 1")
    problem = Block.of(sentence)
    assert problem is not None
    assert many_cases(problem, Options()) is not None
    assert many_cases(problem, Options(certify=True)) is not None
    assert not any(attempt.method == "search" for attempt, _, _ in attempts(Scope.ASKED, problem, WITHOUT))
    few = Block.of(many(CASES_FROM - 1, "x < 1"))
    assert few is not None and many_cases(few, Options()) is None


def test_without_the_solver_it_says_so_and_others_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pysat.solvers", None)
    with pytest.raises(Unable, match=r"pip install 'bezier-qe\[sat\]'"):
        found_point(read("x > 0 or y > 0"), context())
    body = conj(disj((atom(X - k, Relation.EQ), atom(Y - k, Relation.EQ))) for k in range(CASES_FROM))
    answer = qe.eliminate(exists(("x", "y"), conj((body, atom(Y - X, Relation.GT)))), timeout=120, process=False)
    assert answer.truth is False
    assert any("python-sat" in line or "pysat" in line for line in map(str, answer.stats["switches"]))


@settings(max_examples=20, deadline=None)
@given(st.lists(FORMULAS, min_size=2, max_size=5).map(conj))
def test_preferred_literals_move_nothing(body: Formula) -> None:
    """All of them hold together with what was told, at the point as it is."""
    clauses = Clauses(body)
    forms = Forms(said(clauses.inequalities()))
    preferred: dict[int, int] = {}
    for literal in clauses.signs():
        if forms.tell(literal) is not None or forms.settle() is not None:
            break
        before, mark = list(forms.bounds.values), forms.mark()
        preferred |= {abs(changed): changed for changed in forms.changes()}
        assert {abs(one) for one in forms.said} == preferred.keys()
        assert all(forms.tell(one) is None for one in preferred.values())
        assert forms.settle() is None and forms.bounds.values == before
        forms.back(mark)
        assert forms.changes() == []
