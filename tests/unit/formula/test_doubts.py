"""Names that may have been meant as products."""

from qe.formula.doubts import joined_names


def test_products_are_letters_side_by_side() -> None:
    assert joined_names(("ax", "xa", "abx", "aax", "x1", "x_a", "tax", "xx"), ("x",)) == {
        "ax": "a*x",
        "xa": "x*a",
        "xx": "x*x",
    }
    assert joined_names(("a", "abx", "tax"), ("x",)) == {"abx": "a*b*x", "tax": "t*a*x"}
    assert joined_names(("ax",), ("x", "ax")) == {}
