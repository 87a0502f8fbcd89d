"""Blocks that are instances of listed theorems (``qe.theorems``), whose answers take their place.

A theorem says: where ``given`` holds, ``block`` <-> ``answer``, for all values of its letters. The conditions of a
block are held against those of the theorem one by one; the letters stand for what has none of the block's variables.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import permutations

from qe.exact.ring import Poly
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.statements import Theorem, rows, theorem
from qe.kernel.theorem import instance
from qe.proof.entry import Json, poly_to_text
from qe.rules.block_context import BlockContext, Found, Rule
from qe.rules.step import StepKind
from qe.rules.tree import Leaf

Letters = Mapping[str, Poly]
Terms = Mapping[tuple[int, ...], Poly]
"""Polynomials in the letters or parameters, by the powers of the block's variables before which they stand."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A comparison of a theorem's block: its relation, and terms in the letters by the powers of its variables."""

    relation: Relation
    terms: Terms


@dataclass(frozen=True, slots=True)
class Pattern:
    """A theorem with the conditions of its block, over these variables."""

    theorem: Theorem
    variables: tuple[str, ...]
    conditions: tuple[Condition, ...]


def patterns(family: str, size: tuple[int, int], parameters: int) -> Iterator[Pattern]:
    """Those of a family about so many variables and conditions, for use with so many parameters."""
    for row in rows().values():
        if row.family == family and row.size == size and row.parameters <= parameters:
            yield from (_pattern(row.name, words) for words in row.choices)


@cache
def _pattern(name: str, words: tuple[str, ...]) -> Pattern:
    used = theorem(name, words)
    assert used is not None and isinstance(used.block, Exists)
    variables, ring = used.block.variables, used.block.ring
    assert ring is not None
    indices = [ring.index[v] for v in variables]
    parts = [part for part in conjuncts(used.block.body) if isinstance(part, Atom)]
    return Pattern(used, variables, tuple(Condition(p.relation, p.poly.collected(indices)) for p in parts))


@dataclass(frozen=True, slots=True)
class Match:
    """The theorem, and what its letters and variables stand for."""

    theorem: Theorem
    letters: Letters
    variables: Mapping[str, str]

    def instance(self, formula: Formula) -> Formula:
        """A formula of the theorem about what its letters stand for."""
        ring = next(iter(self.letters.values())).ring
        return instance(formula, self.letters, self.variables, ring)

    @property
    def evidence(self) -> dict[str, Json]:
        """What the kernel needs beside the formulas, but for lemmas."""
        return {
            "theorem": self.theorem.name,
            "words": list(self.theorem.words),
            "letters": {name: poly_to_text(poly) for name, poly in self.letters.items()},
            "variables": dict(self.variables),
        }


def matches(family: str, variables: Sequence[str], body: Formula) -> Iterator[Match]:
    """The theorems of a family of which ``exists variables. body`` is an instance, but for what is given."""
    parts = [part for part in conjuncts(body) if isinstance(part, Atom)]
    if body.ring is None or len(parts) < len(conjuncts(body)):
        return
    parameters = len(set(body.free) - set(variables))
    for pattern in patterns(family, (len(variables), len(parts)), parameters):
        for names in permutations(variables):
            indices = [body.ring.index[name] for name in names]
            for letters in _assigned(pattern.conditions, parts, indices, {}):
                whole = {name: letters.get(name, body.ring.constant(0)) for name in pattern.theorem.letters}
                yield from _completed(pattern, whole, names, body)


def _completed(pattern: Pattern, letters: Letters, names: Sequence[str], body: Formula) -> Iterator[Match]:
    """The match, with names for the variables that only the answer binds, if the block is what it has to be."""
    used = {name for poly in letters.values() for name in (poly.ring.names[i] for i in poly.variables)}
    others = [v for v in pattern.theorem.variables if v not in pattern.variables]
    free = [name for name in names if name not in used]
    variables = dict(zip((*pattern.variables, *others), (*names, *free), strict=False))
    if len(variables) < len(pattern.theorem.variables):
        return
    match = Match(pattern.theorem, letters, variables)
    block = match.instance(pattern.theorem.block)
    if isinstance(block, Exists) and set(conjuncts(block.body)) == set(conjuncts(body)):
        yield match


def _assigned(
    conditions: Sequence[Condition], parts: Sequence[Atom], indices: Sequence[int], known: Letters
) -> Iterator[Letters]:
    """The letters, so that each condition of the theorem is one of the parts."""
    if not conditions:
        yield known
        return
    first, *rest = conditions
    for k, part in enumerate(parts):
        for sign, relation in ((1, part.relation), (-1, part.relation.flipped)):
            if relation is first.relation:
                letters = _read_off(first.terms, (part.poly * sign).collected(indices), known)
                if letters is not None:
                    yield from _assigned(rest, [*parts[:k], *parts[k + 1 :]], indices, letters)


def _read_off(terms: Terms, of: Terms, known: Letters) -> Letters | None:
    """The letters with which the polynomial ``of`` has these terms, as far as single letters tell."""
    if not of.keys() <= terms.keys():
        return None
    zero = next(iter(of.values())) * 0
    letters = dict(known)
    for powers, term in terms.items():
        value = of.get(powers, zero)
        if term.term_count() != 1 or term.total_degree != 1:
            continue
        ((exponents, coefficient),) = term.terms()
        name = term.ring.names[exponents.index(1)]
        if abs(coefficient) != 1 or letters.setdefault(name, value * coefficient) != value * coefficient:
            return None
    return letters


def closed_form(kind: StepKind) -> Rule:
    """The rule that takes the answers of the theorems of the family that is called like the step."""

    def rule(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
        if kind not in context.enabled:
            return None
        for match in matches(kind.value, variables, body):
            used = match.theorem
            if _holds(match.instance(used.given), context):
                return Found(kind, used.name, Leaf((), nnf(match.instance(used.answer))), match.evidence)
        return None

    return rule


def _holds(given: Formula, context: BlockContext) -> bool:
    """Whether what is given is known, comparison by comparison."""
    return all(
        part == TRUE or (isinstance(part, Atom) and context.facts.signs(part.poly) <= part.relation.signs)
        for part in conjuncts(given)
    )
