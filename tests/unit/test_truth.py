"""Kleene's three truth values: what is said is right however the unknown ones turn out."""

from itertools import product

from qe.truth import conjunction, disjunction, negation

TRUTHS = (True, False, None)


def test_what_is_known_holds_for_all_values_of_the_unknown_and_nothing_more_is_known() -> None:
    for size in range(4):
        for values in product(TRUTHS, repeat=size):
            for found, rule in ((conjunction(values), all), (disjunction(values), any)):
                possible = {rule(v) for v in product(*((True, False) if x is None else (x,) for x in values))}
                assert found is (possible.pop() if len(possible) == 1 else None)


def test_negation() -> None:
    assert [negation(v) for v in TRUTHS] == [False, True, None]


def test_nothing_is_asked_after_what_decides() -> None:
    def values(decisive: bool):
        yield None
        yield decisive
        raise AssertionError("asked on")

    assert conjunction(values(False)) is False
    assert disjunction(values(True)) is True
