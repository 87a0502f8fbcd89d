"""Misuse, and what is shared between answers: one clear line, and nothing is mixed up."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy

import qe
from qe.cli.smt import Solver
from qe.errors import Unable
from qe.formula.features import written_out
from qe.io import surface as s
from qe.io.sharing import named, ordered, refuse_long
from qe.io.text import read
from tests.cli import command
from tests.tables import each

X, Y = sympy.symbols("x y")


@each(
    ("x == 1", "x = 1"),
    ("x**2 = 4", "x^2 = 4"),
    ("x² < 2 && y > 0", "x^2 < 2 and y > 0"),
    ("x > 0 & y > 0 | y < 1", "x > 0 and y > 0 or y < 1"),
    ("x > 0 || y > 0", "x > 0 or y > 0"),
    ("|x| < 1 | y > 0", "-1 < x < 1 or y > 0"),
    ("||x| - 1| < 2", "-3 < x < 3"),
    ("!(x > 0) && x != -1", "x <= 0 and x /= -1"),
    (".5*x > .25", "x > 1/2"),
    ("2x + 3(y - 1) > 5.", "2*x + 3*y > 8"),
    ("x in [0,1) && y in {1, 2}", "0 <= x and x < 1 and (y = 1 or y = 2)"),
    ("x > 0 AND NOT y > 0 OR FALSE", "x > 0 and y <= 0"),
    ("forall x: x^2 >= y", "y <= 0"),
    ("∃x: x² = y", "y >= 0"),
    ("exists x (x > 0 and x < y) and y < 3", "0 < y < 3"),
    ("∀x∈[0,1]: x*y <= 1", "y <= 1"),
    ("∃x∀y: x + y² > z", "true"),
    ("ForAll[{x}, x > 0, x y > 0]".replace("x y", "x*y"), "y > 0"),
    ("Exists[x, x^2 == y && Element[x, Reals]]", "y >= 0"),
    ("Implies[x > 0, Sqrt[x] < 2]", "x < 4"),
    ("ForAll[{x, y}, x^2 + y^2 <= 1, a x + 2 b y <= 1]", "a^2 + 4*b^2 <= 1"),
    ("ForAll[{x y}, x^2 + y^2 >= a]", "a <= 0"),
    ("And(x > 0, Or(y > 0, Not(x > 1)))", "x > 0 and (y > 0 or x <= 1)"),
    ("ex(x, a*x^2 + 1 = 0)", "a < 0"),
    (r"\exists x\colon x^2 = y", "y >= 0"),
    ("x implies y > 0".replace("x implies", "x > 0 implies"), "x <= 0 or y > 0"),
    ("x <> 1", "x /= 1"),
    ("1/x > 0", "x > 0"),
    ("x^(1/2) > 1", "x > 1"),
    ("√x > 1", "x > 1"),
    ("0.1 + 0.2 = x", "10*x = 3"),
    ("-oo < x < oo", "true"),
    ("i*k = 1", "k /= 0 and i = 1/k"),
    ("(E x)(A y)[x + y^2 >= b /\\ x < 1].", "b < 1"),
    ("(Ex)(x^2 = y) and x > 0", "y >= 0 and x > 0"),
    ("(∃x)(∀y)(x + y² > z)", "true"),
    ("all({x,y}, x**2 + y**2 >= a);", "a <= 0"),
    ("exists x in R. x^2 = a", "a >= 0"),
    ("ex x : Real. x^2 = a", "a >= 0"),
    ("forall x: R, x^2 >= a", "a <= 0"),
    ("∃ x ∈ ℝ, x² = a", "a >= 0"),
    ("∀ x > 0. x*a > 0", "a > 0"),
    ("forall x > 0, x*a > 0", "a > 0"),
    ("exists x >= .5: x = y", "2*y >= 1"),
    ("exists x >= 2. x = y", "y >= 2"),
    ("∀x∈[0,1], x*y <= 1", "y <= 1"),
    ("∀x∈[0,1] ∪ {3}: x*y <= 1", "3*y <= 1"),
    ("forall x, y, x + y > z", "false"),
    ("forall x, exists y, x + y = z", "true"),
    ("forall x, sqrt(x) >= y or x < 0", "y <= 0"),
    ("forall x, y (x^2 + y^2 >= z)", "z <= 0"),
    ("exists x such that x^2 = a", "a >= 0"),
    ("exists x s.t. x^2 = a", "a >= 0"),
    ("for all x: x^2 >= a", "a <= 0"),
    ("there exists x. x^2 = a", "a >= 0"),
    ("∀ε>0 ∃δ>0 ∀x (|x-a|<δ → |x²-a²|<ε)", "true"),
    ("∀ε>0 ∃δ>0 ∀x (|x|<δ → |x + b|<ε)", "b = 0"),
    ("x^2 < y => x < 3", "not x^2 < y or x < 3"),
    ("x not in [0,1]", "x < 0 or x > 1"),
    ("x ∉ (0,1]", "x <= 0 or x > 1"),
    ("x in [0,1] ∪ [2,3)", "0 <= x <= 1 or 2 <= x < 3"),
    ("[x >= 0, y >= 0]", "x >= 0 and y >= 0"),
    ("x =/= 1 and y =< 2", "x /= 1 and y <= 2"),
    (r"\[ x^2 \geq 1 \]", "x^2 >= 1"),
    ("x_{1}^{2} > 0", "x1 /= 0"),
    (r"x \notin [0, 1] \cup [2, 3]", "x < 0 or 1 < x < 2 or x > 3"),
    ("ABS(x) < MAX(1, y)", "abs(x) < max(1, y)"),
    ("∛x > 2", "x > 8"),
    ("x < inf", "true"),
    ("x > 0.", "x > 0"),
    ("x ≠ ½ and ⅓x < ¾", "2*x /= 1 and 4*x < 9"),
    ("¬(x<1 ∨ y≥2) ∧ ⊤", "x >= 1 and y < 2"),
    ("x > 0 ⟹ y > 0", "x <= 0 or y > 0"),
    ("x ∈ {1, 2, 3} ∖ {2}", "x = 1 or x = 3"),
    ("x ∈ [0,2] ∩ [1,3] ∪ {5}", "1 <= x <= 2 or x = 5"),
    ("exists x > 0, y > 0: x*y = a and x + y = b", "a > 0 and b > 0 and b^2 >= 4*a"),
    ("∃ x, y > 0: x*y = a ∧ x + y = b", "a > 0 and b > 0 and b^2 >= 4*a"),
    ("∀ x ∈ [0,1], y ∈ [0,1]: x + y ≤ a", "a >= 2"),
    ("there is x with x^2 = a", "a >= 0"),
    ("∄x: x² = a", "a < 0"),
    ("Inequality[0, Less, x, LessEqual, 1]", "0 < x <= 1"),
    ("Power[x, 2] < Times[2, y, z] + Plus[x, Rational[1, 2]]", "2*x^2 < 4*y*z + 2*x + 1"),
    ("all x. |x| >= 0", "true"),
    ("ex x. |x| < 0", "false"),
    ("|x - 1| < 2", "-1 < x < 3"),
    ("x > 0 | y > 0", "x > 0 or y > 0"),
    ("||x| - 1| > 0", "x /= 1 and x /= -1"),
    ("Element[a | b, Reals] && a > 0", "a > 0"),
    ("Element[{x, y}, {1, 2}]", "(x = 1 or x = 2) and (y = 1 or y = 2)"),
    ("Element[|x| | y, [0, 1]]", "|x| <= 1 and 0 <= y <= 1"),
    ("Element[x, Reals] | y > 0 && x/x = 1", "true"),
)
def test_the_answer_that_was_meant(typed: str, meant: str) -> None:
    assert qe.equivalent(typed, meant)


def test_a_list_holds_together() -> None:
    assert qe.equivalent(sympy.real_root(sympy.Symbol("x", real=True), 3) <= -1, "x <= -1")
    assert qe.equivalent([X > 0, sympy.Eq(X + Y, 1)], "x > 0 and x + y = 1")
    assert qe.equivalent(("x > 0", X < Y), "0 < x and x < y")
    assert qe.find_instance(["x > 2", "x < 3", ["x^2 = 5"]]) is not None
    assert str(qe.solve([X + Y > 0, Y < 1], X)) == "y < 1 and x > -y"
    assert qe.region(["x > 0", "x < 1"]).volume(0.5)
    for wrong in ([], [[]], ["x > 0", 3], [None]):
        with pytest.raises(qe.InputError):
            qe.eliminate(wrong)


@each(
    (lambda: qe.eliminate("sin(x) = 0"), "c^2 + s^2 = 1"),
    (lambda: qe.eliminate("exp(x) > 1"), "new variable"),
    (lambda: qe.eliminate("Exists[x, x > 0 And y > 1]"), "an operator is missing"),
    (lambda: qe.eliminate("2^x > 1"), "rational number"),
    (lambda: qe.eliminate("x => 1"), ">="),
    (lambda: qe.eliminate("1/2x > 1"), "1/(2*x)"),
    (lambda: qe.eliminate("2|x| > 1"), "2*|x|"),
    (lambda: qe.eliminate("x = y = "), "too early"),
    (lambda: qe.eliminate("2½ < x"), "one fraction: 5/2"),
    (lambda: qe.eliminate("xⁿ > 0"), "an exponent is a rational number"),
    (lambda: qe.eliminate("x ∈ ]0,1["), "(0, 1)"),
    (lambda: qe.eliminate("Inequality[0, Less, x, 1]"), "Inequality[0, Less, x, LessEqual, 1]"),
    (lambda: qe.eliminate("UnitStep[x] = 1"), "unknown function UnitStep"),
    (lambda: qe.eliminate("x^2^3 = 1"), "brackets"),
    (lambda: qe.eliminate("exists n in Z. n = x"), "all variables are real"),
    (lambda: qe.eliminate("ex x: Int. x > 0"), "all variables are real (as in ex x. …), Int cannot be asked for"),
    (lambda: qe.eliminate(r"\exists n \in \mathbb{Z} : n = x"), "all variables are real"),
    (lambda: qe.eliminate("0x10 < x"), "decimal"),
    (lambda: qe.eliminate("x = NaN"), "no number"),
    (lambda: qe.find("Pi*x > 1"), "pi is not algebraic"),
    (lambda: qe.Solver().minimize("pi*x"), "pi is not algebraic"),
    (lambda: qe.region("x^2 < pi"), "pi is not algebraic"),
    (lambda: qe.Solver().add("x > pi"), "pi is not algebraic"),
    (lambda: qe.comprehensive_groebner(["x - pi*a"], ["x"]), "pi is not algebraic"),
    (lambda: qe.variables("ℼ"), "it is a number"),
    (lambda: qe.eliminate("x > 0 xor y > 0"), "Xor(p, q)"),
    (lambda: qe.eliminate("let y = x^2 in y > 1"), "definitions are not read"),
    (lambda: qe.eliminate("x > 0 // why"), "a comment starts with #"),
    (lambda: qe.eliminate("x.y > 1"), "`a.b`"),
    (lambda: qe.eliminate("x[1] > 0"), "`x[1]`"),
    (lambda: qe.eliminate("'x > 0'"), "without quotes"),
    (lambda: qe.eliminate("f(x\n, y) = 1"), "unknown function f"),
    (lambda: qe.eliminate("floor(x) = 1"), "integers"),
    (lambda: qe.eliminate("x mod 2 = 1"), "an operator is missing"),
    (lambda: qe.eliminate(""), "empty"),
    (lambda: qe.eliminate("ex x. x + 1"), "a relation"),
    (lambda: qe.eliminate(X**2 == Y), "Eq"),
    (lambda: qe.eliminate(X), "Boolean combination"),
    (lambda: qe.eliminate(sympy.sin(X) > 0), "not algebraic"),
    (lambda: qe.eliminate(sympy.Symbol("n", integer=True) > 0), "integer"),
    (lambda: qe.eliminate(3), "Boolean combination"),
    (lambda: qe.eliminate(None), "formula: text, a Formula or a SymPy Boolean expected, None found"),
    (lambda: qe.eliminate("x > 0", format="maple"), "unknown format"),
    (lambda: qe.eliminate("x > 0", order="z"), "variables of the formula"),
    (lambda: qe.decide("x > 0"), "a sentence expected; free: x"),
    (lambda: qe.minimize("x^2 > 0", "true"), "a term expected"),
    (lambda: qe.solve("x < 1", "x x"), "variables: each name once"),
    (lambda: qe.eliminate("x < y", order="x x"), "order: each name once"),
    (lambda: qe.find_instance("x < 1", workers=-1), "workers: a natural number"),
    (lambda: qe.decide("ex x. x > 1", race="fastest"), "race: "),
    (lambda: qe.equivalent("x > 1", "x > 1", cluster="here"), "cluster: "),
    (lambda: qe.region("x > 0").contains({"y": 1}), "x"),
    (lambda: qe.variables("x") ** 2 == Fraction(1), "x.equals"),
    (lambda: qe.verify("abc"), "a Certificate expected"),
    (lambda: qe.eliminate("x > 0", timeout="10"), "timeout"),
    (lambda: qe.eliminate("x > 0", timeout=math.nan), "timeout"),
    (lambda: qe.decide("true", timeout=-1), "timeout"),
    (lambda: qe.decide("true", memory=math.inf), "memory"),
    (lambda: qe.region("x > 0", timeout=math.inf), "timeout"),
    (lambda: qe.region("x > 0").contains({"x": math.inf}), "exact number"),
    (lambda: qe.region("x > 0").contains(5), ""),
    (lambda: qe.eliminate("x^2 + y^2 < 1", order=(X, 5)), "order"),
    (lambda: qe.Certificate.from_json(5), ""),
    (lambda: qe.parametric_witnesses("true"), ""),
    (lambda: qe.RealAlgebraic.from_root([-2.5, 1], 0, 5), ""),
)
def test_one_line_that_helps(misuse: Callable[[], object], hint: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        misuse()
    assert any(part in str(caught.value) for part in hint.split("|")), str(caught.value)
    assert "\n" not in str(caught.value)


@each(
    (("--version",), 0, "qe 0"),
    ((), 0, "Usage"),
    (("eliminate", "x > 0", "--timeot", "3"), 2, "did you mean --timeout"),
    (("eliminate", "--ordr=x", "x > 0"), 2, "did you mean --order"),
    (("eliminat", "x > 0"), 2, "eliminate"),
    (("eliminate", "1/x > 0 and y = 1", "--total-division"), 0, "x >= 0"),
    (("decide", "all x. |x| >= 0"), 0, "true"),
    (("decide", "x > 0"), 2, "a sentence expected"),
)
def test_the_command(arguments: tuple[str, ...], code: int, part: str) -> None:
    run = command.run("qe", *arguments)
    assert run.returncode == code and part in run.stdout + run.stderr, (run.stdout, run.stderr)
    assert "Traceback" not in run.stderr


ATOMS = [f"(> x {k})" for k in range(40)]
ABOUT_X = "(declare-const x Real)(declare-const y Real)"


def chain(step: str, start: str, count: int, end: str) -> str:
    """An assertion with ``count`` definitions, each of the one before (``@``)."""
    lets = "".join(f"(let ((v{k + 1} {step.replace('@', f'v{k}')})) " for k in range(count))
    return f"{ABOUT_X}(assert (let ((v0 {start})) {lets}{end.replace('@', f'v{count}')}{')' * count}))"


def answers(script: str, timeout: float | None = None) -> list[str]:
    lines: list[str] = []
    Solver(lines.append, lines.append, timeout=timeout).run([script], "<test>")
    return lines


@each(
    (f"{ABOUT_X}(assert (xor {' '.join(ATOMS)}))", "sat"),
    (f"{ABOUT_X}(assert (xor {' '.join(ATOMS)}))(assert (xor true {' '.join(reversed(ATOMS))}))", "unsat"),
    (f"{ABOUT_X}(assert (= (> x 50) (xor {' '.join(ATOMS)})))(assert (> x 60))", "unsat"),
    (chain("(and @ (or @ (> y 1)))", "(> x 0)", 60, "@") + "(assert (< x 0))", "unsat"),
    (chain("(= @ (not (= @ (> y x))))", "(> x 0)", 60, "@"), "sat"),
    (chain("(+ @ @)", "x", 60, "(= @ 1)"), "sat"),
    (chain("(ite (> @ y) (- @ 1) (+ @ @))", "x", 30, "(> @ y)"), "sat"),
    (chain("(ite (> @ y) (- y @) (- @ y))", "x", 30, "(> @ 0)"), "unsat"),
)
def test_what_is_shared_is_not_written_out(script: str, expected: str) -> None:
    assert answers(script + "(check-sat)") == [expected]


def test_values_of_what_is_shared() -> None:
    script = chain("(xor @ (or @ (> y 1)))", "(> x 0)", 60, "@") + "(check-sat)"
    asked = chain("(xor @ (or @ (> y 1)))", "(> x 0)", 60, "@").partition("(assert ")[2][:-1]
    assert answers(f"{script}(get-value ({asked}))")[1].endswith(" true))")


def test_the_limit_holds_while_a_script_is_read() -> None:
    macros = "".join(f"(define-fun f{k + 1} ((a Real)) Real (f{k} (f{k} a)))" for k in range(40))
    script = f"{ABOUT_X}(define-fun f0 ((a Real)) Real (+ a 1)){macros}(assert (> (f40 x) 0))(assert (< x 0))"
    found = answers(f"{script}(check-sat)(get-info :reason-unknown)(check-sat)(echo done)", timeout=0.5)
    assert found == [
        '(error "unable: time limit reached while reading")',
        "unknown",
        "(:reason-unknown timeout)",
        "unknown",
        "done",
    ]


def test_a_limit_holds_below_quantifiers_too() -> None:
    asked = chain("(xor @ (= @ (> y z)) (> z @@))".replace("@@", "3"), "(> z 0)", 60, "@")
    script = asked.replace("(assert ", "(assert (forall ((z Real)) ") + ")(check-sat)"
    assert answers(script, timeout=5) == ["unknown"]


@each("sat", "unsat", "unknown")
def test_a_status_that_is_contradicted_is_said(status: str) -> None:
    found = answers(f"(set-info :status {status}){ABOUT_X}(assert (< (* x x) 0))(check-sat)(check-sat)")
    note = ["the script says :status sat, but the answer is unsat"] if status == "sat" else []
    assert found == [*note, "unsat", "unsat"]


def test_a_text_that_would_be_too_long_is_refused() -> None:
    answer = qe.eliminate("ex x. " + " <-> ".join(f"x > {k}" for k in range(40)), timeout=20)
    assert answer.formula is None and "written out" in answer.reason
    formula = read("x > 0")
    for k in range(60):
        other = read(f"y > {k}")
        formula = (formula & other) | (formula & ~other)
    assert written_out(formula)[0] > 2**60
    assert "written out" in qe.eliminate(formula).reason


# --- names ---------------------------------------------------------------------------------------------------
def positive(name: str) -> s.Node:
    return s.Comparison([s.Name(name, -1), s.Number(0)], [s.Relation.GT], -1)


def tower(start: s.Node, height: int) -> s.Node:
    for _ in range(height):
        start = s.Equivalence(start, positive("y"))
    return start


def test_small_questions_and_bound_variables_keep_their_parts() -> None:
    small, bound = tower(positive("x"), 3), tower(positive("z"), 40)
    assert named([small], [], (), lambda: "b").nodes == [small]
    found = named([s.Quantification(True, ["z"], bound)], [], {"z"}, lambda: "b")
    assert not found.names and found.nodes[0] == s.Quantification(True, ["z"], bound)
    partial = s.Comparison([s.Name("x", -1), s.Root(s.Number(1), s.Name("x", -1), "x", -1)], [s.Relation.EQ], -1)
    assert not named([tower(partial, 40)], [], (), lambda: "b").names


def test_names_make_a_tower_short() -> None:
    names = iter(f"b{k}" for k in range(100))
    found = named([tower(positive("x"), 40)], [], (), lambda: next(names))
    assert len(found.names) == len(found.definitions) > 5
    refuse_long(ordered([*found.definitions, *found.nodes]))
    with pytest.raises(Unable, match="written out"):
        refuse_long(ordered([tower(positive("x"), 40)]))
