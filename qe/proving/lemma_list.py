"""Lemmas under way, as evidence that names each polynomial once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from operator import itemgetter

from qe.errors import CertificateRejected
from qe.exact.algebraic import real_roots
from qe.exact.nearby import rational_between
from qe.exact.ring import Poly, Ring
from qe.exact.sparse_text import digits
from qe.formula.syntax import TRUE, Atom
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.signs import NEGATIVE, POSITIVE, ZERO, Identity, Lemma, Line, read_lemma, read_polynomials, sign_bit
from qe.kernel.step import Claim, Limits
from qe.proof.entry import Entry, Json, poly_to_text
from qe.proving.refutation import NODES, Refutation

Term = tuple[int, tuple[tuple[Poly, int], ...]]
"""A coefficient, and polynomials with exponents."""

FEW_ENTRIES = 16
"""So short a theory is looked through for what it does without."""

EMPTY: Json = {"polynomials": [], "lemmas": [], "cases": []}


@dataclass(slots=True)
class Lemmas:
    """Lemmas under way: polynomials in the order in which they are first used; ``facts``: what each lemma says,
    ``known``: what need not be said again."""

    ring: Ring
    numbers: dict[Poly, int] = field(default_factory=dict)
    lemmas: list[Json] = field(default_factory=list)
    facts: list[Lemma] = field(default_factory=list)
    known: set[object] = field(default_factory=set)

    def number(self, poly: Poly) -> int:
        """The number of a primitive polynomial."""
        return self.numbers.setdefault(poly, len(self.numbers))

    def identity(self, terms: Iterable[Term]) -> None:
        """That the terms, of which some may be 0, add up to 0, unless it has been said."""
        listed: list[Json] = []
        signs: list[tuple[int, tuple[tuple[int, bool], ...]]] = []
        for coefficient, powers in terms:
            exponents: dict[Poly, int] = {}
            for poly, exponent in powers:
                if poly.is_constant:
                    coefficient *= poly.constant_value() ** exponent
                    continue
                content, primitive = poly.normal()
                coefficient *= content**exponent
                exponents[primitive] = exponents.get(primitive, 0) + exponent
            if not coefficient:
                continue
            numbered = [(self.number(p), e) for p, e in exponents.items()]
            listed.append([digits(coefficient), [[i, e] for i, e in numbered]])
            signs.append((sign_bit(coefficient), tuple((i, e % 2 == 1) for i, e in numbered)))
        if (said := repr(listed)) in self.known:
            return
        self.known.add(said)
        self.lemmas.append({"identity": listed})
        self.facts.append(Identity(tuple(signs)))

    def line(self, polys: Sequence[Poly], x: int) -> None:
        """The sign vectors of irreducible polynomials in one variable, unless they have been listed."""
        if (said := (x, *polys)) in self.known:
            return
        self.known.add(said)
        roots = ((r, k) for k, p in enumerate(polys) for r in real_roots(p.to_univariate(x)))
        placed = sorted(roots, key=itemgetter(0))
        samples = [rational_between(a, b) for a, b in pairwise([None, *(r for r, _ in placed), None])]
        self.lemmas.append({"line": [self.number(p) for p in polys], "samples": [str(s) for s in samples]})
        row = [sign_bit((-1) ** p.degree(x) * p.leading(x).constant_value()) for p in polys]  # far to the left
        cells = [tuple(row)]
        for _, k in placed:  # a simple root of this one alone
            for sign in (ZERO, NEGATIVE + POSITIVE - row[k]):
                row[k] = sign
                cells.append(tuple(row))
        self.facts.append(Line(tuple(map(self.number, polys)), tuple(dict.fromkeys(cells))))

    def only(self, used: Iterable[int], searches: Sequence[Refutation] = ()) -> Json:
        """The evidence with these lemmas alone, and the cases of refutations that need no others."""
        chosen = [self.lemmas[k] for k in sorted(used)]
        polys = list(self.numbers)
        numbers = {i: k for k, i in enumerate(dict.fromkeys(i for lemma in chosen for i in _mentioned(lemma)))}
        listed: list[Json] = [poly_to_text(polys[i]) for i in numbers]
        cases = _cases(searches, [polys[i] for i in numbers])
        return {"polynomials": listed, "lemmas": [_renumbered(lemma, numbers) for lemma in chosen], "cases": cases}


def with_cases(evidence: Json, goals: Sequence[Goal], ring: Ring, limits: Limits) -> Json | None:
    """The lemmas with the cases by which they refute the goals; None where they do not."""
    assert isinstance(evidence, dict)
    names, lemmas = Entry(evidence, "theory").fields("polynomials", "lemmas", optional=("cases",))[:2]
    polys = read_polynomials(names, ring)
    known = [read_lemma(e, polys, ring) for e in lemmas.items()]
    searches = [Refutation(goal, limits) for goal in goals]
    for search in searches:
        search.learn(polys, known)
        if not search.go_on(NODES, NODES):
            return None
    return {**evidence, "cases": _cases(searches, polys)}


def without_needless(evidence: Json, goals: Sequence[Goal], ring: Ring, limits: Limits) -> Json:
    """A short theory without the lemmas and the cases that it does without, each left out once."""
    assert isinstance(evidence, dict)
    polys, lemmas, cases = (evidence[name] for name in ("polynomials", "lemmas", "cases"))
    assert isinstance(polys, list) and isinstance(lemmas, list) and isinstance(cases, list)
    if not 1 < 2 * len(lemmas) + len(cases) - bool(lemmas) <= FEW_ENTRIES:
        return evidence
    for k in reversed(range(len(lemmas))):
        rest = [*lemmas[:k], *lemmas[k + 1 :]]
        numbers = {i: n for n, i in enumerate(dict.fromkeys(i for lemma in rest for i in _mentioned(lemma)))}
        listed: Json = [polys[i] for i in numbers]
        fewer: Json = {"polynomials": listed, "lemmas": [_renumbered(lemma, numbers) for lemma in rest]}
        shorter = with_cases(fewer, goals, ring, limits)
        if isinstance(shorter, dict) and len(shorter["cases"]) <= len(cases):  # type: ignore[arg-type]
            return without_needless(shorter, goals, ring, limits)
    for k in reversed(range(len(cases))):
        fewer = {**evidence, "cases": [*cases[:k], *cases[k + 1 :]]}
        if _refutes(fewer, goals, ring, limits):
            return without_needless(fewer, goals, ring, limits)
    return evidence


def _refutes(evidence: Json, goals: Sequence[Goal], ring: Ring, limits: Limits) -> bool:
    """Whether the kernel takes it for a refutation of the goals."""
    claim = Claim("signs", TRUE, TRUE, ring, Entry({"theory": evidence}, "evidence"), "step")
    try:
        ByLemmas(lambda *_: goals)(claim, (), limits)
    except CertificateRejected:
        return False
    return True


def _cases(searches: Sequence[Refutation], polys: Sequence[Poly]) -> list[Json]:
    """The clauses of each of the refutations, with its number, where these are the polynomials of the lemmas."""
    numbers = {poly: k for k, poly in enumerate(polys)}
    return [[k, clause] for k, search in enumerate(searches) for clause in search.cases(numbers)]


def identities(listed: Iterable[Sequence[Term]], ring: Ring, clauses: Iterable[Sequence[Atom]] = ()) -> Json:
    """Sums that are 0, as lemmas over the ring, and clauses about their polynomials for the first goal."""
    lemmas = Lemmas(ring)
    for terms in listed:
        lemmas.identity([(c, tuple((p.convert(ring), e) for p, e in powers)) for c, powers in terms])

    def literal(said: Atom) -> int:
        content, primitive = said.poly.convert(ring).normal()
        return 8 * lemmas.number(primitive) + sum(sign_bit(sign * int(content)) for sign in said.relation.signs)

    cases: list[Json] = [[0, [*map(literal, clause)]] for clause in clauses]
    theory = lemmas.only(range(len(lemmas.lemmas)))
    assert isinstance(theory, dict)
    return {**theory, "cases": cases}


def _mentioned(lemma: Json) -> list[int]:
    assert isinstance(lemma, dict)
    if "line" in lemma:
        return lemma["line"]  # type: ignore[return-value]
    return [power[0] for _, powers in lemma["identity"] for power in powers]  # type: ignore


def _renumbered(lemma: Json, numbers: dict[int, int]) -> Json:
    assert isinstance(lemma, dict)
    if "line" in lemma:
        return {**lemma, "line": [numbers[i] for i in lemma["line"]]}  # type: ignore
    return {"identity": [[c, [[numbers[i], e] for i, e in powers]] for c, powers in lemma["identity"]]}  # type: ignore
