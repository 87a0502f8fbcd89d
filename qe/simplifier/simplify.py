"""The standard simplifier (Dolzmann & Sturm, JSC 24 (1997), sections 3-5), deep and quantifier aware.

A conjunction is simplified under its background facts: its own atoms become ranges of key polynomials,
contradictions and implied atoms are found, and the remaining subformulas are simplified under the facts
extended by these atoms. A disjunction is treated dually: its subformulas may assume the negations of its
atoms. Equivalence: facts -> (formula <-> result). The sum over all atoms of total degree times number of
variables does not grow, and the result is a fixed point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from qe.exact.ring import Poly
from qe.exact.watch import IDLE
from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Atomic, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import conjuncts
from qe.simplifier.absorb import absorb
from qe.simplifier.factors import reduce_atom
from qe.simplifier.facts import NOTHING, Facts, atom_of, constraint, generator
from qe.simplifier.ranges import EVERYTHING, Range, describe, meet
from qe.simplifier.univariate import irredundant

_ROUNDS = 60  # every round removes degree, an atom or a subformula; this only guards against a bug


_SIMPLE, _LEVELS = dict[object, Formula](), dict[object, Formula]()
"""What became of formulas where nothing is assumed, and of a level under facts: results come back to the simplifier."""

_MOST = 2000  # results that are remembered, of each kind


def _remembered(memory: dict[object, Formula], key: object, result: Formula) -> Formula:
    if len(memory) >= _MOST:
        memory.clear()
    memory[key] = result
    return result


def simplify(formula: Formula, assumptions: Formula = TRUE, *, watch: Callable[[], object] = IDLE) -> Formula:
    """A formula, not larger, that is equivalent to ``formula`` wherever ``assumptions`` holds.

    Negations end up in the atoms. Quantified formulas are simplified inside; variables that do not occur
    lose their quantifier. Only conjoined atoms of ``assumptions`` (after simplification) are used. Whatever ``watch``
    raises ends the work.
    """
    facts = NOTHING
    if assumptions != TRUE:
        known = simplify(assumptions, watch=watch)
        if known == FALSE:
            return TRUE
        facts = facts_of(known, formula)
    return simplify_under(formula, facts if watch is IDLE else facts.watched(watch))


def simplify_under(formula: Formula, facts: Facts) -> Formula:
    """As ``simplify``, with the assumptions given as facts."""
    if facts.is_empty and (known := _SIMPLE.get(formula)) is not None:
        return formula if known == formula else known
    current = nnf(formula)
    for _ in range(_ROUNDS):
        previous, current = current, _node(current, facts)
        if current == previous:
            current = formula if current == formula else current  # with what is known about the node that was given
            if facts.is_empty:
                _remembered(_SIMPLE, formula, _remembered(_SIMPLE, current, current))
            break
    return current


def facts_of(known: Formula, formula: Formula) -> Facts:
    """The conjoined atoms of ``known`` as facts about the variables of ``formula``'s ring."""
    ring = formula.ring
    if ring is None:
        return NOTHING
    usable = [
        Atom(a.poly.convert(ring), a.relation)
        for a in conjuncts(known)
        if isinstance(a, Atom) and all(a.poly.ring.names[i] in ring.index for i in a.poly.variables)
    ]
    return NOTHING.extended(atom(a.poly, a.relation) for a in usable)


def _node(formula: Formula, facts: Facts, said: object = None) -> Formula:
    """``said``: what ``_said`` says of the facts, for those who ask about several formulas under the same ones."""
    match formula:
        case Constant():
            return formula
        case And(args) | Or(args):
            key = formula, said or _said(facts)
            return _LEVELS.get(key) or _remembered(_LEVELS, key, _level(args, facts, isinstance(formula, And)))
        case Exists(variables, body) | ForAll(variables, body):
            inner = _node(body, facts.without(variables))
            occurring = inner.free
            kept = tuple(v for v in variables if v in occurring)
            return exists(kept, inner) if isinstance(formula, Exists) else forall(kept, inner)
    return _level((formula,), facts, True)


def _said(facts: Facts) -> object:
    """The facts as they are now, as a value that is equal for equal ones: frozen sets keep their hash."""
    return frozenset(facts.ranges.items()), frozenset(facts.literals.items())


def _level(args: Iterable[Formula], facts: Facts, conjunctive: bool) -> Formula:
    """Simplify a conjunction (or disjunction) of ``args`` under ``facts``."""
    join = conj if conjunctive else disj
    absorbing: Formula = FALSE if conjunctive else TRUE
    atoms, literals, others = _sort(args, conjunctive)
    nothing = Facts(watch=facts.watch)
    for _ in range(_ROUNDS):
        tidied = _tidy(atoms, facts, conjunctive)
        if tidied is None:
            return absorbing
        atoms, produced = tidied
        kept = _literals(literals, facts, conjunctive)
        if kept is None:
            return absorbing
        literals = kept
        if not others and not produced:
            break
        inner = _extended(facts, atoms, literals, conjunctive)
        said = _said(inner)
        simplified = [_node(f, inner, said) for f in (*others, *produced)]
        simplified = absorb(simplified, conjunctive, lambda parts, flag: _level(parts, nothing, flag))
        if absorbing in simplified:
            return absorbing
        new_atoms, new_literals, others = _sort(simplified, conjunctive)
        if not new_atoms and not new_literals:
            break
        atoms, literals = atoms + new_atoms, literals + new_literals
    return join((*atoms, *literals, *others))


def _sort(args: Iterable[Formula], conjunctive: bool) -> tuple[list[Atom], list[Formula], list[Formula]]:
    """Atoms, (negated) root atoms, and everything else; nested levels of the same kind are flattened."""
    atoms: list[Atom] = []
    literals: list[Formula] = []
    others: list[Formula] = []
    for arg in args:
        if isinstance(arg, Atom):
            atoms.append(arg)
        elif isinstance(arg, Atomic | Not):
            literals.append(arg)
        elif isinstance(arg, And if conjunctive else Or):
            a, b, c = _sort(arg.args, conjunctive)
            atoms, literals, others = atoms + a, literals + b, others + c
        elif not (isinstance(arg, Constant) and arg.value == conjunctive):
            others.append(arg)
    return atoms, literals, others


def _literals(literals: list[Formula], facts: Facts, conjunctive: bool) -> list[Formula] | None:
    """Root atoms that are not decided by the facts or by each other; None for a contradiction (tautology)."""
    kept: dict[Formula, bool] = {}
    out: list[Formula] = []
    for literal in literals:
        body, wanted = (literal.arg, False) if isinstance(literal, Not) else (literal, True)
        known = facts.literals.get(body)
        if known is None and body in kept:
            if kept[body] == wanted:
                continue
            return None
        if known is None:
            kept[body] = wanted
            out.append(literal)
        elif (known == wanted) != conjunctive:
            return None
    return out


def _extended(facts: Facts, atoms: Iterable[Atom], literals: Iterable[Formula], conjunctive: bool) -> Facts:
    """The facts, with these atoms and root atoms (or, in a disjunction, their negations) added."""
    known = facts.extended(a if conjunctive else Atom(a.poly, a.relation.negated) for a in atoms)
    values = dict(facts.literals)
    for literal in literals:
        if isinstance(literal, Not):
            values[literal.arg] = not conjunctive
        else:
            values[literal] = conjunctive
    return Facts(known.ranges, values, facts.watch)


class _Board:
    """The atoms of one level by key polynomial, with the ranges they impose (negated in a disjunction)."""

    def __init__(self, atoms: Iterable[Atom], facts: Facts, conjunctive: bool) -> None:
        self.facts, self.conjunctive = facts, conjunctive
        self.groups: dict[Poly, list[Atom]] = {}
        self.own: dict[Poly, Range] = {}
        self.ranges: dict[Poly, Range] = dict(facts.ranges)
        self.view = Facts(self.ranges, facts.literals, facts.watch)
        for given in atoms:
            self.insert(given)

    def insert(self, given: Atom) -> None:
        key, wanted = constraint(given.poly, given.relation if self.conjunctive else given.relation.negated)
        group = self.groups.setdefault(key, [])
        if given not in group:
            group.append(given)
            self.own[key] = meet(self.own.get(key, EVERYTHING), wanted)
            self.ranges[key] = meet(self.facts.ranges.get(key, EVERYTHING), self.own[key])

    def hide(self, key: Poly) -> None:
        """Make ``view`` forget what the atoms with this key say (not what the outer facts say)."""
        outer = self.facts.ranges.get(key)
        if outer is None:
            self.ranges.pop(key, None)
        else:
            self.ranges[key] = outer

    def show(self, key: Poly) -> None:
        self.ranges[key] = meet(self.facts.ranges.get(key, EVERYTHING), self.own[key])

    def drop(self, key: Poly) -> list[Atom]:
        self.hide(key)
        self.own.pop(key)
        return self.groups.pop(key)


def _tidy(atoms: list[Atom], facts: Facts, conjunctive: bool) -> tuple[list[Atom], list[Formula]] | None:
    """The atoms reduced by their factors, by fixed variables and by each other; None if they contradict.

    Also returns subformulas of the other kind that the factor rules produced.
    """
    board = _Board(atoms, facts, conjunctive)
    produced: list[Formula] = []
    for _ in range(_ROUNDS):
        changed = False
        for key in list(board.groups):
            facts.watch()
            if key not in board.groups:
                continue
            board.hide(key)
            group = board.groups[key]
            reduced = [_reduce(given, board.view, conjunctive) for given in group]
            if reduced == group:
                board.show(key)
                continue
            changed = True
            board.drop(key)
            for part in reduced:
                fresh, _, others = _sort((part,), conjunctive)
                if (FALSE if conjunctive else TRUE) in others:
                    return None
                produced += others
                for given in fresh:
                    board.insert(given)
        if not changed:
            break
    kept = _emit(board, conjunctive)
    if kept is not None:
        kept = _in_one_variable(kept, facts, conjunctive)
    return None if kept is None else (kept, produced)


def _in_one_variable(atoms: list[Atom], facts: Facts, conjunctive: bool) -> list[Atom] | None:
    """The atoms (of a disjunction: dually) without those that others in the same variable make redundant."""
    if conjunctive:
        return irredundant(atoms, facts)
    kept = irredundant([Atom(a.poly, a.relation.negated) for a in atoms], facts)
    return None if kept is None else [Atom(a.poly, a.relation.negated) for a in kept]


def _reduce(given: Atom, view: Facts, conjunctive: bool) -> Formula:
    """One atom with the fixed variables replaced and its factors reduced."""
    poly, substituted = given.poly, False
    if len(poly.variables) > 1 or poly.total_degree > 1:
        for index in poly.variables:
            known = view.ranges.get(generator(poly.ring, index))
            value = None if known is None else known.point
            if value is not None:
                poly, substituted = poly.at_rational(index, value), True
    current: Formula = atom(poly, given.relation) if substituted else given
    return reduce_atom(current, view, conjunctive) if isinstance(current, Atom) else current


def _emit(board: _Board, conjunctive: bool) -> list[Atom] | None:
    """The shortest list of atoms for the ranges on the board; None if a range is empty."""
    out: list[Atom] = []
    for key, group in board.groups.items():
        board.facts.watch()
        board.hide(key)
        base = board.view.known(key)
        board.show(key)
        total = meet(base, board.own[key])
        if total.is_empty:
            return None
        wanted = describe(total, base, not conjunctive)
        fresh = [atom_of(key, relation, value) for relation, value in wanted]
        if not conjunctive:
            fresh = [Atom(a.poly, a.relation.negated) for a in fresh]
        out += group if group == fresh or set(group) == set(fresh) else fresh
    return out
