"""Every public function with wrong values for every argument: one clear line, an ``InputError``, nothing else."""

import inspect
from fractions import Fraction

import pytest

import qe
from tests.tables import each
from tests.unit.api.doors import DOORS, EVERYWHERE, REGION, Door
from tests.wrong_values import WRONG

SKIPPED = {
    "bits": {"huge"},
    "memory": {"int"},
    "progress": {"function", "class"},
    "source": set(WRONG),
    "coefficients": {"huge"},
    "objective": {"huge"},
}
"""No matter of types: little memory, much precision, coefficients of great length, functions that take no event."""


def arguments(door: Door) -> list[str]:
    """The names of the arguments, all of which a signature tells."""
    parameters = inspect.signature(door.call).parameters.values()
    assert not any(p.kind is p.VAR_KEYWORD for p in parameters)
    return list(door.around) or [p.name for p in parameters]


CASES = [
    pytest.param(door, argument, id=f"{title}-{argument}")
    for title, door in DOORS.items()
    for argument in arguments(door)
    if (title, argument)
    not in {
        ("Region.plot", "timeout"),
        ("Answer.plot", "timeout"),
        ("Region.exact_volume", "timeout"),
    }  # drawing takes longer than the limits that are fine elsewhere
]


@each(*CASES)
def test_a_wrong_value_is_named_in_one_line(door: Door, argument: str) -> None:
    wrap = door.around.get(argument, lambda value: value)
    given = {name: value for name, value in door.given.items() if value is not None and name != argument}
    for kind, value in WRONG.items():
        if kind in SKIPPED.get(argument, ()):
            continue
        if kind in door.fine.get(argument, EVERYWHERE.get(argument, ())):
            door.call(**given, **{argument: wrap(value)})
            continue
        try:
            door.call(**given, **{argument: wrap(value)})
        except qe.InputError as error:
            assert "\n" not in str(error) and 10 < len(str(error)) < 420 and "NoneType" not in str(error), error
            assert kind not in ("none", "object") or argument in str(error) or ": " in str(error), error
        else:
            pytest.fail(f"{kind} was taken")


@pytest.mark.parametrize("title", DOORS)
def test_the_arguments_of_the_table_work(title: str) -> None:
    """The refusals above are about the one value that is wrong."""
    door = DOORS[title]
    given = {name: door.around.get(name, lambda value: value)(v) for name, v in door.given.items() if v is not None}
    door.call(**given)


def test_a_picture_that_cannot_be_written() -> None:
    with pytest.raises(qe.InputError, match="cannot be written"):
        REGION.plot("no/such/folder/picture.png")
    with pytest.raises(qe.InputError, match="timeout"):
        REGION.plot("picture.png", timeout="10")


def test_the_table_knows_every_public_function() -> None:
    functions = {name for name in qe.__all__ if inspect.isfunction(getattr(qe, name))}
    assert functions <= set(DOORS)


ENGINE = {
    "of",
    "by_index",
    "cells",
    "bundle",
    "witness",
    "substitution",
    "derivation",
    "ball",
    "compare",
    "compare_rational",
    "decided",
    "evidence_for",
    "step",
}
"""Methods that take values of the engine."""


def test_the_table_knows_every_method_that_takes_something() -> None:
    known = {title.split()[0] for title in DOORS}
    for kind in [getattr(qe, name) for name in qe.__all__]:
        if not inspect.isclass(kind) or issubclass(kind, Exception):
            continue
        for name, member in inspect.getmembers(kind, inspect.isfunction):
            taken = [p for p in inspect.signature(member).parameters if p != "self"]
            made_by_the_engine = name in ENGINE
            if taken and not name.startswith("_") and not made_by_the_engine:
                assert f"{kind.__name__}.{name}" in known


@each("y,x", "y x", " y , x ", ["y", "x"], ("y", "x"), iter(("y", "x")), "`y`, x")
def test_an_order_may_be_written_in_many_ways(order: object) -> None:
    assert qe.region("x^2 + y^2 <= 1", order).order == ("y", "x")


def test_names_may_be_sympy_symbols() -> None:
    import sympy

    x, y = sympy.symbols("x y")
    disc = qe.region("x^2 + y^2 <= 1", (y, x))
    assert disc.order == ("y", "x")
    assert disc.contains({x: 0, y: Fraction(1, 2)}) and disc.bounds(x) == disc.bounds("x")
    assert qe.region("x > 0", x).order == ("x",)
    assert qe.eliminate(qe.Exists(x, sympy.Eq(x**2, y)), order=[y, x]).formula is not None
    assert qe.check_witness("all x. ex y. y > x", {y: x + 1}) is True
    with pytest.raises(qe.InputError, match="once"):
        disc.contains({x: 0, "x": 0, y: 0})


def test_a_number_in_text_is_not_larger_than_it_looks() -> None:
    """``Fraction('1e999999999')`` fills the memory."""
    for text in ("1e999999999", "1e-999999999", "9" * 100_000):
        with pytest.raises(qe.InputError, match="exact number"):
            REGION.contains({"x": text, "y": 0})


def test_a_float_is_the_number_that_it_prints() -> None:
    assert qe.region("x = 1/10").contains({"x": 0.1})
    assert 0.1 in REGION.fibre([0.6])[0] and 0.8 in REGION.fibre([0.6])[0]
