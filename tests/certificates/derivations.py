"""Derivations to be altered: one or more for each rule, found by the engine."""

from __future__ import annotations

import functools
import json
from collections.abc import Iterator
from typing import Any

from qe.api.input import read_formula
from qe.engine.run import solve
from qe.formula.syntax import Formula
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.derivation import Derivation, put_together
from qe.proving.prover import proved

CASES = {
    "names": "(ex x. x = a) and (ex x. x = b)",
    "lines": "ex x, y. x = a*y and y = b + 1 and x > 3",
    "sign": "a > 1 and (ex x. a*x = b and x^3 > 2)",
    "guard": "ex x, y. a*x = y and x + y > 1 and y < 2",
    "shift": "ex x. x^12 = a",
    "shift beside zero": "ex x. x /= 0 and x^4 + a*x^2 + b = 0",
    "translated": "ex x, y. (x - y)^4 + (x - y) < a",
    "scaled": "ex x, y. x^3 + y^3 > 0 and x^2*y > 0",
    "squares": "ex x, y. x^2 + y^2 = 0 and x*y = a",
    "squares known": "ex x, y, z. x^4 + y^4 + z^4 + 2 > 4*x*y*z and x*y*z = a and x > b",
    "factors": "ex x. (x - a)*(x - b) = 0 and x > 0",
    "inequations": "ex x, y. x*y < 1 and a*x + b*y /= 0 and x > y",
    "nonzero": "ex x. a*x^2 + b*x + c /= 0 and x /= d",
    "universal": "all x, y. x >= 0 and y >= 0 -> x^2*y + x + y >= 0",
    "apart": "ex x, y. x^2 < a and y^3 - y = b and y > 2",
    "cells": "ex x. x^4 - a*x + 1 = 0",
    "counterexample": "all x. x^2 > 1",
    "none": "all x, y. x^2 + y^2 + 1 > 0 and x + y < 1 + x^2 + y^2",
    "negations": "not (ex x. x = a and x > b)",
    "guarded": "ex x, y. a*x + b*y = 1 and x^3*y > 2",
    "boundary": "ex x. x^2 >= a and b*x /= 1",
    "shorter": "ex x. a*x^2 + b*x + c = 0",
    "constant": "x^2 + y^2 < 1 and x*y > 1",
    "redundant": "p*q < 0 and q /= 0 or p = 0 and q = 0",
    "point": "all x, y, z, u. x^2 + y^2 + z^2 + u^2 > 1",
    "multipliers": "ex x, y, z, u. x^2 + y^2 + z^2 + u^2 + x < -1",
    "basis": "ex x, y. x*y = 1 and x^2 + y^2 = a and x > 0 and y > x",
    "signs of forms": "ex x. x^4 + a*x^2 + b*x + c = 0",
    "infinity": "all x. a*x^3 + b*x + c >= 0 or x = d",
    "terms": "all a, b. ex x. 4*(x - a)^2 <= (a - b)^2 and 4*(x - b)^2 <= (a - b)^2",
    "roots": "x < root(2, x^2 - y)",
    "nonzero shift": "ex x. x^2 = a and x /= 0 and x^4 /= 9*b",
    "discs": "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + y^2 <= 4",
    "gathered": "ex x. x > a and ex y. x*y = 1 and y > 2",
    "gathered all": "all x. x > a or (all y. x*y > 1 or y > x)",
    "turned": "ex x, y. x^2 + y^2 = a and (x^2 + y^2)^2 > b",
    "turned vectors": "all x, y. x^2 + y^2 > a or (ex u, v. u = 2*x and v = 2*y and x*u + y*v > b)",
    "turned inside": "ex u, v. u^2 + v^2 < a and (all x, y. x^2 + y^2 > b or u*x + v*y < 1)",
    "distributed": "ex x, y. x > b and (y = 3*x or x = 2*y + a)",
    "taken": "ex x, y. (a^2 + 1)*x^5 - y*x = b and y^2 > a",
    "taken far out": "ex x. b > 0 and b*x^4 + x > a",
    "taken apart": "ex x, y. a - b = 0 and (a + b)*x = c",
    "zeros": "ex x, y, z. (x /= 0 or y /= 0) and x*z + y*a + 2 < 0 and x^3 > y^2 + z",
    "balls": "s > 0 and ex x, y. (x - a)^2 + y^2 <= 4 and x^2 + y^2 < s^2",
    "sphere": "ex x, y. x^2 + y^2 = a and b*x + y > c",
    "quadric": "a > 0 and ex x, y. x^2 + y^2 = 1 and a*x^2 + b*y > c",
    "named": "ex x, y. (a + b)*x + (a - b)*y = s and (a^2 - b^2)*x*y >= p and x > a",
    "half-plane": "ex x, y. x^2 - y^2 + a*x + b = 0 and 2*x*y + a*y = 0 and x >= c",
    "exchanged": "ex x, y. x^3 + y^3 = a and x > b and y > b",
    "cancelled": "ex x, y. x^3 + a*x = b and y^3 + a*y = b and x < y and a*x*y > 1",
    "cancelled inside": "ex x. x^4 + a*x^2 = b and x > 0 and (all y. y^4 + a*y^2 /= b or y = x or y = -x)",
    "ranges": "ex x, y, z. x^2 + y^2 + z^2 < 1 and x*y*z > 1 and x + a > b",
    "radicands": "ex x, y. 2*x^2 + 2*y^2 - x <= a and x^2 + y^2 < b",
    "nowhere": "a^2 + b^2 + c^2 <= 9 and (ex x, y, z. x + a = 4 and y + b = 9 and z + c = 9 and x^2 + y^2 + z^2 <= 9)",
    "intervals": "all x. x > 3 -> x^2 - 2 > 0 and x /= 1",
    "alternatives": "ex x, y. (x^2 < a or x^3*y > b) and (y < c or x > y)",
    "parts": "ex x, y, z. x^2 = a and x*y^2 + c <= 0 and x*z^2 > b",
    "chords": "ex x, y, z. y /= z and (x*(y - z) + y)^4 + a*(x*(y - z) + y)^2 + (x*(y - z) + y) + b = 0",
}

PROVED = Options(certify=True)


def derived(text: str) -> tuple[Derivation, Formula]:
    """The derivation of the engine's answer, and the answer."""
    question = read_formula(text)
    found = solve(question, PROVED, Budget(20))
    return put_together(question, found.log.steps(), found.formula), found.formula


@functools.cache
def certificate(text: str) -> Certificate:
    """The certificate of the derivation."""
    derivation, answer = derived(text)
    proof = proved(derivation, answer, PROVED, Budget(20))
    assert proof.certificate is not None, (text, proof.unchecked)
    return proof.certificate


def data(text: str) -> dict[str, Any]:
    """The certificate as JSON data."""
    whole: dict[str, Any] = json.loads(certificate(text).to_json())
    return whole


def rules(text: str) -> list[str]:
    """The rules of the steps of a certificate, those inside their evidence included."""
    return list(_rules(data(text)["payload"]))


def _rules(node: Any) -> Iterator[str]:
    if isinstance(node, dict):
        yield from (node["rule"],) if "rule" in node else ()
        node = list(node.values())
    for part in node if isinstance(node, list) else ():
        yield from _rules(part)
