"""Test points of atoms: those of a degree stand only where the coefficient of that degree is not 0."""

from itertools import product

import qe
from qe.formula.evaluate import holds_at
from tests.tables import each

NAMES = ("b", "c", "d", "g")


@each("<=", ">=", "<", "=", "/=")
@each("a*x^2", "a*x^3")
def test_where_the_leading_coefficient_vanishes_it_is_as_if_the_term_were_not_there(lead: str, relation: str) -> None:
    """A root with 0 under its fraction turned every weak condition into 0 >= 0, which was true."""
    rest = f"b*x + c {relation} 0 and x >= d and x <= g"
    whole = qe.eliminate(f"ex x. {lead} + {rest}", method="vs", without="shortening").formula
    short = qe.eliminate(f"ex x. {rest}", method="vs").formula
    assert whole is not None and short is not None
    for values in product((-1, 0, 1), repeat=len(NAMES)):
        at = dict(zip(NAMES, values, strict=True))
        assert holds_at(whole, {**at, "a": 0}) == holds_at(short, at), at
