"""All solutions of a formula, case by case: each variable in terms of those before it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from qe.decomposition.pieces import Piece
from qe.formula.build import disj
from qe.formula.syntax import Formula
from qe.io.latex_text import formula_in_latex
from qe.io.substitution import over_one_ring
from qe.proof.answer import UNPROVED, Answer, Guarantee
from qe.proof.certificate import Certificate
from qe.regions.region import Region
from qe.services import SymPyForm
from qe.spelling import quoted

LONGEST_LINE = 400
"""Characters of a case in texts for people."""
LONG, OFTEN = 40, 4
"""From so many characters on, and from so many places in ``root``, a polynomial has a name."""
_IN_ROOT = re.compile(r"root\(-?[0-9]+, ([^()]+), [^()]+\)")


@dataclass(frozen=True, slots=True, repr=False)
class Solutions(SymPyForm):
    """The solutions in the variables ``order``.

    ``lines``: cases as texts, which together are all solutions; ``str`` writes them with ``or`` between them: a formula
    that can be read back; long polynomials that stand there often have a name. Each value is said once, under the
    condition on the parameters under which it is a solution, where there are finitely many values; values are numbers,
    terms in the variables before, with ``sqrt`` where they can be, or ``root(k, polynomial, variable)``.

    ``cases``: the same as disjoint pieces (``Piece``: ``.ranges``, ``.sample``, ``.formula``), over which one iterates:
    for the first variables where they lie, and for each later one, over those, between which values. ``region``: the
    set that they are. ``answer``, with ``qe.solve(..., check=True)``: to the question whether the text says the same as
    the formula (where what was assumed holds); its certificate is with that of the region's table in ``certificate``.
    """

    order: tuple[str, ...]
    cases: tuple[Piece, ...]
    region: Region
    lines: tuple[str, ...]
    answer: Answer | None = None

    @property
    def guarantee(self) -> Guarantee:
        """CHECKED where separate code accepted the proofs of the table and of the text."""
        return Guarantee.DERIVED if self.reason else Guarantee.CHECKED

    @property
    def reason(self) -> str:
        """Why they are not proved; empty where they are."""
        if self.answer is None or self.region.guarantee is not Guarantee.CHECKED:
            return self.region.reason or UNPROVED
        why = self.answer.why_unchecked
        return f"the text is not proved: {why}" if why else ""

    @property
    def certificate(self) -> Certificate:
        """The certificates of the region and, where there is one, of the text."""
        text, of_region = None if self.answer is None else self.answer.certificate, self.region.proof
        if text is None:
            return of_region
        return Certificate.bundle([("cells", of_region), ("text", text)])

    @property
    def formula(self) -> Formula:
        """The disjunction of the ``cases``, as a formula; it may have root atoms."""
        return disj(over_one_ring(*(case.formula for case in self.cases)))

    def __iter__(self) -> Iterator[Piece]:
        return iter(self.cases)

    def __len__(self) -> int:
        return len(self.cases)

    def __getitem__(self, k: int) -> Piece:
        return self.cases[k]

    def __str__(self) -> str:
        return _with_names(" or\n".join(self.lines)) or "false"

    def to_latex(self) -> str:
        """The cases, one a line, for math mode."""
        lines = " \\lor \\\\\n".join(map(formula_in_latex, self.lines)) or r"\bot"
        return f"\\begin{{array}}{{l}}\n{lines}\n\\end{{array}}"

    def brief(self) -> str:
        """As ``str``, for people: bounds that would fill more than a line or two are described only."""
        return " or\n".join(self._brief) or "false"

    @property
    def _brief(self) -> list[str]:
        is_short = all(len(line) <= LONGEST_LINE for line in self.lines)
        return list(self.lines) if is_short else [case.brief() for case in self.cases]

    def __repr__(self) -> str:
        count = len(self.cases)
        return f"Solutions({', '.join(map(quoted, self.order))}: {count} case{'s' if count != 1 else ''})"

    def _repr_html_(self) -> str:
        lines = "".join(f"<li><code>{escape(line)}</code></li>" for line in self._brief)
        return f"<ul>{lines}</ul>" if lines else "<p>no solutions</p>"


def _with_names(text: str) -> str:
    """The text with a capital for every long polynomial that stands often in ``root``, which it ends with."""
    often = Counter(poly for poly in _IN_ROOT.findall(text) if len(poly) >= LONG)
    free = [name for name in "DPQRSTUVW" if not re.search(rf"(?<!\w){name}(?!\w)", text)]
    named = dict(zip([poly for poly, count in often.items() if count >= OFTEN], free, strict=False))
    for poly, name in named.items():
        text = re.sub(rf"(?<![\w*^/+-])(?<![*^/+-] ){re.escape(poly)}(?= [<>=/]|[,)])", name, text)
    said = ", ".join(f"{name} = {poly}" for poly, name in named.items())
    return f"{text}\nwhere {said}" if said else text
