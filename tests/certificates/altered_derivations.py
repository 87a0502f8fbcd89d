"""Derivations altered in what they mean: a search for one that is accepted although its claim is false.

Where ``false_claims`` changes single entries, everything is changed here at once, so that the steps still fit each
other: a parameter becomes a number in all of them, two variables become one, a quantifier takes in a further variable.
Much of that is accepted, and then the claim has to be true.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from copy import deepcopy
from fractions import Fraction
from typing import Any

from qe.certify.registry import RULES
from qe.errors import QEError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, neg
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Not, Or, Relation
from qe.proof.entry import Entry, formula_from_json, formula_to_json, poly_to_text
from tests.certificates.mutation import lists

Data = dict[str, Any]
Change = Callable[[Formula], Formula]
Names = Callable[[str], str]
STRICT = {Relation.LE: Relation.LT, Relation.GE: Relation.GT}
WEAK = {strict: weak for weak, strict in STRICT.items()}


class NothingToAlter(Exception):
    """The derivation has nothing of this kind."""


def ring_of(data: Data) -> Ring:
    """The ring of all its variables."""
    return Ring.of(data["payload"]["order"])


def steps(node: Any) -> Iterator[Data]:
    """All steps, also those inside evidence."""
    if isinstance(node, dict):
        if "rule" in node and "before" in node:
            yield node
        node = list(node.values())
    for part in node if isinstance(node, list) else ():
        yield from steps(part)


# --- everything at once ------------------------------------------------------------------------------
def everywhere(data: Data, change: Change, texts: Names = str) -> None:
    """Every formula changed, and every other text (polynomials and names in evidence)."""
    ring = ring_of(data)

    def walk(node: Any) -> Any:
        if isinstance(node, list):
            found = _formula(node, ring)
            return [walk(part) for part in node] if found is None else formula_to_json(change(found), quantified=True)
        if isinstance(node, dict):
            return {k: value if k in ("rule", "kind") else walk(value) for k, value in node.items()}
        return texts(node) if isinstance(node, str) else node

    data["payload"] = walk(data["payload"])


def _formula(node: list[Any], ring: Ring) -> Formula | None:
    try:
        return formula_from_json(Entry(node, ""), ring, quantified=True)
    except QEError:
        return None


def rebuilt(change: Callable[[Atom], Formula], names: Names = str) -> Change:
    """A formula with other atoms and other names of its quantifiers."""

    def walk(formula: Formula) -> Formula:
        match formula:
            case Atom():
                return change(formula)
            case And(args) | Or(args):
                return (conj if isinstance(formula, And) else disj)(map(walk, args))
            case Not(arg):
                return neg(walk(arg))
            case Exists(variables, body) | ForAll(variables, body):
                return (exists if isinstance(formula, Exists) else forall)(map(names, variables), walk(body))
        return formula

    return walk


def polynomials(data: Data, change: Callable[[Poly], Poly], names: Names = str) -> None:
    """Every polynomial changed, in formulas and in evidence."""
    ring = ring_of(data)

    def text(given: str) -> str:
        if given in ring.index:
            return names(given)
        try:
            poly = Entry(given, "").polynomial(ring)
        except QEError:
            return given
        return given if poly.is_constant else poly_to_text(change(poly))

    everywhere(data, rebuilt(lambda a: atom(change(a.poly), a.relation), names), text)


def number_for_a_variable(rng: random.Random, data: Data) -> None:
    """Leading coefficients vanish, conditions become constant."""
    ring = ring_of(data)
    i, value = rng.randrange(ring.size), Fraction(rng.choice((0, 0, 1, -1, 2)))
    polynomials(data, lambda p: p.at_rational(i, value) if p.degree(i) else p)


def another_scale(rng: random.Random, data: Data) -> None:
    """A variable moved, turned round, or replaced by a square or a product."""
    ring = ring_of(data)
    if not ring.size:
        return
    i = rng.randrange(ring.size)
    x, y = ring.gen(i), ring.gen(rng.randrange(ring.size))
    image = rng.choice((x + 1, -x, x * 2, x * x, x * y, y, -y))
    polynomials(data, lambda p: p.compose({i: image}) if p.degree(i) and p.total_degree < 12 else p)


def other_names(rng: random.Random, data: Data) -> None:
    """Two variables exchange their names, or get one name: free ones are captured."""
    ring = ring_of(data)
    if not ring.size:
        return
    i, j = (rng.randrange(ring.size) for _ in range(2))
    images = {i: ring.gen(j), **({j: ring.gen(i)} if rng.random() < 0.5 else {})}
    told = {ring.names[k]: ring.names[image.variables[0]] for k, image in images.items()}
    polynomials(data, lambda p: p.compose(images), lambda name: told.get(name, name))


def another_order(rng: random.Random, data: Data) -> None:
    """The same with the variables in another order."""
    old = ring_of(data)
    new = Ring.of(rng.sample(old.names, old.size))

    def text(given: str) -> str:
        try:
            return given if given in old.index else poly_to_text(Entry(given, "").polynomial(old).convert(new))
        except QEError:
            return given

    everywhere(data, lambda f: convert(f, new), text)
    data["payload"]["order"] = list(new.names)


def other_strictness(rng: random.Random, data: Data) -> None:
    """All weak inequalities strict, all strict ones weak, or one relation for another."""
    old, new = rng.sample(list(Relation), 2)
    told = rng.choice((STRICT, WEAK, {old: new}))
    everywhere(data, rebuilt(lambda a: atom(a.poly, told.get(a.relation, a.relation))))


def constant_for_an_atom(rng: random.Random, data: Data) -> None:
    """A condition left out, or taken to be false."""
    found = [_formula(node, ring_of(data)) for _, node in lists(data["payload"]) if node[0] == "atom"]
    chosen, value = rng.choice(found or [None]), rng.choice((TRUE, FALSE))
    everywhere(data, rebuilt(lambda a: value if a == chosen else a))


def other_quantifiers(rng: random.Random, data: Data) -> None:
    """Quantifiers of the other kind, with a further variable, or without one of theirs."""
    name, shape = rng.choice(ring_of(data).names), rng.randrange(3)

    def walk(formula: Formula) -> Formula:
        match formula:
            case And(args) | Or(args):
                return (conj if isinstance(formula, And) else disj)(map(walk, args))
            case Not(arg):
                return neg(walk(arg))
            case Exists(variables, body) | ForAll(variables, body):
                names = [v for v in variables if v != name or shape < 2] + ([name] if shape == 1 else [])
                return (exists if isinstance(formula, Exists) is (shape > 0) else forall)(names, walk(body))
        return formula

    everywhere(data, walk)


# --- single steps --------------------------------------------------------------------------------------
def _lists_of_steps(data: Data) -> list[list[Data]]:
    return [node for _, node in lists(data["payload"]) if all(isinstance(s, dict) and "rule" in s for s in node)]


def steps_exchanged(rng: random.Random, data: Data) -> None:
    """Two steps in the other order."""
    found = [listed for listed in _lists_of_steps(data) if len(listed) > 1]
    if not found:
        raise NothingToAlter
    listed = rng.choice(found)
    i, j = rng.sample(range(len(listed)), 2)
    listed[i], listed[j] = listed[j], listed[i]


def step_left_out(rng: random.Random, data: Data) -> None:
    """A step left out, with what it gave taken for what it was given."""
    found = _lists_of_steps(data)
    if not found:
        raise NothingToAlter
    listed = rng.choice(found)
    gone = listed.pop(rng.randrange(len(listed)))
    old, new = (formula_from_json(Entry(gone[k], ""), ring_of(data), quantified=True) for k in ("after", "before"))
    everywhere(data, lambda f: new if f == old else f)


def other_evidence(rng: random.Random, data: Data) -> None:
    """The evidence of another step, or a list of it emptied, doubled, or turned round."""
    found = list(steps(data["payload"]))
    step, other = rng.choice(found), rng.choice(found)
    if rng.random() < 0.5 or not step["evidence"]:
        step["evidence"] = deepcopy(other["evidence"])
        return
    key = rng.choice(list(step["evidence"]))
    value = step["evidence"][key]
    if isinstance(value, list):
        step["evidence"][key] = rng.choice(([], value[:1], value[::-1], value + value, value[1:]))
    else:
        step["evidence"][key] = rng.choice((None, [], 0, 1, -1, "0"))


def other_rule(rng: random.Random, data: Data) -> None:
    """A step by another rule, sometimes one that says what no evidence is needed for."""
    step = rng.choice(list(steps(data["payload"])))
    step["rule"] = rng.choice(list(RULES))
    if rng.random() < 0.5:
        step["evidence"] = rng.choice(({}, {"theory": {"polynomials": [], "lemmas": [], "cases": []}}, {"steps": []}))
        step["after"] = rng.choice((True, False))
        data["payload"]["answer"] = step["after"]


def other_place(rng: random.Random, data: Data) -> None:
    """Other facts beside a step, or another place."""
    found = list(steps(data["payload"]))
    step, other = rng.choice(found), rng.choice(found)
    step["context"] = rng.choice(([], [step["before"]], [other["after"]], other["context"], [False]))
    step["at"] = rng.choice((step["at"], [], [0], [1], step["at"][:-1], other["at"]))


ALTERATIONS: tuple[Callable[[random.Random, Data], None], ...] = (
    number_for_a_variable,
    another_scale,
    other_names,
    another_order,
    other_strictness,
    constant_for_an_atom,
    other_quantifiers,
    steps_exchanged,
    step_left_out,
    other_evidence,
    other_rule,
    other_place,
)


def altered_derivation(rng: random.Random, given: Data) -> Data | None:
    """The derivation with one to three alterations; None where nothing comes of it."""
    data = deepcopy(given)
    try:
        for _ in range(rng.choice((1, 1, 1, 2, 3))):
            rng.choice(ALTERATIONS)(rng, data)
    except (QEError, NothingToAlter, LookupError, TypeError):
        return None
    return data if data != given else None
