"""Primitive "quantifiers": negations, names, places and order of quantifiers, with nothing said about what is compared.
Steps are also called "renaming", "duality", "negation normal form", "nested blocks of one kind gathered", and
"independent parts and miniscoping".

THEOREM. With A, B for any formulas and v for variables: not ex v A iff all v not A, and De Morgan's laws; a bound
variable may get another name that captures nothing; ex v A iff A, where no variable of v is free in A (R is not
empty); ex v (A or B) iff ex v A or ex v B; ex v (A and B) iff A and ex v B, where no variable of v is free in A; and
ex v ex w A iff ex v, w A; dually for all. So two formulas are equivalent that are the same up to names after
negations went down to the atoms, or that have the same parts and names after every quantifier went in as far as it
goes (``scoped``).

Evidence: none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from qe.formula.build import conj, disj, exists, forall
from qe.formula.syntax import And, Exists, ForAll, Formula, Or
from qe.formula.traverse import connected
from qe.kernel.negation import normal
from qe.kernel.renaming import shape
from qe.kernel.step import Claim, Context, Limits, only


def check_quantifiers(claim: Claim, context: Context, limits: Limits) -> None:
    """Both sides say the same by the laws of quantifiers."""
    only(claim)
    before, after = normal(claim.before), normal(claim.after)
    if before == after or shape(before) == shape(after):
        return
    if unordered(scoped(before)) != unordered(scoped(after)):
        raise claim.fail("the two sides differ in more than negations, names and places of quantifiers")


def scoped(formula: Formula) -> Formula:
    """The formula, whose negations stand at its atoms, with every quantifier before the parts alone that it binds."""
    match formula:
        case And(args):
            return conj(map(scoped, args))
        case Or(args):
            return disj(map(scoped, args))
        case Exists(variables, body) | ForAll(variables, body):
            return _quantified(type(formula), variables, scoped(body))
    return formula


def _quantified(kind: type[Exists | ForAll], names: Iterable[str], body: Formula) -> Formula:
    """The block with its variables as far inside as they go; the body is one of which that is so."""
    is_exists = kind is Exists
    whole, cases = (And, Or) if is_exists else (Or, And)
    join, quantify = (conj, exists) if is_exists else (disj, forall)
    if isinstance(body, cases):
        return (disj if is_exists else conj)(_quantified(kind, names, part) for part in body.args)
    block, parts = _opened(kind, set(names), body.args if isinstance(body, whole) else (body,), whole)
    seen = [block & set(part.free) for part in parts]
    alone = [mine.difference(*(seen[:k] + seen[k + 1 :])) for k, mine in enumerate(seen)]
    inner = [
        (_quantified(kind, mine, part) if isinstance(part, cases) else quantify(sorted(mine), part)) if mine else part
        for part, mine in zip(parts, alone, strict=True)
    ]
    shared = block.difference(*alone)
    single, groups = connected(inner, lambda part: frozenset(shared.intersection(part.free)))
    return join((*single, *(quantify(sorted(names), join(members)) for names, members in groups)))


def _opened(
    kind: type[Exists | ForAll], names: set[str], parts: Sequence[Formula], whole: type[And | Or]
) -> tuple[set[str], list[Formula]]:
    """The variables and parts of a block and of those of its kind inside, whose variables nothing else of it sees."""
    opened: list[Formula] = []
    for k, part in enumerate(parts):
        others = {name for j, other in enumerate(parts) if j != k for name in (*other.free, *other.bound)}
        if isinstance(part, kind) and not set(part.variables) & (names | others):
            names = names | set(part.variables)
            opened += part.body.args if isinstance(part.body, whole) else (part.body,)
        else:
            opened.append(part)
    return names, opened


def unordered(formula: Formula) -> object:
    """A value that is the same for formulas with the same parts in any order."""
    match formula:
        case And(args) | Or(args):
            return type(formula).__name__, frozenset(map(unordered, args))
        case Exists(variables, body) | ForAll(variables, body):
            return type(formula).__name__, frozenset(variables), unordered(body)
    return formula
