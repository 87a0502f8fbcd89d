"""Certificates as files for the proof assistant Coq: each lemma is proved there again, by its own arithmetic.

Written are: rational witnesses; optima (attained) and infeasibility of convex quadratic problems with rational data,
multipliers and point, without faces; linear substitutions (Gauss); the polynomial identities of derivations. A lemma
states the question and its answer over R; the proof gives the numbers and leaves the rest to ``lra`` and ``ring``.
Nothing of this needs to be believed: what is wrong, ``coqc`` refuses. Raises ``Unable``, with the reason, for
everything else.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from importlib.resources import files
from typing import Any

from qe.coq.derivation import derivation
from qe.coq.squares import Form, read_form, squares
from qe.coq.text import identifiers
from qe.errors import Unable
from qe.proof.certificate import Certificate, Kind

_HEADER = """\
From Coq Require Import Reals Lra.
Open Scope R_scope.

Ltac close :=
  solve [ exact I | contradiction | lra | match goal with h : _ <> _ |- _ => exfalso; apply h; lra end ].
"""


def to_coq(certificate: Certificate) -> str:
    """A file that ``coqc`` accepts if the certificate is right. Raises ``Unable`` for what cannot be written."""
    lines = "\n".join(_lemmas(certificate, "main"))
    first = files("qe").joinpath("coq", "primitives.v").read_text("utf-8") if "env_of" in lines else ""
    return "\n".join((_HEADER, first, lines))


def _lemmas(certificate: Certificate, name: str) -> Iterator[str]:
    payload = certificate.payload
    if isinstance(payload, tuple):
        if not payload:
            raise Unable("an empty bundle: there is nothing to prove")
        for k, member in enumerate(payload):
            yield from _lemmas(member.certificate, f"{name}_{k + 1}")
    elif (optimum := certificate.evidence_for("multipliers")) is not None:
        yield from _optimum(optimum, name)
    elif isinstance(payload, dict) and certificate.kind == Kind.DERIVATION:
        yield from derivation(payload, name)
    else:
        raise Unable(f"certificates of kind {certificate.kind.value} cannot be written for Coq")


# --- terms and formulas --------------------------------------------------------------------------------------


def _number(value: Fraction | int) -> str:
    value = Fraction(value)
    text = str(value.numerator) if value.denominator == 1 else f"{value.numerator} / {value.denominator}"
    return f"({text})"


def _terms(terms: Iterable[tuple[Sequence[int], Fraction | int]], names: Sequence[str]) -> str:
    """A sum of coefficient times powers."""
    parts = []
    for exponents, c in terms:
        powers = [n if k == 1 else f"{n} ^ {k}" for n, k in zip(names, exponents, strict=True) if k]
        parts.append(" * ".join([_number(c), *powers]))
    return " + ".join(parts) or "0"


def _lemma(name: str, statement: str, *proof: str) -> str:
    lines = "\n".join(f"  {line}" for line in proof)
    return f"Lemma {name} :\n  {statement}.\nProof.\n{lines}\nQed.\n"


# --- convex problems -----------------------------------------------------------------------------------------


def _optimum(payload: dict[str, Any], name: str) -> Iterator[str]:
    problem, status = payload["problem"], payload["status"]
    if len(payload["field"]["minimal_polynomial"]) > 2 or payload["faces"] or payload.get("links"):
        raise Unable("only optima with rational points, without faces and links, can be written for Coq")
    if status == "unbounded" or (status == "optimal" and not payload["attained"]):
        raise Unable(f"{'unbounded' if status == 'unbounded' else 'not attained'}: this cannot be written for Coq")
    names = identifiers(problem["variables"])
    forms = [read_form(c["terms"]) for c in problem["constraints"]]
    relations = [c["relation"] for c in problem["constraints"]]
    weights = [Fraction(m[0]) for m in payload["multipliers"]]
    point = [Fraction(v[0]) for v in payload["point"]]
    objective = read_form(problem["minimise"])
    given = [f"{_terms(f.items(), names)} {r} 0" for f, r in zip(forms, relations, strict=True)]
    parts = [(w, f) for w, f in zip(weights, forms, strict=True) if w]
    value = Fraction(payload["value"][0]) if status == "optimal" else Fraction(0)
    goal = f"{_number(value)} <= {_terms(objective.items(), names)}" if status == "optimal" else "False"
    if status == "optimal":
        parts.append((Fraction(1), objective))
    yield _lemma(
        name,
        (f"forall {' '.join(names)} : R, " if names else "") + "".join(f"({h}) -> " for h in given) + f"({goal})",
        f"intros {' '.join([*names, *(f'h{k}' for k in range(len(given)))])}.",
        *_positive(parts, point, names),
        "lra.",
    )
    if status == "optimal":
        body = [*given, f"{_terms(objective.items(), names)} = {_number(value)}"]
        together = " /\\ ".join(f"({b})" for b in body)
        statement = f"exists {' '.join(names)} : R, {together}"
        yield _lemma(f"{name}_attained", statement, *(f"exists {_number(v)}." for v in point), "repeat split; lra.")


def _positive(parts: Sequence[tuple[Fraction, Form]], point: Sequence[Fraction], names: Sequence[str]) -> list[str]:
    """The quadratic part of a weighted sum around the point as squares, each shown not to be negative."""
    lines = []
    for k, (factor, row) in enumerate(squares(parts)):
        shifted = " + ".join(
            f"{_number(a)} * ({n} - {_number(v)})" for a, n, v in zip(row, names, point, strict=True) if a
        )
        lines.append(f"assert (s{k} : 0 <= {_number(factor)} * ({shifted}) ^ 2).")
        lines.append("{ apply Rmult_le_pos; [lra | apply pow2_ge_0]. }")
    return lines
