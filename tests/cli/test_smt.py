"""``qe smt`` as a solver: what it answers to every command, and pySMT driving it through pipes."""
# ruff: noqa: E501

from __future__ import annotations

import itertools
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import cast

import pytest

import qe
from qe.cli.smt import Solver
from qe.io.smtlib_parser import Expression, parse
from qe.io.smtlib_script import Script
from qe.io.text_errors import Failing
from tests.tables import each

QE = Path(sys.executable).with_name("qe")
XY = "(declare-fun x () Real)(declare-const y Real)(declare-const p Bool)"


def answers(script: str, *, timeout: float | None = None) -> list[str]:
    lines: list[str] = []
    Solver(lines.append, lines.append, timeout=timeout).run([script], "<test>")
    return lines


@each(
    ("(assert (> x 0))(check-sat)(assert (< x 0))(check-sat)", ["sat", "unsat"]),
    ("(push)(assert (= (* x x) (- 1)))(check-sat)(pop)(check-sat)", ["unsat", "sat"]),
    ("(push 2)(assert false)(pop)(check-sat)(pop)(check-sat)", ["sat", "sat"]),
    ("(assert (= x 1))(check-sat-assuming ((= x 2)))(check-sat)", ["unsat", "sat"]),
    ("(assert (> x 0))(reset-assertions)(declare-const x Real)(assert (< x 0))(check-sat)", ["sat"]),
    ("(assert false)(reset)(check-sat)", ["sat"]),
    (
        "(assert (= (* 2 x) 1))(check-sat)(get-value (x (+ x y) p (> x 0)))",
        ["sat", "((x (/ 1.0 2.0)) ((+ x y) (/ 1.0 2.0)) (p false) ((> x 0) true))"],
    ),
    (
        "(assert p)(assert (= x (- 3)))(check-sat)(get-model)",
        [
            "sat",
            "(\n  (define-fun x () Real (- 3.0))\n  (define-fun y () Real 0.0)\n  (define-fun p () Bool true)\n)",
        ],
    ),
    (
        "(assert (and (= (* x x) 2) (< x 0)))(check-sat)(get-value (x (* x x)))",
        ["sat", "((x (root-obj (+ (^ x 2) (- 2)) 1)) ((* x x) 2.0))"],
    ),
    (
        "(assert (= x (root-obj (+ (^ x 2) (- 2)) 1)))(assert (= (* x x) y))(check-sat)(get-value (y))",
        ["sat", "((y 2.0))"],
    ),
    (
        "(assert (! (> x 0) :named a))(assert (! (> y 0) :named b))(assert (! (< x 0) :named |c d|))(check-sat)(get-unsat-core)",
        ["unsat", "(a |c d|)"],
    ),
    ("(check-sat-assuming (p (> x 0) (not p)))(get-unsat-assumptions)", ["unsat", "(p (not p))"]),
    ("(assert (= x 1))(check-sat (= x 2))(check-sat p (= x 1))", ["unsat", "sat"]),  # z3's; they were passed over
    ("(get-qe (exists ((z Real)) (= (* z z) x)))", ["(>= x 0)"]),
    ("(assert (> x 0))(get-assertions)", ["((> x 0))"]),
    (
        '(echo "a b")(get-info :name)(get-info :assertion-stack-levels)',
        ['"a b"', '(:name "bezier-qe")', "(:assertion-stack-levels 0)"],
    ),
    ("(set-option :print-success true)(set-logic QF_NRA)(push)", ["success", "success", "success"]),
    ("(check-sat-using qfnra)", ["check-sat-using: tactics are not used, the answer is that of check-sat", "sat"]),
    ("(declare-const || Real)(assert (= || 1))(check-sat)(get-value (||))", ["sat", "((|| 1.0))"]),
    ("(declare-const d.g Real)(declare-const x!0 Real)(assert (< d.g x!0))(check-sat)", ["sat"]),
    ("(exit)(check-sat)", []),
    ("(assert (= (/ x 0) 1))(assert (= (/ y 0) 2))(assert (= x y))(check-sat)", ["unsat"]),
    ("(assert (= (/ x 0) 1))(assert (= (/ y 0) 2))(check-sat)", ["sat"]),
    (
        "(assert (= (/ 1 y) 3))(assert (= y 0))(check-sat)(get-value ((/ 1 y) (/ 1 0)))",
        ["sat", "(((/ 1 y) 3.0) ((/ 1 0) 3.0))"],
    ),
    ("(assert (>= (/ y 0) 1))(check-sat)(get-value ((/ y 0) y))", ["sat", "(((/ y 0) 1.0) (y 0.0))"]),
    (
        "(assert (= (/ (ite (distinct y 3) 3 y) 0) 5))(assert (= y 3))(check-sat)(get-value ((/ (ite (distinct y 3) 3 y) 0)))",
        ["sat", "(((/ (ite (distinct y 3) 3 y) 0) 5.0))"],
    ),
    ("(assert (distinct (/ 1 (- x x)) (/ 1 0)))(check-sat)", ["unsat"]),
    ("(assert (forall ((z Real)) (= z (/ 0 0))))(check-sat)", ["unsat"]),
    ("(assert (forall ((z Real)) (= z (/ z 0))))(check-sat)", ["sat"]),
    ("(assert (exists ((z Real)) (distinct (/ z 0) (/ z 0))))(check-sat)", ["unsat"]),
    ("(assert (forall ((z Real)) (> (/ z z) 0)))(check-sat)", ["sat"]),
    ("(assert (forall ((z Real)) (= (/ z 0) (* z z))))(check-sat)", ["unknown"]),
    ("(assert (forall ((z Real)) (= (/ z 0) y)))(check-sat)(get-value ((/ 1 0)))", ["sat", "(((/ 1 0) 0.0))"]),
    (
        "(assert (= (sqrt x) 2))(assert (> x 0))(check-sat)(get-value (x (sqrt x)))",
        ["sat", "((x 4.0) ((sqrt x) 2.0))"],
    ),
)
def test_answers(script: str, expected: list[str]) -> None:
    assert answers(XY + script) == expected


@each(
    ("(declare-const n Int)", "Real or Bool expected, Int found; all numbers are real here"),
    ("(declare-fun f (Real) Real)", "only functions without arguments"),
    ("(assert (> (tanh 1) 0))", "not algebraic"),
    ("(assert (> x (mod 5 2)))", "needs integers"),
    ("(get-model)", "no model"),
    ("(get-unsat-core)", "no refutation"),
    ("(pop)", "only 0 levels"),
    ("(push x)", "a number of levels"),
    ("(frobnicate)", "is not supported"),
    ("(assert-soft (> x 0))", "assert-soft is not supported"),
    ("(define-fun-rec f () Real 1)", "recursive"),
    ("(assert (> x", "never closed"),
    ("(assert (> x 0)))", "no partner"),
    ("(assert (> x #b1))", "unexpected"),
)
def test_what_is_refused(script: str, part: str) -> None:
    (line,) = answers(XY + script)
    assert line.startswith('(error "') and part in line and "\n" not in line


def test_after_an_assertion_that_was_not_understood_the_answer_is_never_sat() -> None:
    script = XY + "(push)(assert (> (tanh x) 2)){}(check-sat)(pop)(check-sat)"
    assert answers(script.format(""))[1:] == ["unknown", "sat"]
    assert answers(script.format("(assert (< x x))"))[1:] == ["unsat", "sat"]


@each(
    ("(declare-const n Int)(assert (> n 0))(check-sat)(assert (< n 0))(check-sat)", ["unknown", "unsat"]),
    ("(declare-const n Int)(assert (or (> n 0) (> x 1)))(assert (< x 5))(check-sat)", ["sat"]),
    ("(declare-fun f (Real Int) Bool)(assert (or (f x 1) (> x 1)))(check-sat)", ["sat"]),
    ("(declare-fun f (Real) Real)(assert (> (f 1) 0))(assert (< (f 1) 0))(check-sat)", ["unsat"]),
    ("(assert (xor p (< (tanh 1) x)))(check-sat)", ["sat"]),
    ("(assert (= x (tanh 1)))(check-sat)", ["sat"]),  # whatever tanh(1) is
    ("(assert (= x (tanh x)))(check-sat)", ["unknown"]),
    ("(assert (= x (tanh y)))(check-sat)", ["unknown"]),  # x is chosen before the value is known
    ("(define-fun t () Real (tanh 1))(assert (and (> x t) (< x (+ t 1))))(check-sat)", ["sat"]),
    ("(assert (forall ((z Real)) (or p (> (tanh z) 2))))(check-sat)", ["unknown"]),
    ("(push)(assert (> x (tanh 1)))(pop)(declare-const unread Real)(assert (< unread 0))(check-sat)", ["sat"]),
    ("(push)(declare-const n Int)(pop)(declare-const n Real)(assert (< n 0))(check-sat)", ["sat"]),
    ("(assert (> x (to_int y)))(push)(assert (< x (to_int y)))(check-sat)(pop)(check-sat)", ["unsat", "unknown"]),
)
def test_values_that_are_not_read_may_be_any(script: str, expected: list[str]) -> None:
    assert [line for line in answers(XY + script) if not line.startswith("(error")] == expected


@each(
    (["(declare-const x Real)(assert (< 1. x (/ 3. 2.)))(check-sat)"], ["sat"]),
    (["(declare-const x Real)(assert (= x 1.x))(check-sat)"], ["column 36: malformed", "unknown"]),
    (["(assert (> 1/2 0))\n", "(check-sat)\n", "(exit)\n"], ["column 12: malformed", "unknown"]),
    (["(push)\n (check-sat) # (echo a)(check-sat)"], ["sat", "line 2 column 14: unknown character", "a", "sat"]),
    (["(check-sat))\n", "(echo b)\n"], ["sat", "column 12: unbalanced", "b"]),
    (["\ufeff(check-sat)\n", "(foo)"], ["sat", "line 2 column 1"]),
    (["(echo |a\n", "b|)(check-sat)\n"], ["|a b|", "sat"]),
    (["(assert (< -x 0))(assert (x > 1))"], ["the symbol -x is not declared", "is not supported"]),
    (["(maximise (* x x))"], ["the command maximise is not supported"]),
    (["(declare-const x Real)(assert (x > 1))"], ["stands first: (> x …)"]),
    (["(declare-const x (_ BitVec 8))"], ["(_ BitVec 8) found"]),
)
def test_after_text_that_cannot_be_read_the_next_command_is_answered(lines: list[str], expected: list[str]) -> None:
    found: list[str] = []
    Solver(found.append, found.append).run(lines, "-")
    found = [line.replace("\n", " ") for line in found]
    assert len(found) == len(expected), found
    assert all(part in line for part, line in zip(expected, found, strict=True)), found


def test_a_sign_or_a_point_may_begin_a_number() -> None:
    """``-2`` and ``.5`` are symbols for the standard and numbers for most who type them; declared ones stay symbols."""
    ask = "(assert (= x (+ -2 (* -1.5 .5))))(check-sat)(eval (- x))(eval (< x -2))(get-value (x))"
    assert answers("(declare-const x Real)" + ask) == ["sat", "(/ 11.0 4.0)", "true", "((x (- (/ 11.0 4.0))))"]
    declared = "(declare-const -2 Real)(assert (> -2 0))(check-sat)"
    assert answers(declared) == ["sat"]
    assert qe.decide("(assert (< -2 .5))", format="smtlib")


def test_places_are_counted_through_all_lines() -> None:
    lines: list[str] = []
    Solver(lines.append, lines.append).run(
        ["(declare-const x Real)\n(assert\n", " (> x 0)) (check-sat)\n", "(foo)\n(assert z)\n"], "-"
    )
    assert lines[0] == "sat" and "line 5 column 9" in lines[2]


def test_a_limit_is_kept() -> None:
    hard = "".join(f"(declare-const a{k} Real)" for k in range(6))
    body = "(assert (> (+ {}) 0))".format(
        " ".join(f"(* a{k} a{k} a{k} a{(k + 1) % 6} a{(k + 3) % 6})" for k in range(6))
    )
    equal = "".join(
        f"(assert (= (* a{k} a{k} a{k}) (+ a{(k + 1) % 6} (* a{(k + 2) % 6} a{(k + 4) % 6}) {k})))" for k in range(6)
    )
    assert answers(hard + body + equal + "(check-sat)(get-info :reason-unknown)", timeout=0.5) == [
        "unknown",
        "(:reason-unknown timeout)",
    ]


def test_the_command(tmp_path: Path) -> None:
    script = tmp_path / "a.smt2"
    script.write_text("(declare-const x Real)(assert (> x 2))(check-sat)")
    run = subprocess.run(
        [QE, "smt", script, "-i"], input="(get-value (x))(bad)\n(exit)\n", capture_output=True, text=True, timeout=60
    )
    assert run.stdout.splitlines()[0] == "sat" and run.stdout.splitlines()[2].startswith('(error "')
    assert run.returncode == 2 and run.stderr == ""
    missing = subprocess.run([QE, "smt", tmp_path / "b.smt2"], capture_output=True, text=True, timeout=60)
    assert missing.returncode == 2 and missing.stderr.count("\n") == 1


def test_pysmt_drives_it() -> None:
    shortcuts = pytest.importorskip("pysmt.shortcuts")
    from pysmt.logics import QF_NRA

    environment = shortcuts.get_env()
    if "qe" not in environment.factory.all_solvers():
        environment.factory.add_generic_solver("qe", [str(QE), "smt", "-i"], [QF_NRA])
    x, y = (shortcuts.Symbol(name, shortcuts.REAL) for name in ("x", "y"))
    with shortcuts.Solver(name="qe", logic=QF_NRA) as solver:
        solver.add_assertion(shortcuts.Equals(shortcuts.Times(x, y), shortcuts.Real(Fraction(1, 2))))
        solver.add_assertion(shortcuts.GT(x, shortcuts.Real(2)))
        assert solver.solve()
        solver.push()
        solver.add_assertion(shortcuts.LT(y, shortcuts.Real(0)))
        assert not solver.solve()
        solver.pop()
        assert solver.solve()
        a, b = (Fraction(str(solver.get_value(symbol).constant_value())) for symbol in (x, y))
        assert a * b == Fraction(1, 2) and a > 2


def test_what_is_said_twice_is_read_once_also_after_pop() -> None:
    script = Script(Failing("", "<test>"))
    text = "(declare-const x Real)(assert (> (/ (abs x) 3) 1))(push)(assert (< (/ (abs x) 3) 2))(pop)(assert (< (/ (abs x) 3) 2))"
    sizes = []
    for command in parse(text, script.fail):
        match script.head(command):
            case "push":
                script.push(1)
            case "pop":
                script.pop(1, command)
            case _:
                script.change(cast(list[Expression], command))
        sizes.append(len(script.shared))
    assert sizes[1] > 2
    assert [size - sizes[1] for size in sizes[1:]] == [0, 0, 1, 0, 1]
    assert answers(text + "(check-sat)") == ["sat"]


def test_values_of_one_command_were_mixed_up_when_terms_had_the_place_of_others_that_were_gone() -> None:
    """Terms are known by their identities while they are evaluated, and Python gives these to others later."""
    truth = [k >= 20 and k % 2 == 0 for k in range(60)]
    asked = [f"(ite (< {k} x) false {'true' if k % 2 == 0 else 'p'})" for k in range(60)]
    script = f"{XY}(assert (= x 20))(assert (not p))(check-sat)(get-value ({' '.join(asked)}))"
    shown = " ".join(f"({term} {'true' if value else 'false'})" for term, value in zip(asked, truth, strict=True))
    assert answers(script) == ["sat", f"({shown})"]


def test_the_core_of_a_check_with_assumptions_named_what_could_be_left_out() -> None:
    """The assumptions of the check hold for its core."""
    script = f"{XY}(assert (! (> x 0) :named a))(assert (! (> y 0) :named b))"
    assert answers(f"{script}(check-sat-assuming ((< x 0)))(get-unsat-core)") == ["unsat", "(a)"]


@each(("(", "("), ("(", "(\n"), ('("', "a\n"), ("(|", "a\n"), ("(", " "))
def test_a_command_without_an_end_is_not_read_for_ever(first: str, rest: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each line was looked through with all lines before it, and no limit held for what never ends."""
    monkeypatch.setattr("qe.cli.smt.MOST_BYTES", 5_000)
    lines: list[str] = []
    solver = Solver(lines.append, lines.append)
    solver.run(itertools.chain([first], itertools.repeat(rest)), "<test>")
    assert solver.failed and len(lines) == 1 and "has no end within the limits" in lines[0]


@pytest.mark.parametrize("limit", [("--timeout", "60"), ("--memory", "1000")])
def test_a_script_under_a_limit_is_answered(tmp_path: Path, limit: tuple[str, str]) -> None:
    """It was unknown: what watches over reading holds streams, which cannot be sent to the worker."""
    script = tmp_path / "a.smt2"
    script.write_text("(declare-const x Real)(assert (> (* x x) 2))(check-sat)")
    done = subprocess.run([QE, "smt", script, *limit], capture_output=True, text=True, timeout=120)
    assert (done.stdout, done.stderr) == ("sat\n", "")


@each(
    (XY + "(assert (<= (+ (* x x) (* y y)) 2))(minimize (+ x y))(check-sat)(get-objectives)", "((+ x y) (- 2.0))"),
    (
        XY + "(assert (<= (+ x y) 10))(assert (<= 1 y 3))(maximize (+ x (* 2 y)) :id o)(maximize y)(check-sat)"
        "(get-objectives)(get-value (x y))",
        "((+ x (* 2 y)) 13.0) (y 3.0) ) ((x 7.0) (y 3.0))",
    ),
    (XY + "(assert (= (* x x) 2))(maximize x)(check-sat)(get-objectives)", "(x (root-obj (+ (^ x 2) (- 2)) 2))"),
    (XY + "(assert (> x 1))(minimize x)(maximize y)(check-sat)(get-objectives)", "(x (+ 1.0 epsilon)) (y)"),
    (XY + "(maximize x)(check-sat)(get-objectives)", "(x oo)"),
    (
        "(set-option :opt.priority box)" + XY + "(assert (> x 1))(minimize x)(maximize y)(check-sat)(get-objectives)",
        "(x (+ 1.0 epsilon)) (y oo)",
    ),
    (XY + "(push)(maximize x)(pop)(check-sat)(get-objectives)", "sat (objectives )"),
    (XY + "(assert (< x x))(maximize x)(check-sat)", "unsat"),
    (XY + "(maximize (= x y))", "a term over the reals expected"),
    (XY + "(get-objectives)", "no model is at hand"),
)
def test_objectives(script: str, expected: str) -> None:
    assert expected in " ".join(" ".join(answers(script)).split())


@pytest.mark.parametrize(
    ("asserted", "answer", "loaded"),
    (
        ("(> (* x x) y 1)", "sat", False),
        ("(= x (+ y 1))", "sat", True),
        ("(> 0 (+ (* x x) (* y y)))", "unsat", True),
    ),
)
def test_where_a_simple_point_will_do_no_engine_is_loaded(
    asserted: str, answer: str, loaded: bool, tmp_path: Path
) -> None:
    script = tmp_path / "simple.smt2"
    script.write_text(f"(declare-const x Real)(declare-const y Real)(assert {asserted})(check-sat)")
    lines = (f"main(['smt', {str(script)!r}])", "print('qe.engine.run' in sys.modules)")
    ran = subprocess.run(
        [sys.executable, "-c", "\n".join(("import sys", "from qe.cli.app import main", *lines))],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert ran.stdout.split() == [answer, str(loaded)]
