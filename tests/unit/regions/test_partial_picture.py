"""The three parts in three colours."""

from pathlib import Path

import pytest

from qe.errors import InputError, Unable
from qe.io.text import read
from qe.options import Budget
from qe.proof.answer import Answer, Status
from qe.proof.partial import Partial
from qe.regions.partial_picture import POINTS, kinds

PARTS = Partial(read("a > 0 and b > 0"), read("a < 0 and b > root(1, b^3 - a)"))
PLAIN = Partial(read("a > 0 and b > 0"), read("a < b"))


def answered(question: str, parts: Partial | None) -> Answer:
    return Answer(Status.UNABLE, None, reason="time limit", question=read(question), partial=parts)


def test_every_point_has_the_colour_of_its_part() -> None:
    rows = kinds(PARTS, ("a", "b"), Budget())
    half = POINTS[2] // 2
    assert len(rows) == len(rows[0]) == POINTS[2]
    assert all(row[half:] == [2] * half for row in rows[half:])  # a, b > 0
    assert all(row[half:] == [1] * half for row in rows[:half])  # a > 0 > b: open
    assert all(row[:half] == [0] * half for row in rows[half:])  # a < 0 < b
    assert rows[0][half - 1] == 1  # b below the cube root of a < 0
    line = kinds(Partial(read("a > 2"), read("a < 1")), ("a",), Budget())
    assert len(line) == 1 and sorted(line[0]) == line[0] and set(line[0]) == {0, 1, 2}


def test_an_answer_in_parts_is_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    found = answered("ex x. x > a and x < b", PLAIN)
    axes = found.plot(tmp_path / "parts.svg")
    assert (tmp_path / "parts.svg").stat().st_size > 1000
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("a", "b")
    assert found.plot(tmp_path / "turned.png", order="b a").get_xlabel() == "b"


def test_what_is_not_drawn(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="1 or 2 variables"):
        answered("ex x. x > a and x < b and x < c", PARTS).plot(tmp_path / "parts.png")
    with pytest.raises(InputError):
        answered("ex x. x > a and x < b", PARTS).plot(tmp_path / "parts.html")
    with pytest.raises(InputError, match="order"):
        answered("ex x. x > a and x < b", PARTS).plot(tmp_path / "parts.png", order="a c")
    with pytest.raises(Unable, match="no formula to draw"):
        answered("ex x. x > a and x < b", None).plot(tmp_path / "parts.png")
