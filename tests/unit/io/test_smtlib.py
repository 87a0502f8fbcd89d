"""SMT-LIB: what terms and scripts mean, what is refused and where, and scripts that solvers read."""

from fractions import Fraction
from itertools import product

import pytest

import qe
from qe.errors import InputError, ParseError
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Atom, Relation
from qe.io import smtlib
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.smtlib_parser import parse
from qe.io.smtlib_terms import Terms
from qe.io.smtlib_words import Macro, is_real
from qe.io.text import read as text
from tests.tables import each
from tests.unit.io.failing import fail


def made(real: str = "x y z", boolean: str = "p q") -> Terms:
    terms = Terms(fail)
    for sort, names in (("Real", real), ("Bool", boolean)):
        for name in names.split():
            terms.globals[name] = terms.variable(terms.fresh(name), sort, 0)
    return terms


def formula(text: str) -> s.Node:
    terms = made()
    return terms.formula(parse(text, fail)[0], terms.globals)


POINTS = [dict(zip("xyzpq", point)) for point in product((-1, 2), (0, 2), (1, 2), (0, 1), (0, 1))]


@each(
    ("(< x y z)", lambda x, y, z, p, q: x < y < z),
    ("(= x y z)", lambda x, y, z, p, q: x == y == z),
    ("(distinct x y z)", lambda x, y, z, p, q: len({x, y, z}) == 3),
    ("(distinct p q)", lambda x, y, z, p, q: p != q),
    ("(distinct p q true)", lambda x, y, z, p, q: False),
    ("(= p q (> x 0))", lambda x, y, z, p, q: p == q == (x > 0)),
    ("(xor p q (< x 0))", lambda x, y, z, p, q: (p + q + (x < 0)) % 2 == 1),
    ("(=> p q (< x 0))", lambda x, y, z, p, q: not p or not q or x < 0),
    ("(and p (or q (not p)))", lambda x, y, z, p, q: p and q),
    ("(ite p q (< x 0))", lambda x, y, z, p, q: q if p else x < 0),
    ("(> (ite p x y) 1)", lambda x, y, z, p, q: (x if p else y) > 1),
    ("(= (- x y z) (- 3))", lambda x, y, z, p, q: x - y - z == -3),
    ("(= (+ x) (* x 1 1))", lambda x, y, z, p, q: True),
    ("(> (/ x y z) 0)", lambda x, y, z, p, q: y * z != 0 and x * y * z > 0),
    ("(= (^ x 2) 4.0)", lambda x, y, z, p, q: x * x == 4),
    ("(> (max x y z) (min x 1) (abs x))", lambda x, y, z, p, q: max(x, y, z) > min(x, 1) > abs(x)),
    ("(let ((x y) (y x)) (< x y))", lambda x, y, z, p, q: y < x),  # at once
    ("(let ((x y)) (let ((x z)) (< x y)))", lambda x, y, z, p, q: z < y),
    ("(let ((true q)) true)", lambda x, y, z, p, q: q),
    ("(! (< x y) :named n)", lambda x, y, z, p, q: x < y),
    ("(to_real p)", None),
    ("(= (to_real x) 2)", lambda x, y, z, p, q: x == 2),
)
def test_what_a_term_means(text: str, meaning: object) -> None:
    if meaning is None:
        with pytest.raises(InputError, match="9: a term of sort Real expected, one of sort Bool"):
            formula(text)
        return
    lowered = lower(formula(text), fail)
    for point in POINTS:
        full = {**point, **{name: 0 for name in lowered.free if name not in point}}
        assert holds_at(lowered, full) == bool(meaning(**point)), (text, point)  # type: ignore[operator]


@each(
    ("(and x p)", "5: a term of sort Bool expected, one of sort Real found"),
    ("(< x p)", "5: a term of sort Real"),
    ("(= p x)", "5: a term of sort Bool"),
    ("(< x)", "1: < needs two arguments"),
    ("(not p q)", "1: not takes one argument"),
    ("(ite p x q)", "9: a term of sort Real"),
    ("(ite p x)", "0: 3 arguments expected, 2 found"),
    ("(+)", "0: + without arguments"),
    ("(x 1)", "1: x takes no arguments"),
    ("(abs x y)", "1: abs does not take 2 arguments"),
    ("(> (div x 2) 0)", "4: div needs integers"),
    ("(> (sin x) 0)", "4: sin is not algebraic"),
    ("(> (f x) 0)", "4: the function f is not supported"),
    ("u", "0: the symbol u is not declared"),
    (":key", "0: unexpected :key"),
    ("()", "0: an operator expected after '('"),
    ("((f) x)", "0: an operator expected"),
    ("(exists () p)", "8: a quantifier without variables"),
    ("(exists ((u)) p)", "9: (name sort) expected"),
    ("(exists ((u Int)) p)", "12: sort Real or Bool expected, Int found; all numbers are real here"),
    ("(exists ((u (Array))) p)", "12: sort Real or Bool expected, (Array) found"),
    ("(exists u p)", "8: a list of sorted variables expected"),
    ("(exists ((1 Real)) p)", "10: a symbol expected"),
    ("(let u p)", "5: a list of bindings expected"),
    ("(let ((u)) p)", "6: (name term) expected"),
    ("(!)", "0: a term expected"),
)
def test_what_is_refused_and_where(text: str, said: str) -> None:
    with pytest.raises(InputError) as error:
        formula(text)
    assert str(error.value).startswith(said)


def test_macros_keep_the_scope_of_their_definition() -> None:
    terms = made()
    body = parse("(+ u x)", fail)[0]
    terms.globals["f"] = Macro([("u", "Real")], "Real", body, dict(terms.globals))
    expression = parse("(let ((x z)) (= (f y) (f x)))", fail)[0]
    lowered = lower(terms.formula(expression, terms.globals), fail, names=terms.names, shared=terms.shared)
    assert str(lowered) == "y = z"  # x + y = x + z, with the x outside
    for term, said in (("f", "f needs 1 arguments"), ("(f)", "1 arguments expected"), ("(f p)", "sort Real expected")):
        with pytest.raises(InputError, match=said):
            terms.meaning(parse(term, fail)[0], terms.globals)


def test_bound_variables_get_names_of_their_own() -> None:
    terms = made()
    node = terms.formula(parse("(exists ((x Real) (|| Bool)) (forall ((x Real)) (< x y)))", fail)[0], terms.globals)
    assert isinstance(node, s.Quantification) and node.names == ["x_1", "v"] and terms.bound == {"x_1", "v", "x_2"}
    terms.reserved.add("w")
    assert terms.fresh("w") == "w_1" and terms.fresh("w") == "w_2"


def test_boolean_variables_are_positive_numbers() -> None:
    assert str(lower(formula("p"), fail)) == "p > 0"
    assert not is_real(s.Truth(True)) and is_real(s.Number(1))


def test_algebraic_numbers_of_models() -> None:
    """The second root of x^2 - 2, whatever x is outside."""
    lowered = lower(formula("(< (root-obj (- (^ x 2) 2) 2) y)"), fail)
    assert holds_at(lowered, {"x": 0, "y": 2, "s1": 0}) and not holds_at(lowered, {"x": 0, "y": 1, "s1": 0})


def test_names_of_formulas_are_definitions() -> None:
    terms = made()
    terms.meaning(parse("(! (< x y) :pattern p :named n)", fail)[0], terms.globals)
    assert str(lower(terms.formula(parse("(not n)", fail)[0], terms.globals), fail)) == "x >= y"


X = "(declare-const x Real)(declare-fun y () Real)(declare-const p Bool)"


@each(
    ("(> x 1.5)", "x > 3/2"),
    ("(= (* 2 x y) (/ 1 3) )", "6*x*y = 1"),
    ("(< x y 3)", "x < y and y < 3"),
    ("(<= (- x) (- 3) (- x y 1))", "x >= 3 and x + 2 >= y"),
    ("(distinct x y 0)", "x /= y and x /= 0 and y /= 0"),
    ("(=> (> x 0) (> y 0) (> x y))", "x <= 0 or y <= 0 or x > y"),
    ("(not (or (> x 0) (< y 0)))", "not (x > 0 or y < 0)"),
    ("(xor (> x 0) true)", "x <= 0"),
    ("(let ((a (+ x 1)) (x 5)) (> a x))", "x > 4"),
    ("(let ((x y) (y x)) (> x (* 2 y)))", "2*x < y"),
    ("(exists ((x Real)) (> x y))", "ex x_1. y < x_1"),
    ("(let ((a x)) (exists ((x Real)) (> x a)))", "ex x_1. x < x_1"),
    ("(forall ((u Real) (q Bool)) (=> q (> u 0)))", "all u, q. q <= 0 or u > 0"),
    ("(and p (not p))", "p > 0 and p <= 0"),
    ("(! (> x 0) :named first)", "x > 0"),
    ("(> (ite (> x 0) x (- x)) 1)", "x > 0 and x > 1 or x <= 0 and x < -1"),
    ("(ite (> x 0) (> y 0) (< y 0))", "(x <= 0 or y > 0) and (x > 0 or y < 0)"),
    ("(= (> x 0) (> y 0) )", "(x <= 0 or y > 0) and (y <= 0 or x > 0)"),
    ("true", "true"),
)
def test_terms(term: str, printed: str) -> None:
    assert str(smtlib.read(f"{X}(assert {term})")) == printed


def chain(step: str, count: int, last: str) -> str:
    """A script in which each of the definitions is made of the one before."""
    steps = "".join(f"(let ((y{i + 1} (+ y{i} {step.format(i)})))" for i in range(count))
    return f"(declare-const x Real)(assert (let ((y0 x)) {steps}(> y{count} {last}){')' * count}))"


SCRIPT = """
    ; a comment
    (set-logic QF_NRA) (set-info :status sat) (set-option :produce-models true)
    (declare-const |my name| Real)
    (define-const c Real (/ 1 2))
    (define-fun square ((t Real)) Real (* t t))
    (define-fun near ((a Real) (b Real)) Bool (< (square (- a b)) c))
    (assert (near |my name| 2))
    (assert (> |my name| 0))
    (check-sat) (get-model) (echo "done")
    (exit)
    (push 1)
"""


@each(
    {
        "a whole script": (SCRIPT, "2*`my name`^2 - 8*`my name` + 7 < 0 and `my name` > 0"),
        "a definition does not capture": (
            "(define-fun below ((x Real)) Bool (exists ((y Real)) (< x y)))(declare-const y Real)(assert (below y))",
            "ex y_1. y < y_1",
        ),
        "long chains of definitions": (chain("1", 500, "0"), "x > -500"),
        "shared definitions are evaluated once": (chain("y{}", 60, f"(* {2**60} 3)"), "x > 3"),
    }
)
def test_scripts(script: str, printed: str) -> None:
    assert str(smtlib.read(script)) == printed


@each(
    ("(assert", 1, 1, "never closed"),
    ("(assert true))", 1, 14, "no partner"),
    ("\n(push 1)", 2, 2, "push is not supported"),
    ("(declare-const x Int)", 1, 18, "Real or Bool"),
    ("(declare-fun f (Real) Real)", 1, 16, "without arguments"),
    ("(declare-const x Real)(assert (> x z))", 1, 36, "z is not declared"),
    ("(declare-const x Real)(assert (sin x))", 1, 32, "sin is not algebraic"),
    ("(declare-const x Real)(assert (> x (mod x 2)))", 1, 37, "needs integers"),
    ("(define-fun-rec f ((x Real)) Real (f x))", 1, 2, "recursive"),
    ("(declare-sort U 0)", 1, 2, "Real and Bool"),
    ("(declare-const x Real)(assert (+ x 1))", 1, 31, "sort Bool expected"),
    ("(declare-const x Real)(assert (and x))", 1, 36, "sort Bool expected"),
    ("(assert (> true 1))", 1, 12, "sort Real expected"),
    ("(assert (> 1x 2))", 1, 12, "malformed number"),
    ("(check-sat)(assert true)", 1, 12, "one question"),
    ("(declare-const x Real)(declare-const x Real)", 1, 38, "twice"),
    ("(assert (> |x 1))", 1, 12, "never closed"),
    ("x", 1, 1, "a command in brackets"),
    ("(frobnicate)", 1, 2, "not supported"),
    ("(assert true true)", 1, 1, "1 arguments expected"),
    ("(assert (exists () true))", 1, 17, "without variables"),
    ("(assert (> #b1 0))", 1, 12, "unexpected"),
)
def test_mistakes(script: str, line: int, column: int, part: str) -> None:
    with pytest.raises(ParseError) as caught:
        smtlib.read(script, source="file.smt2")
    assert part in str(caught.value)
    assert "\n" not in str(caught.value)
    assert (caught.value.line, caught.value.column) == (line, column)


def test_many_case_distinctions() -> None:
    product = " ".join(["(ite (> x 0) x 2)"] * 12)
    formula = smtlib.read(f"{X}(assert (= (* {product}) 4096))")
    assert [holds_at(formula, {"x": x}) for x in (-1, 0, 1, 2)] == [True, True, False, True]
    sums = " ".join(f"(ite (> {name} 0) {name} (- {name}))" for name in "abcdefgh")
    declared = "".join(f"(declare-const {name} Real)" for name in "abcdefgh")
    assert len(str(smtlib.read(f"{declared}(assert (< (+ {sums}) 1))"))) < 30_000


def test_division_by_zero_has_a_value_that_nothing_is_known_of() -> None:
    formula = smtlib.read("(declare-const x Real)(declare-const y Real)(assert (distinct (/ x 0) (/ y 0)))")
    assert holds_at(qe.eliminate(formula).formula, {"x": 1, "y": 2})
    assert not holds_at(qe.eliminate(formula).formula, {"x": 2, "y": 2})
    with pytest.raises(InputError, match="any function of x"):
        smtlib.read("(assert (forall ((x Real)) (= (/ x 0) x)))")


def test_too_deep_is_said() -> None:
    with pytest.raises(ParseError, match="deep"):
        smtlib.read(f"{X}(assert {'(not (and p ' * 1500}p{'))' * 1500})")


def test_writing() -> None:
    written = smtlib.write(text("ex y. 2*x^2*y <= 5 and not x = 0"))
    assert written == (
        "(set-logic NRA)\n(declare-const x Real)\n"
        "(assert (exists ((y Real)) (and (<= (+ (* 2 x x y) (- 5)) 0) (not (= x 0)))))\n"
    )
    assert "QF_NRA" in smtlib.write(text("x > 0"))


@each("and", "pi", "e", "sin", "x'", "a b", "ä", "_", "let", "Real", "is_int", ".x", "1x", "@y", "declare-x")
def test_scripts_with_any_name_are_read_by_z3(name: str) -> None:
    z3 = pytest.importorskip("z3")
    formula = atom(Ring.of((name, f"v_{name}")).gen(0) - Ring.of((name, f"v_{name}")).gen(1), Relation.GT)
    written = smtlib.write(formula)
    (term,) = z3.parse_smt2_string(written)
    assert term.num_args() == 2
    again = smtlib.read(written)
    assert len(again.free) == 2, "no two names become one"
    first, second = (n for n in again.free)
    assert holds_at(again, {first: 1, second: 0}) != holds_at(again, {first: 0, second: 1})


def test_z3_agrees_at_points() -> None:
    z3 = pytest.importorskip("z3")
    formula = text("x^3 - 2*x*y <= 1/3 and (y /= x or not (x < 0 and y > 2))")
    (term,) = z3.parse_smt2_string(smtlib.write(formula))
    for x in (-2, -1, 0, 1, 3):
        for y in (Fraction(-1, 2), 0, 3):
            values = [(z3.Real("x"), z3.RealVal(x)), (z3.Real("y"), z3.RealVal(str(y)))]
            assert z3.is_true(z3.simplify(z3.substitute(term, *values))) is holds_at(formula, {"x": x, "y": y})


def test_a_mistake_behind_everything_else_is_told_with_its_place() -> None:
    """What is read has no places; they are looked for when there is a mistake."""
    text = "\n".join([X, *["(assert (> (* 2 x y) (- 3)))"] * 50, "(assert (or p ; here\n  (> (+ x (* y nobody)) 1)))"])
    with pytest.raises(ParseError, match="the symbol nobody is not declared") as caught:
        smtlib.read(text)
    assert (caught.value.line, caught.value.column) == (53, 16)


def test_an_unknown_symbol_between_bars_is_said_without_them() -> None:
    with pytest.raises(ParseError, match="the symbol a b is not declared"):
        smtlib.read("(assert (> |a b| 0))")
    assert str(smtlib.read("(declare-const |x| Real)(declare-const |1| Real)(assert (> x |1| 1))")) == (
        "x > `1` and `1` > 1"
    )


def test_linear_forms_of_many_names_are_read_without_a_value_in_flint() -> None:
    declared = "".join(f"(declare-const x{i} Real)" for i in range(40))
    script = f"{declared}(assert (<= (+ (* 2 x3) (- x39 (* (/ 2 3) x5)) 7) (* 4 (- x3 1))))"
    formula = smtlib.read(script)
    assert isinstance(formula, Atom) and "p" not in formula.poly.__dict__
    assert str(formula) == "6*x3 + 2*x5 >= 3*x39 + 33"
    assert smtlib.read(f"{script} ; (a comment)") == formula  # which is read by another way than blanks
    with pytest.raises(ParseError, match="malformed number"):
        smtlib.read(script.replace("7", "7x"))
