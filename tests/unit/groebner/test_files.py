"""Systems and partitions written as JSON and read back; damaged and altered texts."""

import json
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings

import qe
from qe.exact.ring import Poly
from tests.certificates.mutation import leaves, lists, replaced, without
from tests.tables import each
from tests.unit.groebner.test_system import systems

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
CUBE_ROOT = qe.RealAlgebraic.from_root([-2, 0, 0, 1], 1, 2)

SYSTEM, CLASSES = qe.ComprehensiveGroebnerSystem.from_json, qe.RealRootClassification.from_json


def system(**more: Any) -> qe.ComprehensiveGroebnerSystem:
    return qe.comprehensive_groebner(["w*x - a*v", "x^2 - b"], "x", constants={"w": ROOT_2, "v": -CUBE_ROOT}, **more)


def classes(**more: Any) -> qe.RealRootClassification:
    return qe.real_root_classification(["w*x - a"], "x", constants={"w": ROOT_2}, positive=["x + 1"], **more)


def test_a_system_that_was_read_is_equal_and_answers() -> None:
    for given_system in (system(faithful=True), system(order="lex"), qe.comprehensive_groebner(["0"], "x y", "a")):
        found = SYSTEM(given_system.to_json())
        assert found == given_system and found.to_json() == given_system.to_json()
        assert found.to_html() == given_system.to_html() and str(found) == str(given_system)
    found = SYSTEM(system().to_json(indent=1))
    point = [ROOT_2, CUBE_ROOT * CUBE_ROOT]
    assert found.at(point) == system().at(point) and found.solutions_at(point) == system().solutions_at(point) != []
    assert found.contains("x^2 - b", [1, 1]) and qe.verify(found.certificate_at(point)).accepted


def test_a_partition_that_was_read_is_equal_and_answers() -> None:
    for whole in (classes(), classes(check=True)):
        found = CLASSES(whole.to_json())
        assert found == whole and found.to_json() == whole.to_json() and str(found) == str(whole)
        assert [found.at([a]) for a in (-1, 0, 5)] == [whole.at([a]) for a in (-1, 0, 5)]
    assert found.certificate is not None and qe.verify(found.certificate).accepted


@settings(max_examples=10)
@given(systems())
def test_every_system_comes_back(polys: list[Poly]) -> None:
    written = qe.comprehensive_groebner(polys, "x, y", "a, b", process=False, faithful=True)
    assert SYSTEM(written.to_json()) == written


OTHERS = [None, 7, "", "a", "q + 1", 1.5, [], {"x": 1}]


def texts(whole: Any, *, signed: bool) -> list[str]:
    """The text with each entry replaced, each element left out, each object without one of its names."""
    found = [replaced(whole, path, v, signed=signed) for path, old in leaves(whole) for v in OTHERS if v != old]
    found += [replaced(whole, path, v, signed=signed) for path, old in lists(whole) for v in OTHERS if v != old]
    found += [without(whole, path, k, signed=signed) for path, old in lists(whole) for k in range(len(old))]
    return found + [json.dumps({k: v for k, v in whole.items() if k != left_out}) for left_out in whole]


@each((lambda: system(faithful=True), SYSTEM), (classes, CLASSES))
def test_damage_is_told_in_one_line(make: Callable[[], Any], read: Callable[[str], Any]) -> None:
    text = make().to_json()
    for damaged in [*texts(json.loads(text), signed=False), text[:-1], text[1:], "", "[]", "{}", "null", text + "}"]:
        with pytest.raises(qe.InputError) as caught:
            read(damaged)
        assert "\n" not in str(caught.value) and len(str(caught.value)) < 300


@each((lambda: system(faithful=True), SYSTEM), (classes, CLASSES))
def test_signed_alterations_are_told_or_read_as_they_stand(make: Callable[[], Any], read: Callable[[str], Any]) -> None:
    """A digest that fits proves nothing: whatever is read says what the text says, and nothing else is raised."""
    for altered in texts(json.loads(make().to_json()), signed=True):
        try:
            found = read(altered)
        except qe.InputError as error:
            assert "\n" not in str(error)
        else:
            assert json.loads(found.to_json()) == json.loads(altered)


@each(
    (("segments", 0, "dimension"), 5, "segments[0].dimension"),
    (("segments", 0, "basis", 0), "x + +", "segments[0].basis[0]"),
    (("segments", 0, "equal"), ["x"], "segments[0].equal"),
    (("variables",), ["a"], "variables"),
    (("numbers", "w", 0), [-4, 0, 1], "numbers.w"),
    (("numbers", "w", 1), 2, "numbers.w"),
    (("constants", "w"), "sqrt(3)", "constants.w"),
    (("order",), "grevlex", "order"),
)
def test_the_entry_is_named(entry: tuple[str | int, ...], value: Any, place: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        SYSTEM(replaced(json.loads(system().to_json()), entry, value))
    assert f"comprehensive Gröbner system: {place}: " in str(caught.value)


def test_other_texts_are_refused() -> None:
    for read, other in ((SYSTEM, classes()), (CLASSES, system())):
        with pytest.raises(qe.InputError, match='"format"'):
            read(other.to_json())
        with pytest.raises(qe.InputError, match="text expected"):
            read(other)
