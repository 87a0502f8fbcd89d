"""Refutations: evidence for lists of formulas, and the search over signs below it."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.certify.registry import RULES
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.io.text import read
from qe.kernel.boolean import ByLemmas, equivalence
from qe.kernel.derivation import limits_of
from qe.kernel.signs import Line, read_lemma
from qe.kernel.step import Claim
from qe.options import Budget
from qe.proof.entry import Entry, Json
from qe.proving.goals import is_hopeless, polynomials_outside
from qe.proving.lemma_list import Lemmas, identities, without_needless
from qe.proving.lemmas import refuting
from qe.proving.refutation import NODES, Refutation
from qe.simplifier.facts import factor_list
from tests.tables import each

# Evidence that refutes lists of formulas: read by the checker's theory, no more of it than is needed.

RING = Ring.of(("a", "x", "y", "z"))
LIMITS = limits_of(Budget(), RULES)


def goal(*texts: str) -> list[Formula]:
    return [convert(read(text), RING) for text in texts]


def lemmas(*goals: list[Formula]) -> list[dict[str, Json]] | None:
    evidence = refuting(goals, RING, LIMITS)
    if evidence is None:
        return None
    ByLemmas(lambda claim, context: list(map(tuple, goals)))(
        Claim("signs", TRUE, TRUE, RING, Entry({"theory": evidence}, "evidence"), "step"), (), LIMITS
    )
    assert isinstance(evidence, dict)
    return evidence["lemmas"]  # type: ignore[return-value]


@each(
    (("x > 0", "x <= 0"), 0),
    (("x > 1", "x < 0"), 1),
    (("x > y", "y > z", "z > x"), 1),
    (("x^2 + 2*x + 2 <= 0",), 1),
    (("x^2*y^2 + a^4 + 1 < 0",), 1),
    (("x*y = 0", "x /= 0", "y > 0"), 1),
    (("x = a + 1", "x^2 < a^2 + 2*a + 1"), 1),
    (("x > 0", "x^5 + x < 0"), None),
    (("a = 1", "x = a", "y = x", "y > 2"), None),
)
def test_what_is_refuted(texts: tuple[str, ...], count: int | None) -> None:
    found = lemmas(goal(*texts))
    assert found is not None and (count is None or len(found) == count)


@pytest.mark.parametrize("texts", [("x > 0",), ("x > 1", "x < 2"), ("x^2 + 2*x + 1 <= 0",), ("x*y = 0", "x /= 0")])
def test_what_holds_somewhere_is_not(texts: tuple[str, ...]) -> None:
    assert lemmas(goal(*texts)) is None


def test_all_goals_are_refuted_or_none() -> None:
    false, true = goal("x > 1", "x < 0"), goal("x > 0")
    assert lemmas(false, false) is not None and lemmas(false, true) is None


def test_polynomials_under_quantifiers_stay_outside() -> None:
    found = polynomials_outside(goal("x > 0 and (y = 1 or z /= 2)", "ex z. z*x > a", "x = 0"))
    assert {str(p): e for p, e in found.items()} == {"Poly(x)": True, "Poly(y - 1)": True, "Poly(z - 2)": True}


def test_cases_that_repeat_many_conditions_are_no_search() -> None:
    """Fifteen disjunctions in every case of a product took two to the fifteen cases."""
    rest = " and ".join(f"(x*z + {k}*y /= 0 or y*z + {k} /= 0)" for k in range(1, 16))
    before = f"x*y = 0 and {rest}"
    after = f"x = 0 and {rest} or y = 0 and x /= 0 and {rest}"
    goals = equivalence(*goal(before, after), ())
    assert lemmas(*map(list, goals))


def test_a_condition_that_is_dropped_from_a_case_is_not_taken_for_repeated() -> None:
    wrong = equivalence(*goal("x*y = 0 and (z > 0 or x > 1)", "x = 0 and z > 0 or y = 0 and (z > 1 or x > 1)"), ())
    assert refuting(wrong, RING, LIMITS) is None


def test_values_of_several_variables_are_put_in_at_once() -> None:
    given = goal("2*x - 1 = 0 and y = 0", "8*x^3*z + y*(a + z)^2 - x*y^2 - z /= 0")
    assert len(lemmas(given) or []) == 1


@each(
    (("x > 0", "all y. y*x > z"), True),
    (("ex y. y*x <= z", "all y. y*x > z"), False),
    (("x > 0", "x < 0 or ex y. y*x > z"), True),
    (("x > 0", "x < 0"), False),
)
def test_a_quantified_part_of_which_nothing_else_speaks_is_not_refuted(texts: tuple[str, ...], hopeless: bool) -> None:
    assert is_hopeless(goal(*texts)) is hopeless
    if hopeless:
        assert refuting([goal(*texts)], RING, LIMITS) is None


def test_what_is_no_combination_of_equations_is_seen_by_its_remainder() -> None:
    """Cofactors of x*y - 1 were looked for in three degrees."""
    goals = equivalence(*goal("x^2 + y^2 - 1 = 0 and x*z - y = 0", "x^2 + y^2 - 1 = 0 and x*z^2 - y*z + a = 0"), ())
    assert refuting(goals, RING, LIMITS) is None
    same = equivalence(*goal("x^2 - y*z = 0 and y^2 - x*z = 0", "x^2 - y*z = 0 and y^2 - x*z = 0 and x^3 = y^3"), ())
    assert lemmas(*map(list, same))


def test_a_condition_that_equations_of_high_degree_turn_into_another() -> None:
    """The difference of the equations gives x^2*y^2, but their cofactors have degrees beyond those tried at first."""
    equations = "81*x^6*y^6 + 9*x^2*y^2 - a^2 = 0 and 81*x^6*y^6 + 144*x^2*y^2 - 64*z^2 = 0"
    sides = (f"{equations} and 9*x^4*y^4 - 2 > 0", f"{equations} and a^4 - 128*a^2*z^2 + 4096*z^4 - 4050 > 0")
    assert lemmas(*map(list, equivalence(*goal(*sides), ())))
    wrong = (sides[0], f"{equations} and a^4 - 128*a^2*z^2 + 4096*z^4 - 4051 > 0")
    assert refuting(equivalence(*goal(*wrong), ()), RING, LIMITS) is None


# Refutations over signs: right for independent signs, going on where lemmas join, and with no lemma too many.

SIGNS_RING = Ring.of(("x", "y", "z"))
X, Y, Z = (SIGNS_RING.gen(i) for i in range(3))

atoms = st.builds(Atom, st.sampled_from((X, Y, Z)), st.sampled_from(list(Relation)))
formulas = st.recursive(
    atoms,
    lambda parts: st.builds(
        lambda join, some: join(some), st.sampled_from((conj, disj)), st.lists(parts, min_size=2, max_size=4)
    ),
    max_leaves=14,
)


def check(goal: tuple[Formula, ...], found: Lemmas, search: Refutation) -> list[dict[str, Json]]:
    """The lemmas that the evidence has, which the kernel accepts."""
    evidence = found.only(search.lemmas, [search])
    assert isinstance(evidence, dict)
    claim = Claim("signs", TRUE, TRUE, SIGNS_RING, Entry({"theory": evidence}, "evidence"), "step")
    ByLemmas(lambda claim, context: [goal])(claim, (), LIMITS)
    return evidence["lemmas"]  # type: ignore[return-value]


@given(st.lists(formulas, min_size=1, max_size=4))
def test_independent_signs_are_excluded_iff_no_point_has_them(parts: list[Formula]) -> None:
    goal, search = tuple(parts), Refutation(tuple(parts), LIMITS)
    somewhere = any(
        all(holds_at(f, dict(zip("xyz", point, strict=True))) for f in goal) for point in product((-1, 0, 1), repeat=3)
    )
    assert search.go_on(NODES, NODES) is not somewhere
    if not somewhere:
        assert check(goal, Lemmas(SIGNS_RING), search) == []


def test_a_search_goes_on_when_lemmas_join_and_names_those_alone_that_it_needs() -> None:
    texts = ("x*y > 0 and (x + z = 0 or y < 0 or z > 0)", "x > 0 and y <= 0 or z^2 + 1 < 0")
    goal = tuple(convert(read(text), SIGNS_RING) for text in texts)
    found, search = Lemmas(SIGNS_RING), Refutation(goal, LIMITS)
    assert not search.go_on(NODES, NODES)
    found.identity([(1, ((X + Z, 1),)), (-1, ((X, 1),)), (-1, ((Z, 1),))])  # says nothing here
    found.identity([(1, ((X * Y, 1),)), (-1, ((X, 1), (Y, 1)))])
    search.learn(tuple(found.numbers), found.facts)
    assert not search.go_on(NODES, NODES) and len(search.pending) == 1
    found.identity([(-1, ((Z * Z + 1, 1),)), (1, ((Z, 2),)), (1, ())])
    search.learn(tuple(found.numbers), found.facts)
    assert search.go_on(NODES, NODES) and search.lemmas == [1, 2]
    assert len(check(goal, found, search)) == 2


def test_too_few_cases_are_no_refutation() -> None:
    triples = product("<>=", repeat=3)
    rest = [convert(read(f"x {one} 0 or y {two} 0 or z {three} 0"), SIGNS_RING) for one, two, three in triples]
    assert not Refutation((*rest, TRUE), LIMITS).go_on(1, 0)
    search = Refutation((*rest, TRUE), LIMITS)
    assert search.go_on(NODES, NODES)
    check((*rest, TRUE), Lemmas(SIGNS_RING), search)


@given(st.lists(st.lists(st.integers(-9, 9), min_size=2, max_size=5), min_size=1, max_size=3))
def test_a_line_is_meant_as_the_kernel_reads_it(rows: list[list[int]]) -> None:
    polys = [SIGNS_RING.from_terms({(0, k, 0): c for k, c in enumerate(row) if c}) for row in rows]
    factors = list(dict.fromkeys(f for p in polys if p for f, _ in factor_list(p) if not f.is_constant))
    found = Lemmas(SIGNS_RING)
    if factors:
        found.line(factors, 1)
        meant, checked = found.facts[0], read_lemma(Entry(found.lemmas[0], "lemma"), tuple(found.numbers), SIGNS_RING)
        assert isinstance(meant, Line) and isinstance(checked, Line)
        assert (meant.polynomials, meant.cells) == (checked.polynomials, checked.cells)


def test_no_lemma_or_case_is_there_for_nothing() -> None:
    """Each is left out once: x > 1 and x < 0 needs one difference and no case."""
    x, y = RING.var("x"), RING.var("y")
    square = [(1, ((x * x + y * y, 1),)), (-1, ((x, 2),)), (-1, ((y, 2),))]
    needed = identities([[(1, ((x, 1),)), (-1, ((x - 1, 1),)), (-1, ())]], RING)
    long = identities(
        [square, [(1, ((x, 1),)), (-1, ((x - 1, 1),)), (-1, ())]],
        RING,
        [[Atom(y, Relation.EQ)], [Atom(x, Relation.LT)]],
    )
    assert isinstance(long, dict)
    assert len(long["cases"]) == 2  # type: ignore[arg-type]
    assert without_needless(long, [tuple(goal("x > 1", "x < 0"))], RING, LIMITS) == needed
