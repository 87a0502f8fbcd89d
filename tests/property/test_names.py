"""Names: of variables, whatever they are, and terms named in formulas."""

from __future__ import annotations

import random
import re
import string
import time
from xml.etree import ElementTree

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import qe
from qe.errors import CertificateRejected, InputError
from qe.exact.number import point_text
from qe.exact.ring import Poly, Ring, format_poly
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms
from qe.io import formats, smtlib, text
from qe.io import json as json_format
from qe.io.sympy import from_sympy, to_sympy
from qe.io.text import read
from qe.proof.entry import Entry, parse_poly, poly_to_text
from qe.spelling import CONSTANTS, KEYWORDS, quoted, unquoted
from tests.corpus.catalogue import problems
from tests.strategies import RELATIONS, formulas, points, polynomials
from tests.tables import each
from tests.universe import same

SYMBOL = string.ascii_letters + string.digits + "~!@$%^&*_-+=<>.?/"
RESERVED = (*KEYWORDS, *CONSTANTS, "E", "A", "root", "let", "Real", "assert", "_", "!", "t_0", "epsilon", "infinity")
LIKE_TERMS = (
    "a + b",
    "x*y",
    "2",
    "-x",
    "x^2",
    " ",
    "a, b",
    "x - y",
    "`",
    "a`b",
    "x = 0",
    "(",
    "#",
    "'",
    "a\nb",
    "\x00",
)
THEORY = frozenset(("+", "-", "*", "/", "^", "=", "<", ">", "<=", ">=", "=>", "!", *KEYWORDS, "let"))
"""Symbols that a script cannot declare, quoted or not: they mean the same with bars."""

names = st.one_of(
    st.text(st.characters(exclude_categories=("Cs",), exclude_characters="|\\"), min_size=1, max_size=5),
    st.text(SYMBOL, min_size=1, max_size=6),
    st.sampled_from((*RESERVED, *LIKE_TERMS, "x", "x'", "ä", "x²", "x₁", "İ", "e\u0301", "é")),
)
triples = st.lists(names, min_size=3, max_size=3, unique=True).map(tuple)


@st.composite
def named_formulas(draw: st.DrawFn, *, quantifiers: int = 0, root_atoms: bool = False) -> Formula:
    """Formulas in which every one of three names occurs, free or bound."""
    chosen = draw(triples)
    drawn = formulas(names=chosen, max_quantifiers=quantifiers, root_atoms=root_atoms)
    x, y, z = map(Ring.of(chosen).var, chosen)
    parts = [atom(x * y - 2 * z + 1, draw(RELATIONS)), draw(drawn)]
    both = conj(parts) if draw(st.booleans()) else disj(parts)
    bound = draw(st.lists(st.sampled_from(chosen), max_size=quantifiers, unique=True))
    return draw(st.sampled_from((exists, forall)))(bound, both)


@st.composite
def named_polynomials(draw: st.DrawFn) -> Poly:
    return draw(polynomials(Ring.of(draw(triples)), max_coefficient=10**30))


@given(names)
def test_a_name_is_read_as_it_was_written(name: str) -> None:
    written = quoted(name)
    assert written.isprintable()
    assert (unquoted(written) if written.startswith("`") else written) == name
    assert text.read(f"{written} > 0").free == (name,)


@given(named_formulas(quantifiers=3, root_atoms=True))
def test_text_and_json(formula: Formula) -> None:
    written = text.write(formula)
    assert written.isprintable()
    assert same(text.read(written), formula), written
    assert json_format.read(json_format.write(formula)) == formula


@given(st.permutations(("a", "b", "ab", "x", "ax", "aab")), st.data())
def test_names_like_products_are_read_as_they_were_written(chosen: list[str], data: st.DataObject) -> None:
    """``ab < a + b`` was printed for a name ab, and is read as a product."""
    formula = data.draw(formulas(names=chosen[:4], max_quantifiers=2, root_atoms=True))
    written = text.write(formula)
    assert same(text.read(written), formula), written


@pytest.mark.parametrize("bound", ["b", "ab", "a"])
def test_answers_about_names_like_products_are_read_as_they_were_printed(bound: str) -> None:
    ring = Ring.of(("a", "b", "ab"))
    a, b, ab = (ring.var(name) for name in ring.names)
    conditions = conj((atom(ab - a - b, Relation.LE), atom(a - b, Relation.GE), atom(b, Relation.GE)))
    asked = exists([bound], conditions)
    assert qe.equivalent(str(qe.eliminate(asked)), asked) and qe.equivalent(str(asked), asked)
    solved = qe.solve(conditions, bound, check=True)
    assert solved.guarantee is qe.Guarantee.CHECKED
    assert qe.equivalent(str(solved), conditions) and qe.equivalent(solved.formula, conditions)
    region = qe.region(conditions)
    assert all(qe.equivalent(str(cell), cell.formula) for cell in region.cells)
    (point,) = qe.find(conditions)
    assert qe.equivalent(
        point_text(point).replace(",", " and"),
        conj([atom(ring.var(n) - int(v), Relation.EQ) for n, v in point.items()]),
    )


@given(named_polynomials())
@example(Ring.of(("a + b", "b", "a")).gen(0) * 3 - Ring.of(("a + b", "b", "a")).gen(1))
def test_polynomials_of_certificates(poly: Poly) -> None:
    assert parse_poly(poly_to_text(poly), poly.ring) == poly
    term, scale = text.read_polynomial(format_poly(poly))
    assert scale == 1
    assert term.convert(poly.ring) == poly


@given(st.text(st.sampled_from("ab`\\ +-*^123_'u{}"), max_size=12))
def test_other_text_is_no_polynomial_of_a_certificate(given_text: str) -> None:
    """There are no two texts for one polynomial: what is read is what would be written."""
    ring = Ring.of(("a", "b", "a b", "`", "a`b"))
    try:
        poly = Entry(given_text, "polynomial").polynomial(ring)
    except CertificateRejected:
        return
    assert poly_to_text(poly) == given_text


@settings(max_examples=8)
@given(triples)
@example(("x!0", "d.g", "$in"))
@example(("a b", "x^*", "pi"))
def test_a_witness_is_checked_whatever_its_variables_are_called(chosen: tuple[str, str, str]) -> None:
    ring = Ring.of(chosen)
    x, y, z = ring.gen(0), ring.gen(1), ring.gen(2)
    body = conj((atom(x * x + y - 3, Relation.EQ), atom(x * y - 1, Relation.EQ), atom(z - x, Relation.GT)))
    answer = qe.eliminate(exists(chosen, body))
    assert answer.truth is True and answer.witness is not None and set(answer.witness) == set(chosen)
    assert answer.guarantee is qe.Guarantee.CHECKED and answer.certificate is not None
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json())).accepted
    checked = qe.eliminate(exists([chosen[0]], body), check=True)
    assert checked.certificate is not None
    assert qe.verify(qe.Certificate.from_json(checked.certificate.to_json())).accepted
    assert qe.equivalent(str(checked.formula), checked.formula)


@given(named_formulas(), st.data())
def test_smtlib(formula: Formula, data: st.DataObject) -> None:
    """Reserved names change, the meaning does not."""
    written = smtlib.write(formula)
    assert not re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\\]", written), "section 3.1 allows none of these"
    again = smtlib.read(written)
    assert len(again.free) == len(formula.free)
    point = data.draw(points(formula.free))
    renamed = {new: point[old] for old, new in zip(formula.free, again.free, strict=True)}
    assert holds_at(again, renamed) == holds_at(formula, point)


@given(st.lists(names.filter(lambda name: name not in THEORY), min_size=1, max_size=3, unique=True))
def test_quoted_symbols_of_smtlib_are_the_names(chosen: list[str]) -> None:
    lines = [f"(declare-const |{name}| Real)(assert (> |{name}| 0))" for name in chosen]
    assert set(smtlib.read("\n".join(lines)).free) == set(chosen)


@each("redlog", "qepcad")
@given(formula=named_formulas())
def test_renaming_formats_keep_variables_apart(format_name: str, formula: Formula) -> None:
    again = formats.read(formats.write(formula, format_name), format_name)
    assert len(again.free) == len(formula.free)


@given(named_formulas(quantifiers=1))
def test_print_formats_are_well_formed(formula: Formula) -> None:
    ElementTree.fromstring(formats.write(formula, "mathml"))
    assert formats.write(formula, "latex").isprintable() or r"\begin{array}" in formats.write(formula, "latex")


@settings(max_examples=20)
@given(named_formulas(), st.data())
def test_sympy_keeps_names(formula: Formula, data: st.DataObject) -> None:
    again = from_sympy(to_sympy(formula))
    assert set(again.free) <= set(formula.free)
    point = data.draw(points(formula.free))
    assert holds_at(again, point) == holds_at(formula, point)


@given(triples)
def test_an_order_in_text_may_name_anything(chosen: tuple[str, str, str]) -> None:
    from qe.arguments import names as order

    assert order(", ".join(map(quoted, chosen))) == chosen
    assert order(" ".join(map(quoted, chosen))) == chosen
    assert order(list(chosen)) == chosen


@given(st.text(min_size=1, max_size=4), st.sampled_from("|\\\ud800"))
def test_names_that_some_format_cannot_hold_are_refused_by_every_reader(name: str, bad: str) -> None:
    import sympy

    assume(name.isprintable())
    with pytest.raises(InputError, match="name"):
        from_sympy(sympy.Symbol(name + bad) > 0)
    with pytest.raises(InputError, match="name"):
        data = json_format.encode(text.read("x > 0"))
        json_format.decode({**data, "ring": [name + bad]})


PROBLEMS = {p.id: p.formula for p in problems() if "slow" not in p.tags}
SLACK = 0.3
"""Seconds of processor time that say nothing."""


def part(poly: Poly, rng: random.Random) -> Poly:
    """The polynomial, or some of its terms."""
    terms = list(poly.terms())
    if len(terms) < 3 or rng.random() < 0.5:
        return poly
    return poly.ring.from_terms(dict(rng.sample(terms, rng.randint(2, len(terms) - 1))))


def named(formula: Formula, rng: random.Random) -> Formula:
    """The same with up to three terms of its blocks under names; the formula where there are none."""
    ring = formula.ring
    if ring is None:
        return formula
    names = [f"name{k}" for k in range(3)]
    wider, left = Ring.of((*ring.names, *names)), names.copy()

    def in_block(f: Formula) -> Formula:
        if not isinstance(f, Exists | ForAll):
            return joined(f, in_block) if isinstance(f, And | Or) else f
        build = exists if isinstance(f, Exists) else forall
        if not f.body.is_quantifier_free:
            return build(f.variables, in_block(f.body))
        sides = [a for a in atoms(f.body) if isinstance(a, Atom) and not a.poly.is_constant]
        chosen = rng.sample(sides, min(len(left), len(sides), rng.randint(1, 3)))
        body, taken, equations = f.body, list[str](), list[Poly]()
        for a in dict.fromkeys(chosen):
            term, name = part(a.poly, rng), left.pop()
            defined = wider.var(name) - term
            other = atom(a.poly - term + wider.var(name), a.relation)
            way = rng.randrange(3)
            if way == 0:  # at the comparison itself
                body = replaced(body, a, exists([name], conj((atom(defined, Relation.EQ), other))))
                continue
            body = body if way == 1 else replaced(body, a, other)
            taken, equations = [*taken, name], [*equations, defined]
        if not taken:
            return build(f.variables, body)
        if rng.random() < 0.5:
            inner = exists(taken, conj((*(atom(e, Relation.EQ) for e in equations), body)))
            return build(f.variables, inner)
        if isinstance(f, Exists):
            return exists((*f.variables, *taken), conj((*(atom(e, Relation.EQ) for e in equations), body)))
        return forall((*f.variables, *taken), disj((*(atom(e, Relation.NE) for e in equations), body)))

    return in_block(convert(formula, wider))


def joined(f: And | Or, change) -> Formula:
    return (conj if isinstance(f, And) else disj)(change(a) for a in f.args)


def replaced(f: Formula, old: Atom, new: Formula) -> Formula:
    if f == old:
        return new
    return joined(f, lambda a: replaced(a, old, new)) if isinstance(f, And | Or) else f


def asked(formula: Formula, method: str, seconds: float) -> tuple[qe.Answer, float, list[str]]:
    start = time.process_time()
    answer = qe.eliminate(formula, method=method, timeout=seconds, process=False)
    plan = [str(choice).split(" for ")[0] for choice in answer.stats.get("plan", ())]
    plan = [choice for choice in plan if not choice.startswith("the answer was decided")]
    return answer, time.process_time() - start, plan


def compared(text: str, seed: int, method: str = "auto", seconds: float = 20.0) -> bool:
    """Whether there was something to compare: a problem that is solved by the method, with terms to be named."""
    formula = read(text)
    other = named(formula, random.Random(seed))
    if other == formula:
        return False
    plain, took, plan = asked(formula, method, seconds)
    if plain.formula is None:
        return False
    answer, seconds, way = asked(other, method, 20 * (took + SLACK))  # of a busy machine; less is asked below
    assert answer.formula is not None, (text, str(other), answer.reason)
    methods = iter(plan)  # a name may save a method, where preparation solves for it; it never needs another one
    assert all(choice in methods for choice in way), (str(other), way, plan)
    if seconds > 2 * took + SLACK:
        seconds = asked(other, method, 20 * (took + SLACK))[1]  # without what was loaded for the first time
    assert seconds <= 2 * took + SLACK, (str(other), seconds, took)
    assert answer.formula == plain.formula or qe.equivalent(answer.formula, plain.formula), str(other)
    for name, value in (answer.witness or {}).items():
        assert name in other.variables, (name, value)  # type: ignore[attr-defined]
    return True


def test_named_terms() -> None:
    share = sorted(PROBLEMS)[::8]
    assert sum(compared(PROBLEMS[name], seed) for seed, name in enumerate(share)) > len(share) // 2


def test_a_name_may_save_a_method() -> None:
    """The term under the name was solved for, and nothing was left for the projection that the problem takes."""
    assert compared(PROBLEMS["true-conjunct"], 31)


@pytest.mark.deep
@pytest.mark.parametrize("name", PROBLEMS)
def test_all_named_terms(name: str) -> None:
    for seed in range(6):
        compared(PROBLEMS[name], seed, seconds=120)


@pytest.mark.deep
@each("vs", "cad", "critical", "convex", "witness", "cgs", "coverings", "roots")
def test_named_terms_by_one_method(method: str) -> None:
    assert sum(compared(text, seed, method, 10) for seed, text in enumerate(PROBLEMS.values())) > 5


def test_a_name_that_nothing_else_looks_at_costs_nothing() -> None:
    """A point is found for four curved conditions; with ``volume`` beside them decomposition did not end."""
    text = "x^3*y + y^3*z + z^3*w + w^3*x*u > 5 and x*y*z*w*u > 1 and x^2*u - y*w > 1"
    text += " and x^2 + y^2 + z^2 + w^2 + u^2 < 20"
    plain = qe.find_instance(text, timeout=20)
    named = qe.find_instance(f"{text} and volume = (x + 1)*(y + 2)*(z + 3)*(w + u)", timeout=20)
    assert plain is not None and named is not None
    assert {name: value for name, value in named.items() if name != "volume"} == dict(plain)
    x, y, z, w, u = (plain[name] for name in "xyzwu")
    assert named["volume"] == (x + 1) * (y + 2) * (z + 3) * (w + u)
