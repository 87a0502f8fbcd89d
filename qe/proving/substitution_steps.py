"""From the trace of virtual substitution to steps with evidence (``qe.kernel.elimination_set`` and its neighbours).

Nothing here is trusted. What the engine's sign knowledge left out (guards that cannot hold, constituents that cannot
degenerate) becomes a point at which the problem is kept, and a step that shows that it is false there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from qe.elimination.vs.trace import (
    Alternatives,
    Apart,
    Decided,
    Eliminated,
    Split,
    Substituted,
    Trace,
    Traces,
    Unchanged,
    without,
)
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_set import block_of, start
from qe.kernel.open_block import inside, shows_open
from qe.kernel.step import Claim, Limits
from qe.proof.certificate import Certificate, Root, written
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json, formula_to_json
from qe.proving.apart import Part, by_alternatives, by_independent_parts
from qe.proving.elimination_points import Point, Points
from qe.proving.made import Made
from qe.proving.shifts import lower_first, raised

Simplified = Callable[[Formula, Formula], Json]
"""A step of the rule "simplification" with its evidence; raises ``CertificateRejected`` where none is found."""


def steps(block: Exists, result: Eliminated, answer: Formula, ring: Ring, by: Simplified, limits: Limits) -> list[Json]:
    """Steps from the block to the answer. Raises ``CertificateRejected`` where some of them cannot be proved."""
    return _Steps(ring, by, limits).whole(block, result, answer)


class _Steps:
    def __init__(self, ring: Ring, by: Simplified, limits: Limits) -> None:
        self.ring, self.by, self.limits = ring, by, limits

    def moved(self, formula: Formula) -> Formula:
        return moved(formula, self.ring)

    def whole(self, block: Exists, result: Eliminated, answer: Formula) -> list[Json]:
        names, matrix, raw = block.variables, self.moved(result.matrix), self.moved(result.answer)
        begin = block_of(names, matrix, self.ring)
        return [
            *self.simplified(block, begin),
            *self.traced(names, matrix, raw, result.trace),
            *self.simplified(raw, answer),
        ]

    def simplified(self, before: Formula, after: Formula) -> list[Json]:
        """No step or one."""
        return [] if before == after else [self.by(before, after)]

    def step(self, rule: str, before: Formula, after: Formula, evidence: Json) -> list[Json]:
        return [written(rule, (), before, after, (), evidence)]

    # --- the trace, node by node ---------------------------------------------------------------
    def traced(self, names: Collection[str], body: Formula, answer: Formula, trace: Trace) -> list[Json]:
        """Steps from ``exists names. body`` to the answer."""
        self.limits.tick()
        before = block_of(names, body, self.ring)
        match trace:
            case Unchanged():
                return self.simplified(before, answer)
            case Decided(None):
                return self.simplified(before, FALSE)
            case Decided(value) if value is not None and isinstance(before, Exists):
                witness = Certificate.witness(body, body.free, [Root.of(value)])
                return self.step("instance", before, TRUE, witness.evidence_for("instance"))
            case Alternatives(disjuncts, parts):
                return self.alternatives(before, names, [self.moved(d) for d in disjuncts], parts)
            case Split(_, simple, parts):
                pieces = [self.moved(case) for case in simple]
                begin = block_of(names, disj(pieces), self.ring)
                return [*self.simplified(before, begin), *self.alternatives(begin, names, pieces, parts)]
            case Apart():
                return self.apart(before, names, body, trace)
            case Substituted():
                return self.substituted(before, names, trace)
        raise CertificateRejected("trace", "an existential block expected")

    def alternatives(
        self, before: Formula, names: Collection[str], pieces: Sequence[Formula], parts: Traces
    ) -> list[Json]:
        if not isinstance(before, Exists):
            raise CertificateRejected("trace", "an existential block expected")
        ends = [self.moved(answer) for answer, _ in parts]
        members: list[Part] = []
        for piece, end, (_, trace) in zip(pieces, ends, parts, strict=False):
            members.append(Part(piece, end, list(self.traced(names, piece, end, trace))))
        members += [Part(p, block_of(names, p, self.ring), []) for p in pieces[len(parts) :]]
        return by_alternatives(self.made(before), [*names], members, disj(p.end for p in members))

    def made(self, before: Formula) -> Made:
        return Made(Claim("steps", before, before, self.ring, Entry({}, "evidence"), "step"), self.limits, before)

    def apart(self, before: Formula, names: Collection[str], body: Formula, trace: Apart) -> list[Json]:
        known = tuple(m for m in conjuncts(body) if not set(names) & set(m.free))
        listed: list[Part] = []
        answers: list[Formula] = []
        for part in trace.parts:
            own, answer = self.moved(part.body), self.moved(part.answer)
            together = bool(known) and not isinstance(part.trace, Unchanged | Decided)
            given = conj((*known, own)) if together else own
            listed.append(Part(own, answer, list(self.traced(names, given, answer, part.trace)), together))
            answers.append(without(answer, known if together else ()))
        after = FALSE if FALSE in answers else conj((*known, *answers))
        return by_independent_parts(self.made(before), [*names], listed, after)

    # --- elimination sets ----------------------------------------------------------------------
    def substituted(self, before: Formula, names: Collection[str], trace: Substituted) -> list[Json]:
        if not isinstance(before, Exists):
            raise CertificateRejected("trace", "an existential block expected")
        if trace.plan.exponent > 1:
            return self.lowered(before, names, trace)
        return self.at_points(before, names, trace, None)

    def lowered(self, before: Exists, names: Collection[str], trace: Substituted) -> list[Json]:
        """The power of a variable for the variable first."""
        given = trace.formula.ring
        assert given is not None
        name = given.names[trace.plan.x]
        made = self.made(before)
        low = lower_first(made, before, name, trace.plan.exponent)
        return [*made.steps, *self.at_points(low, names, trace, (name, trace.plan.exponent))]

    def at_points(
        self, before: Exists, names: Collection[str], trace: Substituted, shift: tuple[str, int] | None
    ) -> list[Json]:
        """The elimination set; where ``shift`` says of which power it is, what stays quantified is of the variable."""
        thin = self.is_thinned(before, trace)
        points = Points(before, trace, self.ring, self.limits, complete=thin)
        rest = [v for v in before.variables if v != points.name]
        if thin:
            return self.open_block(before, points, rest)
        lists: list[Json] = []
        answers: list[Formula] = []
        for point in points.listed:
            begin = start(point.tried, points.x, points.name, before.variables, self.ring)
            left = before.variables if point.tried.point is None else rest
            back: list[Json] = []
            if shift is not None and point.tried.point is None:
                whole = block_of(left, point.result, self.ring)
                if isinstance(whole, Exists) and point.trace is not None:
                    back, begin = raised(self.made(begin), whole, *shift), whole
            lists.append([*back, *self.solved(begin, block_of(left, point.result, self.ring), left, point)])
            answers.append(point.answer)
        return self.step("elimination set", before, disj(answers), points.evidence(lists))

    def is_thinned(self, before: Exists, trace: Substituted) -> bool:
        """Whether openness in the other variables changed what was found."""
        given = trace.formula.ring
        rest = [v for v in before.variables if given is None or v != given.names[trace.plan.x]]
        results = [self.moved(a.result) for a in trace.attempts]
        return bool(rest) and shows_open(before.body, before.variables) and any(inside(r, rest) != r for r in results)

    def solved(self, begin: Formula, made: Formula, left: Collection[str], point: Point) -> list[Json]:
        """From what the checker puts in to what the engine made of it, then on to the answer."""
        if point.trace is None:
            return self.simplified(begin, FALSE) if point.needed else []
        simple = block_of(left, point.simple, self.ring)
        try:
            simplifying = self.simplified(begin, simple)
        except CertificateRejected:
            simplifying = [*self.simplified(begin, made), *self.simplified(made, simple)]
        return [*simplifying, *self.traced(left, point.simple, point.answer, point.trace)]

    def open_block(self, before: Exists, points: Points, rest: Sequence[str]) -> list[Json]:
        """The set of one variable, then what openness in the others allows to leave out."""
        one = block_of((points.name,), before.body, self.ring)
        kept: list[Json] = []
        lists: list[Json] = []
        answers: list[Formula] = []
        for point in points.listed:
            alone = start(point.tried, points.x, points.name, (points.name,), self.ring)
            kept.append(list(self.simplified(alone, point.result)))
            begin = block_of(rest, inside(point.result, rest), self.ring)
            answers.append(point.answer if point.needed else begin)
            lists.append(self.solved(begin, begin, rest, point))
        results = [p.result for p in points.listed]
        evidence: Json = {
            "variable": points.name,
            "steps": self.step("elimination set", one, disj(results), points.evidence(kept)),
            "pieces": [formula_to_json(r, quantified=True) for r in results],
            "parts": lists,
        }
        return self.step("open block", before, disj(answers), evidence)
