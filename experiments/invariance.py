"""Questions rewritten without a change of their meaning: lost, slower, longer? ``experiments invariance``.

A file of rewritings has lines {"id": "ORIGINAL|KIND", "formula": text}, whose originals are in the literature sets.
Without one, affine changes of the bound variables of the project's own corpus are made, the same for one seed.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from experiments.adapters.answer import Limits
from experiments.baseline import FLOOR
from experiments.problem import Problem
from experiments.results import Result, Status
from experiments.runner import Job, run_one
from experiments.solvers import OURS, solver
from experiments.suites.corpus import hard, literature, tagged
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.normal import rename_apart, without_clashes
from qe.formula.syntax import Formula, Quantified
from qe.formula.traverse import has_root_atoms, map_atoms, subformulas
from qe.io.text import CONSTANTS, read, write
from qe.rules.lift import Solve
from qe.rules.normal_position import at_steps

SOLVED = (Status.SOLVED, Status.PROBED, Status.UNCOMPARED)
QUANTILES = (0.5, 0.75, 0.9, 0.95, 1.0)


@dataclass(frozen=True, slots=True)
class Rewriting:
    """A problem, and the same one in other words."""

    original: Problem
    kind: str
    formula: str


@dataclass(frozen=True, slots=True)
class Pair:
    """What became of a rewriting and of its original."""

    rewriting: Rewriting
    before: Result
    after: Result

    @property
    def ratio(self) -> float:
        """Of the seconds, after to before."""
        return max(self.after.cpu, FLOOR) / max(self.before.cpu, FLOOR)

    @property
    def lengthening(self) -> float:
        """Of the answers, after to before."""
        return self.after.length / max(self.before.length, 1)

    def __str__(self) -> str:
        old, new = self.before, self.after
        return (
            f"{self.rewriting.original.id} {self.rewriting.kind}: {old.status} {old.cpu:.3f} s, {new.status} "
            f"{new.cpu:.3f} s, ratio {self.ratio:.2f}, {old.length} to {new.length} characters"
        )


def from_file(path: Path) -> list[Rewriting]:
    """The rewritings of a file whose originals are there."""
    known = {p.id: p for p in (*literature(), *hard())}
    rows = [json.loads(line) for line in path.read_text().splitlines() if line.strip()]
    named = [(*row["id"].rsplit("|", 1), row["formula"]) for row in rows]
    return [Rewriting(known[name], kind, text) for name, kind, text in named if name in known]


def generated(seed: int) -> list[Rewriting]:
    """Affine changes of the project's corpus."""
    rng, found = random.Random(seed), []
    for problem in tagged("classics"):
        formula = rename_apart(without_clashes(read(problem.formula, known=CONSTANTS)))
        changed = rewritten(formula, rng)
        if changed != formula:
            found.append(Rewriting(problem, "generated", write(changed)))
    return found


def rewritten(formula: Formula, rng: random.Random) -> Formula:
    """The question with random affine forms in the variables of every block in their places."""
    if formula.ring is None or has_root_atoms(formula):
        return formula
    for block in [f.variables for f in subformulas(formula) if isinstance(f, Quantified)]:
        steps = [_form(name, [v for v in block if v in formula.ring.index], formula.ring, rng) for name in block]
        formula = map_atoms(formula, lambda a, given=steps: atom(at_steps(a.poly, given), a.relation))  # type: ignore[misc]
    return formula


def _form(name: str, block: Sequence[str], ring: Ring, rng: random.Random) -> Solve:
    others = [v for v in block if v != name]
    top = ring.var(name) * rng.choice((1, 1, 2, 7)) + rng.choice((0, -1, 3))
    if others and rng.random() < 0.5:
        top = top + ring.var(rng.choice(others)) * rng.choice((1, -1, 2))
    return Solve(name, top, ring.constant(rng.choice((1, 1, 3))))


def measured(rewritings: Iterable[Rewriting], limits: Limits) -> Iterator[Pair]:
    """Each rewriting whose original is solved, with the original, which is run once, just before the first of them."""
    before: dict[str, Result] = {}
    for one in rewritings:
        name, job = one.original.id, Job(one.original, solver(OURS), 0)
        if name not in before:
            before[name] = run_one(job, limits)
        if before[name].status in SOLVED:
            yield Pair(
                one, before[name], run_one(replace(job, problem=replace(one.original, formula=one.formula)), limits)
            )


def lines(pairs: Sequence[Pair]) -> Iterator[str]:
    """A table: for each kind what is lost, ratios of processor time and of lengths at quantiles."""
    for kind in dict.fromkeys(p.rewriting.kind for p in pairs):
        chosen = [p for p in pairs if p.rewriting.kind == kind]
        both = [p for p in chosen if p.after.status in SOLVED]
        lost = [p.rewriting.original.id for p in chosen if p.after.status not in SOLVED]
        yield f"{kind}: {len(chosen)} rewritings, {len(lost)} lost" + (f" ({', '.join(lost)})" if lost else "")
        for word, values in (("CPU ratio", [p.ratio for p in both]), ("length", [p.lengthening for p in both])):
            ordered = sorted(values) or [1.0]
            at = (f"{q:.0%} {ordered[min(int(q * len(ordered)), len(ordered) - 1)]:.2f}" for q in QUANTILES)
            yield f"  {word}: {', '.join(at)}; at most 1.5: {sum(v <= 1.5 for v in ordered) / len(ordered):.1%}"
