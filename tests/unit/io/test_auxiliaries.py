"""Names for values in one formula: given out in order, once for each value, and used up."""

import pytest

from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Relation
from qe.io import cases, terms
from qe.io.auxiliaries import MOST_CASES, Auxiliaries, Auxiliary, Exhausted, Place
from qe.io.cases import Case
from qe.io.total import Fill, Total

RING = Ring.of(("x", "y", "s1", "s2"))
X, Y, S = RING.var("x"), RING.var("y"), RING.var("s1")


def made(total: Total | None = None) -> Auxiliaries:
    return Auxiliaries(RING, ("s1", "s2"), total)


def absolute() -> tuple[Case, ...]:
    x = terms.variable(RING, "x")
    return Case((atom(X, Relation.GE),), x), Case((atom(X, Relation.LT),), terms.negative(x))


def test_each_value_gets_one_name() -> None:
    found = made()
    auxiliary = lambda name: Auxiliary(name, TRUE, TRUE)  # noqa: E731
    assert found.named("a", auxiliary) == "s1" and found.named("b", auxiliary) == "s2"
    assert found.named("a", auxiliary) == "s1" and list(found.made) == ["s1", "s2"]
    with pytest.raises(Exhausted):
        found.named("c", auxiliary)


def test_few_combinations_stay_many_get_a_name() -> None:
    few, many = absolute(), tuple(absolute()[0] for _ in range(MOST_CASES + 1))
    assert made().few(few, few) == [few, few]
    found = made()
    (named, single) = found.few(many, cases.plain(terms.variable(RING, "y")))
    assert len(named) == 1 and named[0].value.poly == S and single == cases.plain(terms.variable(RING, "y"))
    assert made().few(terms.variable(RING, "y")) == [cases.plain(terms.variable(RING, "y"))]


def test_a_value_behind_a_name_compares_as_the_value() -> None:
    found = made()
    behind = found.behind_name(absolute())
    formula = found.compared(behind, Relation.GT, cases.plain(terms.number(RING, 2)), Place())
    assert set(formula.free) == {"x"} and not formula.is_quantifier_free
    import qe

    assert qe.equivalent(formula, "x > 2 or x < -2")
    plain = found.compared(absolute(), Relation.GT, cases.plain(terms.number(RING, 2)), Place())
    for x in range(-4, 5):
        assert holds_at(plain, dict.fromkeys(RING.names, 0) | {"x": x}) == (abs(x) > 2)


def test_where_a_value_is_defined() -> None:
    found = made()
    inverse = cases.inverse(Case((), terms.variable(RING, "x")))
    assert found.defined((inverse,), Place()) == atom(X, Relation.NE)
    assert found.defined(cases.plain(terms.variable(RING, "x")), Place()) == TRUE


def test_plain_values_are_seen() -> None:
    found = made()
    found.named("a", lambda name: None)
    assert found.simple(cases.plain(terms.variable(RING, "y"))) == terms.variable(RING, "y")
    assert found.simple(cases.plain(terms.variable(RING, "s1"))) == cases.plain(terms.variable(RING, "s1"))
    assert found.simple(absolute()) == absolute()


def test_outside_a_domain() -> None:
    x, y = Case((), terms.variable(RING, "x")), Case((), terms.variable(RING, "y"))
    same = made(Total(fill=Fill.ARGUMENT))
    assert same.outside("/", x) == (x,)
    constant = made(Total(fill=Fill.CONSTANT))
    assert constant.outside("/", x) == constant.outside("/", y) and constant.total is not None
    assert constant.total.values == {"s1": ("/", ())}
    free = made(Total())
    assert free.outside("/", x) != free.outside("/", y) and free.outside("/", x)[0].value.poly == S
    assert free.total is not None and free.total.values["s2"] == ("/", (y,)) and not free.loose
    assert str(free.agreements()[0]) in ("x /= y or s1 = s2", "s1 = s2 or x /= y")
    bound = made(Total(frozenset("x")))
    bound.outside("/", x)
    assert bound.loose and bound.total is not None and bound.total.weakened and not bound.total.values


def test_names_behind_names() -> None:
    found = made()
    found.named("a", lambda name: Auxiliary(name, atom(S**2 - X, Relation.EQ), TRUE))
    assert found.names_in(Case((), terms.variable(RING, "s1"), ((Y, 1),))) == {"s1", "x", "y"}
