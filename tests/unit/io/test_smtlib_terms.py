"""The meaning of SMT-LIB terms: sorts, scopes, macros, and what is refused, with the offset."""

from __future__ import annotations

from itertools import product

import pytest

from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.smtlib_parser import parse
from qe.io.smtlib_terms import Macro, Terms, is_real
from tests.tables import each


def fail(message: str, at: int) -> InputError:
    return InputError(f"{at}: {message}")


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
    assert str(lowered) == "y - z = 0"  # x + y = x + z, with the x outside
    for text, said in (("f", "f needs 1 arguments"), ("(f)", "1 arguments expected"), ("(f p)", "sort Real expected")):
        with pytest.raises(InputError, match=said):
            terms.meaning(parse(text, fail)[0], terms.globals)


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
    assert str(lower(terms.formula(parse("(not n)", fail)[0], terms.globals), fail)) == "x - y >= 0"
