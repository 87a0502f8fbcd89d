"""The public functions. Formulas may be given as text, as ``Formula``, or as SymPy (``qe.Exists``/``qe.ForAll``)."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from fractions import Fraction
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar

from qe.errors import InputError, InternalError, Unable
from qe.exact.ring import Poly
from qe.formula.build import conj, convert, exists, forall, iff
from qe.formula.counting import without_root_atoms
from qe.formula.features import features
from qe.formula.syntax import Constant, Exists, ForAll, Formula
from qe.formula.traverse import free_variables, is_quantifier_free, polynomials, ring_of
from qe.options import Budget, Method, Options, Stage
from qe.progress import Event, silent
from qe.proof.answer import Answer, Guarantee, Status
from qe.proof.certificate import Certificate, Kind
from qe.proof.elimination import Assignment, Elimination

if TYPE_CHECKING:  # the checker and the optimiser are loaded where they are used
    from qe.certify.verdict import Verdict
    from qe.convex.optimum import Optimum
    from qe.elimination.vs.parametric import ParametricWitness
    from qe.regions.region import Region

Choice = TypeVar("Choice", bound=Enum)
TABLE_VARIABLES = 3
"""In more variables than this, convex regions are not decomposed unless that is asked for."""

MOSTLY_NEEDED = ("qe.engine.run", "qe.rules.block", "qe.elimination.vs.block", "qe.elimination.vs.witness")
"""The parts of the engine that nearly every problem with a quantifier needs."""

Progress = Callable[[Event], None]
AnyFormula = Any
"""A ``Formula``, text, or a SymPy object."""


def read_formula(given: AnyFormula, format: str = "text") -> Formula:
    """The formula given in any of the accepted shapes; ``InputError`` otherwise."""
    if isinstance(given, Formula):
        return given
    if isinstance(given, Answer):
        if given.formula is None:
            raise InputError("an answer without a formula was given")
        return given.formula
    if isinstance(given, str):
        from qe.io import formats

        return formats.read(given, format)
    from qe.io.sympy import from_sympy

    return from_sympy(given)


def _options(
    method: str | Method,
    order: Iterable[str] | None,
    root_atoms: bool,
    without: Iterable[str | Stage],
    progress: Progress,
) -> Options:
    return Options(
        method=_member("method", Method, method),
        order=None if order is None else tuple(order),
        root_atoms=root_atoms,
        without=frozenset(_member("without", Stage, stage) for stage in without),
        progress=progress,
    )


def _member(keyword: str, choices: type[Choice], given: object) -> Choice:
    """The member that is given, by itself or by its value."""
    try:
        return choices(given)
    except ValueError:
        names = ", ".join(str(m.value) for m in choices)
        raise InputError(f"{keyword}: one of {names} expected, {given!r} found") from None


def eliminate(
    formula: AnyFormula,
    *,
    format: str = "text",
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Iterable[str] | None = None,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] = (),
    explain: bool = False,
    check: bool = False,
) -> Answer:
    """Quantifier elimination over the reals: an equivalent quantifier-free formula.

    ``timeout`` in seconds and ``memory`` in MB: with either, the work runs in a forked worker process that is killed at
    the limit, since a single polynomial operation can take long (where processes cannot fork, ``timeout`` is only
    checked between steps). The answer has status UNABLE, with the
    reason, when a limit was reached; it is never partial. With ``check`` the answer comes with a certificate where
    one can be had (if the method makes none, by a decomposition of the whole formula), verified by the separate
    checker; certificates that are a witness always are. ``explain`` tells on
    stderr how the answer was found (``Answer.explanation`` holds the same text); ``without`` leaves stages of the
    engine out (``qe.Stage``), to measure what they gain. Raises ``InputError`` for input that cannot be read.
    """
    given = read_formula(formula, format)
    options = _options(method, order, root_atoms, without, progress).with_(certify=check)
    _check_order(options.order, given)
    answer = _limited(given, options, timeout, memory, check)
    if explain:
        print(answer.explanation or answer.reason, file=sys.stderr)
    return answer


def _check_order(order: tuple[str, ...] | None, formula: Formula) -> None:
    """Raise ``InputError`` for names in an order that are no variables of the formula, or stand twice."""
    known = {*free_variables(formula), *features(formula).bound}
    names = order or ()
    if not known.issuperset(names) or len(set(names)) < len(names):
        raise InputError(f"order: variables of the formula expected, each once, {', '.join(names)} found")


def _limited(formula: Formula, options: Options, timeout: float | None, memory: int | None, check: bool) -> Answer:
    """The answer, found in a worker process where a limit is to hold."""
    if (memory is not None or timeout is not None) and hasattr(os, "fork"):
        from qe.worker import Channel, run

        for part in MOSTLY_NEEDED:  # loaded here once, and not again and again in every worker
            import_module(part)

        def work(channel: Channel) -> Answer:
            return _answer(formula, options.with_(progress=channel.event), timeout, check)

        try:
            return run(work, timeout=timeout, memory=memory, progress=options.progress)
        except Unable as error:
            return Answer(Status.UNABLE, None, reason=str(error))
    return _answer(formula, options, timeout, check)


def _solved(formula: Formula, options: Options, budget: Budget) -> Elimination:
    """The answer of the engine, which is loaded at the first call."""
    from qe.engine.run import solve

    return solve(formula, options, budget)


def _answer(formula: Formula, options: Options, timeout: float | None, check: bool) -> Answer:
    budget = Budget(timeout, listener=options.progress)
    try:
        found = _solved(formula, options, budget)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error), stats={"cells": budget.used_cells})
    certificate = found.evidence if isinstance(found.evidence, Certificate) else None
    guarantee = Guarantee.DERIVED
    if certificate is not None and (check or certificate.kind is Kind.WITNESS):
        verdict = verify(certificate)
        if not verdict.accepted:
            raise InternalError(f"the certificate of an answer was rejected at {verdict.step}: {verdict.reason}")
        guarantee = Guarantee.CHECKED
    return Answer(Status.SOLVED, found.formula, found.witness, certificate, guarantee, stats=found.stats)


def decide(formula: AnyFormula, **keywords: Any) -> bool:
    """The truth of a sentence. Raises ``InputError`` for free variables and ``Unable`` at a limit."""
    given = read_formula(formula, keywords.pop("format", "text"))
    free = free_variables(given)
    if free:
        raise InputError(f"a sentence expected; free: {', '.join(free)}")
    answer = eliminate(given, **keywords)
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    return answer.truth


def find_instance(formula: AnyFormula, **keywords: Any) -> Assignment | None:
    """Exact values of the free variables that satisfy the formula, or None if there are none."""
    given = read_formula(formula, keywords.pop("format", "text"))
    free = free_variables(given)
    if not free:
        return {} if decide(given, **keywords) else None
    answer = eliminate(exists(free, given), **keywords)
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    if answer.truth is False:
        return None
    if answer.witness is None:
        raise Unable("the formula is satisfiable, but no witness was found")
    return {name: answer.witness.get(name, Fraction(0)) for name in free}


def parametric_witnesses(
    formula: AnyFormula, *, format: str = "text", timeout: float | None = None, progress: Progress = silent
) -> tuple[ParametricWitness, ...]:
    """Solutions of the outermost block as terms in the free variables, each under its guard (extended answers).

    The guards together are equivalent to an existential block; for a universal block the terms are counterexamples.
    Raises ``InputError`` for a formula without an outermost block, ``Unable`` where substitution does not apply.
    """
    from qe.elimination.vs.parametric import parametric_witnesses as find

    given = read_formula(formula, format)
    if isinstance(given, Exists | ForAll) and not is_quantifier_free(given.body):
        rebuilt = exists if isinstance(given, Exists) else forall
        inner = _solved(given.body, Options(), Budget(timeout, listener=progress)).formula
        given = rebuilt(given.variables, inner)
    return find(given, budget=Budget(timeout, listener=progress))


def check_witness(sentence: AnyFormula, witness: Mapping[str, AnyFormula], **keywords: Any) -> bool:
    """Whether existential variables can be given by these polynomials in the variables quantified further outside.

    The polynomials (text, ``Poly`` or SymPy) are put in and the stronger sentence is decided: True proves the
    sentence, False says only that this witness does not work everywhere. Raises ``InputError`` for a name that is not
    existentially quantified, or a polynomial in variables that are not known at its place.
    """
    from qe.elimination.witness import Term, instantiate
    from qe.exact.ring import Ring

    given = read_formula(sentence, keywords.pop("format", "text"))
    read = {name: _polynomial(term, f"witness: {name}") for name, term in witness.items()}
    rings = [r for r in (ring_of(given), *(poly.ring for poly, _ in read.values())) if r is not None]
    ring = Ring.of(dict.fromkeys(name for r in rings for name in r.names))
    terms = {name: Term.of(poly.convert(ring), scale) for name, (poly, scale) in read.items()}
    return decide(instantiate(convert(given, ring), terms), **keywords)


def equivalent(left: AnyFormula, right: AnyFormula, **keywords: Any) -> bool:
    """Whether two formulas have the same solutions in all their free variables together."""
    from qe.exact.ring import Ring

    f, g = read_formula(left), read_formula(right)
    rings = [r for r in (ring_of(f), ring_of(g)) if r is not None]
    ring = Ring.of(dict.fromkeys(name for r in rings for name in r.names))
    f, g = convert(f, ring), convert(g, ring)
    free = dict.fromkeys((*free_variables(f), *free_variables(g)))
    return decide(forall(free, iff(f, g)), **keywords)


def region(
    formula: AnyFormula,
    order: Iterable[str] | None = None,
    *,
    format: str = "text",
    timeout: float | None = None,
    progress: Progress = silent,
) -> Region:
    """The solution set of a formula in its free variables (or in ``order``, which may name more).

    Without ``order`` a quantified formula is described in the order in which its answer was found by critical values:
    factors of that projection are part of the answer, and the other order may be much harder.
    A cylindrical description with a certificate; quantifiers are eliminated first. For a conjunction of convex
    quadratic conditions in four or more variables, or with existential quantifiers before it, membership, fibres
    and bounds are found by exact optimisation, and the description only when it is asked for; ``timeout`` (seconds)
    then holds for every question.
    """
    given = without_root_atoms(read_formula(formula, format))
    names = None if order is None else tuple(order)
    quantified = not is_quantifier_free(given)

    def limits() -> Budget:
        return Budget(timeout, listener=progress)

    def eliminated(part: Formula) -> Formula:
        return _solved(part, Options(order=names), limits()).formula

    if quantified or len(free_variables(given)) > TABLE_VARIABLES:
        from qe.regions.convex_region import ConvexRegion, shadow_of

        shadow = shadow_of(given, eliminated)
        if shadow is not None:
            return ConvexRegion(shadow, names, limits=limits)
    from qe.regions.region import Region

    budget = limits()
    if not quantified:
        return Region.of(given, names, budget=budget)
    found = _solved(given, Options(order=names), budget)
    return Region.of(found.formula, names or found.parameter_order, budget=budget)


def minimize(
    objective: AnyFormula,
    constraints: AnyFormula = "true",
    *,
    timeout: float | None = None,
    progress: Progress = silent,
) -> Optimum:
    """The exact minimum of a convex quadratic (or linear) polynomial under convex quadratic or linear constraints.

    ``objective``: text, ``Poly``, or a SymPy expression; ``constraints``: a formula, or a list of formulas to be
    conjoined. Raises ``Unable`` outside that class.
    """
    from qe.convex.optimum import minimize as solve

    poly, scale = _polynomial(objective, "objective")
    return solve(poly, _constraints(constraints), scale=scale, budget=Budget(timeout, listener=progress))


def maximize(
    objective: AnyFormula,
    constraints: AnyFormula = "true",
    *,
    timeout: float | None = None,
    progress: Progress = silent,
) -> Optimum:
    """The exact maximum; see ``minimize``."""
    from qe.convex.optimum import maximize as solve

    poly, scale = _polynomial(objective, "objective")
    return solve(poly, _constraints(constraints), scale=scale, budget=Budget(timeout, listener=progress))


def _constraints(given: AnyFormula) -> Formula:
    if isinstance(given, list | tuple):
        from qe.exact.ring import Ring

        parts = [read_formula(g) for g in given]
        names = dict.fromkeys(n for p in parts if (r := ring_of(p)) is not None for n in r.names)
        ring = Ring.of(names)
        return conj(convert(p, ring) for p in parts)
    return read_formula(given)


def _polynomial(given: AnyFormula, what: str) -> tuple[Poly, Fraction]:
    """The given term as a polynomial p and a rational s: it is s*p. A slack name makes the sign readable."""
    if isinstance(given, Poly):
        return given, Fraction(1)
    slack = "polynomial_value"
    if isinstance(given, str):
        relation = read_formula(f"{slack} = {given}")
    else:
        import sympy

        relation = read_formula(sympy.Eq(sympy.Symbol(slack), given, evaluate=False))
    if isinstance(relation, Constant) or len(polynomials(relation)) != 1:
        raise InputError(f"{what}: a polynomial expected")
    (equation,) = polynomials(relation)
    i = equation.ring.index[slack]
    rest, coefficient = equation.coefficients(i)
    if not coefficient.is_constant or len(equation.coefficients(i)) != 2:
        raise InputError(f"{what}: a polynomial expected")
    return rest, Fraction(-1, coefficient.constant_value())


def verify(certificate: Certificate) -> Verdict:
    """Whether separate code accepts the certificate; see ``qe.certify``."""
    from qe.certify.verify import verify as check

    return check(certificate)


__all__ = [
    "Answer",
    "Certificate",
    "Guarantee",
    "Status",
    "check_witness",
    "decide",
    "eliminate",
    "equivalent",
    "find_instance",
    "maximize",
    "minimize",
    "parametric_witnesses",
    "read_formula",
    "region",
    "verify",
]
