"""Refutations over signs: right for independent signs, going on where lemmas join, and with no lemma too many."""

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from qe.certify.registry import RULES
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.io.text import read
from qe.kernel.boolean import ByLemmas
from qe.kernel.derivation import limits_of
from qe.kernel.signs import Line, read_lemma
from qe.kernel.step import Claim
from qe.options import Budget
from qe.proof.entry import Entry, Json
from qe.proving.lemma_list import Lemmas
from qe.proving.refutation import NODES, Refutation
from qe.simplify.facts import factor_list

RING = Ring.of(("x", "y", "z"))
LIMITS = limits_of(Budget(), RULES)
X, Y, Z = (RING.gen(i) for i in range(3))

atoms = st.builds(Atom, st.sampled_from((X, Y, Z)), st.sampled_from(list(Relation)))
formulas = st.recursive(
    atoms,
    lambda parts: st.builds(
        lambda join, some: join(some), st.sampled_from((conj, disj)), st.lists(parts, min_size=2, max_size=4)
    ),
    max_leaves=14,
)


def check(goal: tuple[Formula, ...], found: Lemmas, search: Refutation) -> list[dict[str, Json]]:
    """The lemmas that the evidence has, which the kernel accepts."""
    evidence = found.only(search.lemmas, [search])
    assert isinstance(evidence, dict)
    claim = Claim("signs", TRUE, TRUE, RING, Entry({"theory": evidence}, "evidence"), "step")
    ByLemmas(lambda claim, context: [goal])(claim, (), LIMITS)
    return evidence["lemmas"]  # type: ignore[return-value]


@given(st.lists(formulas, min_size=1, max_size=4))
def test_independent_signs_are_excluded_iff_no_point_has_them(parts: list[Formula]) -> None:
    goal, search = tuple(parts), Refutation(tuple(parts), LIMITS)
    somewhere = any(
        all(holds_at(f, dict(zip("xyz", point, strict=True))) for f in goal) for point in product((-1, 0, 1), repeat=3)
    )
    assert search.go_on(NODES, NODES) is not somewhere
    if not somewhere:
        assert check(goal, Lemmas(RING), search) == []


def test_a_search_goes_on_when_lemmas_join_and_names_those_alone_that_it_needs() -> None:
    texts = ("x*y > 0 and (x + z = 0 or y < 0 or z > 0)", "x > 0 and y <= 0 or z^2 + 1 < 0")
    goal = tuple(convert(read(text), RING) for text in texts)
    found, search = Lemmas(RING), Refutation(goal, LIMITS)
    assert not search.go_on(NODES, NODES)
    found.identity([(1, ((X + Z, 1),)), (-1, ((X, 1),)), (-1, ((Z, 1),))])  # says nothing here
    found.identity([(1, ((X * Y, 1),)), (-1, ((X, 1), (Y, 1)))])
    search.learn(tuple(found.numbers), found.facts)
    assert not search.go_on(NODES, NODES) and len(search.pending) == 1
    found.identity([(-1, ((Z * Z + 1, 1),)), (1, ((Z, 2),)), (1, ())])
    search.learn(tuple(found.numbers), found.facts)
    assert search.go_on(NODES, NODES) and search.lemmas == [1, 2]
    assert len(check(goal, found, search)) == 2


def test_too_few_cases_are_no_refutation() -> None:
    triples = product("<>=", repeat=3)
    rest = [convert(read(f"x {one} 0 or y {two} 0 or z {three} 0"), RING) for one, two, three in triples]
    assert not Refutation((*rest, TRUE), LIMITS).go_on(1, 0)
    search = Refutation((*rest, TRUE), LIMITS)
    assert search.go_on(NODES, NODES)
    check((*rest, TRUE), Lemmas(RING), search)


@given(st.lists(st.lists(st.integers(-9, 9), min_size=2, max_size=5), min_size=1, max_size=3))
def test_a_line_is_meant_as_the_kernel_reads_it(rows: list[list[int]]) -> None:
    polys = [RING.from_terms({(0, k, 0): c for k, c in enumerate(row) if c}) for row in rows]
    factors = list(dict.fromkeys(f for p in polys if p for f, _ in factor_list(p) if not f.is_constant))
    found = Lemmas(RING)
    if factors:
        found.line(factors, 1)
        meant, checked = found.facts[0], read_lemma(Entry(found.lemmas[0], "lemma"), tuple(found.numbers), RING)
        assert isinstance(meant, Line) and isinstance(checked, Line)
        assert (meant.polynomials, meant.cells) == (checked.polynomials, checked.cells)
