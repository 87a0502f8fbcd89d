"""The theorems of ``qe/theorems``: proofs by the engine that the kernel checks, axioms tried at random instances.

A theorem with a ``proof`` is derived without the rules that it justifies, for each choice of its words, and all values
of its letters; the certificates are one file. An ``axiom`` is tried with integers for its letters, which stand for all
rational numbers: every condition may be multiplied by a positive number.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Annotated

import typer

import qe
from experiments.reference import decide as reference_decides
from experiments.z3_oracle import decide as z3_decides
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula.build import forall, iff, implies
from qe.formula.syntax import TRUE, Constant, Formula
from qe.formula.traverse import bound_variables
from qe.kernel.statements import Theorem, rows, theorem
from qe.proof.certificate import Certificate
from qe.rules.closed_forms import generic, pattern, term

WITHOUT = ("cubic", "roots", "balls", "stability", "quadrics", "forms", "values", "critical")
"""The rules that the theorems justify, and the method that is slow here."""

STORED = files("qe").joinpath("theorems", "proofs")
MOST = 200_000
"""Characters of a certificate that is stored with the theorems; longer ones are made anew."""

NUMBERS = (0, 0, 0, 0, 1, 1, 1, -1, -1, 2, -2, 3, -3, 4, -5)
SIZES, TRIES = frozenset((1, 2, 3)), 4_000
SECONDS = 2.0


@dataclass(frozen=True, slots=True)
class Instance:
    """A theorem whose letters are numbers for which what is given holds."""

    theorem: Theorem
    letters: dict[str, int]
    block: Formula
    answer: Formula

    @property
    def holds(self) -> bool | None:
        """Whether both sides have the same truth; None where that is not decided in time."""
        truths = [truth(side) for side in (self.block, self.answer)]
        return None if None in truths else truths[0] is truths[1]


def instances(name: str, rng: random.Random) -> Iterator[Instance]:
    """Random ones, with words at random."""
    choices = list(rows()[name].choices(SIZES))
    while True:
        used = theorem(name, rng.choice(choices))
        assert used is not None
        yield _instance(used, rng)


def _instance(used: Theorem, rng: random.Random) -> Instance:
    ring, names = Ring.of(used.variables), {v: v for v in used.variables}
    roots = pattern(used.name, used.words).roots
    for _ in range(TRIES):
        numbers = {name: ring.constant(rng.choice(NUMBERS)) for name in used.letters}
        for name, tree in roots.items():
            root = term(used, tree, numbers, ring).square_root()
            if root is None:
                break
            numbers[name] = root * rng.choice((1, -1))
        else:
            if used.formula("given", numbers, names, ring) == TRUE:
                block, answer = (used.formula(part, numbers, names, ring) for part in ("block", "answer"))
                return Instance(used, {k: p.constant_value() for k, p in numbers.items()}, block, answer)
    raise InternalError(f"{used.name}: no numbers for which what is given holds")


def truth(sentence: Formula) -> bool | None:
    """By the method of Cohen and Hörmander where one variable is bound, by z3 otherwise."""
    if isinstance(sentence, Constant):
        return sentence.value
    if len(bound_variables(sentence)) == 1:
        return reference_decides(sentence)
    return z3_decides(sentence, seconds=SECONDS)


def tried(name: str, count: int, seed: int = 1) -> tuple[int, int]:
    """How many random instances hold, and how many are not decided. Raises ``InternalError`` for a counterexample."""
    right = unknown = 0
    for instance, _ in zip(instances(name, random.Random(seed)), range(count), strict=False):
        verdict = instance.holds
        if verdict is False:
            raise InternalError(f"{name} {instance.theorem.words}: false for {instance.letters}")
        right, unknown = right + (verdict is True), unknown + (verdict is None)
    return right, unknown


def sentence(used: Theorem) -> Formula:
    """The theorem for all values of its letters."""
    claim = iff(generic(used, "block"), generic(used, "answer"))
    return forall(used.letters, implies(generic(used, "given"), claim))


def proof(name: str, seconds: float = 600) -> Certificate:
    """Derivations of the theorem for all words, made by the engine and accepted by the kernel."""
    members = []
    for words in rows()[name].choices():
        used = theorem(name, words)
        assert used is not None
        found = qe.eliminate(sentence(used), timeout=seconds, check=True, without=WITHOUT)
        if found.truth is not True or found.certificate is None or found.trusts:
            raise InternalError(f"{name} {words}: not proved: {found.truth}, {found.why_unchecked}")
        members.append((" ".join(words) or name, found.certificate))
    return Certificate.bundle(members)


def accepted(name: str, certificate: Certificate) -> bool:
    """Whether the kernel accepts these as derivations of the theorem, for each choice of words, without axioms."""
    used = [theorem(name, words) for words in rows()[name].choices()]
    members = certificate.payload if isinstance(certificate.payload, tuple) else ()
    return (
        len(members) == len(used)
        and not certificate.trusts
        and all(
            t is not None and qe.verify(member.certificate, formula=sentence(t), timeout=600).accepted
            for t, member in zip(used, members, strict=True)
        )
    )


def stored(file: str) -> Certificate | None:
    """The certificate in a file beside the theorems, if there is one."""
    path = STORED.joinpath(file)
    return Certificate.from_json(path.read_text("utf-8")) if path.is_file() else None


def main(
    count: Annotated[int, typer.Option("--instances", help="Random instances of each axiom.")] = 10_000,
    only: Annotated[str, typer.Option(help="Theorems whose name contains this.")] = "",
    seed: Annotated[int, typer.Option(help="Of the random instances.")] = 1,
) -> None:
    """Prove every theorem that has a proof, try every axiom. Proofs that are short are stored with the theorems."""
    for name, row in rows().items():
        if only not in name:
            continue
        if axiom := row.data.get("axiom"):
            right, unknown = tried(name, count, seed)
            typer.echo(f"axiom    {name}: {right} instances hold, {unknown} not decided; {axiom}")
            continue
        certificate = stored(row.data["proof"]) or proof(name)
        if not accepted(name, certificate):
            raise InternalError(f"{name}: its proof is not accepted")
        text = certificate.to_json()
        typer.echo(f"theorem  {name}: proved, {len(text)} characters")
        if len(text) <= MOST:
            Path(str(STORED)).mkdir(exist_ok=True)
            Path(str(STORED.joinpath(row.data["proof"]))).write_text(text, "utf-8")


if __name__ == "__main__":
    typer.run(main)
