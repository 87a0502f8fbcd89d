"""Words and formulas apart."""

from qe.io.sentence import Sentence
from tests.tables import each


@each(
    (
        "Find all values of k for which x^2 + kx + 1 = 0 has real roots.",
        "find §0 such that §1 has roots",
        ["k", "x^2 + kx + 1 = 0"],
    ),
    ("Prove that a^2 >= 0", "prove that §0", ["a^2 >= 0"]),
    ("the positive numbers a and b", "positive numbers §2", ["a", "b", "a, b"]),
    ("x is never 1", "§0 is never §1", ["x", "1"]),
)
def test_words_with_formulas_between_them(text: str, words: str, formulas: list[str]) -> None:
    """Two names in a row are one list; a word that nobody knows stays a word."""
    said = Sentence(text)
    assert (said.words, said.formulas) == (words, formulas)


def test_a_part_is_the_text_again() -> None:
    said = Sentence("Prove that a + b >= 2, where a, b are positive")
    assert said["§0"] == "a + b >= 2"
    assert said.names("§1") == ["a", "b"]
