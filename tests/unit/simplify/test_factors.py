"""What the sign theory knows: ranges, factors with exponents, and atoms decided or made smaller by it."""

from __future__ import annotations

from qe.exact.ring import Ring
from qe.formula.build import atom, convert
from qe.formula.syntax import FALSE, TRUE, And, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.simplify.factors import atom_under, reduce_atom
from qe.simplify.facts import NOTHING, factor_list
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)


@each(
    ("x > 0", X**2 * Y, {-1, 0, 1}),
    ("x < 0", X**2 * Y**2, {0, 1}),
    ("x < 0 and y < 0", X * Y, {1}),
    ("x < 0 and y < 0", X**2 * Y, {-1}),
    ("x < 0 and y < 0", -(X**2) * Y, {1}),
    ("x /= 0 and y <= 0", X**2 * Y, {-1, 0}),
    ("x - y > 0", (X - Y) ** 3, {1}),
    ("x - y < 0 and y < 0", (X - Y) ** 2 * Y, {-1}),
    ("x - y /= 0 and y < 0", -((X - Y) ** 2) * Y, {1}),
    ("x > 1 and y > 1", X + Y - 2, {1}),
)
def test_signs(known: str, poly: object, signs: set[int]) -> None:
    facts = NOTHING.extended(conjuncts(convert(read(known), RING)))
    assert facts.signs(poly) == signs  # type: ignore[arg-type]
    assert facts.sign(poly) == (next(iter(signs)) if signs in ({1}, {-1}) else None)  # type: ignore[arg-type]


@each(
    ("x > 0", X * Y, Relation.LT, "y < 0"),
    ("x < 0", X * Y, Relation.LT, "y > 0"),
    ("x /= 0", X**2 * Y, Relation.LE, "y <= 0"),
    ("x >= 0", X * Y, Relation.GT, "x /= 0 and y > 0"),
    ("x >= 0", X, Relation.LE, "x = 0"),
    ("y = 0 or x > 0", X * Y, Relation.EQ, "x*y = 0"),
)
def test_atoms_made_smaller(known: str, poly: object, relation: Relation, expected: str) -> None:
    facts = NOTHING.extended(conjuncts(convert(read(known), RING)))
    assert atom_under(poly, relation, facts) == convert(read(expected), RING)  # type: ignore[arg-type]


def test_atoms_decided() -> None:
    facts = NOTHING.extended((atom(X, Relation.GT),))
    assert atom_under(X * (Y**2 + 1), Relation.GT, facts) == TRUE
    assert atom_under(X * (Y**2 + 1), Relation.LE, facts) == FALSE
    assert atom_under(X**2 + Y**2, Relation.LE, NOTHING) == convert(read("y = 0 and x = 0"), RING)


def test_factors_of_any_associate() -> None:
    assert factor_list(-6 * X**2 * Y) == factor_list(X**2 * Y)
    assert dict(factor_list(X**2 * Y)) == {X: 2, Y: 1}
    assert factor_list(3 - 3 * X) == ((X - 1, 1),)


@each(
    ("x*y /= 0", True, "x /= 0 and y /= 0"),
    ("x*y /= 0", False, "x*y /= 0"),
    ("x*y = 0", False, "x = 0 or y = 0"),
    ("x*y = 0", True, "x*y = 0"),
    ("x^3*y = 0", True, "x*y = 0"),
    ("x^2 + y^2 = 0", True, "x = 0 and y = 0"),
    ("x^2 + y^2 = 0", False, "x^2 + y^2 = 0"),
    ("x^2 + y^2 /= 0", False, "x /= 0 or y /= 0"),
    ("x^2 + y^2 /= 0", True, "x^2 + y^2 /= 0"),
    ("(y^2 + 1)*(x^2 + y^2) = 0", True, "x^2 + y^2 = 0"),  # the factor that is left is looked at another time
    ("x^2 - 2*x*y + y^2 = 0", True, "x - y = 0"),
)
def test_equations_are_split_where_that_keeps_their_meaning(text: str, conjunctive: bool, expected: str) -> None:
    """Products in /= are split in a conjunction, those in = in a disjunction, and nowhere else."""
    given = convert(read(text), RING)
    found = reduce_atom(given, NOTHING, conjunctive)  # type: ignore[arg-type]
    assert members(found) == members(convert(read(expected), RING))


def members(formula: Formula) -> tuple[type, frozenset[Formula]]:
    """The kind of a formula with its members in any order."""
    return type(formula), frozenset(formula.args if isinstance(formula, And | Or) else [formula])
