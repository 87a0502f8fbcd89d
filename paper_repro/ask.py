"""Questions to the engine, each recorded with its answer, time and certificate."""

from __future__ import annotations

import re
import time
from typing import Any

import qe
from paper_repro.claim import Asked

LIMIT = 60.0
"""Seconds for one question."""

_POINT = re.compile(r"\\mathrm\{([pqr])([0-9])([xyz])\}")


def eliminated(text: str, question: Any, expected: str, method: str = "auto") -> Asked:
    """Eliminate the quantifiers of ``question``, by this method alone if one is named; the answer must be equivalent to
    ``expected``."""
    start = time.perf_counter()
    answer = qe.eliminate(question, timeout=LIMIT, method=method)
    seconds = time.perf_counter() - start
    as_expected = answer.formula is not None and qe.equivalent(answer.formula, expected, timeout=LIMIT)
    shown = tex(answer) if answer.formula is not None else rf"\text{{{answer.reason}}}"
    return Asked(text, str(question), shown, as_expected, seconds, expected=expected)


def decided(text: str, sentence: Any, expected: bool = True, *, proved: bool = False) -> Asked:
    """Decide a sentence. A witness or counterexample is part of the answer, and its certificate is checked.

    ``proved``: a certificate is demanded of every answer, also of one that has no witness.
    """
    start = time.perf_counter()
    answer = qe.eliminate(sentence, timeout=LIMIT, check=proved)
    seconds = time.perf_counter() - start
    shown = answer.reason if answer.truth is None else str(answer.truth).lower()
    if answer.witness:
        values = ", ".join(f"{name} = {value}" for name, value in sorted(answer.witness.items()))
        shown = f"{shown}: {values}" if len(values) < 160 else shown
    holds = answer.truth is expected and _accepted(answer.certificate) and not (proved and answer.certificate is None)
    return Asked(text, str(sentence), rf"\text{{{shown}}}", holds, seconds, answer.certificate)


def optimised(text: str, objective: str, constraints: str, value: str) -> tuple[Asked, qe.Optimum]:
    """Minimise exactly; the least value must be the number ``value`` (as text), its certificate is checked."""
    start = time.perf_counter()
    found = qe.minimize(objective, constraints, timeout=LIMIT, method="convex")
    seconds = time.perf_counter() - start
    holds = str(found.value) == value and _accepted(found.certificate)
    shown = rf"\min = {number(found.value)}" if found.is_optimal else rf"\text{{{found.status.value}}}"
    question = f"minimise {objective} subject to {constraints}"
    return Asked(text, question, shown, holds, seconds, found.certificate), found


def verified(text: str, question: str, certificate: qe.Certificate) -> Asked:
    """The checker's verdict about a certificate for an answer to ``question``."""
    start = time.perf_counter()
    verdict = qe.verify(certificate)
    seconds = time.perf_counter() - start
    return Asked(text, question, rf"\text{{{verdict}}}", verdict.accepted, seconds, certificate)


def _accepted(certificate: qe.Certificate | None) -> bool:
    return certificate is None or qe.verify(certificate).accepted


def tex(answer: qe.Answer) -> str:
    """The answer in LaTeX, coordinates of control points with indices."""
    return _POINT.sub(lambda m: f"{m[1].upper()}_{{{m[2]}{m[3]}}}", answer.to_latex())


def number(value: Any) -> str:
    """An exact number in LaTeX: a fraction, or the engine's text for an algebraic number with its roots as such."""
    text = re.sub(r"sqrt\(([^()]*)\)", r"\\sqrt{\1}", str(value)).replace("*", r"\,")
    fraction = re.fullmatch(r"(-?)\(?([^()]+?)\)?/(\d+)", text)
    return rf"{fraction[1]}\frac{{{fraction[2]}}}{{{fraction[3]}}}" if fraction else text
