"""Blocks that are instances of listed theorems (``qe.theorems``), whose answers take their place.

A theorem says: where ``given`` holds, ``block`` <-> ``answer``, for all values of its letters. The conditions of a
block are held against those of the theorem one by one; the letters stand for what has none of the block's variables.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import permutations, product

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.kernel.reading import Reading, Tree
from qe.kernel.statements import Row, Theorem, number, rows, theorem
from qe.proof.entry import Json, poly_to_text
from qe.rules.block_context import BlockContext, Found, Rule, rule
from qe.rules.step import StepKind
from qe.rules.tree import Leaf

MOST_TERMS = 2_000
"""With more terms in a polynomial an answer is of no use."""

MOST_CONDITIONS = 8
"""Longer conjunctions are not held against theorems: their conditions are tried in every order."""

Letters = Mapping[str, Poly]
Terms = Mapping[tuple[int, ...], Poly]
"""Polynomials in the letters or parameters, by the powers of the block's variables before which they stand."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A comparison of a block: its relation, and terms in letters or parameters by the powers of its variables.

    ``letters``: those that are such a term up to a sign, with its powers.
    """

    relation: Relation
    terms: Terms
    letters: tuple[tuple[str, int, tuple[int, ...]], ...] = ()

    @property
    def degree(self) -> int:
        """The degree in the variables of the block."""
        return max(map(sum, self.terms))


@dataclass(frozen=True, slots=True)
class Pattern:
    """A theorem with the variables and conditions of its block; ``roots``: by letters that do not stand there, terms
    whose square roots they are."""

    theorem: Theorem
    row: Row
    variables: tuple[str, ...]
    conditions: tuple[Condition, ...]
    roots: Mapping[str, ast.expr]


@lru_cache(maxsize=1_000)
def patterns(
    families: tuple[str, ...], parameters: int, variables: int, degree: int, relations: tuple[str, ...]
) -> tuple[Pattern, ...]:
    """Those of these families that a block may be an instance of, by the numbers of its parameters and variables, the
    highest degree in one of these, and its relations, sorted, up to their direction."""
    sizes = frozenset((variables, degree))
    return tuple(
        pattern(row.name, words)
        for row in rows().values()
        if row.family in families and row.data.get("parameters", 0) <= parameters
        for words in row.choices(sizes)
        if relations_in(row, words) == relations and variables_in(row, words) == variables
    )


def relations_in(row: Row, words: Sequence[str]) -> tuple[str, ...]:
    """Those between the two sides of the comparisons of a theorem's block, sorted, ``undirected``; read off its text,
    as a theorem is chosen before it is read."""
    marks = row.marks(words)
    listed = re.findall(r"\{\w+\}|[<>/]=|[<>=]", row.data["block"])
    return tuple(sorted(undirected(marks.get(relation.strip("{}"), relation)) for relation in listed))


def variables_in(row: Row, words: Sequence[str]) -> int:
    """How many variables the block of a theorem binds."""
    vectors, marks = row.table("vectors"), row.marks(words)
    binders = row.table("bound")["block"].split()
    return sum(number(vectors[name], marks) if name in vectors else 1 for name in binders)


def undirected(relation: str) -> str:
    """The relation that is meant where a side may be any of the two."""
    return relation.replace(">", "<")


def generic(used: Theorem, part: str) -> Formula:
    """A part of a theorem about its letters and variables themselves."""
    ring = Ring.of((*used.letters, *used.variables))
    return used.formula(part, {name: ring.var(name) for name in used.letters}, {v: v for v in used.variables}, ring)


def term(used: Theorem, tree: Tree, letters: Letters, ring: Ring) -> Poly:
    """A term in the letters of a theorem, with polynomials for them."""
    return Reading(used.language, letters, {}, ring).term(tree, {})


@cache
def pattern(name: str, words: tuple[str, ...]) -> Pattern:
    """The pattern of a theorem."""
    used = theorem(name, words)
    assert used is not None
    block = generic(used, "block")
    assert isinstance(block, Exists) and block.ring is not None
    indices = [block.ring.index[v] for v in block.variables]
    parts = [part for part in conjuncts(block.body) if isinstance(part, Atom)]
    collected = [p.poly.collected(indices) for p in parts]
    conditions = tuple(
        Condition(part.relation, terms, tuple(_single(terms))) for part, terms in zip(parts, collected, strict=True)
    )
    return Pattern(used, rows()[name], block.variables, conditions, dict(_roots(used, block)))


def _single(terms: Terms) -> Iterator[tuple[str, int, tuple[int, ...]]]:
    """The letters that are a term up to a sign, that sign, and the powers before which they stand."""
    for powers, term in terms.items():
        if term.term_count() == 1 and term.total_degree == 1:
            ((exponents, coefficient),) = term.terms()
            if abs(coefficient) == 1:
                yield term.ring.names[exponents.index(1)], coefficient, powers


def _roots(used: Theorem, block: Formula) -> Iterator[tuple[str, ast.expr]]:
    """Letters that what is given says to be square roots, as in T^2 = 4*R*S."""
    for node in ast.walk(used.trees["given"]):
        match node:
            case ast.Compare(ast.BinOp(ast.Name(name), ast.Pow(), ast.Constant(2)), [ast.Eq()], [square]):
                if name not in block.free:
                    yield name, square


@dataclass(frozen=True, slots=True)
class Match:
    """The theorem, and what its letters and variables stand for."""

    theorem: Theorem
    letters: Letters
    variables: Mapping[str, str]
    ring: Ring

    def formula(self, part: str) -> Formula:
        """A part of the theorem about what its letters stand for."""
        return self.theorem.formula(part, self.letters, self.variables, self.ring)

    @property
    def evidence(self) -> dict[str, Json]:
        """What the kernel needs beside the formulas, but for lemmas."""
        return {
            "theorem": self.theorem.name,
            "words": list(self.theorem.words),
            "letters": {name: poly_to_text(poly) for name, poly in self.letters.items()},
            "variables": dict(self.variables),
        }


def matches(families: tuple[str, ...], variables: Sequence[str], body: Formula) -> Iterator[Match]:
    """The theorems of these families of which ``exists variables. body`` is an instance, but for what is given."""
    parts = [part for part in conjuncts(body) if isinstance(part, Atom)]
    if body.ring is None or len(parts) < len(conjuncts(body)) or len(parts) > MOST_CONDITIONS:
        return
    index, parameters = body.ring.index, len(set(body.free) - set(variables))
    degree = max(part.poly.degree(index[v]) for part in parts for v in variables)
    if len(parts) == degree == 1 or (len(variables) == 1 and not parameters):
        return  # no theorem is about the one, and the other is decided as quickly: none has to be read
    relations = tuple(sorted(undirected(part.relation.value) for part in parts))
    candidates = patterns(families, parameters, len(variables), degree, relations)
    orders = (permutations(variables) if len(variables) < 3 else [tuple(variables)]) if candidates else ()
    ways = [(names, [_both_sides(part, [index[v] for v in names]) for part in parts]) for names in orders]
    for one in candidates:
        if not one.row.data.get("dense") or all(set(variables) <= set(part.free) for part in parts):
            for names, sides in ways:
                for letters in _assigned(one.conditions, sides, {}):
                    yield from _completed(one, letters, names, variables, body)


def _both_sides(part: Atom, indices: Sequence[int]) -> tuple[Condition, Condition]:
    """An atom about its polynomial, and about minus that."""
    terms, relation = part.poly.collected(indices), part.relation
    return Condition(relation, terms), Condition(relation.flipped, {powers: -t for powers, t in terms.items()})


def _completed(
    given: Pattern, letters: Letters, names: Sequence[str], variables: Sequence[str], body: Formula
) -> Iterator[Match]:
    """The matches, with names for the variables that only the answer binds and square roots, if the block fits."""
    assert body.ring is not None
    others = [v for v in given.theorem.variables if v not in given.variables]
    if len(others) > len(variables):
        return
    named = dict(zip((*given.variables, *others), (*names, *variables), strict=False))
    whole = {name: letters.get(name, body.ring.constant(0)) for name in given.theorem.letters}
    match = Match(given.theorem, whole, named, body.ring)
    block = match.formula("block")
    if not isinstance(block, Exists) or set(conjuncts(block.body)) != set(conjuncts(body)):
        return
    roots = {name: term(match.theorem, tree, whole, body.ring).square_root() for name, tree in given.roots.items()}
    if None not in roots.values():
        for signs in product((1, -1), repeat=len(roots)):
            signed = {name: root * s for (name, root), s in zip(roots.items(), signs, strict=True) if root is not None}
            yield replace(match, letters={**whole, **signed})


def _assigned(
    conditions: Sequence[Condition], parts: Sequence[tuple[Condition, Condition]], known: Letters
) -> Iterator[Letters]:
    """The letters, so that each condition of the theorem is one of the parts."""
    if not conditions:
        yield known
        return
    first, *rest = conditions
    for k, sides in enumerate(parts):
        for side in sides:
            if side.relation is first.relation:
                letters = _read_off(first, side, known)
                if letters is not None:
                    yield from _assigned(rest, [*parts[:k], *parts[k + 1 :]], letters)


def _read_off(condition: Condition, side: Condition, known: Letters) -> Letters | None:
    """The letters with which the condition of a theorem may be this side of a part, as far as single letters tell.

    None also where the degree is lower: where leading terms vanish, other methods have shorter answers.
    """
    if not side.terms.keys() <= condition.terms.keys() or side.degree < condition.degree:
        return None
    zero = next(iter(side.terms.values())) * 0
    letters = dict(known)
    for name, sign, powers in condition.letters:
        value = side.terms.get(powers, zero) * sign
        if letters.setdefault(name, value) != value:
            return None
    return letters


def closed_form(*kinds: StepKind) -> Rule:
    """The rule that takes the answers of the theorems of the families that are called like the steps."""

    def apply(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
        families = tuple(kind.value for kind in kinds if kind in context.enabled)
        with suppress(Unable):  # a determinant is too large
            for match in matches(families, variables, body):
                if _holds(match.formula("given"), context):
                    answer = nnf(match.formula("answer"))
                    if all(p.term_count() <= MOST_TERMS for p in polynomials(answer)):
                        kind, name = StepKind(match.theorem.family), match.theorem.name
                        return Found(kind, name, Leaf((), answer), match.evidence)
        return None

    return rule(apply, *kinds)


def _holds(given: Formula, context: BlockContext) -> bool:
    """Whether what is given is known, comparison by comparison."""
    return all(
        part == TRUE or (isinstance(part, Atom) and context.facts.signs(part.poly) <= part.relation.signs)
        for part in conjuncts(given)
    )
