"""Bounds seen in floats: whatever these say, what comes back are contradictions, and sentences are decided rightly."""

import random
from fractions import Fraction

import pytest

import qe
from experiments import z3_oracle
from qe.convex.highs import FloatRows
from qe.elimination.search import guided
from qe.elimination.search.linear_forms import FormBounds
from qe.elimination.search.proposed_bounds import ProposedBounds, suits
from qe.io.text import read

pytest.importorskip("highspy")
pytest.importorskip("pysat")

NUMBERS = [Fraction(k, 3) for k in range(-9, 10)] + [Fraction(10) ** 12, Fraction(1, 10**12), -(Fraction(10) ** 400)]


def random_forms(rng, size, count):
    """Coefficients in other orders of magnitude among them."""
    forms = {}
    for _ in range(count):
        columns = sorted(rng.sample(range(size), rng.randint(1, min(3, size))))
        row = [rng.choice([1, 1, 2, -1, -3, 10**9]) for _ in columns]
        row[0] = 1
        forms[tuple((((j, 1),), c) for j, c in zip(columns, row))] = None
    return list(forms)


def contradict(directions, known):
    """Whether the exact simplex method refutes bounds: form, number, whether it is an upper one, strict."""
    exact = FormBounds()
    for k, number, upper, strict in known:
        bound = exact.at_most if upper else exact.at_least
        if bound(exact.of(directions[k]), number, strict=strict, reason=0) is not None:
            return True
    return exact.conflict(lambda: None) is not None


def session(rng, conflict_checked):
    """Bounds come and go; each set of reasons has to contradict itself."""
    directions = random_forms(rng, rng.randint(1, 5), rng.randint(1, 9))
    floats = ProposedBounds()
    rows = [floats.of(d) for d in directions]
    known, marks = [], []
    for _ in range(25):
        if known and rng.random() < 0.25:
            keep = rng.randrange(len(known))
            floats.back(marks[keep])
            del known[keep:], marks[keep:]
            continue
        marks.append(floats.mark())
        k, number = rng.randrange(len(rows)), rng.choice(NUMBERS)
        known.append((k, number, rng.random() < 0.5, rng.random() < 0.3))
        bound = floats.at_most if known[-1][2] else floats.at_least
        reasons = bound(rows[k], number, strict=known[-1][3], reason=known[-1]) or floats.conflict(lambda: None)
        conflict_checked(directions, known, reasons)
        if reasons:
            floats.back(marks.pop())
            known.pop()


def test_conflicts_are_contradictions_and_hardly_any_is_overlooked():
    rng, overlooked, seen = random.Random(5), 0, 0

    def checked(directions, known, reasons):
        nonlocal overlooked, seen
        if reasons:
            seen += 1
            assert reasons <= set(known) and contradict(directions, reasons)
        else:
            overlooked += contradict(directions, known)

    for _ in range(60):
        session(rng, checked)
    assert seen > 100 and overlooked < seen / 4


def test_a_broken_proposer_contradicts_nothing_that_holds(monkeypatch):
    rng = random.Random(6)

    def broken(self):
        numbers = [rng.choice([0.0, 1.0, -1.0, 2.5, 1e300, float("inf"), float("nan")]) for _ in self.values]
        return {i: w for i, w in enumerate(numbers) if w} or None

    def checked(directions, known, reasons):
        assert not reasons or contradict(directions, reasons)

    monkeypatch.setattr(FloatRows, "contradiction", broken)
    for _ in range(60):
        session(rng, checked)


def random_sentence(rng):
    """Clauses of bounds in few variables, with equations, inequations, equal and close numbers."""
    names = [f"x{k}" for k in range(rng.randint(2, 6))]
    parts = []
    for _ in range(rng.randint(12, 26)):
        atoms = []
        for _ in range(rng.randint(1, 3)):
            form = " + ".join(f"({rng.choice([1, 2, -1, -2, 10**6])})*{x}" for x in rng.sample(names, 2))
            number = rng.choice(["0", "1", "-1", "1/1000000000000", "3", "-7"])
            atoms.append(f"{form} {rng.choice(['<', '<=', '>', '>=', '=', '/='])} {number}")
        parts.append(f"({' or '.join(atoms)})")
    return f"ex {', '.join(names)}. {' and '.join(parts)}"


def test_random_clauses_against_z3(monkeypatch):
    pytest.importorskip("z3")
    monkeypatch.setattr(guided, "LARGE", 0)
    rng, truths = random.Random(7), set()
    for _ in range(40):
        sentence = random_sentence(rng)
        answer = qe.decide(sentence, process=False, timeout=60)
        truths.add(bool(answer))
        assert z3_oracle.decide(read(sentence), seconds=20) is bool(answer), sentence
    assert truths == {True, False}


@pytest.mark.parametrize("broken", [lambda self: None, lambda self: {0: 1.0, 1: -1.0, 2: 3.0}])
def test_whatever_floats_say_sentences_are_decided(monkeypatch, broken):
    monkeypatch.setattr(guided, "LARGE", 0)
    rng = random.Random(8)
    sentences = [random_sentence(rng) for _ in range(6)]
    expected = [bool(qe.decide(s, process=False, timeout=60)) for s in sentences]
    monkeypatch.setattr(FloatRows, "contradiction", broken)
    assert [bool(qe.decide(s, process=False, timeout=60)) for s in sentences] == expected


def test_a_certificate_of_many_clauses(monkeypatch):
    monkeypatch.setattr(guided, "LARGE", 0)
    cases = " and ".join(f"(x{k} <= 0 or x{k} >= 2)" for k in range(14))
    total = " + ".join(f"x{k}" for k in range(14))
    lower = " and ".join(f"x{k} >= 0" for k in range(14))
    answer = qe.eliminate(
        f"ex {total.replace(' + ', ', ')}. {cases} and {lower} and {total} > 0 and {total} < 2", check=True
    )
    assert answer.truth is False and answer.guarantee is qe.Guarantee.CHECKED


def test_huge_numbers_are_left_to_exact_arithmetic():
    assert not suits([((((0, 1),), 10**30),)])
