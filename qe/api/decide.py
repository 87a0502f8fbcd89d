"""The public functions that decide: sentences, instances, witnesses, equivalence. All of them ask ``eliminate``."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from qe import arguments
from qe.api.eliminate import Order, Progress, eliminate
from qe.api.input import AnyFormula, order_of, read_polynomial, together
from qe.api.limits import left_of, limits_of, read_under, reading
from qe.errors import InputError, Unable
from qe.exact.number import Assignment, ExactPoint
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert, exists, forall, iff
from qe.formula.counting import without_root_atoms
from qe.formula.features import features
from qe.formula.traverse import bound_variables, ring_of
from qe.options import Method, Stage
from qe.progress import silent
from qe.spelling import glued


def decide(
    formula: AnyFormula,
    *,
    format: str = "text",
    total_division: bool = False,
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Order = None,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] | str | Stage = (),
    explain: bool = False,
    check: bool = False,
    process: bool = True,
    workers: int = 0,
    cluster: str | None = None,
    race: Iterable[str | Method] | str | Method = (),
) -> bool:
    """The truth of a sentence; the keywords are those of ``eliminate``.

    Raises ``InputError`` for free variables and ``Unable`` at a limit.
    """
    limits = limits_of(timeout, memory, progress, process).begun(time.monotonic())
    given = reading(formula, format, limits, total_division)
    free = given.free
    if free:
        raise InputError(f"a sentence expected; free: {', '.join(free)}{glued(free, bound_variables(given))}")
    answer = eliminate(
        given,
        timeout=left_of(limits),
        memory=memory,
        method=method,
        order=order_of(order, formula, given),
        progress=progress,
        root_atoms=root_atoms,
        without=without,
        explain=explain,
        check=check,
        process=process,
        workers=workers,
        cluster=cluster,
        race=race,
    )
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    return answer.truth


def find_instance(
    formula: AnyFormula,
    *,
    format: str = "text",
    total_division: bool = False,
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Order = None,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] | str | Stage = (),
    explain: bool = False,
    check: bool = False,
    process: bool = True,
    workers: int = 0,
    cluster: str | None = None,
    race: Iterable[str | Method] | str | Method = (),
) -> Assignment | None:
    """Exact values of the free variables that satisfy the formula, or None if there are none.

    The keywords are those of ``eliminate``. Raises ``Unable`` at a limit.
    """
    limits = limits_of(timeout, memory, progress, process).begun(time.monotonic())
    given = reading(formula, format, limits, total_division)
    free = given.free
    answer = eliminate(
        exists(free, given),
        timeout=left_of(limits),
        memory=memory,
        method=method,
        order=order_of(order, formula, given),
        progress=progress,
        root_atoms=root_atoms,
        without=without,
        explain=explain,
        check=check,
        process=process,
        workers=workers,
        cluster=cluster,
        race=race,
    )
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    if answer.truth is False:
        return None
    if answer.witness is None and free:
        raise Unable("the formula is satisfiable, but no witness was found")
    return ExactPoint({name: (answer.witness or {}).get(name, Fraction(0)) for name in free})


def check_witness(
    sentence: AnyFormula,
    witness: Mapping[Any, AnyFormula],
    *,
    format: str = "text",
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Order = None,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] | str | Stage = (),
    explain: bool = False,
    check: bool = False,
    process: bool = True,
    workers: int = 0,
    cluster: str | None = None,
    race: Iterable[str | Method] | str | Method = (),
) -> bool:
    """Whether existential variables can be given by these polynomials in the variables quantified further outside.

    The polynomials (text, ``Poly`` or SymPy) are put in and the stronger sentence is decided: True proves the
    sentence, False says only that this witness does not work everywhere. Raises ``InputError`` for a name that is not
    existentially quantified, or a polynomial in variables that are not known at its place.
    """
    from qe.elimination.witness import Term, instantiate

    limits = limits_of(timeout, memory, progress, process).begun(time.monotonic())
    given = without_root_atoms(reading(sentence, format, limits))
    offered, known = arguments.by_name(witness, "witness"), features(given).bound

    def polynomials() -> dict[str, tuple[Poly, Fraction]]:
        return {name: read_polynomial(term, f"witness: {name}", known=known) for name, term in offered.items()}

    read = read_under(limits, polynomials, offered)
    rings = [r for r in (ring_of(given), *(poly.ring for poly, _ in read.values())) if r is not None]
    ring = Ring.of(dict.fromkeys(name for r in rings for name in r.names))
    terms = {name: Term.of(poly.convert(ring), scale) for name, (poly, scale) in read.items()}
    asked = instantiate(convert(given, ring), terms)
    return decide(
        asked,
        timeout=left_of(limits),
        memory=memory,
        method=method,
        order=order_of(order, sentence, asked),
        progress=progress,
        root_atoms=root_atoms,
        without=without,
        explain=explain,
        check=check,
        process=process,
        workers=workers,
        cluster=cluster,
        race=race,
    )


def equivalent(
    left: AnyFormula,
    right: AnyFormula,
    *,
    format: str = "text",
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Order = None,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] | str | Stage = (),
    explain: bool = False,
    check: bool = False,
    process: bool = True,
    workers: int = 0,
    cluster: str | None = None,
    race: Iterable[str | Method] | str | Method = (),
) -> bool:
    """Whether two formulas have the same solutions in all their free variables together.

    The keywords are those of ``eliminate``. Raises ``Unable`` at a limit.
    """
    limits = limits_of(timeout, memory, progress, process).begun(time.monotonic())
    f, g = together(reading(left, format, limits), reading(right, format, limits))
    free = dict.fromkeys((*f.free, *g.free))
    asked = forall(free, iff(f, g))
    return decide(
        asked,
        timeout=left_of(limits),
        memory=memory,
        method=method,
        order=order_of(order, [left, right], asked),
        progress=progress,
        root_atoms=root_atoms,
        without=without,
        explain=explain,
        check=check,
        process=process,
        workers=workers,
        cluster=cluster,
        race=race,
    )
