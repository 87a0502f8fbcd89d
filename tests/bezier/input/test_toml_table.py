"""Tables with exact numbers: what is read, and which line a message names."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from bezier.input import toml_table
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
