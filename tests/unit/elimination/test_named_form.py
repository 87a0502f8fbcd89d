"""A linear form that gets a name: short answers, what is left alone, the same truth at points, forged steps."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest

import qe
import qe.elimination.named_form as named_form
from qe.elimination.protocol import Context
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Exists, Formula, Relation
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from tests.certificates.test_steps_by_hand import accepted as accepted_in_its_ring
from tests.tables import each
from tests.unit.proving.elaborated import refused

SIMPLEX = "x >= 0 and y >= 0 and x + y <= 1"
FIRST, SECOND = "a + x*(b - a) + y*(c - a)", "d + x*(f - d) + y*(g - d)"
SUM_AND_PRODUCT = f"ex x, y. {SIMPLEX} and {FIRST} + {SECOND} = s and ({FIRST})*({SECOND}) = p"


def accepted(step: Step) -> bool:
    """Whether the checker accepts a step, in a ring that has the new name."""
    names = [name for f in (step.before, step.after) if f.ring is not None for name in f.ring.names]
    ring = Ring.of(dict.fromkeys(names))
    return accepted_in_its_ring(replace(step, before=moved(step.before, ring), after=moved(step.after, ring)))


def step_of(asked: Formula) -> Step | None:
    """What the method says about a block."""
    problem, log = Block.of(asked), RunLog()
    assert problem is not None
    if named_form.NamedForm().suits(problem, Options()) is None:
        return None
    found = named_form.NamedForm().run(problem, Context(Options(), Budget(), log))
    return None if found is None else next(log.steps())


def test_sum_and_product_of_barycentric_combinations() -> None:
    """The answer had 6.6 million characters."""
    answer = qe.eliminate(SUM_AND_PRODUCT).formula
    assert answer is not None and len(str(answer)) < 100_000
    rng = random.Random(3)
    for _ in range(40):
        point = {v: Fraction(rng.randint(-3, 3), rng.choice((1, 2))) for v in "abcdfg"}
        at = {**point, "x": Fraction(rng.randint(0, 2), 4), "y": Fraction(rng.randint(0, 2), 4)}
        one, two = (
            a + at["x"] * (b - a) + at["y"] * (c - a) for a, b, c in ([at[v] for v in vs] for vs in ("abc", "dfg"))
        )
        assert holds_at(answer, {**point, "s": one + two, "p": one * two})
        assert not holds_at(answer, {**point, "s": one + two, "p": (one + two) ** 2 / 4 + 1})


@each(
    "ex x, y. x^2 + y^2 = a and x + b*y > c",
    "ex x, y. x*y = a and x + b > c",
    "ex x, y. x + b*y = s and b*x*y = p and x > a",
    "ex x, y. (x + a*y)^3 = b and x > c",
    "ex x, y. (x + a*y)^2 = b or x > c",
    "ex x, y. (x + a*y)^2 = b and (x - a*y)^2 = c and x > 0",
    "ex x, y. x^2 + y^2 = 1",
    "all x. ex y. (x + a*y)^2 = b and x > c",
)
def test_others_are_left_alone(text: str) -> None:
    assert step_of(read(text)) is None


def made(rng: random.Random) -> Formula:
    """Conditions on one form, with multiples of an equation added, beside linear ones."""
    ring = Ring.of(("a", "b", "c", "x", "y", "z"))
    a, b, c, x, y, z = (ring.gen(i) for i in range(6))
    form = x * rng.choice((a, b, ring.constant(2))) + y * rng.choice((c, ring.constant(1))) + rng.choice((a, z))
    line = x * rng.choice((c - 1, a + b)) - y * (b + 1) + b * rng.randint(0, 2) + z * rng.randint(0, 1)
    parts: list[Formula] = [atom(line, Relation.EQ), atom(z + x - a, rng.choice(tuple(Relation)))]
    for _ in range(rng.randint(1, 2)):
        curve = (form * rng.randint(1, 2) - b) * (form + rng.choice((c, a * 2))) + rng.choice((b, ring.constant(-1)))
        curve = curve + line * rng.choice((form, x + b, ring.constant(0)))
        parts.append(atom(curve * rng.choice((1, -1)), rng.choice(tuple(Relation))))
    rng.shuffle(parts)
    return exists(("x", "y", "z"), conj(parts))


def test_what_the_method_does_is_accepted() -> None:
    steps = [step for seed in range(60) if (step := step_of(made(random.Random(seed)))) is not None]
    assert len(steps) > 15 and all(map(accepted, steps))


def test_forged_steps_are_refused() -> None:
    step = step_of(read("ex x, y. (a + b)*x + (a - b)*y = s and (a^2 - b^2)*x*y >= p and x > a"))
    assert step is not None and accepted(step)
    rule, before, after, evidence = step.rule, step.before, step.after, step.evidence
    assert isinstance(after, Exists)
    (name,) = after.variables
    line, form, quadratic = "(a + b)*x + (a - b)*y = s", "(a + b)*x", f"s*{name} - {name}^2 - p"
    for outer, inner in (
        (f"{quadratic} > 0", f"{line} and x > a and {name} = {form}"),
        (f"{quadratic} >= 0", f"{line} and {name} = {form}"),
        (f"{quadratic} >= 0", f"{line} and x > a and {name} = {form} + y"),
        (f"{quadratic} >= 0", f"x > a and y > 0 and {name} = {form}"),
        (f"{quadratic} >= 0", f"{line} and x > a and {name}^2 = {form}"),
        (f"{quadratic} >= a", f"{line} and x > a and {name} = {form}"),
    ):
        text = f"ex {name}. {outer} and ex x, y. {inner}"
        assert not accepted(Step(rule, before, read(text), evidence=evidence)), text
    for scales in ([], [Fraction(1), Fraction(1)], [Fraction(0)]):
        assert not accepted(Step(rule, before, after, evidence={"proof": {"scales": scales}}))


PRODUCT = "ex x, y. x + y = a and x^2 + x*y >= b"
NAMED = "ex z. a*z - b >= 0 and (ex x, y. x + y = a and z = x)"


@each(
    (PRODUCT, NAMED, "1", ""),
    (PRODUCT, NAMED, "2", "not the one of the block"),
    (PRODUCT.replace("= a", ">= a"), NAMED.replace("= a", ">= a"), "1", "not the one of the block"),
    (PRODUCT, NAMED.replace("z = x", "2*z = x").replace("a*z - b", "a*z - 2*b"), "2", "coefficient"),
    (PRODUCT, NAMED.replace("z = x", "(z = x or z > 5)"), "1", "an equation that is linear"),
    (PRODUCT, NAMED.replace("ex z", "all z"), "1", "a block of one variable"),
    (PRODUCT, "ex z. a*z - b >= 0 and z > x", "1", "one block"),
    (PRODUCT, NAMED.replace("z = x", "z = x and y > 5"), "1", "not those of the block"),
    (PRODUCT, NAMED.replace("ex x, y", "ex x"), "1", "the same block"),
    (PRODUCT + " and z > 0", NAMED.replace("= x", "= x and z > 0"), "1", "new variable"),
)
def test_what_the_checker_says(before: str, after: str, scale: str, reason: str) -> None:
    """x^2 + x*y is a*x where x + y = a, but not where x + y >= a; an equation for 2*z gives no z."""
    assert bool(refused("linear form named", before, after, {"scales": [scale]})) is bool(reason)


def test_a_producer_that_names_another_form(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shift of the form is forgotten in the quadratic polynomials."""
    asked = read("ex x, y. (a + b)*x + (a - b)*y = s and ((a + b)*x + a)*((a - b)*y + b) = p and x > a")
    right = step_of(asked)
    assert right is not None and accepted(right)
    monkeypatch.setattr(named_form._Quadratic, "moved", lambda self, shift: self)
    monkeypatch.setattr(named_form, "_shift", lambda found: found.slope.ring.var("a"))
    broken = step_of(asked)
    assert broken is not None
    assert not accepted(broken)
