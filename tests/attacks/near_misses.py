"""Near misses: a true equivalence with one thing changed in a way that invites a mistake.

A near miss takes (before, after, facts, ring) and says nothing about evidence, so that the claims can be offered to any
checker. Where the change is one of names or of polynomials, it also says what that makes of polynomials elsewhere
(``Change``), so that evidence may follow. Whether the claim that comes out is false is for others to see.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms
from tests.attacks.formulas import places, put, same
from tests.certificates.altered_derivations import rebuilt


@dataclass(frozen=True, slots=True)
class Equivalence:
    """``before`` <-> ``after`` wherever all ``facts`` hold; all over ``ring``."""

    before: Formula
    after: Formula
    facts: tuple[Formula, ...]
    ring: Ring

    @property
    def parts(self) -> tuple[Formula, ...]:
        """Its formulas, the claimed answer first."""
        return (self.after, self.before, *self.facts)

    def with_part(self, k: int, new: Formula) -> Equivalence:
        """The claim with another formula at place k of ``parts``; a fact that holds anyhow is none."""
        if k < 2:
            return replace(self, before=new) if k else replace(self, after=new)
        others = self.facts[: k - 2] + (() if new == TRUE else (new,)) + self.facts[k - 1 :]
        return replace(self, facts=others)


@dataclass(frozen=True, slots=True)
class Change:
    """Every polynomial and every name replaced."""

    poly: Callable[[Poly], Poly]
    name: Callable[[str], str] = str

    def __call__(self, formula: Formula) -> Formula:
        return rebuilt(lambda a: atom(self.poly(a.poly), a.relation), self.name)(formula)


Made = tuple[Equivalence, Change | None]
NearMiss = Callable[[random.Random, Equivalence], Made | None]

NEAR = {
    Relation.LT: (Relation.LE, Relation.LE, Relation.NE),
    Relation.LE: (Relation.LT, Relation.LT, Relation.EQ),
    Relation.GT: (Relation.GE, Relation.GE, Relation.NE),
    Relation.GE: (Relation.GT, Relation.GT, Relation.EQ),
    Relation.EQ: (Relation.LE, Relation.GE),
    Relation.NE: (Relation.LT, Relation.GT),
}


# --- parts of a claim ----------------------------------------------------------------------------------
SIDES, FACTS, ALL = slice(2), slice(2, None), slice(None)
"""Which of the ``parts`` of a claim may be changed."""


def somewhere(
    rng: random.Random, claim: Equivalence, change: Callable[[Formula], Formula | None], among: slice = ALL
) -> Made | None:
    """The claim with one part changed, mostly one of the answer's."""
    chosen = list(range(len(claim.parts))[among])
    rng.shuffle(chosen)
    if rng.random() < 0.5:
        chosen.sort()
    for k in chosen:
        found = list(places(claim.parts[k]))
        for place, part in rng.sample(found, len(found)):
            new = change(part)
            if new is not None and new != part:
                return claim.with_part(k, put(claim.parts[k], place, new)), None
    return None


def free_names(claim: Equivalence) -> list[str]:
    return sorted({n for f in claim.parts for n in f.free})


def bound_names(claim: Equivalence) -> list[str]:
    found = (q for f in claim.parts for _, q in places(f) if isinstance(q, Exists | ForAll))
    return sorted({n for q in found for n in q.variables})


# --- atoms ---------------------------------------------------------------------------------------------
def of_an_atom(change: Callable[[random.Random, Equivalence, Atom], Formula]) -> NearMiss:
    """One atom of the claim is another."""

    @wraps(change)
    def made(rng: random.Random, claim: Equivalence) -> Made | None:
        return somewhere(rng, claim, lambda f: change(rng, claim, f) if isinstance(f, Atom) else None)

    return made


@of_an_atom
def strictness(rng: random.Random, claim: Equivalence, f: Atom) -> Formula:
    """An equality or an end where there is none, and the other way round."""
    return Atom(f.poly, rng.choice(NEAR[f.relation]))


@of_an_atom
def sign(rng: random.Random, claim: Equivalence, f: Atom) -> Formula:
    """A variable with the other sign."""
    i = rng.choice(f.poly.variables)
    return atom(f.poly.compose({i: -f.poly.ring.gen(i)}), f.relation)


@of_an_atom
def wrong_letter(rng: random.Random, claim: Equivalence, f: Atom) -> Formula:
    """A variable in place of another."""
    other = rng.choice(free_names(claim) or bound_names(claim))
    return atom(f.poly.compose({rng.choice(f.poly.variables): f.poly.ring.var(other)}), f.relation)


@of_an_atom
def lower_degree(rng: random.Random, claim: Equivalence, f: Atom) -> Formula:
    """The highest power of a variable is forgotten."""
    i = rng.choice(f.poly.variables)
    return atom(f.poly - f.poly.leading(i) * f.poly.ring.gen(i) ** f.poly.degree(i), f.relation)


@of_an_atom
def coefficient(rng: random.Random, claim: Equivalence, f: Atom) -> Formula:
    """One coefficient is another number."""
    terms = dict(f.poly.terms())
    exponents = rng.choice([*terms, (0,) * f.poly.ring.size])
    terms[exponents] = terms.get(exponents, 0) + rng.choice((-1, 1))
    return atom(f.poly.ring.from_terms(terms), f.relation)


# --- Boolean structure -----------------------------------------------------------------------------------
def without_one(rng: random.Random, f: And | Or) -> Formula:
    k = rng.randrange(len(f.args))
    return (conj if isinstance(f, And) else disj)(f.args[:k] + f.args[k + 1 :])


def missing_guard(rng: random.Random, claim: Equivalence) -> Made | None:
    """A conjunct is forgotten."""
    return somewhere(rng, claim, lambda f: without_one(rng, f) if isinstance(f, And) else None, SIDES)


def missing_case(rng: random.Random, claim: Equivalence) -> Made | None:
    """A disjunct is forgotten."""
    return somewhere(rng, claim, lambda f: without_one(rng, f) if isinstance(f, Or) else None, SIDES)


def weaker_fact(rng: random.Random, claim: Equivalence) -> Made | None:
    """What holds at the place does not, or what is not zero there may be."""
    weak = {Relation.LT: Relation.LE, Relation.GT: Relation.GE}

    def change(f: Formula) -> Formula | None:
        if isinstance(f, Atom) and f.relation in weak and rng.random() < 0.5:
            return Atom(f.poly, weak[f.relation])
        return TRUE if f in claim.facts else None

    return somewhere(rng, claim, change, FACTS)


def boundary(rng: random.Random, claim: Equivalence) -> Made | None:
    """The points where a polynomial vanishes belong to the answer, or do not."""
    free = set(free_names(claim))
    polys = [a.poly for f in claim.parts for a in atoms(f) if isinstance(a, Atom) and set(a.free) <= free]
    if not polys:
        return None
    poly, answer = rng.choice(polys), claim.after
    more, less = disj((answer, atom(poly, Relation.EQ))), conj((answer, atom(poly, Relation.NE)))
    return replace(claim, after=rng.choice((more, less))), None


def empty_or_whole(rng: random.Random, claim: Equivalence) -> Made | None:
    """A part, or the whole answer, is empty, or everything."""
    if rng.random() < 0.5:
        return replace(claim, after=rng.choice((TRUE, FALSE))), None
    return somewhere(rng, claim, lambda f: rng.choice((TRUE, FALSE)), SIDES)


def other_join(rng: random.Random, claim: Equivalence) -> Made | None:
    """A conjunction for a disjunction."""

    def change(f: Formula) -> Formula | None:
        return (disj if isinstance(f, And) else conj)(f.args) if isinstance(f, And | Or) else None

    return somewhere(rng, claim, change, SIDES)


# --- quantifiers and names -----------------------------------------------------------------------------------
def of_a_block(change: Callable[[random.Random, Equivalence, Exists | ForAll], Formula]) -> NearMiss:
    """One block of quantifiers is another."""

    @wraps(change)
    def made(rng: random.Random, claim: Equivalence) -> Made | None:
        return somewhere(rng, claim, lambda f: change(rng, claim, f) if isinstance(f, Exists | ForAll) else None, SIDES)

    return made


@of_a_block
def other_quantifier(rng: random.Random, claim: Equivalence, f: Exists | ForAll) -> Formula:
    """A universal block for an existential one, or one variable of it, which goes first or last."""
    first, other = rng.choice(f.variables), forall if isinstance(f, Exists) else exists
    rest = [v for v in f.variables if v != first]
    some = (same(f)(rest, other([first], f.body)), other([first], same(f)(rest, f.body)))
    return rng.choice((other(f.variables, f.body), *some))


@of_a_block
def freed(rng: random.Random, claim: Equivalence, f: Exists | ForAll) -> Formula:
    """A quantifier forgets one of its variables."""
    k = rng.randrange(len(f.variables))
    return same(f)(f.variables[:k] + f.variables[k + 1 :], f.body)


@of_a_block
def captured_binder(rng: random.Random, claim: Equivalence, f: Exists | ForAll) -> Formula:
    """A bound variable gets the name of one that is free below its quantifier, or beside it."""
    names = free_names(claim)
    return renaming(claim.ring, rng.choice(f.variables), rng.choice(names))(f) if names else f


def captured_parts(rng: random.Random, claim: Equivalence) -> Made | None:
    """An atom about a free variable becomes one about another variable of the same name: in one side, in both alike, or
    as one more case."""
    known = [a for f in claim.parts for a in atoms(f) if a.free and isinstance(a, Atom)]
    if not known:
        return None
    about_one = [a for a in known if len(a.free) == 1]  # as a guard is
    one = rng.choice(about_one if about_one and rng.random() < 0.5 else known)
    other = rng.choice((exists, exists, forall))([rng.choice(one.free)], one)
    shape = rng.random()
    if shape < 0.4:
        join = rng.choice((conj, disj))
        found = list(places(claim.after))
        place, part = rng.choice(found)
        return replace(claim, after=put(claim.after, place, join((part, other)))), None

    def wrapped(f: Formula) -> Formula:
        return next((put(f, place, other) for place, part in places(f) if part == one), f)

    before = wrapped(claim.before) if shape < 0.7 else claim.before
    return replace(claim, before=before, after=wrapped(claim.after)), None


def captured_letter(rng: random.Random, claim: Equivalence) -> Made | None:
    """A letter is bound in each atom that has it, on both sides alike, under the name of another letter."""
    names = free_names(claim)
    if len(names) < 2:
        return None
    old, new = rng.sample(names, 2)
    quantify, change = rng.choice((exists, forall)), renaming(claim.ring, old, new)

    def bound(f: Formula) -> Formula:
        return rebuilt(lambda a: quantify([new], change(a)) if old in a.free else a)(f)

    return everywhere(claim, bound), None


def captured_fact(rng: random.Random, claim: Equivalence) -> Made | None:
    """A condition on a bound variable is forgotten, and known of a free one of the same name."""
    block = claim.before
    if not isinstance(block, Exists | ForAll) or not isinstance(block.body, And):
        return None
    conditions = block.body.args
    one = rng.choice([c for c in conditions if {*block.variables} & {*c.free}])
    before = same(block)(block.variables, conj(c for c in conditions if c != one))
    place, _ = next((found for found in places(claim.after) if found[1] == one), ((), None))
    after = put(claim.after, place, TRUE) if place else claim.after
    return Equivalence(before, after, (*claim.facts, one), claim.ring), None


def captured_everywhere(rng: random.Random, claim: Equivalence) -> Made | None:
    """A bound variable, mostly of an inner block, gets the name of a free one wherever it stands, or a free one that of
    a bound one."""
    free, bound = free_names(claim), bound_names(claim)
    if not free or not bound:
        return None
    outer = claim.before.variables if isinstance(claim.before, Exists | ForAll) else ()
    inner = [n for n in bound if n not in outer]
    if inner and rng.random() < 0.7:
        change = renaming(claim.ring, rng.choice(inner), rng.choice([*free, *outer]))
    else:
        old, new = rng.sample((rng.choice(free), rng.choice(bound)), 2)
        change = renaming(claim.ring, old, new)
    return everywhere(claim, change), change


def repeated_names(rng: random.Random, claim: Equivalence) -> Made | None:
    """Two bound variables become one."""
    bound = bound_names(claim)
    if len(bound) < 2:
        return None
    change = renaming(claim.ring, *rng.sample(bound, 2))
    if rng.random() < 0.5:
        return replace(claim, before=change(claim.before)), change
    return everywhere(claim, change), change


# --- polynomials everywhere ----------------------------------------------------------------------------------
def vanishing_lead(rng: random.Random, claim: Equivalence) -> Made | None:
    """A bound variable times a free one, so that the leading coefficients vanish with that; the answer stays."""
    free, bound = free_names(claim), bound_names(claim)
    if not bound:
        return None
    x, a = claim.ring.var(rng.choice(bound)), claim.ring.var(rng.choice([*free, claim.ring.names[-1]]))
    change = Change(lambda p: p.compose({x.variables[0]: x * a}))
    return replace(claim, before=change(claim.before)), change


def number_for_a_letter(rng: random.Random, claim: Equivalence) -> Made | None:
    """A parameter is zero, or another number, on one side."""
    free = free_names(claim)
    if not free:
        return None
    i, value = claim.ring.index[rng.choice(free)], claim.ring.constant(rng.choice((0, 0, 0, 1, -1)))
    change = Change(lambda p: p.compose({i: value}))
    kept = rng.choice((claim.after, change(claim.after)))
    return replace(claim, before=change(claim.before), after=kept), change


def squared(rng: random.Random, claim: Equivalence) -> Made | None:
    """A variable becomes a square: what had an odd degree has an even one."""
    names = [*free_names(claim), *bound_names(claim)]
    if not names:
        return None
    i = claim.ring.index[rng.choice(names)]
    x = claim.ring.gen(i)
    change = Change(lambda p: p.compose({i: x * x}) if p.total_degree <= 6 else p)
    return replace(claim, before=change(claim.before)), change


def renaming(ring: Ring, old: str, new: str) -> Change:
    """One name for another, wherever it stands."""
    i, image = ring.index[old], ring.var(new)
    return Change(lambda p: p.compose({i: image}), lambda name: new if name == old else name)


def everywhere(claim: Equivalence, change: Callable[[Formula], Formula]) -> Equivalence:
    """All formulas of a claim changed."""
    return replace(claim, before=change(claim.before), after=change(claim.after), facts=tuple(map(change, claim.facts)))


CAPTURES: tuple[NearMiss, ...] = (
    captured_binder,
    captured_parts,
    captured_letter,
    captured_fact,
    captured_everywhere,
    repeated_names,
)
"""Names that mean something else below a quantifier."""

OTHERS: tuple[NearMiss, ...] = (
    strictness,
    sign,
    wrong_letter,
    lower_degree,
    coefficient,
    missing_guard,
    missing_case,
    weaker_fact,
    boundary,
    empty_or_whole,
    other_join,
    other_quantifier,
    freed,
    vanishing_lead,
    number_for_a_letter,
    squared,
)
