"""A short run of ``make fuzz``, and what it does with a reader that fails."""

from __future__ import annotations

from itertools import islice

import pytest

from tests import fuzz


def test_damaged_texts_are_read_or_refused_in_one_line() -> None:
    for door, text in islice(fuzz.texts(11), 400):
        fuzz.examine(door, text)


def test_a_failing_reader_is_found(monkeypatch, capsys) -> None:
    def broken(text: str) -> None:
        raise KeyError(text[:1])

    monkeypatch.setitem(fuzz.DOORS, "prompt", broken)
    monkeypatch.setattr("sys.argv", ["fuzz", "--inputs", "500"])
    with pytest.raises(KeyError):
        fuzz.main()
    assert capsys.readouterr().out.startswith("prompt: ")


def test_the_number_of_texts(monkeypatch, capsys) -> None:
    monkeypatch.setattr("sys.argv", ["fuzz", "--inputs", "50"])
    assert fuzz.main() == 0 and capsys.readouterr().out == "50 texts read\n"


def test_a_line_break_in_a_word_of_latex() -> None:
    fuzz.examine("latex", "\\forall x \\lnot \\mathrm{a\nc} = x")
