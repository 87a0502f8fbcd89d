"""What checkers ask of a step: its block, and the variable that the evidence names."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.kernel.step import Claim
from qe.proof.entry import Entry


def claim(before: Formula, names: str = "ax") -> Claim:
    return Claim("a rule", before, before, Ring.of(tuple(names)), Entry({}, "evidence"), "steps[0]")


def test_the_variable_of_a_block_has_its_place_in_the_ring() -> None:
    given = claim(read("ex x. x > a"))
    assert given.variable(Entry("x", "evidence")) == (given.before, "x", 1)


@pytest.mark.parametrize(("name", "names"), [("a", "ax"), ("y", "ax"), ("x", "a")])
def test_other_names_are_refused(name: str, names: str) -> None:
    """A parameter, a name that does not occur, and a variable that the ring does not have."""
    with pytest.raises(CertificateRejected, match="a variable of the existential block"):
        claim(read("ex x. x > a"), names).variable(Entry(name, "evidence"))


def test_a_formula_that_is_no_existential_block_is_refused() -> None:
    for text in ("x > a", "all x. x > a"):
        with pytest.raises(CertificateRejected, match="an existential block"):
            claim(read(text)).block()
