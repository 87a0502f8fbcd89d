"""The public functions about parametric polynomial systems."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import replace
from enum import Enum
from functools import partial
from typing import Any, Unpack

from qe import arguments
from qe.api.input import names_typed, read_polynomial
from qe.api.limits import limits_of, read_under, under
from qe.api.settings import Optimisation, Parametric, with_settings
from qe.decomposition.interval import Coordinate, number_of
from qe.engine.assuming import can_hold, simplified
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.block_order import BlockOrder
from qe.exact.groebner import MonomialOrder
from qe.exact.ring import Poly, Ring, format_poly
from qe.formula.build import conj, convert
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.groebner.counting import RealRootClassification, classified
from qe.groebner.question import ParametricSystem
from qe.groebner.system import ComprehensiveGroebnerSystem
from qe.io.substitution import over_one_ring
from qe.options import Budget, Options
from qe.processes.execution import perform

Names = Any
"""``"y, x"``, ``"y x"``, or a list of names or SymPy symbols."""


class Order(Enum):
    """Orders of the monomials in the variables, of which the first listed is the largest."""

    GREVLEX = "grevlex"
    GRLEX = "grlex"
    LEX = "lex"


_ORDERS = dict(zip(Order, (MonomialOrder.DEGREVLEX, MonomialOrder.DEGLEX, MonomialOrder.LEX), strict=True))


@with_settings(Parametric)
def comprehensive_groebner(
    polys: Sequence[Any],
    variables: Names,
    parameters: Names = None,
    order: str | Order = Order.GREVLEX,
    *,
    constants: Mapping[str, Any] | None = None,
    equal: Sequence[Any] = (),
    nonzero: Sequence[Any] = (),
    faithful: bool = False,
    **settings: Unpack[Parametric],
) -> ComprehensiveGroebnerSystem:
    """A comprehensive Gröbner system: parameter space in disjoint segments, each with one basis for all its points.

    Algorithm of Kapur, Sun and Wang (ISSAC 2010; JSC 49, 2013). ``polys``: a list of polynomials over Q (text,
    ``Poly``, SymPy). ``variables``: largest first; ``parameters``: by default all other names, sorted. ``order``: of
    the monomials, ``"grevlex"``, ``"grlex"`` or ``"lex"``. ``constants``: names that stand for real algebraic numbers
    (``RealAlgebraic``, SymPy numbers). ``equal`` and ``nonzero``: polynomials in the parameters; segments are made only
    where the former vanish and none of the latter does; ``assuming`` says the same, and leaves out segments where it
    cannot hold. ``faithful``: every segment also has elements of the given ideal itself with the same values as its
    basis. Raises ``InputError`` for what is no polynomial over Q, ``Unable`` where bases grow too large and
    ``BudgetExceeded`` at a limit.
    """
    limits = limits_of(settings)
    chosen = _ORDERS[arguments.member(order, Order, "order")]
    wanted = arguments.flag(faithful, "faithful")
    inner, _ = _assumed(variables, polys, equal, nonzero)  # an ideal knows no signs of its variables
    known = under(TRUE, inner, settings["assuming"], limits, others=names_typed(polys)).known
    given = polys, variables, parameters, chosen, constants, equal, nonzero
    system, _ = read_under(limits, partial(read_system, *given, known=known), polys, equal, nonzero)
    work = partial(_solved, system, convert(known, system.ring), wanted)
    return perform(work, limits, at_once=limits.timeout is not None)


@with_settings(Optimisation)
def real_root_classification(
    polys: Sequence[Any],
    variables: Names,
    parameters: Names = None,
    *,
    positive: Sequence[Any] = (),
    constants: Mapping[str, Any] | None = None,
    equal: Sequence[Any] = (),
    nonzero: Sequence[Any] = (),
    **settings: Unpack[Optimisation],
) -> RealRootClassification:
    """The partition of parameter space by the number of distinct real solutions of polys = 0, as formulas.

    ``positive``: only solutions at which all of these polynomials are positive count. Signatures of Hermite's trace
    forms over the segments of a comprehensive Gröbner system (Weispfenning 1998; Fukasaku, Iwane, Sato 2015); where
    the system has infinitely many complex solutions the count is None. With ``check`` the partition as a whole comes
    with a certificate that the checker has accepted, or ``Unable`` is raised. Other arguments and errors as for
    ``comprehensive_groebner``.
    """
    limits = limits_of(settings)
    inner, signs = _assumed(variables, polys, equal, nonzero, positive)
    known = under(TRUE, inner, settings["assuming"], limits, others=names_typed(polys)).known
    positive = (*positive, *signs) if signs else positive
    given = polys, variables, parameters, MonomialOrder.DEGREVLEX, constants, equal, nonzero, positive
    system, above = read_under(limits, partial(read_system, *given, known=known), polys, equal, nonzero, positive)
    work = partial(_classified, system, above, convert(known, system.ring), settings["check"])
    return perform(work, limits, at_once=limits.timeout is not None)


def _assumed(variables: Names, *given: Sequence[Any]) -> tuple[Formula, list[Poly]]:
    """What SymPy's symbols are assumed to be: of parameters, and polynomials that are positive where variables are so.

    Raises ``InputError`` where a variable is assumed to be no more than nonnegative or nonpositive."""
    symbolic = [part for listed in given if isinstance(listed, list | tuple) for part in listed]
    symbolic = [part for part in symbolic if hasattr(part, "free_symbols")]
    if not symbolic:
        return TRUE, []
    from qe.io.sympy import assumed_of

    own, inner, signs = arguments.names(variables, "variables") or (), list[Formula](), list[Poly]()
    for condition in dict.fromkeys(one for part in symbolic for one in assumed_of(part)):
        if condition.free[0] not in own:
            inner.append(condition)
        elif isinstance(condition, Atom) and condition.relation in (Relation.GT, Relation.LT, Relation.NE):
            poly, sides = condition.poly, {Relation.GT: 1, Relation.LT: -1}
            signs.append(sides.get(condition.relation, condition.poly) * poly)
        else:
            raise InputError(f"polys: {condition.free[0]} is assumed to satisfy {condition}, expected > or < or /=")
    return conj(over_one_ring(*inner)) if inner else TRUE, signs


def _solved(system: ParametricSystem, known: Formula, faithful: bool, budget: Budget) -> ComprehensiveGroebnerSystem:
    """The system, without segments where the assumptions cannot hold."""
    solved = system.solved(budget, faithful=faithful)
    if known == TRUE:
        return solved
    kept = [s for s in solved if can_hold(conj((known, solved.condition(s))), Options(), budget)]
    return replace(solved, segments=tuple(kept))


def _classified(
    system: ParametricSystem, positive: tuple[Poly, ...], known: Formula, check: bool, budget: Budget
) -> RealRootClassification:
    """The classification, with conditions as short as the assumptions allow; its certificate is of those without."""
    classification = classified(system, positive, budget)
    if check:
        from qe.api.classified import certified

        classification = certified(system, classification, budget)
    if known == TRUE:
        return classification
    shorter = [
        replace(one, condition=simplified(one.condition, known, Options(), budget).outcome.formula)
        for one in classification
    ]
    return replace(classification, classes=tuple(one for one in shorter if one.condition != FALSE))


def read_system(
    polys: Sequence[Any],
    variables: Names,
    parameters: Names,
    order: MonomialOrder,
    constants: Mapping[str, Any] | None,
    equal: Sequence[Any] = (),
    nonzero: Sequence[Any] = (),
    positive: Sequence[Any] = (),
    *,
    known: Formula = TRUE,
) -> tuple[ParametricSystem, tuple[Poly, ...]]:
    """The arguments of a question about a parametric system, checked, and ``positive``. Raises ``InputError``.

    ``known``: what is assumed of the parameters; its equations and strict relations join ``equal`` and ``nonzero``."""
    offered = arguments.by_name({} if constants is None else constants, "constants")
    fixed = {name: algebraic(value, f"constants: {name}") for name, value in offered.items()}
    largest = arguments.names(variables, "variables") or ()
    named = arguments.names(parameters, "parameters")
    names = {*largest, *(named or ()), *fixed}
    if strange := {*known.free} & {*largest} if named is None else {*known.free} - {*named, *fixed}:
        raise InputError(f"assuming: conditions on the parameters expected, {min(strange)} found")
    offers = {"polys": polys, "equal": equal, "nonzero": nonzero, "positive": positive}
    lists = [_polynomials(given, what, names) for what, given in offers.items()]
    for part in conjuncts(known):
        if isinstance(part, Atom) and part.relation not in (Relation.LE, Relation.GE):
            lists[1 if part.relation is Relation.EQ else 2].append(part.poly)
    if not lists[0]:
        raise InputError("polys: at least one polynomial expected, none found")
    occurring = {
        what: {p.ring.names[i] for p in group for i in p.variables} for what, group in zip(offers, lists, strict=True)
    }
    others = tuple(sorted(set(known.free).union(*occurring.values()) - {*largest, *fixed})) if named is None else named
    _check_names(largest, others, fixed, occurring)
    ring = Ring.of((*fixed, *reversed(others), *reversed(largest)))
    block = BlockOrder(
        tuple(ring.index[n] for n in largest), tuple(ring.index[n] for n in (*others, *reversed([*fixed]))), order
    )
    read = [tuple(p.convert(ring) for p in group) for group in lists]
    for what, group in (("equal", read[1]), ("nonzero", read[2])):
        for p in group:
            if not block.is_free(p):
                raise InputError(f"{what}: polynomials in the parameters expected, {format_poly(p)} found")
    return ParametricSystem(ring, block, read[0], fixed, read[1], read[2]), read[3]


def _check_names(
    variables: tuple[str, ...],
    parameters: tuple[str, ...],
    constants: Mapping[str, RealAlgebraic],
    occurring: Mapping[str, set[str]],
) -> None:
    if not variables:
        raise InputError("variables: the name of at least one variable expected, none found")
    everything = (*variables, *parameters, *constants)
    twice = [name for k, name in enumerate(everything) if name in everything[:k]]
    if twice:
        raise InputError(
            f"parameters: every name once, as variable, parameter or constant, expected, {twice[0]} found twice"
        )
    for what, names in occurring.items():
        if unknown := sorted(names.difference(everything)):
            raise InputError(f"{what}: variables and parameters as listed expected, {unknown[0]} found")


def _polynomials(given: object, what: str, known: Container[str]) -> list[Poly]:
    if isinstance(given, str | Mapping | set | frozenset) or not hasattr(given, "__iter__"):
        raise arguments.wrong(what, "a list of polynomials", given)
    return [
        read_polynomial(p, f"{what}: entry {k}", known=known)[0]
        for k, p in enumerate(arguments.by_place(given, what), 1)
    ]


def algebraic(value: Coordinate, what: str) -> RealAlgebraic:
    """A real algebraic number: ``RealAlgebraic``, an element of a number field, a SymPy or a rational number."""
    number = number_of(value, what, "a real algebraic number")
    return number if isinstance(number, RealAlgebraic) else RealAlgebraic.rational(number)
