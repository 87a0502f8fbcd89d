"""Every formula of the literature sets is read: variables as listed, and truth values as plain Python gives."""

from __future__ import annotations

import json
import random
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

from qe.formula.evaluate import holds_at
from qe.formula.syntax import Exists, ForAll
from qe.io.text import read, write
from tests.universe import same

_PYTHON = {"/\\": " and ", "\\/": " or ", "~": " not ", "/=": "!=", "=": "==", "^": "**", "<=": "<=", ">=": ">="}
_TOKEN = re.compile(r"<==>|==>|/\\|\\/|/=|<=|>=|[-+*/^()~=<>]|\d+|[A-Za-z_]\w*'*")


def records(shared: Path) -> list[dict[str, Any]]:
    found = []
    for name in ("public.jsonl", "timed_realgeom.jsonl"):
        with open(shared / "corpora" / name) as handle:
            found += [json.loads(line) for line in handle]
    return found + json.loads((shared / "corpora" / "classics.json").read_text())["problems"]


def python_source(text: str) -> str:
    """The text as a Python expression over the dictionary ``point``; numbers are exact."""
    parts = []
    for token in _TOKEN.findall(text):
        if token.isdigit():
            parts.append(f"Fraction({token})")
        elif token in ("true", "false"):
            parts.append(token.capitalize())
        elif token[0].isalpha() or token[0] == "_":
            parts.append(f"point[{token!r}]")
        else:
            parts.append(_PYTHON.get(token, token))
    return "".join(parts)


def test_problems_are_read_with_their_variables(shared: Path) -> None:
    for record in records(shared):
        formula = read(record["formula"])
        again = read(write(formula))  # of two bounds that are written as a range the lower one is read first
        assert same(again, formula) or write(again) == write(formula), record
        if "free" in record:
            assert set(formula.free) <= set(record["free"]), record["id"]
        if record.get("prefix") and record["stats"]["prenex"]:
            prefix, body = [], formula
            while isinstance(body, Exists | ForAll):
                prefix += [["ex" if isinstance(body, Exists) else "all", name] for name in body.variables]
                body = body.body
            assert prefix == [[kind, name] for kind, name in record["prefix"]], record["id"]
            assert formula.bound


def test_expected_answers_mean_what_they_say(shared: Path) -> None:
    generator = random.Random(7)
    compared = 0
    for record in records(shared):
        text = record.get("expected")
        if not text or re.search(r"==>|\b(Ex|All)\b", text):
            continue
        formula = read(text)
        assert formula.is_quantifier_free
        names = sorted(set(re.findall(r"[A-Za-z_]\w*'*", text)) - {"true", "false"})
        assert set(formula.free) <= set(names)
        code = compile(python_source(text), "expected", "eval")
        for _ in range(4):
            point = {name: Fraction(generator.randint(-3, 3), generator.randint(1, 2)) for name in names}
            assert holds_at(formula, point) is bool(eval(code, {"Fraction": Fraction, "point": point})), text
            compared += 1
    assert compared > 300
