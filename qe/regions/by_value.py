"""Solutions by their values: each value once, under the condition on the parameters under which it is a solution.

Over a cell of the parameters a section is a root of a factor. Where the signs of the factor's coefficients and of its
discriminant are known there, it is a quotient (degree 1), a fraction with a square root (degree 2), else the k-th root.
Cells over which the same terms are solutions are put together, and the condition that they are is read off the signs
(``formula_of_cells``). So the cases say what the cells of the table say, and need not be disjoint.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.decomposition.formulas import Undistinguished, formula_of_cells
from qe.decomposition.pieces import RootFunction, Sections, merge, quotient_text
from qe.decomposition.sampled_cells import Place, any_true, child, leaves
from qe.decomposition.sign_table import Columns, placed_signs
from qe.exact.ring import Poly, Ring, format_poly
from qe.formula.build import conj, convert
from qe.formula.syntax import TRUE, Formula, Or
from qe.formula.traverse import conjuncts, polynomials
from qe.options import Budget
from qe.proof.cells import SIGN_OF, Cell, CellTable, FreeCell
from qe.spelling import quoted

MOST_CELLS = 400
"""Cells of the parameters; more are described as pieces."""

Terms = tuple[str, ...]
"""What each of the last variables is."""


def cases_by_value(table: CellTable, parameters: int, budget: Budget, known: Formula = TRUE) -> list[str] | None:
    """The cases as texts, with ``or`` between them a formula for the true cells of a table without quantifiers.

    ``parameters``: how many variables are not solved for; ``known``: what the conditions on them need not say. Where a
    variable has neither finitely many values nor all, it is a parameter, too. None where there are too many cells,
    and where signs do not tell which ones are meant.
    """
    ring, lines = Ring.of(table.order), list[str]()
    given = convert(conj(f for f in conjuncts(known) if {*f.free} <= {*table.order[:parameters]}), ring)
    everything: frozenset[tuple[int, ...]] = frozenset()  # cells that are said, with all that is over them
    for depth in range(parameters, len(table.order)):
        bases = list(leaves(table, depth=depth))
        if len(bases) > MOST_CELLS:
            return None
        determined = {i for i, base in enumerate(bases) if _is_determined(base.cell)}
        try:
            lines += _lines(table, depth, bases, determined, everything, _outside(table, bases, given), budget)
        except Undistinguished:
            return None
        rest = frozenset(base.path for i, base in enumerate(bases) if i not in determined)
        if not rest:
            return lines
        everything |= {base.path for base in bases if _is_all(base.cell)}
        table = _only(table, rest | everything)
    rest = frozenset(base.path for base in leaves(table) if not _begins(base.path, everything))
    return lines + [str(piece) for piece in merge(_only(table, rest), budget=budget)]


def _outside(table: CellTable, bases: list[Place], known: Formula) -> frozenset[int]:
    """Those cells of the parameters on which an assumption does not hold."""
    depth = max((base.depth for base in bases), default=0)
    cells = [FreeCell(base.path, tuple(map(placed_signs, base.used, base.signs)), True) for base in bases]
    listed = {factor for level in table.factors[:depth] for factor in level}
    if not all(factor in listed for poly in polynomials(known) for factor, _ in poly.factors()[1]):
        return frozenset()
    false = Columns(cells, table.factors[:depth]).where(known)[1]
    return frozenset(i for i in range(len(bases)) if false >> i & 1)


def _begins(path: tuple[int, ...], cells: frozenset[tuple[int, ...]]) -> bool:
    """Whether a cell is one of these, or over one."""
    return any(path[:k] in cells for k in range(len(path) + 1))


def _lines(
    table: CellTable,
    depth: int,
    bases: list[Place],
    known: set[int],
    everything: frozenset[tuple[int, ...]],
    outside: frozenset[int],
    budget: Budget,
) -> list[str]:
    """The cases over those cells of the parameters that are known to have finitely many values, or all; but not over
    those with ``everything``, which is said already; ``outside`` are those that conditions may or may not include."""
    values = _Values(table, Sections(table, budget))
    found: dict[tuple[int, tuple[int, ...]], set[Terms]] = {}
    for i in sorted(known):
        budget.check("solutions by value")
        found |= {(i, place.path): terms for place, terms in values.over(bases[i])}
    free = frozenset(i for i in known if _is_all(bases[i].cell))
    holding: dict[frozenset[int], list[Terms]] = {}
    for terms in _cover(found):
        holding.setdefault(frozenset(i for (i, _), all_terms in found.items() if terms in all_terms), []).append(terms)
    if new := free - {i for i in free if _begins(bases[i].path, everything)}:
        holding[new] = [()]
    ordered = sorted(holding.items(), key=lambda pair: min(pair[0]))
    names = table.order[depth:]
    return [
        line
        for cells, terms in ordered
        for line in _cases(_condition(table, bases, cells, (free | outside) - cells, budget), terms, names)
    ]


def _only(table: CellTable, kept: frozenset[tuple[int, ...]], truth: bool | None = None) -> CellTable:
    """The table with what is over these cells alone; with ``truth`` they are cut off there and have that."""

    ways = {path[:k] for path in kept for k in range(len(path))}

    def cut(cell: Cell, path: tuple[int, ...]) -> Cell:
        if path in kept:
            return cell if truth is None else Cell(cell.signs, truth)
        if cell.stack is None or path not in ways:
            return Cell(cell.signs, False)
        below = tuple(cut(inner, (*path, k)) for k, inner in enumerate(cell.stack.cells))
        return replace(cell, stack=replace(cell.stack, cells=below))

    return replace(table, root=cut(table.root, ()))


def _is_all(cell: Cell) -> bool:
    """Whether everything over a cell is true."""
    return cell.truth is True if cell.stack is None else all(map(_is_all, cell.stack.cells))


def _is_determined(cell: Cell) -> bool:
    """Whether over a cell each variable has finitely many values that are solutions, or all are."""
    if cell.stack is None or _is_all(cell):
        return True
    return not any(map(any_true, cell.stack.cells[::2])) and all(map(_is_determined, cell.stack.cells))


@dataclass(frozen=True, slots=True)
class _Values:
    """What the true sections over cells of the parameters are."""

    table: CellTable
    sections: Sections

    def over(self, place: Place, fixed: Mapping[int, Fraction] | None = None) -> Iterator[tuple[Place, set[Terms]]]:
        """The solutions over a cell, with the terms that they are; ``fixed``: the variables with a rational value."""
        fixed, stack = fixed or {}, place.cell.stack
        if stack is None or _is_all(place.cell):
            return
        ends = self.sections.of(place)
        for k, candidates in enumerate(ends):
            above = child(self.table, place, 2 * k + 1)
            if not any_true(above.cell):
                continue
            values = {text for end in candidates for text in self.texts(end, place, fixed)}
            if _is_all(above.cell):
                yield above, {(value,) for value in values}
                continue
            number = above.point.number(place.depth)
            inner = {**fixed, place.depth: number} if isinstance(number, Fraction) and _is_fixed(candidates) else fixed
            for end, terms in self.over(above, inner):
                yield end, {(value, *rest) for value in values for rest in terms}

    def texts(self, end: RootFunction, place: Place, fixed: Mapping[int, Fraction]) -> list[str]:
        """The terms that a section is as a root of a factor."""
        level, poly = place.depth, end.poly
        if end.value is not None:
            return [str(end.value)]
        signs = [self.sign(c, place) for c in poly.coefficients(level)]
        while len(signs) > 1 and signs[-1] == 0:
            signs.pop()
        inside = None
        if len(signs) == 3 and signs[2]:
            c, b, a = poly.coefficients(level)[:3]
            inside = self.sign(b * b - 4 * (a * c), place)
        short = poly
        for i, value in fixed.items():
            short = short.at_rational(i, value)
        forms = [form.coefficients(level) for form in dict.fromkeys((short, poly))]
        if len(signs) == 2 and signs[1]:
            return [quotient_text(-form[0], None, form[1], 0) for form in forms]
        if inside is not None and inside >= 0 and signs[2]:
            greater = (end.k == 2) == (signs[2] > 0)
            which = (-1, 1) if inside == 0 else (1 if greater else -1,)
            return [_quadratic_text(form[:3], sign) for form in forms for sign in which]
        return [f"root({end.k}, {format_poly(poly)}, {quoted(self.table.order[level])})"]

    def sign(self, poly: Poly, place: Place) -> int | None:
        """The sign of a product of factors on the cell; None where it is not among those that the table says."""
        unit, factors = poly.factors() if poly else (0, ())
        result = (unit > 0) - (unit < 0)
        for factor, exponent in factors:
            level = factor.level
            if level >= place.depth or factor not in self.table.factors[level]:
                return None
            j = self.table.factors[level].index(factor)
            if j not in place.used[level]:
                return None
            character = place.signs[level][place.used[level].index(j)]
            if character == "?":
                return None
            result *= SIGN_OF[character] ** exponent
        return result


def _is_fixed(candidates: frozenset[RootFunction]) -> bool:
    """Whether the value does not depend on the cell, but is the same number wherever these are solutions."""
    return any(end.value is not None for end in candidates)


def _quadratic_text(coefficients: tuple[Poly, ...], sign: int) -> str:
    c, b, a = coefficients
    front, inside, bottom = -b, b * b - 4 * (a * c), 2 * a
    if front.normal()[0] % 2 == 0 and inside.normal()[0] % 4 == 0:
        front, inside, bottom = front.exact_divide(2), inside.exact_divide(4), a
    return quotient_text(front, inside, bottom, sign)


def _cover(found: Mapping[tuple[int, tuple[int, ...]], set[Terms]]) -> list[Terms]:
    """Few and short terms that are all solutions."""
    where: dict[Terms, set[tuple[int, tuple[int, ...]]]] = {}
    for solution, all_terms in found.items():
        for terms in all_terms:
            where.setdefault(terms, set()).add(solution)
    uncovered, chosen = set(found), []
    while uncovered:
        best = min(where, key=lambda terms: (-len(where[terms] & uncovered), sum(map(len, terms)), min(where[terms])))
        chosen.append(best)
        uncovered -= where[best]
    return sorted(
        chosen, key=lambda terms: (min(where[terms]), ["+ sqrt" in text for text in terms], sorted(where[terms]))
    )


def _condition(
    table: CellTable, bases: list[Place], chosen: frozenset[int], open_: frozenset[int], budget: Budget
) -> str:
    """The condition on the parameters that says which cells: the ``chosen`` ones, and perhaps some of those that are
    open. It is a formula, or what one piece says if that is shorter."""
    depth = max((base.depth for base in bases), default=0)
    cells = [
        FreeCell(base.path, tuple(map(placed_signs, base.used, base.signs)), i in chosen)
        for i, base in enumerate(bases)
        if i not in open_
    ]
    formula = formula_of_cells(table.factors[:depth], cells)
    if formula == TRUE:
        return ""
    text = f"({formula})" if isinstance(formula, Or) else str(formula)
    pieces = merge(_only(table, frozenset(bases[i].path for i in chosen), True), budget=budget)
    return min([text, *map(str, pieces)], key=len) if len(pieces) == 1 else text


def _cases(condition: str, values: list[Terms], names: tuple[str, ...]) -> list[str]:
    """A condition and the values of which one holds; those of the first variable that are the same are said once."""
    parts = _values(values, names)
    if condition and len(parts) > 1:
        parts = [f"({' or '.join(parts)})"]
    return [" and ".join(part for part in (condition, said) if part) or "true" for said in parts or [""]]


def _values(values: list[Terms], names: tuple[str, ...]) -> list[str]:
    firsts: dict[str, list[Terms]] = {}
    for terms in values:
        if terms:
            firsts.setdefault(terms[0], []).append(terms[1:])
    parts = []
    for first, rest in firsts.items():
        inner = _values(rest, names[1:])
        said = f"({' or '.join(inner)})" if len(inner) > 1 else "".join(inner)
        parts.append(f"{quoted(names[0])} = {first}" + (f" and {said}" if said else ""))
    return parts
