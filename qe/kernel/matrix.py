"""Three-valued truth of a quantifier-free formula on a cell, from the signs of listed factors alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, format_poly
from qe.formula.build import atom, neg
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or, Relation, RootAtom
from qe.formula.traverse import conjuncts, disjuncts
from qe.kernel.arithmetic.products import FactorLists, Product, Signs, possible_signs, sign
from qe.kernel.projection import checked_resultant
from qe.truth import Truth


@dataclass(slots=True)
class Situation:
    """Where a cell is: the signs known on it; for each level the sections of its stack, the factors whose roots
    they show, the factors nullified there, and its position in the stack."""

    signs: Signs
    sections: list[tuple[tuple[int, ...], ...]]
    isolated: list[frozenset[int]]
    nullified: list[frozenset[int]]
    positions: list[int]


Test = Callable[[Situation], Truth]


def compiled(formula: Formula, lists: FactorLists, step: str) -> Test:
    """The formula's truth as a function of the situation; ``CertificateRejected`` if a factor is not listed."""
    match formula:
        case Constant(value):
            return lambda situation: value
        case Atom(poly, relation):
            return _atom(_product(poly, lists, step), relation)
        case RootAtom():
            return _root_atom(formula, lists, step)
        case Not(arg):
            inner = compiled(arg, lists, step)
            return lambda situation: None if (t := inner(situation)) is None else not t
        case And(args):
            return _combined([compiled(a, lists, step) for a in args], False)
        case Or(args):
            return _combined([compiled(a, lists, step) for a in args], True)
    raise CertificateRejected(step, "a quantifier where a quantifier-free formula is needed")


def _combined(tests: list[Test], decisive: bool) -> Test:
    def run(situation: Situation) -> Truth:
        result: Truth = not decisive
        for test in tests:
            value = test(situation)
            if value is decisive:
                return decisive
            if value is None:
                result = None
        return result

    return run


def _product(poly: Poly, lists: FactorLists, step: str) -> Product:
    if poly.ring is not lists.ring:
        raise CertificateRejected(step, "a polynomial in other variables than the table's")
    product = lists.decompose(poly)
    if product is None:
        raise CertificateRejected(step, f"{format_poly(poly)} is not a product of listed factors")
    return product


def _atom(product: Product, relation: Relation) -> Test:
    holding = relation.signs

    def run(situation: Situation) -> Truth:
        possible = possible_signs(product, situation.signs)
        return True if possible <= holding else None if possible & holding else False

    return run


def _root_atom(formula: RootAtom, lists: FactorLists, step: str) -> Test:
    """``x r root_k(p)``: the k-th section on which a factor of p vanishes, compared with the cell's position.

    False where p vanishes identically in x: where a factor of p is nullified or a factor of lower level is zero.
    """
    level = lists.ring.index.get(formula.variable, -1)
    product = _product(formula.poly, lists, step)
    here = {index for at, index, _ in product.powers if at == level}
    lower = [(at, index) for at, index, _ in product.powers if at < level]
    if formula.poly.level != level:
        raise CertificateRejected(step, "a root of a polynomial whose main variable is another one")
    most = _most_roots([lists.lists[level][index] for index in sorted(here)], level, lists)

    def run(situation: Situation) -> Truth:
        if any(situation.signs[at][index] == 0 for at, index in lower if at < len(situation.signs)):
            return False
        if level >= len(situation.positions):
            return False if abs(formula.k) > most(situation) else None
        if not here <= situation.isolated[level]:
            return None
        sections, position = situation.sections[level], situation.positions[level]
        roots = [2 * j + 1 for j, section in enumerate(sections) if here & set(section)]
        if here & situation.nullified[level]:
            return False
        k = formula.k - 1 if formula.k > 0 else len(roots) + formula.k
        if not 0 <= k < len(roots):
            return False
        return formula.relation.holds((position > roots[k]) - (position < roots[k]))

    return run


def _most_roots(factors: list[Poly], level: int, lists: FactorLists) -> Callable[[Situation], int]:
    """An upper bound on the number of distinct real roots, from lower signs: the degrees, but for degree 2 none
    where the discriminant is negative and one where it is zero and the leading coefficient is not."""
    known = [(f.degree(level), lists.decompose(f.leading(level))) for f in factors]
    discriminants = [lists.decompose(f.discriminant(level)) if f.degree(level) == 2 else None for f in factors]

    def run(situation: Situation) -> int:
        total = 0
        for (degree, lead), discriminant in zip(known, discriminants, strict=True):
            s = sign(discriminant, situation.signs) if discriminant else None
            if s == 0 and lead and sign(lead, situation.signs):
                degree = 1
            total += 0 if s == -1 else degree
        return total

    return run


def strengthened(matrix: Formula, lists: FactorLists, constraints: Sequence[frozenset[int]], step: str) -> Test:
    """The matrix together with the conditions it implies on fewer variables.

    Rule: over R, a*z^2 + b*z + c <= 0 with a constant a > 0 has a solution z only if b^2 - 4ac >= 0, and
    a*z^2 + b*z + c < 0 only if b^2 - 4ac > 0 (complete the square). Rule: f = 0 and g = 0 only if their resultant,
    which is a combination of f and g, is zero. Each conjunct gives such conditions on the other variables, applied
    again to what they give. A condition whose factors are not listed is left out, and resultants are formed with
    equational constraints only. A disjunction is treated as the negated conjunction of its negated parts.
    """
    tests, dual = [compiled(matrix, lists, step)], isinstance(matrix, Or)
    pending = [*(disjuncts(matrix) if dual else conjuncts(matrix))]
    equations: list[Poly] = []
    while pending:
        part = pending.pop()
        if not isinstance(part, Atom):
            continue
        conjunct = Atom(part.poly, part.relation.negated) if dual else part
        implied = [implied_condition(conjunct)]
        if conjunct.relation is Relation.EQ:
            implied += [_eliminated(conjunct.poly, other, lists, constraints) for other in equations]
            equations.append(conjunct.poly)
        for condition in implied:
            found = neg(condition) if dual and condition is not None else condition
            if isinstance(found, Constant):
                tests.append(compiled(found, lists, step))
            elif isinstance(found, Atom):
                product = lists.decompose(found.poly)
                if product is not None:
                    tests.append(_atom(product, found.relation))
                    pending.append(found)
    return _combined(tests, dual)


def _eliminated(f: Poly, g: Poly, lists: FactorLists, constraints: Sequence[frozenset[int]]) -> Formula | None:
    """The resultant of two equations with one main variable, one of them made of the factors of a constraint."""
    level = f.level
    if level < 1 or g.level != level:
        return None
    allowed = {(level, index) for index in constraints[level]}
    for p in (f, g):
        product = lists.decompose(p)
        if product is not None and all((at, index) in allowed for at, index, _ in product.powers):
            return atom(checked_resultant(lists, f, g, level, 0), Relation.EQ)
    return None


def implied_condition(conjunct: Atom) -> Formula | None:
    """The discriminant condition of one atom in its main variable, or None if the rule does not apply."""
    level = conjunct.poly.level
    if level < 0 or conjunct.poly.degree(level) != 2:
        return None
    c, b, a = conjunct.poly.coefficients(level)
    if not a.is_constant:
        return None
    facing = conjunct.relation if a.constant_value() > 0 else conjunct.relation.flipped
    if facing in (Relation.LE, Relation.EQ):
        return atom(b * b - 4 * a * c, Relation.GE)
    if facing is Relation.LT:
        return atom(b * b - 4 * a * c, Relation.GT)
    return None
