"""Atoms in one variable against each other: what follows, what contradicts, by sampling every piece."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Atom, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.simplifier.facts import NOTHING
from qe.simplifier.univariate import irredundant, roots_of
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)


def kept(text: str, known: str = "true") -> str | None:
    given_atoms = [a for a in conjuncts(read(f"0*x = 0 and {text}")) if isinstance(a, Atom)]
    facts = NOTHING if known == "true" else NOTHING.extended(conjuncts(read(known)))
    found = irredundant(given_atoms, facts)
    return None if found is None else "" if not found else str(conj(found))


@each(
    ("x^2 < 2 and x < 2", "x^2 < 2"),
    ("x^2 <= 2 and x < 2", "x^2 <= 2"),
    ("x^2 <= 4 and x <= 2", "x^2 <= 4"),
    ("x^2 <= 4 and x < 2", "x < 2 and x^2 <= 4"),
    ("x^2 > 2 and x > 3", "x > 3"),
    ("x^2 >= 4 and x >= 2", "x >= 2"),
    ("x^2 < 2 and x > 2", None),
    ("x^2 = 2 and x > 0 and x^3 > 0", "x > 0 and x^2 = 2"),
    ("x^2 <= 0 and x^3 >= 1", None),
    ("x^2 <= 4 and x = 2", "x = 2"),
    ("x^3 > 1 and x /= 1", "x^3 > 1"),
    ("x^2 > -1 and x^4 + x^2 > -1", ""),
    ("x^2 < -1 and x > 1", None),
    ("x^2 = 2 and x^4 = 4", "x^2 = 2"),
    ("x^2 - x <= 0 and x^2 = x", "x^2 - x = 0"),
    (
        "10^30*x > 1 and x^3 > 0 and x*(10^30*x - 2) < 0",
        "x > 1/1000000000000000000000000000000 and 500000000000000000000000000000*x^2 - x < 0",
    ),
    ("x^3 >= 1 and x /= 1", "x /= 1 and x^3 >= 1"),
)
def test_atoms_of_one_variable(text: str, left: str | None) -> None:
    found = kept(text)
    assert (
        found is None if left is None else found is not None and set(found.split(" and ")) == set(left.split(" and "))
    )


@each(
    ("x^2 < 9 and y < 1", "0 < x and x < 2", "y < 1"),
    ("x^2 > 9", "0 < x and x < 2", None),
    ("x^2 > 1", "0 < x and x < 2", "x^2 > 1"),
    ("x^2 > 1 and x > 0", "x > -5", "x^2 > 1 and x > 0"),
    ("x^2 > 1", "x > 1", ""),
)
def test_what_is_known_counts(text: str, known: str, left: str | None) -> None:
    assert kept(text, known) == left


def test_roots() -> None:
    assert [float(r) for r in roots_of((X - 1) ** 2 * (X + 2))] == [-2.0, 1.0]
    assert roots_of(Y**2 + 1) == ()


FACTORS = st.sampled_from([X, X - 1, X + 2, X**2 - 2, X**2 - 3, X**2 + 1, 2 * X - 3, (X - 1) ** 2])
ATOMS = st.builds(lambda f, g, r: Atom(f * g, r), FACTORS, FACTORS, st.sampled_from(tuple(Relation)))
PROBES = [Fraction(n, 8) for n in range(-24, 25)] + [Fraction(141421, 10**5), Fraction(173205, 10**5)]


@given(st.lists(ATOMS, min_size=2, max_size=5, unique=True))
def test_the_conjunction_stays_what_it_is(atoms):
    found = irredundant(atoms, NOTHING)
    for probe in PROBES:
        point = {"x": probe, "y": Fraction(0)}
        before = all(holds_at(a, point) for a in atoms)
        assert before == (found is not None and all(holds_at(a, point) for a in found))
    if found is not None:
        assert set(found) <= set(atoms)
        for a in found:  # nothing is left that follows from the others
            assert irredundant([b for b in found if b is not a] or [a], NOTHING) is not None


@given(st.lists(ATOMS, min_size=2, max_size=4, unique=True))
def test_nothing_is_left_that_can_go(atoms):
    found = irredundant(atoms, NOTHING)
    if found is not None and any(a.poly.total_degree > 1 for a in found):
        assert irredundant(found, NOTHING) == found
