"""Names in text: what the printer quotes is what the reader would take for something else."""

import pytest

from qe.io import text_lexer
from qe.io.text import read, write
from qe.spelling import KEYWORDS, quoted_if_needed


def test_printer_and_reader_know_the_same_words() -> None:
    assert set(text_lexer.KEYWORDS) == KEYWORDS


@pytest.mark.parametrize("name", [*sorted(KEYWORDS), "two words", "9", "x", "y''", "x_1"])
def test_spelled_names_are_read_back(name: str) -> None:
    spelled = quoted_if_needed(name)
    formula = read(f"{spelled} > 0")
    assert formula.poly.ring.names == (name,)
    assert write(formula) == str(formula) == f"{spelled} > 0"
