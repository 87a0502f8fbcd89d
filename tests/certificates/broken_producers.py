"""Producers that forget a side condition: by what is replaced in them, with questions at which the steps are wrong.

A row is the rule whose steps are then refused, questions, and for each place what is made of what stands there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import qe.elimination.critical.degenerate as degenerate
import qe.elimination.rootsigns.theory as theory
import qe.elimination.vs.cubic as cubic
import qe.elimination.vs.points as points
import qe.elimination.vs.radical_free as radical_free
from qe.elimination.critical.method import ConvexUniversal
from qe.elimination.protocol import Context, Outcome
from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.build import atom, conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, And, Atom, ForAll, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.groebner.signs import SignatureConditions
from qe.proof.step import Nested

Make = Callable[[Any], object]
Row = tuple[str | tuple[str, ...], dict[str, Make]]


def always(value: object) -> Make:
    """A function that returns this whatever it is given."""
    return lambda real: lambda *_, **__: value


def once(value: object, then: object) -> Make:
    """A function that returns the first value at its first call only."""

    def made(_: object) -> Callable[..., object]:
        values = iter((value,))
        return lambda *_, **__: next(values, then)

    return made


def equations_alone(variables: tuple[str, ...], body: Formula) -> Iterator[tuple[object, ...]]:
    """Equations, with one of their variables, as if no other condition looked at it."""
    parts = conjuncts(body)
    for k, part in enumerate(parts):
        if isinstance(part, Atom) and part.relation is Relation.EQ:
            yield next(v for v in variables if v in part.free), part, parts[:k], parts[k + 1 :]


def fewer_factors(real: Any) -> object:
    def choice(*given: object) -> object:
        known = real(*given)
        return known and (known[0], known[1][:-1])

    return choice


def other_side(real: Any) -> object:
    def difference(poly: Poly, equation: Poly) -> tuple[int, int, Poly] | None:
        known = real(poly, equation)
        return None if known is None else (known[0], known[1], -known[2])

    return difference


def sum_of_squares(polys: Iterable[Poly]) -> Poly:
    first, *more = polys
    return sum((p * p for p in more), first * first)


RULES, ELIMINATION = "qe.rules.", "qe.elimination."

PREPARATION: dict[str, Row] = {
    "boundary apart: the boundary itself": (
        "ex x. x^2 >= a and b*x /= 1",
        {RULES + "generic.Any": lambda real: lambda nodes: real(nodes[:1])},
    ),
    "negation normal form: a negation": (
        "not (ex x. x^3 > a and x < b)",
        {RULES + "preparation.nnf": lambda real: lambda formula, negate=False: real(formula, negate=not negate)},
    ),
    "duality: to negate the body of a universal block": (
        "all x. x^2 + a > 0",
        {RULES + "preparation.nnf": lambda real: lambda formula, negate=False: real(formula)},
    ),
    "standard simplification: a factor of even exponent that may be zero": (
        "ex x. a^2*(x^3 + b) < 0 and x^5 > c",
        {
            "qe.simplifier.factors._assemble": lambda real: (
                lambda relation, odd, even, settled: settled(atom(odd, relation))
            )
        },
    ),
    "conditions on zeros that follow: to look what follows from zeros": (
        "ex x, y. (x /= 0 or y /= 0) and x*y + a = 0",
        {RULES + "zeros.truth_under": always(False)},
    ),
    "linear equation solved: the sign of a coefficient": (
        "ex x. a*x = b and x > c",
        {RULES + "linear._sign": always(1)},
    ),
    "linear equation solved under a guard: the guard of the regular case": (
        "ex x. a*x = b and x > c",
        {RULES + "structural._nonzero": always(TRUE)},
    ),
    "degree shift: x >= 0 after an even shift": (
        "ex x. x^4 + a < 0 and x^2 + b > 0",
        {RULES + "degree_shift.values": always(TRUE)},
    ),
    "degree shift: which exponents there are": (
        ("ex x. x^4 + a < 0 and x < 0", "ex x. x^5 + a < 0 and x^3 > c"),
        {RULES + "degree_shift.common_exponent": once(2, 1)},
    ),
    "homogeneous scaling: which weights make polynomials homogeneous": (
        "ex x, y. x^2 + y > 1 and x*y < 2",
        {RULES + "scaling.homogeneous_weights": always({"x": Fraction(1), "y": Fraction(1)})},
    ),
    "homogeneous scaling: the values 0 and -1 after scaling": (
        "ex x, y. x^3 + y^3 < 0 and x < y",
        {RULES + "scaling.sorted": always([1])},
    ),
    "translation of the origin: that polynomials change along a direction": (
        "ex x, y. x^2 + y^2 < a and x + y > 1",
        {
            RULES + "translation.constant_direction": lambda real: (
                lambda body, names: dict.fromkeys(sorted(names), Fraction(1))
            )
        },
    ),
    "inequations that remove no interior: that a condition is not open": (
        "ex x, y. x + y <= a and x*y >= a^2 and x - y /= a",
        {RULES + "generic.is_open": always(True)},
    ),
    "case split on factors: one factor of a product": (
        "ex x. (x - a)*(x + a) = 0 and x > 1",
        {RULES + "equations.factor_choice": fewer_factors},
    ),
    "independent parts and miniscoping: that conditions share a variable": (
        "ex x, y. x*y > a and x + y < 1",
        {
            RULES + "structural.connected": lambda real: (
                lambda parts, names: ((), [(frozenset("xy"), (p,)) for p in parts])
            )
        },
    ),
}

ALONE: dict[str, Row] = {
    "Groebner basis of the equations: an equation of a basis": (
        "ex x, y. x^2 + y = a and x*y = 1 and x > y",
        {RULES + "equations.better_equations": lambda real: lambda known, basis, names: tuple(basis.polys)[:1]},
    ),
    "multiple of an equation subtracted: the sign of what remains": (
        "ex x, y. x^3 + a*x + b = 0 and y^3 + a*y + b > 0",
        {RULES + "cancelling.difference": other_side},
    ),
    "multiple of an equation subtracted: the equation that was subtracted": (
        "ex x, y. x^3 + a*x + b = 0 and y^3 + a*y + b = 0",
        {RULES + "cancelling.conj": lambda real: lambda parts: conj(parts[1:])},
    ),
    "two variables exchanged: all but the sum of two conditions that change places": (
        "ex x, y. x^3 + y^3 = a and x > b and y > b",
        {RULES + "exchange._both": lambda real: lambda *given: real(*given)[:1]},
    ),
    "two variables exchanged: that not any two numbers are a sum and a product": (
        "ex x, y. x^3 + y^3 = a and x*y > 1",
        {RULES + "exchange.conj": lambda real: lambda parts: next(iter(parts))},
    ),
    "two variables exchanged: to look whether conditions change": (
        "ex x, y. x^3 + y^3 = a and x > 1",
        {RULES + "exchange._symmetry": always(True)},
    ),
    "nested blocks of one kind gathered: names that are free beside a block": (
        ("ex x. x > y and ex y. x*y > 1", "all x. x > y or (all y. x*y > 1)"),
        {RULES + "gather._names": always(set())},
    ),
    "nested blocks of one kind gathered: that a disjunction is no conjunction": (
        "ex x. x > a or ex y. x*y > 1",
        {RULES + "gather.conjuncts": lambda real: lambda f: f.args if isinstance(f, And | Or) else (f,)},
    ),
    "rotation of the axes: that a polynomial is not constant along a rotation": (
        ("ex x, y. x^2 + 2*y^2 + x + y < a", "all x, y. x^2 + 2*y^2 > a or x*y > b"),
        {RULES + "rotation.rotations": lambda real: lambda polys, pairs, *_: [{pairs[0]: Fraction(1)}]},
    ),
    "rotation of the axes: that two variables are joined to others": (
        "ex x, y, z. x^2 + y^2 + z^2 < a and x + y + z > b",
        {RULES + "rotation.sum": lambda real: lambda values, start=0: start},
    ),
    "rotation of the axes: that inequalities are no components of a vector": (
        "ex x, y. x^2 + 2*x*y - y^2 > 0 and x^2 - 2*x*y - y^2 > 0",
        {RULES + "rotation._sums": lambda real: lambda formula: [sum_of_squares(a.poly for a in formula.args)]},
    ),
    "disjuncts with equations apart: the last case": (
        "ex x. x > a and (x = b or x = c)",
        {RULES + "structural.Any": lambda real: lambda nodes: real(nodes[:-1])},
    ),
    "disjuncts with equations apart: what stands beside a disjunction": (
        "ex x. x > a and (x = b or x = c)",
        {RULES + "structural.conj": lambda real: lambda parts: conj(list(parts)[-1:])},
    ),
    "value that is taken: degrees and leading coefficients": (
        (
            "ex x. x^2 = a and b > 0",
            "ex x. a*x^3 + x^2 + 1 = 0 and b > 0",
            "ex x. b*x^2 + x > a",
            "ex x. a*x^2 + a*x + b /= 0",
        ),
        {RULES + "takes_value._is_met": always(True)},
    ),
    "value that is taken: which sign a leading coefficient has": (
        "ex x. x^2 + x < a",
        {RULES + "takes_value._WANTED": lambda real: dict.fromkeys(Relation, 1)},
    ),
    "value that is taken: all conditions but equations": (
        "ex x. x^3 + x = a and x > b",
        {RULES + "takes_value.looked_at_once": lambda real: equations_alone},
    ),
}
"""Of rules that are the only one then."""


def not_the_other_sign(real: Any) -> object:
    def prepared(block: Any, budget: Any) -> Nested:
        equation = any(getattr(a, "relation", None) is Relation.EQ for a in conjuncts(block.body))
        return real(block, budget) if equation else Nested(block, (), FALSE)

    return prepared


def without_interior(real: Any) -> object:
    """As if the set had no interior points."""

    def run(self: ConvexUniversal, problem: Block, context: Context) -> Outcome | None:
        block = problem.formula
        assert isinstance(block, ForAll)
        made = degenerate.thin_universal(block, problem.positive, problem.free, context.budget)
        assert made is not None
        proof = {"proof": made.evidence}
        return Outcome(context.log.step("degenerate truth set", block, made.formula, evidence=proof))

    return run


INFINITY, COUNTING, THIN = (
    ELIMINATION + "vs.infinity_first.",
    "qe.formula.counting.",
    ELIMINATION + "critical.method.ConvexUniversal.run",
)
DISC = "all t. 0 <= t and t <= 1 -> x^2 + (y - t)^2 <= 1/4"

BLOCKS: dict[str, Row] = {
    "infinity first: what holds where the leading coefficient is not 0": (
        "ex x. a*x^4 + b*x + c < 0 and x > d",
        {INFINITY + "_prepared": not_the_other_sign},
    ),
    "infinity first: what holds far on the right": (
        "ex x. a*x^3 + b*x^2 + c < 0",
        {INFINITY + "_prepared": not_the_other_sign, INFINITY + "disj": lambda real: lambda parts: next(iter(parts))},
    ),
    "witness in the parameters: to look at the first candidate": (
        "all a, b. ex x. (x - a)^2 <= (a - b)^2 and x < a",
        {ELIMINATION + "witness.simplify": always(TRUE), ELIMINATION + "witness._probes": always(())},
    ),
    "roots counted: that a root at a place is not before it": (
        "x > root(1, x^2 - y)",
        {
            COUNTING + "_at_least": lambda real: (
                lambda poly, x, names, relation: real(
                    poly, x, names, Relation.LE if relation is Relation.LT else relation
                )
            )
        },
    ),
    "roots counted: that a polynomial may vanish identically": (
        "x > root(1, a*x^2 - y)",
        {COUNTING + "disj": always(TRUE)},
    ),
    "roots counted: one root": (
        "x <= root(2, x^2 - y)",
        {COUNTING + "counted_roots": lambda real: lambda known, names: real(replace(known, k=1), names)},
    ),
    "degenerate truth set: that necessary conditions have solutions": (
        DISC,
        {THIN: without_interior, ELIMINATION + "critical.degenerate.implied_equations": always(None)},
    ),
    "degenerate truth set: that an equation is not implied": (
        DISC,
        {
            THIN: without_interior,
            ELIMINATION + "critical.degenerate.implied_equations": lambda real: (
                lambda conditions, budget: [conditions.ring.var("x") + conditions.ring.var("y")]
            ),
        },
    ),
    "constant: every exception": (
        "a^2 + b^2 < 1 and a^4 + b > 0",
        {
            "qe.engine.run.outcome_for": always(Outcome(FALSE)),
            "qe.engine.constant._at": always(False),
            "qe.engine.constant.holds_at": always(False),
        },
    ),
}

CANDIDATES, BLOCK = ELIMINATION + "vs.candidates.", ELIMINATION + "vs.block."
CUBIC, CUBIC_ROWS = ELIMINATION + "vs.cubic.", ELIMINATION + "vs.roots.CUBIC"


def any_quadratic(real: Any) -> object:
    def lone(formula: Formula, x: int) -> Any:
        parts = (f for a in radical_free.atoms(formula) for f, _ in radical_free.factor_list(a.poly))
        return next((f for f in parts if f.degree(x) == 2), None)

    return lone


def no_infinities(real: Any) -> object:
    def plan(*given: Any) -> Any:
        made = real(*given)
        return None if made is None else replace(made, infinities=())

    return plan


SUBSTITUTION: dict[str, Row] = {
    "all disjuncts but one": (
        "ex x. x^2 = a and x > b or x < a and x > 3",
        {
            BLOCK + "_Run._solve": lambda real: (
                lambda self, formula, inside: real(
                    self, formula.args[0] if isinstance(formula, Or) else formula, inside
                )
            )
        },
    ),
    "that parts share a variable": (
        "ex x. a*x > b and x < c",
        {BLOCK + "connected": lambda real: lambda parts, names: ((), [(frozenset(), (p,)) for p in parts])},
    ),
    "to look at a number": (
        "ex x, y. x*y > 1 and x^2 > y^2 + 5*x",
        {
            BLOCK + "solution": lambda real: (
                lambda formula, variable, known: next(
                    v for v in map(Fraction, range(99)) if not holds_at(formula, {variable: v})
                )
            ),
            "qe.proving.prover.Prover._tabulated": always(None),  # by which the right answer is proved all the same
        },
    ),
    "the degenerate case": ("ex x. a*x = b and x > a", {CANDIDATES + "vanishing": always(FALSE)}),
    "infinity": ("ex x. a*x > b and x < a", {ELIMINATION + "vs.plan._with_bounds": no_infinities}),
    "the direction": (
        "ex x. a*x > b and x < a",
        {CANDIDATES + "_roots": lambda real: lambda g, f, e, c, d, *others: real(g, f, e, c, -d, *others)},
    ),
    "epsilon": (
        "ex x. x > a and x < b and a*x /= 1",
        {CANDIDATES + "_roots": lambda real: lambda g, f, e, *others: real(g, f, 0, *others)},
    ),
    "one branch": (
        "ex x. x^2 = a and x > b",
        {CANDIDATES + "_roots": lambda real: lambda *given: list(real(*given))[:1]},
    ),
    "what earlier points do not settle": (
        "ex x. x^2 > a and x*a > b and x < 1",
        {
            BLOCK + "in_order": lambda real: (
                lambda listed: (
                    (c, frozenset(a for a in conjuncts(c.formula) if a.relation.is_strict and c.point.epsilon))
                    for c in listed
                )
            )
        },
    ),
    "other conjuncts": (
        "ex x. (a*x = b and x > 1 and x < 2 or x = 5) and x < c",
        {CANDIDATES + "disjuncts": always(())},
    ),
    "that a quadratic is not alone": (
        "ex x. (x^2 >= a or x < b) and x^2 <= a",
        {ELIMINATION + "vs.radical_free.lone_quadratic": any_quadratic},
    ),
    "the side in a table": (
        "ex x. x^2 = a and x > b",
        {ELIMINATION + "vs.substitute.root_condition": lambda real: lambda a, b, d, r, make: real(a, b, -d, r, make)},
    ),
    "that a formula is not open": ("ex x, y. x + a*y = 1 and x - b*y = a and x > 3", {BLOCK + "is_open": always(True)}),
}

CUBICS: dict[str, Row] = {
    "lower degrees": (
        ("ex x. a*x^3 + b*x < 1 and x > b", "ex x. a*x^3 + b*x = 1 and x > b"),
        {
            CANDIDATES + "_roots": lambda real: (
                lambda *given: [c for c in real(*given) if isinstance(c.point, points.CubicRoot)]
            )
        },
    ),
    "double roots in the table": (
        ("ex x. x^3 + a*x + b = 0 and x > a and x < 1", "ex x. x^3 + a*x + b <= 0 and x > a"),
        {CUBIC_ROWS: lambda rows: tuple((k, Relation.GT if r is Relation.GE else r, s) for k, r, s in rows)},
    ),
    "a single root": ("ex x. x^3 + a*x + b = 0 and x > a", {CUBIC_ROWS: lambda rows: rows[1:]}),
    "which root": (
        "ex x. x^3 + a*x + b = 0 and x > a and x < 1",
        {CUBIC_ROWS: lambda rows: tuple((4 - k if k else 0, r, s) for k, r, s in rows[:2]) + rows[2:]},
    ),
    "the direction of cubics": (
        "ex x. x^3 + a*x + b < 0 and x > a",
        {CUBIC_ROWS: lambda rows: tuple((k, r, -s) for k, r, s in rows)},
    ),
    "epsilon at cubics": (
        "ex x. x^3 + a*x + b < 0 and x > a",
        {CANDIDATES + "ROWS": lambda rows: {**rows, 3: lambda coefficients, epsilon: rows[3](coefficients, 0)}},
    ),
    "that more than one thing is asked": (
        "ex x. x^3 + a*x + b = 0 and x > a and x < b",
        {ELIMINATION + "vs.clusters.asks_one": always(True)},
    ),
    "the rank": (
        "ex x. x^3 + a*x + b = 0 and x > a and x < b",
        {CUBIC + "_ranked": lambda real: lambda e, rank, *others: real(e, cubic.Rank.LEAST, *others)},
    ),
    "the leading sign": (
        "ex x. b*x^3 + a*x + 1 = 0 and x^3 < a",
        {CUBIC + "remainder": lambda real: lambda f, x, e: (real(f, x, e)[0], False)},
    ),
    "complex zeros": (
        "ex x. x^3 + a*x + b = 0 and x^2 + a*x > b",
        {CUBIC + "_at_only": lambda real: lambda e, u, v, w, r, atom: atom(cubic.symmetric(e, u, v, w)[2], r)},
    ),
    "double roots at critical points": (
        "ex x. x^3 + a*x + b = 0 and 3*x^2 + a > 0 and x > 1",
        {
            CUBIC + "_at_critical": lambda real: (
                lambda e, u, r, atom: real(replace(e, index=2 if e.index != 2 else 1), u, r, atom)
            )
        },
    ),
}

ONE_INEQUALITY = "ex x. x^2 + a*x + b = 0 and x > 0"
COUNT = "qe.groebner.counting.SolutionCount.is_positive"

COUNTED: dict[str, Row] = {
    "that zero is not positive": (
        "ex x. x^2 = a and x > b",
        {"qe.groebner.counting._WEIGHTS": lambda real: {**real, Relation.GT: real[Relation.GE]}},
    ),
    "where a basis is one": ("ex x. a*x^2 + b*x + 1 = 0", {ELIMINATION + "cgs.condition_of": always(TRUE)}),
    "that no solution is none": (
        ONE_INEQUALITY,
        {COUNT: lambda real: property(lambda self: self.is_in(range(self.most + 1)))},
    ),
    "two solutions": ("ex x. x^2 = a", {COUNT: lambda real: property(lambda self: self.is_in({1}))}),
    "negative signatures": (ONE_INEQUALITY, {"qe.groebner.trace_form._is_square": always(True)}),
    "that minors are of no Hankel matrix": (
        "ex x, y. x^2 = a and y^2 = b",
        {
            "qe.groebner.trace_form.SignatureConditions": lambda real: (
                lambda minors, coefficients, is_hankel, *rest: SignatureConditions(minors, coefficients, True, *rest)
            )
        },
    ),
    "segments with infinitely many solutions": (
        "ex x. a*x = 0 and x > b",
        {
            ELIMINATION + "cgs._Conjunction._of_segment": lambda real: (
                lambda self, segment, *rest: real(self, segment, *rest) if segment.dimension == 0 else FALSE
            )
        },
    ),
    "conditions on the parameters alone": (
        "ex x. a*x^2 + b*x + 1 = 0 and a < b",
        {
            ELIMINATION + "cgs._Conjunction.of": lambda real: staticmethod(
                lambda *given: replace(real(*given), outside=())
            )
        },
    ),
    "one end of the line": (
        "ex x. x < a",
        {ELIMINATION + "cgs._at_end": lambda real: lambda g, relation, x, side: real(g, relation, x, 1)},
    ),
    "bounded intervals": (
        "ex x. x^2 + a*x + 1 < 0 and x > 0",
        {ELIMINATION + "cgs._Conjunction._at_zeros": always(FALSE)},
    ),
}


def without_gaps(signs: tuple[int, ...]) -> int:
    """The signature, zeros among the minors passed over."""
    return sum(a * b for a, b in pairwise([1, *filter(None, signs)]))


SIGNS = ELIMINATION + "rootsigns."

ROOT_SIGNS: dict[str, Row] = {
    "that an interval is closed": (
        "ex x. x^3 + a*x + b = 0 and x >= c",
        {SIGNS + "question._on_interval": lambda real: lambda *given: replace(real(*given), closed=(False, False))},
    ),
    "that an interval may be empty": (
        "ex x. x^3 + a <= 0 and x > c and x < d",
        {SIGNS + "question._on_interval": lambda real: lambda *given: replace(real(*given), side=TRUE)},
    ),
    "signs of minors for a negative leading coefficient": (
        "ex x. a*x^3 + b*x + c = 0 and x > 0 and x < 1",
        {SIGNS + "theory._parts": lambda real: lambda shape, kind, lead: real(replace(shape, odd=False), kind, lead)},
    ),
    "a lower degree": ("ex x. a*x^3 + b*x + c = 0 and x > 0", {SIGNS + "question.Question.degenerate": always(FALSE)}),
    "that a double root is no change of sign": (
        "ex x. x^4 + a*x^2 + b*x + c < 0",
        {
            SIGNS + "question.Question.holds": lambda real: (
                lambda self, lead, kind: lead < 0 or theory.count(kind, *theory.REAL) > 0
            )
        },
    ),
    "which form minors are of": (
        "ex x. x^3 + a*x + b = 0 and c*x + 1 > 0",
        {SIGNS + "method.minors": lambda real: lambda c, g, budget: real(c, [-p for p in g], budget)},
    ),
    "zeros among the minors": (
        "ex x. x^4 + a*x^2 + b*x + c = 0",
        {SIGNS + "theory._signature": lambda real: without_gaps},
    ),
}
