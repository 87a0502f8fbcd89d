"""The public functions that optimise: ``minimize`` and ``maximize``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar, Unpack, overload

from qe import arguments
from qe.api.input import (
    AnyFormula,
    names_typed,
    note_doubts,
    of_one_problem,
    read_objective,
    read_posed_constraints,
    warned,
)
from qe.api.limits import limits_of, performed, read_under, under
from qe.api.settings import Optimisation, with_settings
from qe.convex import optimum as convex
from qe.convex.optimum import NotConvex, Optimum
from qe.errors import InputError
from qe.formula.build import conj
from qe.formula.doubts import numbers_as_names, products_as_names
from qe.formula.numbers import bounds_of_numbers
from qe.formula.syntax import Formula
from qe.io.parser import FUNCTIONS
from qe.io.substitution import over_one_ring
from qe.io.text import optimum_asked
from qe.optimization.values import Goal, Objective
from qe.options import Budget
from qe.proof.answer import Guarantee
from qe.services import SymPyForm
from qe.spelling import NUMBERS

if TYPE_CHECKING:
    from qe.optimization.global_optimum import GlobalOptimum
    from qe.optimization.parametric_optimum import ParametricOptimum

Names = str | Iterable[Any]
Way = Literal["auto", "convex", "elimination"]
Kind = TypeVar("Kind")
AnyOptimum: TypeAlias = "Optimum | GlobalOptimum | ParametricOptimum"


@overload
def minimize(
    objective: AnyFormula, constraints: AnyFormula = ..., *, method: Literal["convex"], **settings: Unpack[Optimisation]
) -> Optimum: ...
@overload
def minimize(
    objective: AnyFormula,
    constraints: AnyFormula = ...,
    *,
    parameters: Names,
    method: Way = ...,
    **settings: Unpack[Optimisation],
) -> ParametricOptimum: ...
@overload
def minimize(
    objective: AnyFormula, constraints: AnyFormula = ..., *, method: Way = ..., **settings: Unpack[Optimisation]
) -> Optimum | GlobalOptimum: ...
@with_settings(Optimisation)
def minimize(
    objective: AnyFormula,
    constraints: AnyFormula = "true",
    *,
    parameters: Names | None = None,
    method: Way = "auto",
    **settings: Unpack[Optimisation],
) -> AnyOptimum:
    """The exact global minimum of a term where it has a value and the constraints hold.

    ``objective``: text, ``Poly``, a pair of p and a rational s for s p, or a SymPy expression; a polynomial, or made
    with quotients, roots, ``abs``, ``min`` and ``max``; or Mathematica's ``Minimize[{f, c}, {x, y}]``. ``constraints``:
    a formula, or a list of them that hold together. Convex quadratic (or linear) problems get an ``Optimum`` with
    multipliers; all others a ``GlobalOptimum`` with all minimisers, by elimination (``method``: "convex" or
    "elimination" takes that way only). ``parameters``: variables that are not optimised over; the answer is a
    ``ParametricOptimum``: value and points as functions of them (``pi`` is always one). That there is no optimum is an
    answer too: ``status`` says ``UNBOUNDED`` or ``INFEASIBLE``, and ``value`` is None. With ``check`` its certificate
    is verified: ``guarantee`` is ``CHECKED``, or ``reason`` says why not; an elimination comes with its derivation
    (``answer``). Raises ``InputError`` for what cannot be read, ``Unable`` where no proof was found and
    ``BudgetExceeded`` at a limit.
    """
    return _best(1, objective, constraints, parameters, method, settings)


def _typed_as(model: Kind) -> Callable[[Any], Kind]:
    """For type checkers: a function is called as another one."""
    return lambda function: function


@_typed_as(minimize)
@with_settings(Optimisation)
def maximize(
    objective: AnyFormula,
    constraints: AnyFormula = "true",
    *,
    parameters: Names | None = None,
    method: Way = "auto",
    **settings: Unpack[Optimisation],
) -> AnyOptimum:
    """The exact global maximum; see ``minimize``."""
    return _best(-1, objective, constraints, parameters, method, settings)


@dataclass(frozen=True, slots=True)
class Extremes(SymPyForm):
    """The ``least`` and the ``greatest`` value, each as ``minimize`` and ``maximize`` give it."""

    least: AnyOptimum
    greatest: AnyOptimum

    def __iter__(self) -> Iterator[AnyOptimum]:
        return iter((self.least, self.greatest))

    def __str__(self) -> str:
        return f"least: {self.least}\ngreatest: {self.greatest}"


@with_settings(Optimisation)
def optimum(
    objective: AnyFormula,
    constraints: AnyFormula = "true",
    *,
    parameters: Names | None = None,
    method: Way = "auto",
    **settings: Unpack[Optimisation],
) -> Extremes:
    """The exact least and greatest value of a term; see ``minimize``."""
    low, high = (_best(sign, objective, constraints, parameters, method, settings) for sign in (1, -1))
    return Extremes(low, high)


def _best(
    sign: int,
    objective: AnyFormula,
    constraints: AnyFormula,
    parameters: Names | None,
    method: Way,
    settings: Optimisation,
) -> AnyOptimum:
    """The optimum of a convex problem by its method, of any other by elimination."""
    limits = limits_of(settings)
    variables: tuple[str, ...] = ()
    if isinstance(objective, str) and (command := optimum_asked(objective)) is not None:
        goal, objective, more, variables = command
        if goal == -sign:
            raise InputError(f"objective: a {'least' if sign > 0 else 'greatest'} value is asked for here, not there")
        constraints = [constraints, more]
        others = names_typed([objective, more]).difference(variables, FUNCTIONS) if variables else ()
        parameters = sorted(others) or parameters
    given, assuming = arguments.names(parameters, "parameters"), settings["assuming"]
    named = {*(given or ()), *variables}
    objective, constraints, assuming = of_one_problem(objective, constraints, assuming, listed=named)
    read = read_under(limits, partial(read_posed_constraints, constraints, objective), constraints)
    stated = under(*read, assuming, limits, others=names_typed([objective]), numbers=True)
    conditions = stated.restricted
    strangers = sorted({*(given or ())} - names_typed([objective, constraints, conditions]))
    if strangers:
        raise InputError(f"parameters: variables of the problem expected, each once, {', '.join(strangers)} found")
    ring = conditions.ring
    taken = (*(ring.names if ring is not None else ()), *(given or ()))
    term = read_under(limits, partial(read_objective, objective, taken), objective)
    note_doubts(constraints, conditions)
    if numbers := [name for name in NUMBERS if name in {*term.names, *conditions.free}]:
        conditions = conj(over_one_ring(conditions, bounds_of_numbers(term.graph, conditions)))
        given = (*numbers, *(given or ()))
    if isinstance(objective, str):
        alone = [name for name in term.names if name not in conditions.free]
        names = (*term.names, *conditions.free)
        warned([*products_as_names(names, conditions.free), *numbers_as_names(alone, objective, (*names, *taken))])
    if not isinstance(method, str) or method not in ("auto", "convex", "elimination"):
        raise arguments.wrong("method", "auto, convex or elimination", method)
    if given is not None and method == "convex":
        raise InputError("parameters: method auto or elimination expected with parameters, convex found")
    work = partial(_optimum, sign, term, conditions, given, method, settings["check"])
    return performed(work, conditions, limits)


def _optimum(
    sign: int,
    term: Objective,
    conditions: Formula,
    parameters: tuple[str, ...] | None,
    method: Way,
    check: bool,
    budget: Budget,
) -> AnyOptimum:
    solved: AnyOptimum | None = None
    if parameters is not None:
        from qe.optimization.parametric_optimum import optimum_of

        solved = optimum_of(sign, Goal.of(term, conditions, parameters), budget=budget, check=check)
    elif method != "elimination":
        solved = _convex(sign, term, conditions, method == "convex", budget)
    if solved is None:
        from qe.optimization.global_optimum import best

        solved = best(sign, Goal.of(term, conditions), budget=budget, check=check)
    return _with_guarantee(solved, budget) if check else solved


def _convex(sign: int, term: Objective, conditions: Formula, only: bool, budget: Budget) -> Optimum | None:
    """The optimum of a convex problem; None for any other, unless it is to be solved as one ``only``."""
    try:
        if term.polynomial is None:
            raise NotConvex("the objective is no polynomial")
        poly, scale = term.polynomial
        solved = convex.minimize if sign > 0 else convex.maximize
        return solved(poly, conditions, scale=scale, budget=budget, near=True)
    except NotConvex:
        if only:
            raise
        return None


def _with_guarantee(optimum: AnyOptimum, budget: Budget) -> AnyOptimum:
    """The optimum with what the checker says of its certificate."""
    from qe.api.verify import judged
    from qe.optimization.global_optimum import POINT, GlobalOptimum

    guarantee, reason = judged(optimum.certificate, budget)
    if isinstance(optimum, Optimum):
        return replace(optimum, guarantee=guarantee, reason=reason)
    if optimum.certificate is None:
        reason = optimum.answer.why_unchecked
    elif isinstance(optimum, GlobalOptimum) and POINT in optimum.unchecked_steps:
        guarantee, reason = Guarantee.DERIVED, reason or "the point under the quantifiers is not proved"
    return replace(optimum, guarantee=guarantee, reason=reason)
