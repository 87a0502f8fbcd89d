"""Polynomial witnesses: for all parameters p of a set G, values of existential variables y as polynomials in p.

THEOREM. If f(p, y(p)) holds wherever G(p) does, then  all p (G(p) -> ex y f(p, y)).
The converse is wrong, so a candidate that fails proves nothing: the caller goes on with a complete method.

Candidates are centres. For g_1, ..., g_m convex in y with bounded level sets,  ex y (all g_i(p, y) <= 0)  holds iff
min_y sum w_i g_i(p, y) <= 0 for all weights w >= 0 (minimax theorem; Rockafellar, Convex Analysis, 1970, cor. 37.3.2),
and a point that does it minimises such a sum. Where the second derivatives in y are constants, that minimiser is
a polynomial in p; it is tried for the sum over every subset of the conditions.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import chain, combinations, islice
from math import lcm

from qe.elimination.protocol import Context, Outcome
from qe.errors import InputError
from qe.exact.parametric_form import ParametricForm, parametric_form
from qe.exact.quadratic_form import solve_linear
from qe.exact.ring import Poly, format_poly
from qe.formula.block import Block
from qe.formula.build import conj, exists, forall, map_children, neg
from qe.formula.evaluate import at_quotients, holds_at
from qe.formula.normal import nnf, rename_apart
from qe.formula.syntax import TRUE, And, Atom, Atomic, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms, conjuncts, subformulas
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from qe.rules.preparation import prepare
from qe.rules.step import ALL_STEPS, StepKind
from qe.simplifier.simplify import simplify

MOST = 500
"""Subsets of the conditions that are tried at most, small ones first."""

PROBES, UNPROBED = 8, 200
"""Parameter points at which a candidate must hold before a proof is tried; candidates tried where there are none."""


WITHOUT_CASES = ALL_STEPS - {
    StepKind.GUARDED_LINEAR,
    StepKind.FACTOR_SPLIT,
    StepKind.SCALING,
    StepKind.DISTRIBUTION,
}
"""Preparation that does not fan out: of many cases each would need a witness of its own, and it takes seconds."""


RULE = "witness in the parameters"


class PolynomialWitnesses:
    """Sentences and formulas ``all p. ... ex y. ...`` that polynomials in p prove."""

    name = "witness"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Universal blocks with quantifiers inside."""
        return "polynomials may solve the inner blocks" if problem.universal and not problem.is_flat else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """TRUE where witnesses were found and proved; None says nothing."""
        log = RunLog()
        found = find(problem.formula, budget=context.budget, log=log)
        if found is None:
            return None
        for proof in found:
            context.log.choice(self.name, (), f"{RULE}: {proof}")
        context.log.entries.extend(log.steps())
        return Outcome(TRUE)


@dataclass(frozen=True, slots=True)
class Term:
    """The polynomial ``numerator / denominator`` in the parameters. Invariant: ``denominator`` > 0."""

    numerator: Poly
    denominator: int = 1

    @staticmethod
    def of(poly: Poly, factor: Fraction) -> Term:
        """``factor * poly`` in lowest terms."""
        unit, primitive = poly.normal()
        scale = unit * factor
        return Term(primitive * scale.numerator, scale.denominator)

    def __str__(self) -> str:
        text = format_poly(self.numerator)
        return text if self.denominator == 1 else f"({text})/{self.denominator}"


@dataclass(frozen=True, slots=True)
class PolynomialWitness:
    """Wherever ``assumptions`` hold, ``terms`` satisfy ``claim``, the prepared body of an existential block."""

    terms: Mapping[str, Term]
    assumptions: Formula
    claim: Formula

    def __str__(self) -> str:
        return ", ".join(f"{name} = {term}" for name, term in self.terms.items())

    def equations(self) -> list[tuple[str, Poly]]:
        """By variable, the polynomial that is zero where the variable is the term."""
        rings = [(name, term, term.numerator.ring) for name, term in self.terms.items()]
        return [(name, ring.var(name) * term.denominator - term.numerator) for name, term, ring in rings]


def find(sentence: Formula, *, budget: Budget, log: RunLog | None = None) -> tuple[PolynomialWitness, ...] | None:
    """Witnesses for the existential blocks that together prove the sentence; None when none were found."""
    log = log or RunLog()
    renamed = log.step("renaming", sentence, rename_apart(sentence))
    return _Search(budget, log).prove(log.step("negation normal form", renamed, nnf(renamed)), TRUE)


def instantiate(sentence: Formula, terms: Mapping[str, Term]) -> Formula:
    """A formula that implies the given one: existential variables replaced by polynomials, negations pushed inside.

    ``terms``: by variable, in the ring of the sentence. A term may use the free variables, those quantified further
    outside, and those of the same block that are not replaced. Raises ``InputError`` for other terms and names.
    """
    prepared = nnf(rename_apart(sentence))
    ring = prepared.ring
    if ring is not None:  # names of their own for variables that are quantified twice are part of it
        terms = {name: Term(term.numerator.convert(ring), term.denominator) for name, term in terms.items()}
    unused = dict(terms)
    result = _instantiated(prepared, terms, frozenset(prepared.free), unused)
    if unused:
        raise InputError(f"witness: {', '.join(unused)} not found among the existential variables")
    return result


def _instantiated(
    formula: Formula, terms: Mapping[str, Term], scope: frozenset[str], unused: dict[str, Term]
) -> Formula:
    match formula:
        case Exists(variables, body):
            given = {name: terms[name] for name in variables if name in terms}
            kept = [name for name in variables if name not in given]
            visible = scope | set(kept)
            for name, term in given.items():
                ring, unknown = term.numerator.ring, term.numerator.variables
                hidden = [ring.names[i] for i in unknown if ring.names[i] not in visible]
                if hidden:
                    raise InputError(f"witness: {name} depends on {', '.join(hidden)}, which is not known at its place")
                unused.pop(name, None)
            return exists(kept, _instantiated(substituted(body, given), terms, visible, unused))
        case ForAll(variables, body):
            return forall(variables, _instantiated(body, terms, scope | set(variables), unused))
    return map_children(formula, lambda part: _instantiated(part, terms, scope, unused))


def substituted(formula: Formula, terms: Mapping[str, Term]) -> Formula:
    """The formula with variables replaced by polynomials; every atom is multiplied by a positive number."""
    return at_quotients(formula, {name: (term.numerator, term.denominator) for name, term in terms.items()})


# --- the proof --------------------------------------------------------------------------------------------
Witnesses = tuple[PolynomialWitness, ...]


@dataclass(frozen=True, slots=True)
class _Search:
    """``barren``: blocks for which nothing is tried, found out once however often they occur."""

    budget: Budget
    log: RunLog
    barren: set[Formula] = field(default_factory=set)

    def prove(self, formula: Formula, known: Formula) -> Witnesses | None:
        """Witnesses that prove ``formula``, in negation normal form, where ``known`` holds."""
        if formula.is_quantifier_free:
            if simplify(formula, known, watch=self.budget.check) != TRUE:
                return None
            self.log.step("simplification", formula, TRUE, context=known)
            return ()
        match formula:
            case ForAll(_, body):
                return self.prove(body, known)
            case And(args):
                parts = [self.prove(a, known) for a in args]
                return None if any(p is None for p in parts) else tuple(w for p in parts if p is not None for w in p)
            case Or(args):
                return self.one_of(args, known)
            case Exists():
                return self.block(formula, known)
        return None

    def one_of(self, args: Sequence[Formula], known: Formula) -> Witnesses | None:
        """A disjunct with quantifiers, proved where those without fail."""
        plain = [a for a in args if a.is_quantifier_free]
        extended = conj((known, *(nnf(neg(a)) for a in plain)))
        for a in args:
            mark = self.log.mark()
            found = None if a.is_quantifier_free else self.prove(a, extended)
            if found is not None:
                return found
            self.log.forget_steps(mark)
        return None

    def block(self, formula: Exists, known: Formula) -> Witnesses | None:
        """An existential block: prepared without case distinctions, then by a candidate."""
        if formula in self.barren:
            return None
        if any(isinstance(inside, ForAll) for inside in subformulas(formula)):
            return None  # preparation would have to decide it, and hardly ever does
        ready = prepare(formula, budget=self.budget, enabled=WITHOUT_CASES, log=self.log).formula
        if not isinstance(ready, Exists):
            return self.prove(ready, known)
        if not ready.body.is_quantifier_free or _is_barren(ready):
            self.barren.add(formula)
            return None
        witness = _witness(ready, known, self.budget)
        if witness is None:
            return None
        self.log.step(RULE, ready, TRUE, context=known, evidence={"proof": {"equations": witness.equations()}})
        return (witness,)


def _is_barren(block: Exists) -> bool:
    """Whether no minimiser can be expected to do: there is none, or equations that preparation could not solve are left
    among the conditions."""
    names = set(block.variables)
    equations = (a for a in conjuncts(block.body) if isinstance(a, Atom) and a.relation is Relation.EQ)
    return any(names & set(a.free) for a in equations) or next(_candidates(block), None) is None


def _witness(block: Exists, known: Formula, budget: Budget) -> PolynomialWitness | None:
    names = dict.fromkeys((*known.free, *block.free))
    probes = list(_probes(known, names))
    for terms in islice(_candidates(block), None if probes else UNPROBED):
        budget.check("polynomial witness")
        claim = substituted(block.body, terms)
        if all(holds_at(claim, probe) for probe in probes) and simplify(claim, known, watch=budget.check) == TRUE:
            return PolynomialWitness(terms, known, block.body)
    return None


def _probes(known: Formula, names: Iterable[str]) -> Iterator[dict[str, Fraction]]:
    """A few small points where ``known`` holds, many coordinates 0: they only spare proofs that cannot succeed."""
    source, count = random.Random(1), 0
    for _ in range(40 * PROBES):
        point = {name: Fraction(source.choice((0, 0, 0, 0, -1, 1, -2, 2, -3, 4))) for name in names}
        if count < PROBES and holds_at(known, point):
            count += 1
            yield point


# --- the candidates -----------------------------------------------------------------------------------------
def _candidates(block: Exists) -> Iterator[dict[str, Term]]:
    """The minimisers of the sums over subsets of the conditions, each once."""
    ring = block.body.ring
    assert ring is not None
    places = [ring.index[name] for name in block.variables]
    slopes = [s for a in dict.fromkeys(atoms(block.body)) if (s := _form(a, places)) is not None]
    seen = set()
    sizes = range(1, len(slopes) + 1)
    for chosen in islice(chain.from_iterable(combinations(slopes, k) for k in sizes), MOST):
        centre = _centre(chosen)
        if centre is not None and centre not in seen:
            seen.add(centre)
            yield dict(zip(block.variables, centre, strict=True))


def _form(condition: Atomic, places: Sequence[int]) -> ParametricForm | None:
    """The form g of a condition g <= 0; None for atoms that are no weak or strict inequality of constant second
    derivatives in y."""
    if not isinstance(condition, Atom) or condition.relation in (Relation.EQ, Relation.NE):
        return None
    g = condition.poly if condition.relation in (Relation.LE, Relation.LT) else -condition.poly
    return parametric_form(g, places)


def _centre(chosen: Sequence[ParametricForm]) -> tuple[Term, ...] | None:
    """The point where the slopes add up to zero, if there is exactly one."""
    size = len(chosen[0].gradient)
    total = [[sum((form.hessian[i][j] for form in chosen), Fraction(0)) for j in range(size)] for i in range(size)]
    rest = [sum((form.gradient[i] for form in chosen[1:]), chosen[0].gradient[i]) for i in range(size)]
    columns = []
    for k in range(size):
        solved = solve_linear(total, [Fraction(int(i == k)) for i in range(size)], size)
        if solved is None or solved.kernel:
            return None
        columns.append(solved.particular)
    terms = []
    for i in range(size):
        common = lcm(*(column[i].denominator for column in columns))
        numerator = sum((rest[k] * int(-columns[k][i] * common) for k in range(size)), rest[0] * 0)
        terms.append(Term.of(numerator, Fraction(1, common)))
    return tuple(terms)
