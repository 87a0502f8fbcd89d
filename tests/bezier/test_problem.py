"""Problems: their files, the numbers in them, and what is refused."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.workspace import WorkspaceKind
from bezier.input import toml_table
from bezier.input.numbers import NotANumber, describe, parse, read_squared
from bezier.input.toml_table import Table
from bezier.problem import PlanMethod, load_problem, read_problem
from qe.errors import InputError
from qe.exact.radicals import root_text
from tests.tables import each

BASE = {
    "method": '"quadratic"',
    "workspace": '"ball"',
    "start": "[-4, 1, 1]",
    "via": "[[-1, 3, 3], [1, 3, 3]]",
    "goal": '["9/2", 1, 1]',
    "radius": '"auto"',
}


def text(**changes):
    table = {**BASE, **changes}
    return "".join(f"{key} = {value}\n" for key, value in table.items() if value is not None)


def test_the_main_example(root):
    problem = load_problem(root / "examples" / "three_balls.toml")
    assert problem.method is PlanMethod.QUADRATIC and problem.workspace.kind is WorkspaceKind.BALL
    assert problem.goal == (Fraction(9, 2), 1, 1)
    assert problem.workspace.radius_squared == Fraction(89, 4) and problem.radius_is_auto
    assert problem.notes == ()


@each("three_balls", "hemisphere_gap", "no_control_point")
def test_examples_are_readable(name, root):
    assert load_problem(root / "examples" / f"{name}.toml").source.endswith(f"{name}.toml")


def test_decimals_are_exact():
    problem = read_problem(text(start="[-0.1, 1e-1, '0.30']", radius="5.5"))
    assert problem.start == (Fraction(-1, 10), Fraction(1, 10), Fraction(3, 10))
    assert problem.workspace.radius_squared == Fraction(121, 4)


def test_radius_as_a_root():
    problem = read_problem(text(radius='"sqrt(27)"'))
    assert problem.workspace.radius_squared == 27 and problem.workspace.radius_text == "3*sqrt(3)"


def test_defaults():
    problem = read_problem(text(method=None, workspace=None, radius=None))
    assert problem.method is PlanMethod.QUADRATIC and problem.radius_is_auto


def test_notes():
    notes = read_problem(text(via="[[-1, 3, 3], [1, 2, 3]]", start="[0, 0, 0]")).notes
    assert len(notes) == 2 and "differ in y" in notes[0] and "origin" in notes[1]


@each("[[-1, 2, 3], [4, 1, 0]]", "[[4, 1, 0], [-1, 2, 3]]")
def test_the_strip_of_heights_lies_between_the_points_on_the_way(via):
    strip = read_problem(text(via=via)).strip
    assert (strip.low, strip.high, strip.heights) == (-1, 4, {"y": 1})


def test_via_points_that_nobody_gave_are_not_called_via_0():
    """ "radius: expected at least …, the norm of via[0]" was said where a wall leaves no way over it."""
    wall = '[[obstacle]]\nkind = "box"\nlow = [-1, -9, -1]\nhigh = [1, 9, 9]'
    with pytest.raises(InputError, match="via: expected two points in the workspace, found none; one over the obst"):
        read_problem(f"start = [-4, 2, 1]\ngoal = [4, 2, 1]\nradius = 6\n{wall}")


BAD = {
    "start = [1,2]": ("start", "3 numbers", "2 values"),
    'start = [1,2,"x"]': ("start[2]", "fraction", '"x"'),
    "start = [1,2,nan]": ("start[2]", "decimal", "nan"),
    "start = [1,2,-inf]": ("start[2]", "decimal", "-inf"),
    "start = [1,2,true]": ("start[2]", "integer", "true"),
    "start = [1,2,[3]]": ("start[2]", "integer", "array"),
    'start = ["1/0",1,1]': ("start[0]", "integer", "divides by zero"),
    'start = ["sqrt(2)",1,1]': ("start[0]", "integer", "sqrt(2)"),
    "start = [1e999999999,1,1]": ("start[0]", "decimal", "exponent"),
    "start = 3": ("start", "point", "3"),
    "start = 1979-05-27": ("start", "point", "date"),
    'colour = "red"': ("colour", "one of the keys", "unknown key"),
    'radius = "1/2"': ("radius", "at least 3*sqrt(2) (about 4.2426407), the norm of start", "1/2 (about 0.5)"),
    "radius = 2": ("radius", "at least", "2"),
    "radius = -9": ("radius", "positive", "negative"),
    "radius = 0": ("radius", "positive", "zero"),
    'radius = "sqrt(-1)"': ("radius", "positive", "negative"),
    'radius = "big"': ("radius", "positive", "big"),
    "radius = true": ("radius", "positive", "true"),
    'method = "octic"': ("method", '"quadratic"', '"octic"'),
    "method = 8": ("method", '"quadratic"', "8"),
    'workspace = "torus"': ("workspace", '"hemisphere"', '"torus"'),
    "via = [[1,1,1]]": ("via", "two points", "1 value"),
    "via = [1, 2]": ("via", "two points", "2 values"),
    "via = [[1,1,1],[1,1]]": ("via[1]", "3 numbers", "2 values"),
    "via = [[1,1,1],[1,1,1]]": ("via[1]", "other than via[0]", "same point"),
    "via = [[-4,1,1],[1,1,1]]": ("via[0]", "other than start", "same point"),
    "goal = [1, 3, 3]": ("goal", "other than via[1]", "same point"),
}


@pytest.mark.parametrize("line", BAD)
def test_bad_values_get_one_line_with_key_expected_and_found(line):
    key, value = (part.strip() for part in line.split("=", 1))
    with pytest.raises(InputError) as caught:
        read_problem(text(**{key: value}), "p.toml")
    message = str(caught.value)
    name, expected, found = BAD[line]
    assert "\n" not in message and message.startswith("p.toml:") and f": {name}: expected " in message
    assert expected in message.split(", found ")[0] and found in message.split(", found ", 1)[1]


def test_the_line_of_the_key_is_named():
    with pytest.raises(InputError, match=r"^p\.toml:5: goal\[1\]: "):
        read_problem(text(goal='[1, "?", 1]'), "p.toml")


@each("start", "via", "goal")
def test_missing_points(key):
    with pytest.raises(InputError, match=rf"^p\.toml: {key}: expected .* found no such key$"):
        read_problem(text(**{key: None}), "p.toml")


@each("start = [1, 2", "= 3", "a = 1\na = 2", "[x", "x = '''", "\x00", "via = [[1,,2]]")
def test_broken_toml(body):
    with pytest.raises(InputError, match=r"^p\.toml:\d+.*expected a TOML file, found") as caught:
        read_problem(body, "p.toml")
    assert "\n" not in str(caught.value)


def test_huge_integer_is_refused():
    with pytest.raises(InputError):
        read_problem(text(radius="1" * 5000), "p.toml")
    with pytest.raises(InputError):
        read_problem(text(radius="1" * 1000), "p.toml")


def test_below_the_table():
    with pytest.raises(InputError, match=r"goal: expected a point with z >= 0"):
        read_problem(text(goal="[4, 1, -1]", workspace='"hemisphere"'))


def test_unreadable_files(tmp_path: Path):
    with pytest.raises(InputError, match="expected a readable file"):
        load_problem(tmp_path / "none.toml")
    with pytest.raises(InputError, match="expected a readable file"):
        load_problem(tmp_path)
    (tmp_path / "latin.toml").write_bytes(b"# \xe9\xff\n")
    with pytest.raises(InputError, match="expected UTF-8"):
        load_problem(tmp_path / "latin.toml")
    (tmp_path / "big.toml").write_bytes(b"#" * 1_000_001)
    with pytest.raises(InputError, match="at most"):
        load_problem(tmp_path / "big.toml")


@given(st.fractions(max_denominator=10**6))
def test_fractions_are_read_back(value):
    assert parse(str(value)) == value


@given(st.decimals(allow_nan=False, allow_infinity=False, min_value=-(10**9), max_value=10**9))
def test_decimals_are_read_exactly(value):
    assert parse(str(value)) == Fraction(value)


@given(st.text(max_size=12))
def test_any_text_is_a_number_or_refused(raw):
    try:
        parse(raw)
    except NotANumber as error:
        assert "\n" not in str(error)


@each(("start = ['1e51', 1, 1]", "start"), ("radius = '1e400'", "radius"))
def test_numbers_beyond_floating_point_are_refused(line, key):
    text = "start = [0, 0, 1]\nvia = [[1, 1, 1], [2, 1, 1]]\ngoal = [3, 1, 1]\nradius = 9\n"
    kept = [old for old in text.splitlines() if not old.startswith(key)]
    with pytest.raises(InputError, match=rf"{key}.*: expected .* at most 10\^50.*, found a larger one"):
        read_problem("\n".join([*kept, line]))


@given(st.fractions(0, 10**6, max_denominator=10**6))
def test_a_radius_is_read_as_it_is_printed(square):
    assert read_squared(root_text(square)) == square


@each((" 3/2 * sqrt( 2 ) / 3 ", Fraction(1, 2)), ("sqrt(27/4)", Fraction(27, 4)), ("1.5", Fraction(9, 4)))
def test_other_spellings(text, square):
    assert read_squared(text) == square


@each(
    "sqrt(-1)",
    "-2*sqrt(3)",
    "sqrt(3)/0",
    "sqrt(3)/-2",
    "2*3*sqrt(5)",
    "sqrt(2)*3",
    "sqrt(sqrt(2))",
    "sqrt()",
    "*sqrt(2)",
)
def test_what_is_no_radius(text):
    with pytest.raises(NotANumber):
        read_squared(text)


def test_articles():
    assert describe(object()) == "an object" and describe(b"") == "a bytes"


TEXT = """\
title = "x"

[[half_space]]
normal = [0, 0.1, "1/3"]
offset = 2

[[half_space]]
normal = [1, 0, 0]
offset = "two"
points = ["Q1", "Q2", "Q1"]
"""


@pytest.fixture
def table():
    return Table.parse(TEXT, "p.toml")


def test_exact_values(table):
    first, second = table.tables("half_space")
    assert first.point("normal") == (0, Fraction(1, 10), Fraction(1, 3)) and first.number("offset") == 2
    assert first.number("missing", Fraction(7)) == 7 and table.tables("obstacle") == ()
    with pytest.raises(InputError, match=r"^p\.toml:9: half_space\[1\]\.offset: expected .*two"):
        second.number("offset")


def test_the_line_of_a_key_in_the_second_table(table):
    with pytest.raises(InputError, match=r"^p\.toml:10: half_space\[1\]\.points\[2\]: expected a list of points"):
        table.tables("half_space")[1].words("points", ("Q1", "Q2"), "points")
    with pytest.raises(InputError, match=r"^p\.toml: half_space\[0\]\.points: expected .* found no such key$"):
        table.tables("half_space")[0].words("points", ("Q1",), "points")
    with pytest.raises(InputError, match=r"^p\.toml:3: half_space\[0\]\.radius: expected something, found nothing$"):
        raise table.tables("half_space")[0].error("radius", "something", "nothing")


def test_unknown_keys_and_wrong_shapes(table):
    with pytest.raises(InputError, match=r"^p\.toml:9: half_space\[1\]\.offset: expected one of the keys normal"):
        table.tables("half_space")[1].only(("normal",))
    with pytest.raises(InputError, match=r"^p\.toml:1: title: expected tables \[\[title\]\]"):
        table.tables("title")
    with pytest.raises(InputError, match="above zero, found 0"):
        Table({"radius": 0}).positive("radius")
    with pytest.raises(InputError, match="list of points"):
        Table({"points": []}).words("points", ("Q1",), "points")


def test_text_with_and_without_a_mark_of_order(tmp_path: Path) -> None:
    for data in ("x = 'ü'".encode(), "x = 'ü'".encode("utf-8-sig")):
        (tmp_path / "p.toml").write_bytes(data)
        assert toml_table.read_text(tmp_path / "p.toml") == "x = 'ü'"


def test_what_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "p.toml"
    with pytest.raises(InputError, match=r"p\.toml: expected a readable file, found: No such file"):
        toml_table.read_text(file)
    with pytest.raises(InputError, match="expected a readable file"):
        toml_table.read_text(tmp_path)
    file.write_bytes(b"a = '\xff'")
    with pytest.raises(InputError, match="expected UTF-8 text, found byte 0xff at 5"):
        toml_table.read_text(file)
    monkeypatch.setattr(toml_table, "MAX_BYTES", 10)
    file.write_bytes(b"0123456789")
    assert toml_table.read_text(file) == "0123456789"
    file.write_bytes(b"0123456789x")
    with pytest.raises(InputError, match="at most 10 bytes, found more"):
        toml_table.read_text(file)
