"""Parts of an answer that make no difference on any cell of a decomposition of its space."""

from __future__ import annotations

from qe.decomposition.sign_table import Columns, free_cells
from qe.elimination.cad import decomposed
from qe.elimination.protocol import Context
from qe.engine.redundant import by_size, dropped
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, Formula
from qe.proof.cells import CellTable
from qe.proof.on_demand import OnDemand, Repeated
from qe.proof.run_log import RunLog
from qe.proof.step import Nested


def without_parts_on_cells(formula: Formula, table: CellTable, context: Context) -> tuple[Formula, bool]:
    """The formula without parts that matter on no cell of a decomposition of its space, as far as the signs of its
    polynomials are known there; and whether they are known well enough to show that all others matter."""
    cells = Cells(table)
    while True:
        context.budget.check("shorten")
        try:
            parts = by_size(formula, cells)
        except KeyError:  # a polynomial came up that is no product of the table's factors
            return formula, False
        part = next((part for part in parts if not part.may), None)
        if part is None:
            return formula, not parts
        log = RunLog()
        if context.options.certify:
            decomposed(part.sentence, context.options, context.budget, log)
        else:
            again = OnDemand(Repeated(decomposed, part.sentence, context.options))
            log.step("cells", part.sentence, FALSE, evidence={"proof": again})
        formula = dropped(formula, part, Nested(part.sentence, tuple(log.steps()), FALSE), context)


class Cells:
    """Formulas on the cells of the free variables, by the signs that are known there."""

    def __init__(self, table: CellTable) -> None:
        self.ring, self.known = Ring.of(table.order), dict[Formula, tuple[int, int]]()
        self.columns = Columns(free_cells(table), table.factors[: table.free])

    def where(self, formula: Formula) -> tuple[int, int]:
        """The cells where the formula holds, and where it fails. Raises ``KeyError`` where a factor is unknown."""
        found = self.known.get(formula)
        if found is None:
            found = self.known[formula] = self.columns.where(convert(formula, self.ring))
        return found
