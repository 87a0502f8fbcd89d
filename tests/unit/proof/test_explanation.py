"""A run in words: numbered steps with their formulas, and what was chosen and done between them."""

from qe.io.text import read
from qe.proof.explanation import LONGEST, explained
from qe.proof.run_log import RunLog


def test_the_lines_of_a_run() -> None:
    log = RunLog()
    log.step("one rule", read("x > 0 and x > 1"), read("x > 1"), evidence={"detail": "twice"})
    log.work("cad", {"cells": 7, "partial": True, "order": ["x", "y"], "none": [], "whole": False})
    log.step("another", read("x > 1"), read("x > 2"), context=read("y > 0"))
    lines = explained(log).splitlines()
    assert lines[0] == "1. one rule (twice): x > 0 and x > 1"
    assert lines[1] == "   <==> x > 1"
    assert lines[2] == "decomposition cells 7; partial yes; order x, y; none none; whole no"
    assert lines[3:5] == ["2. another: x > 1", "   <==> x > 2   (where y > 0)"]


def test_other_methods_keep_their_names_and_long_formulas_are_cut() -> None:
    log = RunLog()
    log.work("coverings", {"samples": 3})
    long = read(" or ".join(f"x = {k}" for k in range(100)))
    log.step("rule", long, read("true"))
    first, second, third = explained(log).splitlines()[:3]
    assert first == "coverings samples 3" and third == "   <==> true"
    assert second == f"1. rule: {str(long)[:LONGEST]} ..."


def test_choices_and_the_time() -> None:
    log = RunLog()
    assert explained(log) == ""
    log.choice("vs", ("x",), "because")
    log.seconds = 1.5
    lines = explained(log).splitlines()
    assert lines[0].startswith("planned ") and "because" in lines[0] and lines[-1] == "took 1.5 s"
