"""All solutions of a formula, case by case: each variable in terms of those before it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from qe.decomposition.pieces import Piece
from qe.formula.build import disj
from qe.formula.syntax import Formula
from qe.io.substitution import over_one_ring
from qe.regions.region import Region
from qe.services import SymPyForm


@dataclass(frozen=True, slots=True, repr=False)
class Solutions(SymPyForm):
    """The solutions in the variables ``order`` as disjoint cases, which together are all of them.

    A case says for the first variables where they lie, and for each later one, over those, between which values; ends
    are numbers, terms in the variables before, with ``sqrt`` where they can be, or ``root(k, polynomial, variable)``.
    Iterate over them for the cases (``Piece``: ``.ranges``, ``.sample``, ``.formula``). ``str`` writes one case a line,
    with ``or`` between them: a formula that can be read back. ``region``: the set that they are.
    """

    order: tuple[str, ...]
    cases: tuple[Piece, ...]
    region: Region

    @property
    def formula(self) -> Formula:
        """What ``str`` says, as a formula; it may have root atoms."""
        return disj(over_one_ring(*(case.formula for case in self.cases)))

    def __iter__(self) -> Iterator[Piece]:
        return iter(self.cases)

    def __len__(self) -> int:
        return len(self.cases)

    def __getitem__(self, k: int) -> Piece:
        return self.cases[k]

    def __str__(self) -> str:
        return " or\n".join(map(str, self.cases)) or "false"

    def brief(self) -> str:
        """As ``str``, for people: bounds that would fill more than a line or two are described only."""
        return " or\n".join(case.brief() for case in self.cases) or "false"

    def __repr__(self) -> str:
        count = len(self.cases)
        return f"Solutions({', '.join(self.order)}: {count} case{'s' if count != 1 else ''})"

    def _repr_html_(self) -> str:
        lines = "".join(f"<li><code>{escape(case.brief())}</code></li>" for case in self.cases)
        return f"<ul>{lines}</ul>" if lines else "<p>no solutions</p>"
