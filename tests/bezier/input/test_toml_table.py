"""Tables with exact numbers: what is read, and which line a message names."""

from fractions import Fraction

import pytest

from bezier.input.toml_table import Table
from qe.errors import InputError

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
