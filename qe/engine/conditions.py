"""When a method is worth trying: pure functions of a problem, each with its reason (figures: docs/algorithms.md)."""

from __future__ import annotations

from collections.abc import Callable
from math import prod

from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.features import is_short
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import connected, subformulas
from qe.options import Method, Options, Stage
from qe.rules.linear import may_define

Condition = Callable[[Block, Options], str | None]

CAD_VARIABLES = 3
"""Up to this many variables decomposition is fast and its answers are short (measured: tens of milliseconds)."""

CAD_FIRST_VARIABLES = 4
"""Up to this many variables decomposition goes first where substitution would square degrees."""

CRITICAL_PARAMETERS = 2
"""Up to this many parameters critical values go first for convex conditions."""

MANY_FROM = 8
"""Sentences with equations, in so many variables, are tried at points."""

CONVEX_FROM, CONVEX_CURVED = 4, 4
"""Existential sentences in so many variables are first tried as convex problems; in one variable less where so many
polynomials are not linear; with fewer, the others are faster."""


EQUATIONS_FROM, FEW_SOLUTIONS, MANY_SOLUTIONS = 4, 16, 130
"""Sentences with as many equations as variables, so many, are solved as systems if the product of degrees (Bézout's
bound of the number of complex solutions) lies between these: below, the other methods take tens of milliseconds."""

CASES_FROM, CURVED_CASES = 12, 80
"""Sentences with so many case distinctions are searched by a SAT solver first, unless more polynomials are not linear:
what has to be decided again and again is then too large."""

HOPELESS_CASES, LINEAR_VARIABLES = 150, 4
"""So many cases, or any cases of linear conditions in so many variables, are for the SAT solver alone: whatever else
there is would go through them one by one."""

MANY = 24
"""The same for so many alternatives of linear conditions in fewer variables."""

LINEAR_TERMS = 1000
"""Coefficients from which on a conjunction of linear conditions is decided as it stands."""

POSITION_TERMS = 5000
"""Terms of all atoms together up to which better coordinates are looked for."""

CONVEX_PARTS = 24
"""In more variables, conditions that fall apart into some without common variables are not one convex problem."""


def always(problem: Block, options: Options) -> str | None:
    """A method of last resort."""
    return "nothing speaks against it"


def complete(problem: Block, options: Options) -> str | None:
    """Decomposition takes everything; the reason says how much there is."""
    total = problem.total
    short = (
        ": decomposition is cheap and its answer short" if total <= CAD_VARIABLES else f" of degree {problem.degree}"
    )
    return f"{total} variables in all{short}"


def never(problem: Block, options: Options) -> str | None:
    """Only where the caller asks for the method."""
    return None


def inner_blocks(problem: Block, options: Options) -> str | None:
    """Quantifiers inside a universal block."""
    if options.method is not Method.AUTO:
        return None
    return "blocks inside a universal one" if problem.universal and not problem.is_flat else None


def many_cases(problem: Block, options: Options) -> str | None:
    """A sentence with ``CASES_FROM`` disjunctions or more."""
    cases = case_count(problem)
    if cases < CASES_FROM or problem.curved > CURVED_CASES or hopeless_cases(problem, options):
        return None
    return f"a sentence with {cases} case distinctions"


def hopeless_cases(problem: Block, options: Options) -> str | None:
    """A sentence with so many cases that no other method will end, or with linear conditions alone."""
    cases = case_count(problem)
    if cases and not problem.curved and (len(problem.variables) >= LINEAR_VARIABLES or _alternatives(problem) >= MANY):
        return f"a linear sentence with {cases} case distinctions"
    return f"a sentence with {cases} case distinctions, too many for other methods" if cases >= HOPELESS_CASES else None


def many_linear_cases(problem: Block, options: Options) -> str | None:
    """A linear sentence with ``CASES_FROM`` disjunctions or more: simplifying takes longer (twice, for automata)."""
    cases = 0 if problem.curved or options.method is not Method.AUTO else case_count(problem)
    return f"a linear sentence with {cases} case distinctions" if cases >= CASES_FROM else None


def definitions(problem: Block, options: Options) -> str | None:
    """An equation that is linear in a bound variable."""
    return "an equation may define a variable" if may_define(problem.formula) else None


def quantified(problem: Block, options: Options) -> str | None:
    """Any quantifier."""
    return None if problem.formula.is_quantifier_free else "quantifiers"


def large_linear_system(problem: Block, options: Options) -> str | None:
    """A sentence of linear conditions with so many coefficients that even simplifying takes longer than deciding."""
    if problem.free or not problem.is_flat or options.method not in (Method.AUTO, Method.CONVEX):
        return None
    found = [a.poly for a in problem.conditions if isinstance(a, Atom) and a.relation is not Relation.NE]
    is_linear = len(found) == len(problem.conditions) and all(poly.total_degree <= 1 for poly in found)
    count = sum(poly.term_count() for poly in found) if is_linear else 0
    return f"linear conditions with {count} coefficients" if count >= LINEAR_TERMS else None


def curved_and_bound(problem: Block, options: Options) -> str | None:
    """Quantifiers over polynomials that are not linear, in more than one variable."""
    if not problem.curved or problem.formula.is_quantifier_free or not is_short(problem.formula, POSITION_TERMS):
        return None
    if len(problem.variables) == 1 and problem.is_flat and not problem.free:
        return None  # the numbers of one line are isolated as quickly where they are
    return "polynomials that are not linear"


def case_count(problem: Block) -> int:
    """The disjunctions in a sentence of one block that may be searched; 0 for any other."""
    if problem.free or not problem.is_flat:
        return 0
    kind = And if problem.universal else Or
    return sum(1 for f in subformulas(problem.body) if isinstance(f, kind))


def _alternatives(problem: Block) -> int:
    """The members of all disjunctions in the body of a sentence."""
    kind = And if problem.universal else Or
    return sum(len(f.args) for f in subformulas(problem.body) if isinstance(f, kind))


def closed_in_many_variables(problem: Block, options: Options) -> str | None:
    """A sentence in at least ``CONVEX_FROM`` variables, or in one less and ``CONVEX_CURVED`` curved conditions."""
    count = len(problem.variables)
    if count < CONVEX_FROM - 1 or not problem.is_flat or problem.free:
        return None
    if count < CONVEX_FROM and problem.curved < CONVEX_CURVED:
        return None
    if count > CONVEX_PARTS and _falls_apart(problem):
        return None  # preparation takes the parts apart, and each is decided alone
    return f"a sentence in {count} variables"


def polyhedron(problem: Block, options: Options) -> str | None:
    """Linear conditions on variables and parameters, all but one at most."""
    if not problem.free or not problem.is_flat:
        return None
    curved = [p for p in problem.conditions if not isinstance(p, Atom) or p.poly.total_degree > 1]
    if len(curved) > 1 or (curved and problem.degree > 1):
        return None
    kind = "a linear form with parameters on a polyhedron in" if curved else "a polyhedron projected along"
    return f"{kind} {len(problem.variables)} variables"


def curved_in_many_variables(problem: Block, options: Options) -> str | None:
    """A sentence, not linear, in ``CONVEX_FROM`` variables or more, ``MANY_FROM`` where a conjunct is an equation."""
    equations = any(isinstance(part, Atom) and part.relation is Relation.EQ for part in problem.conditions)
    if len(problem.variables) < (MANY_FROM if equations else CONVEX_FROM) or not problem.curved:
        return None
    return f"{len(problem.variables)} variables" if problem.is_flat and not problem.free else None


def curved_between_bounds(problem: Block, options: Options) -> str | None:
    """Such a sentence, with equations or not, where conditions bound a variable on either side."""
    if len(problem.variables) < CONVEX_FROM or not problem.curved or not problem.is_flat or problem.free:
        return None
    linear = [a.poly for a in problem.conditions if isinstance(a, Atom) and a.poly.total_degree == 1]
    bounds = [poly.variables for poly in linear if poly.term_count() <= 2 and len(poly.variables) == 1]
    return f"{len(problem.variables)} variables between bounds" if len(bounds) > len({*bounds}) else None


def _falls_apart(problem: Block) -> bool:
    """Whether some conjuncts share no variable with the others."""
    block = frozenset(problem.variables)
    parts = problem.conditions
    return len(connected(parts, lambda part: block.intersection(part.free))[1]) > 1


def equations_bind_a_sentence(problem: Block, options: Options) -> str | None:
    """A conjunction with as many equations as variables, four or more, and neither few nor many complex solutions:
    preparation would solve the equations one by one and make them longer."""
    if not problem.is_flat or problem.free or len(problem.variables) < EQUATIONS_FROM:
        return None
    parts = problem.conditions
    if not all(isinstance(part, Atom) for part in parts):
        return None
    degrees = [a.poly.total_degree for a in parts if isinstance(a, Atom) and a.relation is Relation.EQ]
    count = len(problem.variables)
    if len(degrees) < count or not FEW_SOLUTIONS < prod(sorted(degrees)[:count]) <= MANY_SOLUTIONS:
        return None
    return f"{len(degrees)} equations bind {count} variables"


def curved_in_the_block(problem: Block, options: Options) -> str | None:
    """A universal block of degree above 2 in its variables: substitution cannot do it."""
    if not problem.universal or not problem.is_flat:
        return None
    return "degree above 2 in the quantified variables" if problem.degree > 2 else None


def curved_with_parameters(problem: Block, options: Options) -> str | None:
    """The same, of one variable: an inner block whose outer one has other variables than the parameters it looks at."""
    return curved_in_the_block(problem, options) if len(problem.variables) == 1 and problem.free else None


def as_many_equations_as_variables(problem: Block, options: Options) -> str | None:
    """A small curved block that takes finitely many values, as where roots are counted."""
    equations = [a for a in problem.conditions if isinstance(a, Atom) and a.relation is Relation.EQ]
    is_small = problem.total <= CAD_FIRST_VARIABLES + 2 and len(equations) == len(problem.variables)
    if not is_small or not problem.free or not problem.curved or options.root_atoms:  # which what is around cannot read
        return None
    return "as many equations as variables"


def several_parameters(problem: Block, options: Options) -> str | None:
    """More variables in all than decomposition takes."""
    total = problem.total
    return f"{total} variables in all" if problem.free and total > CAD_FIRST_VARIABLES else None


def one_variable_and_parameters(problem: Block, options: Options) -> str | None:
    """A block of one variable with parameters."""
    return "one variable and parameters" if len(problem.variables) == 1 and problem.free else None


def convex_conditions(problem: Block, options: Options) -> str | None:
    """Weak convex conditions in several quantified variables and few parameters."""
    bound, total = problem.occurring, problem.total
    if bound <= 1 or total <= CAD_VARIABLES or total - bound > CRITICAL_PARAMETERS or not _is_convex(problem.positive):
        return None
    return "convex conditions on several quantified variables: critical values are few"


def low_degrees(problem: Block, options: Options) -> str | None:
    """Where substitution is quick, or the variables are too many for anything else."""
    if convex_conditions(problem, options) is not None:
        return None
    bound, total, degree = problem.occurring, problem.total, problem.degree
    if degree <= 1:
        return "every quantified variable is linear"
    if total <= CAD_VARIABLES:
        return None
    if bound == 1 and degree <= 2:
        return "one quadratic variable and many parameters"
    return None if total <= CAD_FIRST_VARIABLES else f"{total} variables: substitution removes what it can first"


def cubic_and_many_parameters(problem: Block, options: Options) -> str | None:
    """A variable of degree 3, and too many others for a quick decomposition."""
    if Stage.CUBIC in options.without or convex_conditions(problem, options) is not None:
        return None
    total = problem.total
    if total <= CAD_VARIABLES or not _has_cubic(problem):
        return None
    return f"a short try of roots of cubics before decomposing {total} variables"


def curved_and_many_parameters(problem: Block, options: Options) -> str | None:
    """One variable, of degree 3 or more, and as many parameters; the roots of a cubic under a condition are left to
    substitution, whose answers are a third as long."""
    total = problem.total
    if len(problem.variables) > 1 or total <= CAD_VARIABLES or problem.degree < 3:
        return None
    # of a cubic, more than one polynomial with the variable beside numbers or letters that it is compared with
    if problem.degree == 3 and sum(degree > 1 or not lead.is_constant for degree, lead in _leads(problem)) > 1:
        return None
    return f"one variable of degree {problem.degree} and {total - 1} parameters"


def _leads(problem: Block) -> list[tuple[int, Poly]]:
    """The degrees in the only variable of all polynomials that have it, with their leading coefficients."""
    (name,) = problem.variables
    places = ((p, p.ring.index[name]) for p in problem.polynomials if name in p.ring.index)
    return [(p.degree(x), p.leading(x)) for p, x in places if p.degree(x)]


def _has_cubic(problem: Block) -> bool:
    """Whether some polynomial has degree 3 in a quantified variable."""
    bound = frozenset(problem.variables)
    return any(p.degree(i) == 3 for p in problem.polynomials for i in p.variables if p.ring.names[i] in bound)


def worth_a_short_try(problem: Block, options: Options) -> str | None:
    """Where decomposition goes first but has many variables: a small complete answer may come at once."""
    if low_degrees(problem, options) is not None or convex_conditions(problem, options) is not None:
        return None
    if cubic_and_many_parameters(problem, options) is not None:
        return None  # which tries the same, and roots of cubics
    total = problem.total
    return f"a short try before decomposing {total} variables" if total > CAD_VARIABLES else None


def quadratic_and_few_parameters(problem: Block, options: Options) -> str | None:
    """One variable of degree 2 and a parameter or two: decomposition is quick, substitution is ten times as quick."""
    if len(problem.variables) > 1 or not problem.free or problem.degree > 2 or problem.total > CAD_VARIABLES:
        return None
    squares = [lead for degree, lead in _leads(problem) if degree == 2]
    if len(problem.free) > 1 < len(squares) and not all(lead.is_constant for lead in squares):
        return None
    return "one quadratic variable: its answer may be an atom"


def _is_convex(body: Formula) -> bool:
    """Whether the body is a conjunction of weak convex quadratic inequalities of which one is not linear."""
    if not isinstance(body, And):
        return False
    from qe.convex.system import NotConvex, read_system

    try:
        system = read_system(body)
    except NotConvex:
        return False
    return system.is_weak and not all(form.is_linear for form in system.forms)
