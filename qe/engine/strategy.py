"""The strategy as data: which method may try what, in which order, on which condition, with how much work.

An attempt is limited by work (cells built, test points substituted, terms projected), never by seconds, so that the
form of an answer does not depend on how fast the machine is. A limit on time ends the whole search only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from importlib import import_module

from qe.elimination.protocol import Method as EliminationMethod
from qe.elimination.protocol import Outcome, Problem
from qe.engine import conditions as on
from qe.errors import Unable
from qe.formula.traverse import atoms
from qe.options import Method, Options, Stage
from qe.rules.step import EQUATION_STEPS, SYMMETRY_STEPS, StepKind

METHODS = {
    "vs": ("qe.elimination.vs.method", "VirtualSubstitution"),
    "vs, cubic": ("qe.elimination.vs.method", "CubicSubstitution"),
    "cad": ("qe.elimination.cad", "Decomposition"),
    "critical": ("qe.elimination.critical.method", "CriticalValues"),
    "critical, convex universal": ("qe.elimination.critical.method", "ConvexUniversal"),
    "convex": ("qe.elimination.convex", "ConvexOptimisation"),
    "witness": ("qe.elimination.witness", "PolynomialWitnesses"),
    "samples": ("qe.elimination.samples", "SampledPoints"),
    "search": ("qe.elimination.search.method", "BooleanSearch"),
    "cgs": ("qe.elimination.cgs", "ComprehensiveGroebner"),
    "coverings": ("qe.elimination.coverings", "Coverings"),
    "infinity first": ("qe.elimination.vs.infinity_first", "InfinityFirst"),
    "roots by signs": ("qe.elimination.rootsigns.method", "RootsBySigns"),
    "linear form named": ("qe.elimination.named_form", "NamedForm"),
}
"""Where each method stands; it is loaded when it is first tried."""

LEFT_OUT_BY = {
    "vs": Stage.SUBSTITUTION,
    "vs, cubic": Stage.CUBIC,
    "critical": Stage.CRITICAL,
    "critical, convex universal": Stage.CRITICAL,
    "convex": Stage.CONVEX,
    "witness": Stage.WITNESS,
    "samples": Stage.SAMPLES,
    "search": Stage.SEARCH,
    "cgs": Stage.CGS,
    "infinity first": Stage.INFINITY,
    "roots by signs": Stage.ROOTS,
    "linear form named": Stage.NAMING,
}
"""The stage without which a method is not tried. Decomposition takes what all others leave, and nobody but the caller
asks for coverings."""

SWITCHED = {
    Stage.EQUATIONS: EQUATION_STEPS,
    Stage.SYMMETRY: SYMMETRY_STEPS,
    Stage.GATHERING: {StepKind.GATHERING},
    Stage.DISTRIBUTION: {StepKind.DISTRIBUTION},
    Stage.VALUES: {StepKind.TAKES_VALUE, StepKind.SQUARE_ALONE},
    Stage.ZEROS: {StepKind.ZEROS},
    Stage.RANGES: {StepKind.RANGES},
    Stage.BALLS: {StepKind.BALLS, StepKind.SPHERE},
    Stage.STABILITY: {StepKind.HALF_PLANE},
    Stage.QUADRICS: {StepKind.QUADRICS},
    Stage.CUBIC: {StepKind.CUBIC_INTERVAL},
    Stage.FORMS: {StepKind.CLOSED_FORM},
    Stage.SQUARES: {StepKind.SQUARES},
    Stage.EXCHANGE: {StepKind.EXCHANGE},
    Stage.MINISCOPING: {StepKind.MINISCOPE},
    Stage.SHIFT: {StepKind.DEGREE_SHIFT},
    Stage.GENERIC: {StepKind.GENERIC, StepKind.BOUNDARY},
    Stage.CANCELLING: {StepKind.CANCELLING},
    Stage.SPLITTING: {StepKind.FACTOR_SPLIT},
}
"""The steps of preparation that a stage left out switches off."""

SPOKEN = {
    "auto": "no method",
    "vs": "virtual substitution alone",
    "cad": "decomposition alone",
    "critical": "elimination by critical values alone",
    "convex": "convex optimisation alone",
    "witness": "the search for witnesses alone",
    "cgs": "elimination by comprehensive Gröbner systems alone",
    "coverings": "coverings alone",
    "roots": "the signs of Hermite's forms alone",
    "infinity first": "looking at infinity alone",
}
"""What a method is called where it does not suffice, if not by its name."""


class Scope(Enum):
    """What a method is shown: the question as it was asked; the prepared question, one block with conditions outside;
    one block over a quantifier-free body; such a block inside another; a block with blocks inside.
    """

    ASKED = "as asked"
    PREPARED = "prepared"
    BLOCK = "block"
    INNER = "inner block"
    NESTED = "nested"


def any_outcome(outcome: Outcome, problem: Problem) -> bool:
    """Whatever the method found."""
    return True


def complete(outcome: Outcome, problem: Problem) -> bool:
    """Nothing is left quantified."""
    return outcome.formula.is_quantifier_free


def complete_if_closed(outcome: Outcome, problem: Problem) -> bool:
    """A sentence is decided, for its witness; with parameters something may be left."""
    return bool(problem.free) or complete(outcome, problem)


def complete_and_small(outcome: Outcome, problem: Problem) -> bool:
    """A complete answer of at most ``SMALL_ATOMS`` atoms."""
    return complete(outcome, problem) and sum(1 for _ in atoms(outcome.formula)) <= SMALL_ATOMS


def complete_and_small_or_alone(outcome: Outcome, problem: Problem) -> bool:
    """The same, or any complete answer in ``ALONE_FROM`` variables or more."""
    many = len(problem.variables) + len(problem.free) >= ALONE_FROM
    return complete(outcome, problem) if many else complete_and_small(outcome, problem)


ALONE_FROM = 6
"""In so many variables decomposition does not end where roots of cubics give a long answer (measured: two cubics with
six parameters 0.3 s, and no answer in 15 s where decomposition looked for a shorter one first)."""

SMALL_ATOMS = 30
"""An answer of a short try of substitution with more atoms is worse than what decomposition would give."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """``when``: the reason to try, or None. ``work``: the limit, None for none. ``keep``: which outcomes are taken.
    ``shorten``: the answer is long where it could be short, and worth another look. ``spare``: a complete outcome that
    is not kept is taken after all where the next attempt does not end within ``SPARE`` units of work.
    """

    scope: Scope
    method: str
    when: on.Condition
    work: int | None = None
    keep: Callable[[Outcome, Problem], bool] = any_outcome
    shorten: bool = False
    spare: bool = False

    def load(self) -> EliminationMethod:
        """The method itself."""
        module, name = METHODS[self.method]
        found: EliminationMethod = getattr(import_module(module), name)()
        return found


SHORTCUT, FIRST, PROBE, SPARE = 20_000, 60_000, 1_500, 20_000
"""Units of work of shortcuts; of a first method while another could take over; of a short try before decomposition; of
whatever might give a shorter answer than the one that is known.

A unit is one cell, or about the time of one (a tenth of a millisecond); see ``Budget.spend``.
"""

STRATEGY: tuple[Attempt, ...] = (
    Attempt(Scope.ASKED, "witness", on.inner_blocks, SHORTCUT),
    Attempt(Scope.ASKED, "search", on.hopeless_cases),
    Attempt(Scope.ASKED, "search", on.many_cases, SHORTCUT),
    Attempt(Scope.ASKED, "convex", on.closed_in_many_variables, SHORTCUT),
    Attempt(Scope.ASKED, "samples", on.curved_inequalities, PROBE),
    Attempt(Scope.ASKED, "cgs", on.equations_bind_a_sentence, SHORTCUT, complete),
    Attempt(Scope.ASKED, "critical, convex universal", on.curved_in_the_block, SHORTCUT),
    Attempt(Scope.ASKED, "linear form named", on.several_parameters),
    Attempt(Scope.PREPARED, "critical", on.convex_conditions, SHORTCUT),
    Attempt(Scope.BLOCK, "infinity first", on.one_variable_and_parameters),
    Attempt(Scope.BLOCK, "critical", on.convex_conditions, FIRST),
    Attempt(Scope.BLOCK, "vs", on.low_degrees, FIRST, complete_if_closed, shorten=True),
    Attempt(Scope.BLOCK, "roots by signs", on.curved_and_many_parameters, SHORTCUT, shorten=True),
    Attempt(
        Scope.BLOCK,
        "vs, cubic",
        on.cubic_and_many_parameters,
        PROBE,
        complete_and_small_or_alone,
        shorten=True,
        spare=True,
    ),
    Attempt(Scope.BLOCK, "vs", on.worth_a_short_try, PROBE, complete_and_small, shorten=True, spare=True),
    Attempt(Scope.BLOCK, "cad", on.complete),
    Attempt(Scope.BLOCK, "vs", on.always, None, complete_if_closed, shorten=True),
    Attempt(Scope.INNER, "vs", on.always, FIRST, complete),
    Attempt(Scope.INNER, "critical, convex universal", on.curved_with_parameters, SHORTCUT, complete_and_small),
    Attempt(Scope.INNER, "critical", on.never),
    Attempt(Scope.BLOCK, "cgs", on.never),
    Attempt(Scope.INNER, "cgs", on.never),
    Attempt(Scope.BLOCK, "coverings", on.never, shorten=True),
    Attempt(Scope.NESTED, "coverings", on.never, shorten=True),
    Attempt(Scope.NESTED, "cad", on.complete),
)


def attempts(scope: Scope, problem: Problem, options: Options) -> Iterator[tuple[Attempt, EliminationMethod, str]]:
    """The attempts that the strategy makes of a problem, with their reasons. A method that the caller asked for is the
    only one, without conditions and limits of work.
    """
    seen: set[str] = set()
    for attempt in STRATEGY:
        if attempt.scope is not scope:
            continue
        if options.method is not Method.AUTO:
            if not attempt.method.startswith(options.method.value) or attempt.method in seen:
                continue
            seen.add(attempt.method)
            attempt, reason = replace(attempt, when=on.always, work=None), "asked for"
        else:
            found = None if LEFT_OUT_BY.get(attempt.method) in options.without else attempt.when(problem, options)
            if found is None:
                continue
            reason = found
        method = attempt.load()
        if method.suits(problem, options) is not None:
            yield attempt, method, reason


def allows(options: Options, name: Method) -> bool:
    """Whether the caller lets a method take part."""
    return options.method in (Method.AUTO, name)


def alone(name: str) -> Unable:
    """The error where a method, or all of them, leave quantifiers."""
    return Unable(f"{SPOKEN.get(name, f'{name} alone')} does not eliminate all quantifiers of this formula")
