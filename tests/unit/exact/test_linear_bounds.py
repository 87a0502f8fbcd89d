"""Bounds of linear forms: contradictions with reasons that suffice and are needed, points that keep all bounds."""

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Relation

RING = Ring.of(("x", "y", "z"))
SMALL = st.integers(-3, 3)
CONDITION = st.tuples(st.tuples(SMALL, SMALL, SMALL), SMALL, st.sampled_from(["<", "<=", ">", ">="]))
Condition = tuple[tuple[int, int, int], int, str]


class Asked:
    """A system whose forms stay, asked about several sets of conditions one after another."""

    def __init__(self) -> None:
        self.bounds = LinearBounds()
        self.columns = [self.bounds.variable() for _ in range(3)]
        self.forms: dict[tuple[int, int, int], int] = {}

    def ask(self, conditions: list[Condition]) -> set[object] | None:
        self.bounds.clear()
        for k, (coefficients, bound, relation) in enumerate(conditions):
            if coefficients not in self.forms:
                terms = {x: Fraction(c) for x, c in zip(self.columns, coefficients, strict=True)}
                self.forms[coefficients] = self.bounds.form(terms)
            tell = self.bounds.at_least if relation[0] == ">" else self.bounds.at_most
            found = tell(self.forms[coefficients], Fraction(bound), strict="=" not in relation, reason=k)
            if found is not None:
                return set(found)
        found = self.bounds.conflict(lambda: None)
        return None if found is None else set(found)


def holds(condition: Condition, point: list[Fraction]) -> bool:
    coefficients, bound, relation = condition
    value = sum((c * v for c, v in zip(coefficients, point, strict=True)), Fraction(0))
    return Relation(relation).holds((value > bound) - (value < bound))


def possible(conditions: list[Condition]) -> bool:
    parts = []
    for coefficients, bound, relation in conditions:
        form = sum((c * RING.gen(i) for i, c in enumerate(coefficients)), RING.constant(-bound))
        parts.append(atom(form, Relation(relation)))
    return qe.decide(exists(RING.names, conj(parts)), timeout=60)


@settings(max_examples=45, deadline=None)
@given(st.lists(st.lists(CONDITION, min_size=1, max_size=9), min_size=1, max_size=4))
def test_points_keep_bounds_and_reasons_contradict(questions: list[list[Condition]]) -> None:
    asked = Asked()
    for conditions in questions:
        found = asked.ask(conditions)
        if found is None:
            values = asked.bounds.point()
            assert all(holds(c, [values[x] for x in asked.columns]) for c in conditions)
        else:
            assert not possible([conditions[k] for k in found if isinstance(k, int)])
            if asked.bounds.stuck:
                check_weakened(asked, conditions, found)
        for form in [*asked.forms][::2]:  # what is known of the others stays
            x = asked.forms.pop(form)
            asked.bounds.free(x)
            asked.bounds.forget(x)


def check_weakened(asked: Asked, conditions: list[Condition], found: set[object]) -> None:
    """Each bound exchanged for one that follows from it, and still a contradiction."""

    def offered(x: int, above: bool) -> list[tuple[Fraction, bool, object]]:
        form = next(c for c, y in asked.forms.items() if x == y) if x in asked.forms.values() else None
        relations = ("<=", "<") if above else (">=", ">")
        bounds = (range(6, -7, -1) if above else range(-6, 7)) if form else ()
        return [(Fraction(b), "=" not in r, (form, b, r)) for b in bounds for r in relations]

    weaker = [conditions[k] if isinstance(k, int) else k for k in asked.bounds.weakened(offered)]
    assert len(weaker) <= len(found)
    assert not possible(weaker)
    for condition in weaker:
        form, bound, relation = condition
        opposite = form, bound, {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}[relation]
        assert any(not possible([conditions[k], opposite]) for k in found if isinstance(k, int))


def test_strict_bounds_meet_at_no_point() -> None:
    asked = Asked()
    assert asked.ask([((1, 1, 0), 1, ">="), ((1, 1, 0), 1, "<=")]) is None
    assert asked.ask([((1, 1, 0), 1, ">"), ((1, 1, 0), 1, "<=")]) == {0, 1}
    assert asked.ask([((1, 0, 0), 0, ">"), ((0, 1, 0), 0, ">"), ((1, 1, 0), 0, "<="), ((0, 0, 1), 5, ">")]) == {0, 1, 2}
    assert asked.ask([((0, 0, 0), 0, ">=")]) is None
    assert asked.ask([((0, 0, 0), 0, ">")]) == {0}


def test_a_conflict_of_two_bounds_is_no_conflict_on_the_row_of_an_earlier_question() -> None:
    asked = Asked()
    assert asked.ask([((0, 0, 0), 0, "<")]) == {0} and asked.bounds.stuck
    assert asked.ask([((0, 0, 1), 0, "<"), ((0, 0, 1), 0, ">")]) == {0, 1}
    assert {reason for *_, reason in asked.bounds.stuck} == {0, 1}


def test_huge_and_close_numbers() -> None:
    big = 10**40
    asked = Asked()
    low, high = ((1, 0, 0), big, ">"), ((1, 0, 0), big + 1, "<")
    assert asked.ask([low, high]) is None
    assert big < asked.bounds.point()[asked.columns[0]] < big + 1
