"""Parts of an answer that make no difference, dropped: what elimination tells apart often needs no telling apart.

``c = 0 and P or c /= 0 and Q`` is Q where Q says at c = 0 what P says. A part of a disjunction matters at the points
where it holds, the other parts do not, and every conjunct beside the way down to it does (every disjunct does not);
in a conjunction, where it fails and the others hold. Whether there is such a point is a sentence. A few points answer
most of these sentences at once; the others are decided, with little work, largest parts first.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from qe.decomposition.sign_table import Masks, where
from qe.elimination.protocol import Context
from qe.errors import Unable
from qe.exact.number import Values
from qe.exact.ring import Poly
from qe.formula.build import conj, disj, exists
from qe.formula.features import length
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import atoms, bound_variables
from qe.options import Stage
from qe.proof.step import Nested, Place, Step
from qe.simplifier.simplify import simplify

WORK, QUESTION_WORK, LINEAR_WORK, PATIENCE = 500, 100, 500, 4
"""Units of work for all sentences, for one of them, and for one that is linear (the simplex method answers it with
little time for each unit); how many parts in a row may make a difference after all."""

DEGREES = {1: 40, 2: 12, 3: 6}
"""The total degree of a sentence with so many variables that is decided; with more, it is ``MANY_DEGREE``."""

MANY_DEGREE = 3

MOST_ATOMS, MOST_VARIABLES, MOST_TERMS = 60, 8, 400
"""A larger answer is left as it is."""

MOST_CURVED = 2
"""So many conditions side by side, with curved ones among them, are asked about: with more that takes too long."""

MOST_ATOMS_ALONE, MOST_TERMS_ALONE = 40, 10_000
"""So many atoms of a larger answer are looked at as conditions on signs alone, with so many terms of conditions."""

FEW_VARIABLES, FEW_TERMS = 4, 6
"""With more variables all polynomials that are not linear have so few terms: substitution is slow in longer ones."""

FIRST, COARSE, FINE = 10, 40, 120
"""How many points are looked at first, beside those on the axes; how many for the parts that these leave, and then how
many more."""

SMALL = (0, 0, 0, 1, 1, -1, -1, 2, -2, 3, -3, 5)
CLOSE = tuple(map(Fraction, ("0", "1/2", "-1/2", "1/3", "-2/3", "1", "-1", "5/4", "-7/2", "9")))
"""The coordinates of these points."""

Holding = Callable[[Formula], int]
"""At which points, or on which cells, a formula holds, as bits."""


@dataclass(slots=True)
class Start:
    """The question that an answer is to, where its steps begin in the log, and whether the answer is as short as cells
    allow."""

    question: Formula
    mark: int
    settled: bool = False


@dataclass(frozen=True)
class Part:
    """An argument of a conjunction or disjunction, its ``place``, and the conditions under which it matters: ``those``
    that hold there, and others that fail."""

    place: Place
    formula: Formula
    of_conjunction: bool
    those: tuple[tuple[Formula, bool], ...]

    @property
    def conditions(self) -> tuple[Formula, ...]:
        """The conditions as formulas that hold."""
        return tuple(f if holds else nnf(f, negate=True) for f, holds in self.those)

    @cached_property
    def sentence(self) -> Formula:
        """Whether there is a point where it matters."""
        body = conj(self.conditions)
        return exists(body.free, body)


def without_redundant_parts(
    formula: Formula, context: Context, start: Start | None = None, *, known: Formula = TRUE
) -> Formula:
    """The formula without parts that make no difference where ``known`` holds, as far as little work shows them.

    The sentences are likely to be false, so that trials at points would be in vain; and there is too little work for
    better coordinates to pay.
    """
    if context.decide is None or not all(isinstance(a, Atom) for a in atoms(formula)) or formula != nnf(formula):
        return formula
    plain = [a for a in formula.args if isinstance(a, Atom)] if isinstance(formula, And | Or) else []
    is_long = len(plain) == length(formula)[0] > MOST_CURVED and any(a.poly.total_degree > 1 for a in plain)
    if is_long or not _is_suited(conj((known, formula))):
        return _without_excluded_parts(formula, context) if known == TRUE else formula
    points = Points(conj((known, formula)).free, context.budget.check)
    options = context.options.with_(without=context.options.without | {Stage.SAMPLES, Stage.POSITION})
    budget, kept, patience = context.budget.part(WORK), set[Formula](), PATIENCE
    while (
        patience and budget.used <= WORK and (part := next(_unsettled(formula, points, kept, known), None)) is not None
    ):
        sentence = part.sentence
        linear = all(a.poly.total_degree <= 1 for a in atoms(sentence))
        try:
            outcome = context.decide(sentence, options, budget.part(LINEAR_WORK if linear else QUESTION_WORK))
        except Unable:
            context.budget.check("shorten")
            outcome = None
        if outcome is not None and outcome.formula == FALSE:
            formula = _dropped(formula, part, outcome.nested(sentence), context, known)
            patience = PATIENCE
        else:
            kept.add(sentence)
            points.take(outcome.witness if outcome is not None else None)
            patience -= 1
    return _without_excluded_parts(formula, context, points)


def _without_excluded_parts(formula: Formula, context: Context, points: Points | None = None) -> Formula:
    """The formula without parts that the signs of its own polynomials exclude: these need not be small for that."""
    if sum(1 for _ in atoms(formula)) > MOST_ATOMS_ALONE:
        return formula
    points, kept, terms = points or Points(formula.free, context.budget.check), set[Formula](), MOST_TERMS_ALONE
    points.fill(FIRST)
    parts = iter(_by_size(formula, points.holding))
    while (part := next(parts, None)) is not None:
        # What mattered once has fewer conditions, not more, after another part is dropped: it is not looked at again.
        if part.formula in kept:
            continue
        terms -= sum(length(condition)[1] for condition, _ in part.those)
        if terms < 0:
            break
        if simplify(conj(part.conditions), watch=context.budget.check) == FALSE:
            nested = Nested(part.sentence, (Step("simplification", part.sentence, FALSE),), FALSE)
            formula = _dropped(formula, part, nested, context)
            parts = iter(_by_size(formula, points.holding))
        else:
            kept.add(part.formula)
    return formula


def _dropped(formula: Formula, part: Part, nested: Nested, context: Context, known: Formula = TRUE) -> Formula:
    """The formula without a part, simplified; ``nested`` says why."""
    proof = {"at": list(part.place), "steps": nested}
    rest = without_part(formula, part.place)
    shorter = context.log.step("redundant part", formula, rest, context=known, evidence={"proof": proof})
    simple = simplify(shorter, known, watch=context.budget.check)
    return context.log.step("simplification", shorter, simple, context=known)


def _is_suited(formula: Formula) -> bool:
    """Whether the formula is small enough for sentences about it to be decided."""
    size, terms = length(formula)
    if not 2 <= size <= MOST_ATOMS or terms > MOST_TERMS or len(formula.free) > MOST_VARIABLES:
        return False
    return len(formula.free) <= FEW_VARIABLES or all(
        a.poly.total_degree <= 1 or a.poly.term_count() <= FEW_TERMS for a in atoms(formula)
    )


def without_part(formula: Formula, place: Sequence[int]) -> Formula:
    """The formula without the argument at a place."""
    assert isinstance(formula, And | Or)
    join, k = conj if isinstance(formula, And) else disj, place[0]
    inner = [] if len(place) == 1 else [without_part(formula.args[k], place[1:])]
    return join((*formula.args[:k], *inner, *formula.args[k + 1 :]))


def is_cheap_sentence(sentence: Formula) -> bool:
    """Whether an existential sentence of this size is decided with little work."""
    degree = max((a.poly.total_degree for a in atoms(sentence)), default=0)
    return degree <= DEGREES.get(len(bound_variables(sentence)), MANY_DEGREE) and _is_suited(sentence)


def _unsettled(formula: Formula, points: Points, kept: set[Formula], known: Formula = TRUE) -> Iterator[Part]:
    """The parts worth a question of which no known point says that they matter, largest first."""
    equations = {a for a in atoms(formula) if isinstance(a, Atom) and a.relation is Relation.EQ}
    for count in (FIRST, COARSE, COARSE + FINE):
        if not points.fill(count) and count < COARSE + FINE:
            continue
        parts = _by_size(formula, points.holding, known)
        parts = [p for p in parts if not (p.of_conjunction and p.formula in equations)]  # these are hardly redundant
        if not any(is_cheap_sentence(p.sentence) for p in parts):
            return
    yield from (p for p in parts if p.sentence not in kept and is_cheap_sentence(p.sentence))


def _by_size(formula: Formula, holding: Holding, known: Formula = TRUE) -> list[Part]:
    """The parts of which no point tells that they matter, largest first."""
    parts = _silent(formula, holding, (), () if known == TRUE else ((known, True),), holding(known))
    return sorted(parts, key=lambda part: length(part.formula), reverse=True)


def _silent(
    formula: Formula, holding: Holding, place: Place, above: tuple[tuple[Formula, bool], ...], there: int
) -> Iterator[Part]:
    """The parts below a place that matters under conditions, at the points ``there``, and that no point tells."""
    if not isinstance(formula, And | Or):
        return
    both = isinstance(formula, And)
    masks = [holding(a) for a in formula.args]
    for k, (arg, mask) in enumerate(zip(formula.args, masks, strict=True)):
        here = there
        for j, other in enumerate(masks):
            here = here if j == k else here & other if both else here & ~other
        conditions = (*above, *((r, both) for j, r in enumerate(formula.args) if j != k))
        if not here & (~mask if both else mask):
            yield Part((*place, k), arg, both, (*conditions, (arg, not both)))
        yield from _silent(arg, holding, (*place, k), conditions, here)


@dataclass(slots=True)
class Points:
    """Points, and for formulas the sets of those where they hold, as bits."""

    names: tuple[str, ...]
    watch: Callable[[], object]
    listed: list[Mapping[str, Fraction | int]] = field(default_factory=list)
    known: dict[Formula, tuple[int, int]] = field(default_factory=dict)
    signs: dict[Poly, tuple[int, int, int]] = field(default_factory=dict)
    chosen: random.Random = field(default_factory=lambda: random.Random(1))

    def fill(self, count: int) -> bool:
        """So many points at least, beside those on the axes; whether there were fewer."""
        axes, before = 2 * len(self.names), len(self.listed)
        while len(self.listed) < count + axes:
            k = len(self.listed)
            if k < axes:
                self.listed.append({name: (-1) ** k * (i == k // 2) for i, name in enumerate(self.names)})
                continue
            values: Sequence[Fraction | int] = SMALL if k < COARSE + axes else CLOSE
            self.listed.append({name: self.chosen.choice(values) for name in self.names})
        return len(self.listed) > before

    def take(self, witness: Values | None) -> bool:
        """One more point, if its coordinates are rational; whether they are."""
        values = [(name, (witness or {}).get(name, Fraction(0))) for name in self.names]
        point = {name: value for name, value in values if isinstance(value, Fraction)}
        if witness is None or len(point) < len(self.names):
            return False
        self.listed.append(point)
        return True

    def holding(self, formula: Formula) -> int:
        """Where the formula holds."""
        seen, mask = self.known.get(formula, (0, 0))
        if seen != len(self.listed):
            mask, _ = where(formula, self.signs_of, (1 << len(self.listed)) - 1)
            self.known[formula] = len(self.listed), mask
        return mask

    def signs_of(self, poly: Poly) -> Masks:
        """Where a polynomial has each sign."""
        seen, below, above = self.signs.get(poly, (0, 0, 0))
        if seen != len(self.listed):
            self.watch()
            names = poly.ring.names
            for k, point in enumerate(self.listed[seen:], start=seen):
                sign = poly.sign_at([point.get(name, 0) for name in names])
                below, above = below | (sign < 0) << k, above | (sign > 0) << k
            self.signs[poly] = len(self.listed), below, above
        return {-1: below, 0: (1 << len(self.listed)) - 1 & ~(below | above), 1: above}
