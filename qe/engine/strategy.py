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
from qe.elimination.protocol import Outcome
from qe.engine import conditions as on
from qe.errors import Unable
from qe.formula.block import Block
from qe.formula.traverse import atoms
from qe.options import Method, Options, Stage
from qe.proof.step import Step


@dataclass(frozen=True, slots=True)
class Listed:
    """A method as the strategy knows it; ``suits`` and ``run`` are its own. It is loaded when it is first tried."""

    module: str
    kind: str
    """The module, and its class there."""

    sentence: str
    """What is said not to suffice alone where the method leaves quantifiers."""

    switch: Stage | None = None
    """The stage without which it is not tried; None for decomposition, which takes what all others leave, and for what
    the strategy never tries unbidden."""

    choice: Method | None = None
    """How callers choose it, if they can."""


METHODS = {
    "standard simplification": Listed("qe.engine.reductions", "Simplification", "simplifying"),
    "definitions": Listed("qe.engine.reductions", "Definitions", "substituting definitions", Stage.EQUATIONS),
    "normal position": Listed("qe.engine.reductions", "NormalPosition", "a change of coordinates", Stage.POSITION),
    "local variables": Listed(
        "qe.engine.reductions", "LocalVariables", "eliminating local variables", Stage.MINISCOPING
    ),
    "vs": Listed(
        "qe.elimination.vs.method", "VirtualSubstitution", "virtual substitution", Stage.SUBSTITUTION, Method.VS
    ),
    "vs, cubic": Listed(
        "qe.elimination.vs.method", "CubicSubstitution", "substitution of roots of cubics", Stage.CUBIC, Method.VS
    ),
    "cad": Listed("qe.elimination.cad", "Decomposition", "decomposition", choice=Method.CAD),
    "critical": Listed(
        "qe.elimination.critical.method",
        "CriticalValues",
        "elimination by critical values",
        Stage.CRITICAL,
        Method.CRITICAL,
    ),
    "critical, convex universal": Listed(
        "qe.elimination.critical.method",
        "ConvexUniversal",
        "elimination by critical values",
        Stage.CRITICAL,
        Method.CRITICAL,
    ),
    "convex": Listed("qe.elimination.convex", "ConvexOptimisation", "convex optimisation", Stage.CONVEX, Method.CONVEX),
    "witness": Listed(
        "qe.elimination.witness", "PolynomialWitnesses", "the search for witnesses", Stage.WITNESS, Method.WITNESS
    ),
    "samples": Listed("qe.elimination.samples", "SampledPoints", "trying points", Stage.SAMPLES),
    "branching": Listed("qe.elimination.branching", "BranchAndBound", "branch and bound", Stage.BRANCHING),
    "search": Listed("qe.elimination.search.method", "BooleanSearch", "the Boolean search", Stage.SEARCH),
    "cgs": Listed(
        "qe.elimination.cgs",
        "ComprehensiveGroebner",
        "elimination by comprehensive Gröbner systems",
        Stage.CGS,
        Method.CGS,
    ),
    "coverings": Listed("qe.elimination.coverings", "Coverings", "coverings", choice=Method.COVERINGS),
    "infinity first": Listed(
        "qe.elimination.vs.infinity_first", "InfinityFirst", "looking at infinity", Stage.INFINITY
    ),
    "roots by signs": Listed(
        "qe.elimination.rootsigns.method", "RootsBySigns", "the signs of Hermite's forms", Stage.ROOTS, Method.ROOTS
    ),
    "projection": Listed("qe.elimination.projection", "Projection", "projecting polyhedra", Stage.SUBSTITUTION),
    "linear form named": Listed("qe.elimination.named_form", "NamedForm", "naming a linear form", Stage.NAMING),
}
"""Every method by its name. Attempts of ``STRATEGY`` say when it is tried, with how much work at most."""


class Scope(Enum):
    """What a method is shown: any question, where no block need be outermost; a block as it was asked, and again
    prepared; the prepared question, one block with conditions outside; one block over a quantifier-free body; such a
    block inside another; a block with blocks inside.
    """

    QUESTION = "question"
    ASKED = "as asked"
    PREPARED = "prepared"
    BLOCK = "block"
    INNER = "inner block"
    NESTED = "nested"


def any_outcome(outcome: Outcome, problem: Block) -> bool:
    """Whatever the method found."""
    return True


def complete(outcome: Outcome, problem: Block) -> bool:
    """Nothing is left quantified."""
    return outcome.formula.is_quantifier_free


def complete_if_closed(outcome: Outcome, problem: Block) -> bool:
    """A sentence is decided, for its witness; with parameters something may be left."""
    return bool(problem.free) or complete(outcome, problem)


def complete_and_small(outcome: Outcome, problem: Block) -> bool:
    """A complete answer of at most ``SMALL_ATOMS`` atoms."""
    return complete(outcome, problem) and sum(1 for _ in atoms(outcome.formula)) <= SMALL_ATOMS


def complete_and_shortest(outcome: Outcome, problem: Block) -> bool:
    """A complete answer of one atom at most: no method has a shorter one."""
    return complete(outcome, problem) and sum(1 for _ in atoms(outcome.formula)) <= 1


def complete_and_small_or_alone(outcome: Outcome, problem: Block) -> bool:
    """The same, or any complete answer in ``ALONE_FROM`` variables or more."""
    many = len(problem.variables) + len(problem.free) >= ALONE_FROM
    return complete(outcome, problem) if many else complete_and_small(outcome, problem)


ALONE_FROM = 6
"""In so many variables decomposition does not end where roots of cubics give a long answer."""

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
    keep: Callable[[Outcome, Block], bool] = any_outcome
    shorten: bool = False
    spare: bool = False

    @property
    def listed(self) -> Listed:
        """What is known of the method before it is loaded."""
        return METHODS[self.method]

    def load(self) -> EliminationMethod:
        """The method itself."""
        method: EliminationMethod = getattr(import_module(self.listed.module), self.listed.kind)()
        return method


@dataclass(frozen=True, slots=True)
class Spare:
    """A complete outcome that was too long to be taken at once, with its steps."""

    outcome: Outcome
    attempt: Attempt
    name: str
    steps: tuple[Step, ...]


SHORTCUT, FIRST, PROBE, GLANCE, SPARE = 20_000, 60_000, 1_500, 200, 20_000
"""Units of work of shortcuts; of a first method while another could take over; of a short try before decomposition; of
one before a quick decomposition; of whatever might give a shorter answer than the one that is known.

A unit is one cell, or about the time of one (a tenth of a millisecond); see ``Budget.spend``.
"""

STRATEGY: tuple[Attempt, ...] = (
    Attempt(Scope.QUESTION, "convex", on.large_linear_system, SHORTCUT),
    Attempt(Scope.QUESTION, "local variables", on.many_linear_cases),
    Attempt(Scope.QUESTION, "search", on.many_linear_cases),
    Attempt(Scope.QUESTION, "standard simplification", on.quantified),
    Attempt(Scope.QUESTION, "definitions", on.definitions),
    Attempt(Scope.QUESTION, "witness", on.inner_blocks, SHORTCUT),
    Attempt(Scope.QUESTION, "normal position", on.curved_and_bound),
    Attempt(Scope.ASKED, "search", on.hopeless_cases),
    Attempt(Scope.ASKED, "search", on.many_cases, SHORTCUT),
    Attempt(Scope.ASKED, "convex", on.closed_in_many_variables, SHORTCUT),
    Attempt(Scope.ASKED, "branching", on.curved_between_bounds, 3 * GLANCE),
    Attempt(Scope.ASKED, "samples", on.curved_in_many_variables, PROBE),
    Attempt(Scope.ASKED, "cgs", on.equations_bind_a_sentence, SHORTCUT, complete),
    Attempt(Scope.ASKED, "critical, convex universal", on.curved_in_the_block, 2 * SHORTCUT),
    Attempt(Scope.ASKED, "projection", on.polyhedron, FIRST),
    Attempt(Scope.ASKED, "branching", on.curved_between_bounds, SHORTCUT),
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
    Attempt(Scope.BLOCK, "vs", on.quadratic_and_few_parameters, GLANCE, complete_and_shortest, shorten=True),
    Attempt(Scope.BLOCK, "cad", on.complete),
    Attempt(Scope.BLOCK, "vs", on.always, None, complete_if_closed, shorten=True),
    Attempt(Scope.INNER, "vs", on.always, FIRST, complete),
    Attempt(Scope.INNER, "cad", on.as_many_equations_as_variables, PROBE, complete_and_small),
    Attempt(Scope.INNER, "critical, convex universal", on.curved_with_parameters, SHORTCUT, complete_and_small),
    Attempt(Scope.INNER, "critical", on.never),
    Attempt(Scope.ASKED, "witness", on.never),
    Attempt(Scope.BLOCK, "cgs", on.never),
    Attempt(Scope.INNER, "cgs", on.never),
    Attempt(Scope.BLOCK, "coverings", on.never, shorten=True),
    Attempt(Scope.NESTED, "coverings", on.never, shorten=True),
    Attempt(Scope.NESTED, "cad", on.complete),
)


def attempts(scope: Scope, problem: Block, options: Options) -> Iterator[tuple[Attempt, EliminationMethod, str]]:
    """The attempts that the strategy makes of a problem, with their reasons. A method that the caller asked for is the
    only one, without conditions and limits of work.
    """
    seen: set[str] = set()
    for attempt in STRATEGY:
        if attempt.scope is not scope:
            continue
        if options.method is not Method.AUTO and scope is not Scope.QUESTION:  # reduced, it is still for that method
            if attempt.listed.choice is not options.method or attempt.method in seen:
                continue
            if scope is Scope.INNER and any(a.scope is Scope.NESTED and a.method == attempt.method for a in STRATEGY):
                continue  # it takes all blocks at once
            seen.add(attempt.method)
            attempt, reason = replace(attempt, when=on.always, work=None), "asked for"
        else:
            why = None if attempt.listed.switch in options.without else attempt.when(problem, options)
            if why is None:
                continue
            reason = why
        method = attempt.load()
        if method.suits(problem, options) is not None:
            yield attempt, method, reason


def allows(options: Options, name: Method) -> bool:
    """Whether the caller lets a method take part."""
    return options.method in (Method.AUTO, name)


def alone(method: str) -> Unable:
    """The error where a method leaves quantifiers."""
    return _insufficient(f"{METHODS[method].sentence} alone")


def chosen_alone(method: Method) -> Unable:
    """The error where the method that a caller chose, or all of them, leave quantifiers."""
    sentences = [listed.sentence for listed in METHODS.values() if listed.choice is method]
    return _insufficient(f"{sentences[0]} alone" if sentences else "no method")


def _insufficient(what: str) -> Unable:
    return Unable(f"{what} does not eliminate all quantifiers of this formula")
