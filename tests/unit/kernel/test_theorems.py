"""All theorems as data: right at random numbers, instances accepted, what is nearly one refused. One suite for all."""

from __future__ import annotations

import random
from dataclasses import replace
from functools import cache

import pytest

import qe
from experiments.theorems import accepted, instances, stored, tried
from experiments.z3_oracle import decide as z3_decides
from qe.errors import CertificateRejected, InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, exists, neg
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.negation import negation
from qe.kernel.statements import Theorem, rows, theorem
from qe.kernel.step import Claim, Context
from qe.kernel.theorem import check_theorem
from qe.proof.entry import Entry, Json, poly_to_text
from qe.rules.closed_forms import (
    generic,
    matches,
    pattern,
    relations_in,
    term,
    undirected,
    variables_in,
)
from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, limits

NAMES = tuple(rows())
AXIOMS = tuple(name for name, row in rows().items() if "axiom" in row.data)
SIZES = frozenset((1, 2, 3))
BOUND = ("x", "y", "z", "w")
RING = Ring.of((*"abcdefgh", *BOUND))


class Case:
    """An instance with polynomials for letters, and what is given known beside it."""

    def __init__(self, used: Theorem, rng: random.Random) -> None:
        self.used = used
        self.letters = {name: self.polynomial(rng) for name in used.letters}
        for bound in used.bound.values():
            assert len(bound) <= len(BOUND)
        self.variables = {v: BOUND[k] for bound in used.bound.values() for k, v in enumerate(bound)}
        for name, tree in pattern(used.name, used.words).roots.items():
            self.make_square(used, name, tree)

    def polynomial(self, rng: random.Random) -> Poly:
        return RING.var(rng.choice("abcdefgh")) * rng.choice((1, 2, -1)) + rng.choice((0, 1, -3))

    def make_square(self, used: Theorem, name: str, tree: object) -> None:
        """The radii become b and 1, about a point on the first axis and the origin."""
        a, b, f, g = (RING.var(name) for name in "abfg")
        zero = dict.fromkeys(self.letters, RING.constant(0))
        self.letters = {**zero, "c": f, "k": g, "b0": 2 * a * f, "e": f * (a * a - b * b), "m": -g}
        root = term(used, tree, self.letters, RING).square_root()  # type: ignore[arg-type]
        assert root is not None
        self.letters[name] = root

    def formula(self, part: str) -> Formula:
        return self.used.formula(part, self.letters, self.variables, RING)

    @property
    def known(self) -> Context:
        return tuple(part for part in conjuncts(self.formula("given")) if part != TRUE)

    @property
    def evidence(self) -> dict[str, Json]:
        letters: dict[str, Json] = {name: poly_to_text(poly) for name, poly in self.letters.items()}
        words: list[Json] = list(self.used.words)
        variables: dict[str, Json] = dict(self.variables)
        return {"theorem": self.used.name, "words": words, "letters": letters, "variables": variables}


def objection(before: Formula, after: Formula, evidence: dict[str, Json], known: Context) -> str:
    """Why a step is refused; nothing where it is accepted."""
    entry = Entry({**evidence, "theory": NO_LEMMAS}, "evidence")
    try:
        check_theorem(Claim("theorem", before, after, RING, entry, "step"), known, limits())
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


@cache
def cases(name: str, count: int = 4) -> list[Case]:
    rng = random.Random(name)
    choices = list(rows()[name].choices(SIZES))
    listed: list[Case] = []
    while len(listed) < count:
        used = theorem(name, rng.choice(choices))
        assert used is not None
        case = Case(used, rng)
        if FALSE not in (case.formula("given"), case.formula("block")) and case.formula("block") != TRUE:
            listed.append(case)
    return listed


@pytest.mark.parametrize("name", NAMES)
@each((20, 18), pytest.param(60, 55, marks=pytest.mark.deep))
def test_right_at_random_numbers(count: int, at_least: int, name: str) -> None:
    right, _ = tried(name, count, seed=3)
    assert right >= at_least


@pytest.mark.deep
@pytest.mark.parametrize("name", AXIOMS)
def test_axioms_are_right_at_many_random_numbers(name: str) -> None:
    right, _ = tried(name, 10_000, seed=4)
    assert right >= 9_900


@pytest.mark.parametrize("name", NAMES)
def test_both_truths_occur(name: str) -> None:
    rng, seen = random.Random(5), set()
    for instance, _ in zip(instances(name, rng), range(200), strict=False):
        seen.add(instance.answer in (TRUE, FALSE) and instance.answer == TRUE)
        if len(seen) == 2:
            return
    assert name.startswith(("a quadric", "an ellipse"))  # whose answers have a quantifier


@pytest.mark.parametrize("name", NAMES)
def test_instances_are_accepted(name: str) -> None:
    """Existential, and as the negation of a universal block."""
    for case in cases(name):
        before, after = case.formula("block"), case.formula("answer")
        assert not objection(before, after, case.evidence, case.known)
        assert not objection(negation(before), negation(after), case.evidence, case.known)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_given_has_to_be_known(name: str) -> None:
    refused = 0
    for case in cases(name):
        known = case.known
        for part in known:
            rest = tuple(other for other in known if other != part)
            wrong = conj((*rest, negation(part)))
            if z3_decides(exists(wrong.free, wrong)):
                assert objection(case.formula("block"), case.formula("answer"), case.evidence, rest)
                refused += 1
    assert refused or not any(case.known for case in cases(name))


@pytest.mark.parametrize("name", NAMES)
def test_a_letter_has_no_bound_variable(name: str) -> None:
    """The block is what the evidence says, but the letter would be captured."""
    for case in cases(name):
        for letter in list(case.letters)[:6]:
            whole = dict(case.letters)
            case.letters = {**whole, letter: whole[letter] + RING.var(case.variables[case.used.bound["block"][0]])}
            before, after = case.formula("block"), case.formula("answer")
            assert "different variables" in objection(before, after, case.evidence, case.known)
            case.letters = whole


@pytest.mark.parametrize("name", NAMES)
def test_other_answers_are_refused(name: str) -> None:
    for case in cases(name):
        before, after = case.formula("block"), case.formula("answer")
        for wrong in (neg(after), TRUE, FALSE, case.formula("given"), before):
            if wrong != after:
                assert objection(before, wrong, case.evidence, case.known)
        assert objection(after, before, case.evidence, case.known) or before == after


@pytest.mark.parametrize("name", NAMES)
def test_other_letters_are_refused(name: str) -> None:
    """One letter stands for something else in the evidence, or in one of the two formulas."""
    for case in cases(name):
        before, after, known = case.formula("block"), case.formula("answer"), case.known
        for letter in case.letters:
            other = Case.__new__(Case)
            other.used, other.variables = case.used, case.variables
            other.letters = {**case.letters, letter: case.letters[letter] + RING.var("h") ** 2 + 1}
            changed = other.formula("block"), other.formula("answer")
            if changed != (before, after) or set(other.known) - set(known):
                assert objection(before, after, other.evidence, known), letter
            if changed[1] != after:
                assert objection(before, changed[1], case.evidence, known), letter


@pytest.mark.parametrize("name", [name for name in NAMES if len(list(rows()[name].choices(SIZES))) > 1])
def test_other_words_are_refused(name: str) -> None:
    for case in cases(name):
        before, after, known = case.formula("block"), case.formula("answer"), case.known
        for words in rows()[name].choices(SIZES):
            used = theorem(name, words)
            assert used is not None
            if set(used.letters) == set(case.letters) and set(used.variables) == set(case.variables):
                sides = [used.formula(part, case.letters, case.variables, RING) for part in ("block", "answer")]
                if sides == [before, after]:
                    continue
            assert objection(before, after, {**case.evidence, "words": list(words)}, known)
        assert "no theorem" in objection(before, after, {**case.evidence, "words": ["?"]}, known)


@pytest.mark.parametrize("name", NAMES)
def test_malformed_evidence_is_refused(name: str) -> None:
    case = cases(name, 1)[0]
    before, after, known, evidence = case.formula("block"), case.formula("answer"), case.known, case.evidence
    first, *rest = case.used.letters
    letters, variables = evidence["letters"], evidence["variables"]
    assert isinstance(letters, dict) and isinstance(variables, dict)
    bound = case.used.bound["block"]
    changes: list[dict[str, Json]] = [
        {"theorem": f"{name}!"},
        {"theorem": None},
        {"letters": {letter: letters[letter] for letter in rest}},
        {"letters": {**letters, "?": "a"}},
        {"letters": {**letters, first: "a/b"}},
        {"variables": {}},
        {"variables": {**variables, bound[0]: "?"}},
        {"variables": {**variables, bound[0]: "a"}} if "a" in before.free else {"variables": {}},
        {"variables": dict.fromkeys(variables, "x")} if len(bound) > 1 else {"variables": {}},
        {"more": 1},
    ]
    for change in changes:
        assert objection(before, after, {**evidence, **change}, known)


@pytest.mark.parametrize("name", NAMES)
def test_the_matcher_reads_the_letters_off(name: str) -> None:
    """Of an instance it makes one again, of the same block."""
    for case in cases(name):
        block = case.formula("block")
        listed = list(matches((case.used.family,), block.variables, block.body))  # type: ignore[attr-defined]
        assert any(match.theorem.name == name for match in listed) or len(block.free) < 3  # too few parameters
        for match in listed:
            assert not objection(block, match.formula("answer"), match.evidence, conjuncts(match.formula("given")))


@pytest.mark.parametrize("name", NAMES)
def test_what_the_text_of_a_block_says_is_what_the_block_has(name: str) -> None:
    """By its relations and the number of its variables a theorem is chosen before it is read."""
    row = rows()[name]
    for words in row.choices(SIZES):
        known = pattern(name, words)
        relations = (undirected(condition.relation.value) for condition in known.conditions)
        assert relations_in(row, words) == tuple(sorted(relations))
        assert variables_in(row, words) == len(known.variables)


def test_proofs_that_are_stored_are_accepted() -> None:
    """Those of other theorems are none of this one."""
    proofs = {name: stored(row.data["proof"]) for name, row in rows().items() if "proof" in row.data}
    assert any(proofs.values())
    for name in proofs:
        for other, certificate in proofs.items():
            assert certificate is None or accepted(name, certificate) is (name == other)


def test_each_is_proved_or_an_axiom_with_a_source() -> None:
    for row in rows().values():
        used = theorem(row.name, next(row.choices()))
        assert used is not None and used.source and bool(used.axiom) != bool(used.proof)


def test_a_statement_that_is_none() -> None:
    used = theorem(NAMES[0], next(rows()[NAMES[0]].choices()))
    assert used is not None
    with pytest.raises(InputError):
        generic(replace(used, letters=()), "block")


def test_an_answer_names_the_axioms_that_it_needs() -> None:
    answer = qe.eliminate("ex x, y. x^2 + y^2 <= a and (x - b)^2 + y^2 <= 1", check=True)
    assert answer.guarantee is qe.Guarantee.CHECKED and answer.trusts == ("two balls meet",)
    assert answer.certificate is not None
    again = qe.Certificate.from_json(answer.certificate.to_json())
    assert qe.Certificate.bundle([("one", again), ("two", again)]).trusts == answer.trusts
    assert qe.eliminate("ex x, y. x^2 + y^2 <= a and x*y > 1 and x < 0", check=True, without="balls").trusts == ()
    for name in ("a parabola takes a value", "a line meets a box"):
        assert "axiom" not in rows()[name].data  # proved: nothing to believe
