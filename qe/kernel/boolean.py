"""The propositional part of rules: the same truth for all signs that polynomials can have.

THEOREM. Let every comparison p rel 0 of A, B and of what is known beside them be a condition on the sign of p. If no
assignment of signs that respects the lemmas (``qe.kernel.signs``, each proved) makes what is known true and A and B
different, then A <-> B holds wherever that is. Quantified parts and root atoms count as conditions of their own: the
same where they are the same up to the names of bound variables, and all x not A is the negation of ex x A.

Evidence of a step, as its member ``theory``: ``polynomials`` (those that the lemmas use), ``lemmas``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from qe.errors import Unable
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import shape
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO, Domains, Lemma, read_lemma, read_polynomials
from qe.kernel.step import Claim, Context, Limits
from qe.proof.entry import Entry

NODES = 2_000
"""Case distinctions for one alternative of what may be wrong, at most."""

_SIGNS: Mapping[Relation, int] = {
    relation: sum({-1: NEGATIVE, 0: ZERO, 1: POSITIVE}[s] for s in relation.signs) for relation in Relation
}


Goal = tuple[Formula, ...]
"""Formulas that cannot hold together."""


@dataclass(frozen=True, slots=True)
class ByLemmas:
    """A checker: what has to be refuted so that a step is right, and the refutation by the lemmas in its evidence.

    ``obligations`` raises ``CertificateRejected`` where no refutation could help. The member ``theory`` of the evidence
    is read here.
    """

    obligations: Callable[[Claim, Context], Sequence[Goal]]

    def __call__(self, claim: Claim, context: Context, limits: Limits) -> None:
        goals = self.obligations(claim, context)
        assert isinstance(claim.evidence.value, dict)  # the obligations have read it
        theory = read_theory(Entry(claim.evidence.value.get("theory"), f"{claim.evidence.path}.theory"), claim, limits)
        for goal in goals:
            if not theory.refutes(goal):
                raise claim.fail("the signs that the lemmas allow do not exclude that it is wrong")


def equivalence(left: Formula, right: Formula, context: Iterable[Formula]) -> list[Goal]:
    """What has to be refuted so that two formulas have the same truth under the context."""
    if normal(left) == normal(right):
        return []
    known = tuple(context)
    return [(*known, *_without(left, right)), (*known, *_without(right, left))]


def _without(left: Formula, right: Formula) -> Goal:
    """``left`` and not ``right``. A common conjunct need not be refuted, of common disjuncts no case need be looked at.

    C and A and not (C and B) iff C and A and not B; (C or A) and not (C or B) iff A and not C and not B;
    C and A and not ((C and B) or D) iff C and A and not (B or D).
    """
    if isinstance(left, And) and isinstance(right, Or):
        return left, negation(disj(conj(f for f in conjuncts(case) if f not in left.args) for case in right.args))
    if isinstance(left, And) and isinstance(right, And):
        return left, negation(conj(f for f in right.args if f not in left.args))
    if isinstance(left, Or) and isinstance(right, Or):
        return disj(f for f in left.args if f not in right.args), negation(right)
    return left, negation(right)


def read_theory(entry: Entry, claim: Claim, limits: Limits) -> Theory:
    """The lemmas of a step's evidence, proved."""
    listed, lemmas = entry.fields("polynomials", "lemmas")
    polys = read_polynomials(listed, claim.ring)
    found = []
    for lemma in lemmas.items():
        limits.tick()
        found.append(read_lemma(lemma, polys, claim.ring))
    return Theory(polys, tuple(found), limits)


@dataclass(frozen=True, slots=True)
class Theory:
    """Polynomials, lemmas about their signs, and the limits of a search."""

    polynomials: tuple[Poly, ...]
    lemmas: tuple[Lemma, ...]
    limits: Limits
    cases: int = NODES

    def refutes(self, formulas: Iterable[Formula]) -> bool:
        """Whether no signs that respect the lemmas make all formulas true. ``Unable`` past so many ``cases``."""
        return self.used(formulas) is not None

    def used(self, formulas: Iterable[Formula]) -> frozenset[int] | None:
        """The lemmas that took part in refuting the formulas; None where they are not refuted."""
        search = _Search(self)
        nodes = [search.compiled(normal(f)) for f in formulas]
        return frozenset(search.used) if search.refuted_one_by_one(nodes) else None


@dataclass(frozen=True, slots=True)
class _Literal:
    """The sign of a variable is in a set."""

    variable: int
    signs: int


@dataclass(frozen=True, slots=True)
class _Join:
    """A conjunction, or a disjunction."""

    conjunctive: bool
    parts: tuple[_Node, ...]


_Node = bool | _Literal | _Join


@dataclass(slots=True)
class _Search:
    theory: Theory
    numbers: dict[object, int] = field(default_factory=dict)
    start: Domains = field(default_factory=list)
    used: set[int] = field(default_factory=set)
    nodes: int = 0
    about: list[tuple[int, ...]] = field(init=False)
    touching: dict[int, dict[int, None]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for poly in self.theory.polynomials:
            self._number(poly, ANY)
        self.about = [lemma.polynomials for lemma in self.theory.lemmas]
        for k, polys in enumerate(self.about):
            for i in polys:
                self.touching.setdefault(i, {})[k] = None

    def _number(self, key: object, signs: int) -> int:
        """The variable of a polynomial, or of a condition that is no comparison: positive where it holds."""
        if key not in self.numbers:
            self.numbers[key] = len(self.start)
            self.start.append(signs)
        return self.numbers[key]

    def compiled(self, formula: Formula) -> _Node:
        """A formula whose negations are in the atoms."""
        match formula:
            case Constant(value):
                return value
            case Atom(poly, relation):
                return _Literal(self._number(poly, ANY), _SIGNS[relation])
            case And(args) | Or(args):
                return _Join(isinstance(formula, And), tuple(self.compiled(a) for a in args))
            case Not(arg):
                return _Literal(self._number(arg, NEGATIVE | POSITIVE), NEGATIVE)
            case ForAll():
                return _Literal(self._number(shape(negation(formula)), NEGATIVE | POSITIVE), NEGATIVE)
            case Exists():
                return _Literal(self._number(shape(formula), NEGATIVE | POSITIVE), POSITIVE)
        return _Literal(self._number(formula, NEGATIVE | POSITIVE), POSITIVE)

    def refuted_one_by_one(self, nodes: Sequence[_Node]) -> bool:
        """Whether the conditions are refuted, the last of them (what may be wrong) one alternative at a time.

        An alternative settles much of what stands beside it, which has many cases without it.
        """
        *known, last = nodes or [True]
        for case in last.parts if isinstance(last, _Join) and not last.conjunctive else (last,):
            self.nodes = 0
            if not self.refuted(list(self.start), [*known, case]):
                return False
        return True

    def refuted(self, domains: Domains, pending: Sequence[_Node], fixed: Sequence[int] = ()) -> bool:
        """Whether no signs in the domains make all pending conditions true.

        ``fixed``: domains from which the lemmas take nothing away; none are known where it is empty.
        """
        self.nodes += 1
        if self.nodes > self.theory.cases:
            raise Unable(f"more than {self.theory.cases} cases of signs")
        self.theory.limits.tick()
        left = self._settled(domains, list(pending), fixed)
        if left is None:
            return True
        if left:
            chosen = min(left, key=lambda join: len(join.parts))
            rest = [join for join in left if join is not chosen]
            return all(self.refuted(list(domains), [*rest, part], domains) for part in chosen.parts)
        return self._split(domains)

    def _split(self, domains: Domains) -> bool:
        """Cases on a sign on which lemmas depend."""
        for i in self.touching:
            if domains[i] not in (NEGATIVE, ZERO, POSITIVE):
                signs = [s for s in (NEGATIVE, ZERO, POSITIVE) if domains[i] & s]
                return all(self.refuted([*domains[:i], s, *domains[i + 1 :]], [], domains) for s in signs)
        return False

    def _settled(self, domains: Domains, pending: list[_Node], fixed: Sequence[int]) -> list[_Join] | None:
        """What is left to decide after all that follows at once; None for a contradiction."""
        while True:
            before = list(domains)
            left: list[_Join] = []
            while pending:
                node = pending.pop()
                if isinstance(node, _Literal):
                    domains[node.variable] &= node.signs
                elif isinstance(node, _Join) and node.conjunctive:
                    pending += node.parts
                elif isinstance(node, _Join):
                    parts = [p for p in node.parts if _truth(p, domains) is not False]
                    if any(_truth(p, domains) for p in parts):
                        continue
                    if len(parts) > 1:
                        left.append(_Join(False, tuple(parts)))
                    else:
                        pending += parts or [False]
                elif not node:
                    return None
            if not all(domains) or not self._cut(domains, fixed):
                return None
            if domains == before:
                return left
            pending, fixed = list(left), list(domains)

    def _cut(self, domains: Domains, fixed: Sequence[int]) -> bool:
        """All lemmas about signs that are not as they were applied until nothing changes; whether signs are left."""
        pending = {} if fixed else dict.fromkeys(range(len(self.about)))
        for i, signs in enumerate(fixed):
            if domains[i] != signs:
                pending |= self.touching.get(i, {})
        while pending:
            k = next(iter(pending))
            del pending[k]
            before = [domains[i] for i in self.about[k]]
            if not self.theory.lemmas[k].cut(domains):
                continue
            self.used.add(k)
            if not all(domains):
                return False
            for i, signs in zip(self.about[k], before, strict=True):
                if domains[i] != signs:
                    pending |= self.touching[i]
        return True


def _truth(node: _Node, domains: Domains) -> bool | None:
    match node:
        case bool():
            return node
        case _Literal(variable, signs):
            domain = domains[variable]
            return True if not domain & ~signs else None if domain & signs else False
        case _Join(conjunctive, parts):
            found = [_truth(p, domains) for p in parts]
            if (not conjunctive) in found:
                return not conjunctive
            return None if None in found else conjunctive
