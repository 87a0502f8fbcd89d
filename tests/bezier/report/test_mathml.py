"""Mathematics that may end a line: nothing is lost, nothing is broken inside of an element."""

import re
from xml.etree import ElementTree

from bezier.report import mathml
from qe.io.text import read


def elements(line):
    return [ElementTree.fromstring(part) for part in line.split("<wbr>")]


def written(line):
    return "".join("".join(element.itertext()) for element in elements(line))


def test_a_long_sum_ends_at_its_signs():
    (line,) = mathml.conjunction_lines(read("4*x^2 + 4*y^2 - 3*x*y - 48 <= 0"))
    _, *rest = elements(line)
    assert len(rest) == 3 and all(e[0].text in "+−" and e[0].get("form") == "infix" for e in rest)
    whole = mathml.math(mathml.formula(read("4*x^2 + 4*y^2 - 3*x*y - 48 <= 0")))
    assert written(line) == "".join(ElementTree.fromstring(whole).itertext())


def test_brackets_roots_and_fractions_stay_whole():
    body = mathml.number_text("(3 - sqrt(5 + 2))/2")
    assert "<wbr>" not in mathml.lines(body)
    assert len(elements(mathml.lines(f"<mo>∃</mo><mi>x</mi><mo>(</mo>{body}<mo>∧</mo>{body}<mo>)</mo>"))) == 2
    bracketed = "<mrow><mo>(</mo><mi>a</mi><mo>+</mo><mi>b</mi><mo>)</mo></mrow>"
    assert mathml.lines(bracketed) == mathml.math(bracketed)


def test_a_sign_at_the_beginning_is_no_end():
    (line,) = mathml.conjunction_lines(read("x*y = 0"))
    assert "<wbr>" not in line
    assert re.match(r"<math[^>]*><mo>−</mo>", mathml.lines("<mrow><mo>−</mo><mi>x</mi></mrow>"))
