"""Evidence with derivations inside: the checker of the rule says where each begins, and it is proved from there.

Nothing here is trusted: what is found is checked once more as a whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from qe.elimination.vs.trace import Eliminated, shifts_degrees
from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Formula
from qe.io.names import names_in
from qe.kernel.step import Context, Limits
from qe.proof.entry import Entry, Json
from qe.proof.run_log import RunLog
from qe.proof.step import Nested, Step
from qe.proving.elaborators import NAMING
from qe.proving.made import FRESH

Prove = Callable[[Nested, Formula, Context], tuple[Formula, list[Json]]]
"""From the formula with which a checker begins, under a context, to the answer of a derivation: that, and the steps.

Raises ``CertificateRejected`` where a step has no accepted evidence.
"""


def derivations_within(value: object) -> Iterator[Nested]:
    """All derivations in the evidence of a step, also those inside each other; certificates, as data, have none."""
    if isinstance(value, Nested):
        yield value
        yield from derivations_within([step.evidence for step in value.steps])
    elif isinstance(value, Mapping):
        yield from derivations_within([part for name, part in value.items() if name != "certificate"])
    elif isinstance(value, list | tuple):
        for part in value:
            yield from derivations_within(part)


def names_within(value: object) -> Iterator[str]:
    """The names in the formulas and polynomials of evidence, also in derivations inside it."""
    match value:
        case _ if isinstance(value, Formula):
            yield from names_in(value)
        case Poly():
            yield from (value.ring.names[i] for i in value.variables)
        case Nested(start, steps, answer):
            yield from names_within([start, *steps, answer])
        case Step(rule, before, after, context, evidence):
            yield from FRESH if rule in NAMING else ()
            yield from names_within([before, after, context, evidence])
        case Eliminated(trace=trace):
            yield from FRESH if shifts_degrees(trace) else ()
        case RunLog():
            yield from names_within(list(value.steps()))
        case Mapping():
            yield from names_within(list(value.values()))
        case list() | tuple():
            for part in value:
                yield from names_within(part)


def proved_inside(run: Callable[[Limits], Json], limits: Limits, prove: Prove) -> Json:
    """What ``run`` gives, with the steps of its derivations, which it replays by the limits it is given.

    Raises as ``run`` and ``prove`` do.
    """
    proofs: dict[int, list[Json]] = {}

    def replay(entry: Entry, start: Formula, known: Context, ring: Ring) -> Formula:
        nested: object = entry.value
        if not isinstance(nested, Nested):
            raise CertificateRejected(entry.path, "no derivation")
        answer, proofs[id(nested)] = prove(nested, start, known)
        return answer

    def filled(value: object) -> Json:
        if isinstance(value, Nested):
            return list(proofs[id(value)])
        if isinstance(value, dict):
            return {name: filled(part) for name, part in value.items()}
        return [filled(part) for part in value] if isinstance(value, list) else value  # type: ignore[return-value]

    return filled(run(replace(limits, replay=replay)))
