"""Optima by cases for people: LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from qe.decomposition.pieces import Range, RootFunction, range_text
from qe.io import latex

Place = Sequence[Range]


def to_latex(cases: Sequence[tuple[Place, RootFunction | None, bool, Sequence[Place]]]) -> str:
    """A brace with a line for each case: value (None: unbounded), where it is attained, and for which parameters."""
    lines = []
    for ranges, value, attained, places in cases:
        what = r"\text{unbounded}" if value is None else root_in_latex(value)
        note = r"\ (\text{not attained})" if value is not None and not attained else ""
        where = r" \lor ".join(", ".join(map(_range, place)) for place in places)
        at = rf"\ \text{{at}}\ {where}" if where else ""
        lines.append(f"{what}{note}{at} & {', '.join(map(_range, ranges))}")
    inside = " \\\\\n".join(lines) or r"\text{no point meets the constraints} &"
    return f"\\begin{{cases}}\n{inside}\n\\end{{cases}}"


def root_in_latex(root: RootFunction) -> str:
    """A root function, with a square root where it can be."""
    written = root.written
    if written is None:
        name = latex.name(root.poly.ring.names[root.poly.level])
        return rf"\operatorname{{root}}_{{{root.k}}}\left({latex.term(root.poly)}, {name}\right)"
    front, inside, bottom = written
    top = latex.term(front) if front or inside is None else ""
    if inside is not None:
        sign = "-" if (root.k == 1) is (bottom.constant_value() > 0) else "+" if top else ""
        top += f"{' ' if top else ''}{sign}{' ' if top else ''}\\sqrt{{{latex.term(inside)}}}"
    return top if bottom == bottom.ring.constant(1) else rf"\frac{{{top}}}{{{latex.term(bottom)}}}"


def _range(one: Range) -> str:
    name = latex.name(one.variable)
    if one.lower is not None and one.is_point:
        return f"{name} = {root_in_latex(one.lower)}"
    lower, upper = ("" if end is None else root_in_latex(end) for end in (one.lower, one.upper))
    if not lower and not upper:
        return rf"{name} \in \mathbb{{R}}"
    text = range_text(name, lower, upper, one.lower_closed, one.upper_closed)
    return text.replace("<=", r"\leq").replace(">=", r"\geq")
