"""Parts that are used again and again: named instead of written out, and limits that hold where they are not."""

from __future__ import annotations

import pytest

import qe
from qe.cli.smt import Solver
from qe.errors import Unable
from qe.formula.weight import written_out
from qe.io import surface as s
from qe.io.sharing import named, ordered, refuse_long
from qe.io.text import read
from tests.tables import each

ATOMS = [f"(> x {k})" for k in range(40)]
X = "(declare-const x Real)(declare-const y Real)"


def chain(step: str, start: str, count: int, end: str) -> str:
    """An assertion with ``count`` definitions, each of the one before (``@``)."""
    lets = "".join(f"(let ((v{k + 1} {step.replace('@', f'v{k}')})) " for k in range(count))
    return f"{X}(assert (let ((v0 {start})) {lets}{end.replace('@', f'v{count}')}{')' * count}))"


def answers(script: str, timeout: float | None = None) -> list[str]:
    lines: list[str] = []
    Solver(lines.append, lines.append, timeout=timeout).run([script], "<test>")
    return lines


@each(
    (f"{X}(assert (xor {' '.join(ATOMS)}))", "sat"),
    (f"{X}(assert (xor {' '.join(ATOMS)}))(assert (xor true {' '.join(reversed(ATOMS))}))", "unsat"),
    (f"{X}(assert (= (> x 50) (xor {' '.join(ATOMS)})))(assert (> x 60))", "unsat"),
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
    script = f"{X}(define-fun f0 ((a Real)) Real (+ a 1)){macros}(assert (> (f40 x) 0))(assert (< x 0))"
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
    found = answers(f"(set-info :status {status}){X}(assert (< (* x x) 0))(check-sat)(check-sat)")
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
