"""What is known about signs: facts, factors, absorption."""

from fractions import Fraction
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.simplifier.absorb import absorb
from qe.simplifier.factors import atom_under, reduce_atom
from qe.simplifier.facts import NOTHING, Facts, factor_list, generator
from qe.simplifier.simplify import simplify
from tests.strategies import points
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
MONOMIALS = [k for k in product(range(4), repeat=3) if 0 < sum(k) <= 5]


assert len(MONOMIALS) > 30


def poly(coefficients: list[int]) -> Poly:
    x, y, z = (RING.gen(i) for i in range(3))
    terms = (c * x**a * y**b * z**d for c, (a, b, d) in zip(coefficients, MONOMIALS, strict=True))
    return sum(terms, RING.constant(0))


def facts(*relations: tuple[int, Relation]) -> Facts:
    return Facts().extended(atom(generator(RING, i), relation) for i, relation in relations)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(0, 3), min_size=len(MONOMIALS), max_size=len(MONOMIALS)), st.data())
def test_a_long_sum_of_one_sign(coefficients: list[int], data: st.DataObject) -> None:
    signs = [
        data.draw(st.sampled_from((Relation.GT, Relation.GE, Relation.LT, Relation.LE, Relation.NE))) for _ in "xyz"
    ]
    down = data.draw(st.booleans())
    flipped = data.draw(st.integers(0, len(coefficients) - 1))
    if data.draw(st.booleans()):
        coefficients[flipped] *= -1
    sums = poly([-c for c in coefficients] if down else coefficients)
    if sums.is_constant:
        return
    known = facts(*enumerate(signs)).signs(sums)
    values = [data.draw(st.sampled_from([v for v in (-2, -1, 0, 1, 2) if r.holds((v > 0) - (v < 0))])) for r in signs]
    value = sums.evaluate([Fraction(v) for v in values])
    assert (value > 0) - (value < 0) in known


def test_long_sums_are_decided() -> None:
    ones = poly([1] * len(MONOMIALS))
    positive = [(i, Relation.GT) for i in range(3)]
    assert facts(*positive).signs(ones) == {1}
    assert facts(*positive).signs(-ones) == {-1}
    assert facts(*((i, Relation.GE) for i in range(3))).signs(ones) == {0, 1}
    assert facts(*positive[:2]).signs(ones) == {-1, 0, 1}
    squares = poly([1 if not any(k % 2 for k in powers) or powers[0] else 0 for powers in MONOMIALS])
    assert facts((0, Relation.GT), (1, Relation.NE)).signs(squares) == {-1, 0, 1}
    assert facts(*positive).signs(ones - 2 * poly([1] + [0] * (len(MONOMIALS) - 1))) == {-1, 0, 1}
    with_x = poly([int(powers[0] > 0) for powers in MONOMIALS])
    assert with_x.term_count() > 24
    below = facts((0, Relation.LT), *positive[1:])
    assert below.signs(with_x) == {-1, 0, 1}
    assert below.signs(poly([powers[0] and (-1) ** powers[0] for powers in MONOMIALS])) == {1}


def test_a_sentence_on_a_long_sum_needs_no_decomposition() -> None:
    text = " + ".join(f"{k + 1}*x^{a}*y^{b}*z^{c}" for k, (a, b, c) in enumerate(MONOMIALS))
    answer = qe.eliminate(f"ex x, y, z. x > 0 and y > 0 and z > 0 and {text} < 1/10^9 - 1/10^9", timeout=60, check=True)
    assert answer.truth is False


PLANE = Ring.of(("x", "y"))
X, Y = PLANE.gen(0), PLANE.gen(1)


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
    facts = NOTHING.extended(conjuncts(convert(read(known), PLANE)))
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
    facts = NOTHING.extended(conjuncts(convert(read(known), PLANE)))
    assert atom_under(poly, relation, facts) == convert(read(expected), PLANE)  # type: ignore[arg-type]


def test_atoms_decided() -> None:
    facts = NOTHING.extended((atom(X, Relation.GT),))
    assert atom_under(X * (Y**2 + 1), Relation.GT, facts) == TRUE
    assert atom_under(X * (Y**2 + 1), Relation.LE, facts) == FALSE
    assert atom_under(X**2 + Y**2, Relation.LE, NOTHING) == convert(read("y = 0 and x = 0"), PLANE)


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
    given = convert(read(text), PLANE)
    found = reduce_atom(given, NOTHING, conjunctive)  # type: ignore[arg-type]
    assert members(found) == members(convert(read(expected), PLANE))


def members(formula: Formula) -> tuple[type, frozenset[Formula]]:
    """The kind of a formula with its members in any order."""
    return type(formula), frozenset(formula.args if isinstance(formula, And | Or) else [formula])


NAMES = ("a", "b", "c")
CUBE = Ring.of(NAMES)


def formula(text: str) -> Formula:
    return convert(read(text), CUBE)


def level(parts: tuple[Formula, ...], conjunctive: bool) -> Formula:
    """What two comparisons of one polynomial say together, by their signs."""
    left, right = parts
    if not (isinstance(left, Atom) and isinstance(right, Atom) and left.poly == right.poly):
        return (conj if conjunctive else disj)(parts)
    join = frozenset.intersection if conjunctive else frozenset.union
    signs = join(left.relation.signs, right.relation.signs)
    if not signs:
        return FALSE
    if len(signs) == 3:
        return TRUE
    return Atom(left.poly, next(r for r in Relation if r.signs == signs))


def absorbed(*members: str, conjunctive: bool = False) -> set[Formula]:
    return set(absorb([formula(m) for m in members], conjunctive, level))


@each(
    (("a > 0 and b > 0", "a > 0 and b > 0 and c = 0"), ("a > 0 and b > 0",)),
    (("a > 0 and b > 0", "a > 0 and b = 0"), ("a > 0 and b >= 0",)),
    (("a > 0 and b > 0", "a > 0 and b <= 0"), ("a > 0",)),
    (("a > 0 and b > 0", "a > 0 and c > 0"), ("a > 0 and b > 0", "a > 0 and c > 0")),
    (("a > 0 and b > 0", "a = 0 and b = 0"), ("a > 0 and b > 0", "a = 0 and b = 0")),
    (("a > 0 and b > 0 and c > 0", "a > 0 and b > 0 and c <= 0", "a > 0 and b <= 0"), ("a > 0",)),
)
def test_members_of_a_disjunction(members: tuple[str, ...], left: tuple[str, ...]) -> None:
    assert absorbed(*members) == set(map(formula, left))


def test_members_of_a_conjunction() -> None:
    assert absorbed("a > 0 or b > 0", "a > 0 or b > 0 or c = 0", conjunctive=True) == {formula("a > 0 or b > 0")}
    assert absorbed("a > 0 or b >= 0", "a > 0 or b <= 0", conjunctive=True) == {formula("a > 0 or b = 0")}


def test_one_member_and_atoms_stay() -> None:
    members = [formula("a > 0"), formula("b > 0 and c > 0")]
    assert absorb(members, False, level) is members
    assert absorb([], False, level) == []


ATOMS = st.builds(lambda i, r: Atom(CUBE.gen(i), r), st.integers(0, 2), st.sampled_from(tuple(Relation)))


@settings(max_examples=40)
@given(st.lists(st.lists(ATOMS, min_size=1, max_size=3), max_size=5), st.booleans(), points(NAMES))
def test_the_truth_stays(parts: list[list[Formula]], conjunctive: bool, point: dict[str, object]) -> None:
    inner, outer = (disj, conj) if conjunctive else (conj, disj)
    members = list(dict.fromkeys(inner(part) for part in parts))
    found = absorb(members, conjunctive, level)
    assert holds_at(outer(found), point) is holds_at(outer(members), point)  # type: ignore[arg-type]
    assert len(found) <= len(members)


@each("p^3 <= 0", "p*(p^2 + 1) <= 0")
def test_powers_of_products_of_many_terms_are_seen_as_products(text: str) -> None:
    """Expanded they have more than 1,000 terms (x10y2 of Redlog's test set, with what does not change its meaning)."""
    product = "*".join(f"(a{k}*x^10 - b{k}*y^2)" for k in range(1, 6))
    assert simplify(read(text.replace("p", f"({product})"))) == simplify(read(f"{product} <= 0"))
