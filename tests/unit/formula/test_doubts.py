"""Names that may have been meant as products."""

import time

from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.doubts import doubts, joined_names
from qe.formula.syntax import Relation


def test_products_are_letters_side_by_side() -> None:
    assert joined_names(("ax", "xa", "abx", "aax", "x1", "x_a", "tax", "xx"), ("x",)) == {
        "ax": "a*x",
        "xa": "x*a",
        "xx": "x*x",
    }
    assert joined_names(("a", "abx", "tax"), ("x",)) == {"abx": "a*b*x", "tax": "t*a*x"}


def test_notes_on_many_names_take_little_time() -> None:
    """Of 8,000 variables they took half a second, more than the reading: each name was compared with all others."""
    ring = Ring.of(tuple(f"x{i}" for i in range(20_000)))
    chain = conj(atom(ring.gen(i) - ring.gen(i + 1), Relation.LT) for i in range(ring.size - 1))
    formula = exists(ring.names, chain)
    start = time.process_time()
    assert not doubts(formula, "x0 < x1", "text") and time.process_time() - start < 1.5
