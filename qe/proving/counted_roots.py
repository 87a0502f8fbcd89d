"""Comparisons with the k-th root of a polynomial, as numbers of roots, in steps of the kernel."""

from __future__ import annotations

from qe.elimination.cad import certificate_for
from qe.formula.counting import counted_roots
from qe.formula.syntax import Formula, RootAtom
from qe.formula.traverse import atoms
from qe.kernel.step import only
from qe.options import Options
from qe.proof.certificate import written
from qe.proving.made import Made


def roots_counted(made: Made, after: Formula) -> None:
    """One comparison after the other: a table of the numbers of roots has it as its answer."""
    only(made.claim)
    before = made.current
    names = [name for name in made.ring.names if name in after.bound - before.bound - {*before.free}]
    for root in dict.fromkeys(a for a in atoms(before) if isinstance(a, RootAtom)):
        try:
            counted = counted_roots(root, names)
        except IndexError:
            raise made.claim.fail("not enough names for the roots that are counted") from None
        order = (*(v for v in root.free if v != root.variable), root.variable)  # its roots are those of one line
        table = certificate_for(counted, root, Options(order=order), made.limits.budget)
        if table is None:
            raise made.claim.fail("no decomposition shows what a comparison with a root means")
        step = written("cells", (), counted, root, (), table.single_step["evidence"])
        while root in {*atoms(made.current)}:
            made.step("converse", root, counted, {"steps": [step]})
