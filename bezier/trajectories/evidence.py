"""That limits are kept at all times, as sentences of the kernel: one for each piece, a polynomial inequality in one
variable; and that one is broken, by a rational time at which it is.

Slowed down by k, a derivative of order r is p / k^r: that it stays within its limit L is p <= L k^r. So the claims
about a trajectory and about a slower one differ in nothing but these numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import lcm

from bezier.curves.sentences import Said, by_signs, in_bernstein
from bezier.trajectories.limits import Limit, Outcome, Verdict, limited
from bezier.trajectories.piecewise import Trajectory
from qe.errors import Unable
from qe.exact.rational_poly import RationalPoly
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate, Evidence
from qe.proving.lemma_list import Lemmas

RING = Ring.of(("t",))
T = RING.var("t")


def whole(p: RationalPoly, sign: int, bound: Fraction) -> Poly:
    """A positive multiple of sign * p - bound with whole coefficients."""
    listed = [sign * c for c in p.coefficients()] or [Fraction(0)]
    listed[0] -= bound
    below = lcm(*(c.denominator for c in listed))
    return RING.from_terms({(k,): int(c * below) for k, c in enumerate(listed) if c})


def _ends(length: Fraction) -> tuple[Poly, Poly]:
    return T, T * length.denominator - length.numerator


def exceeding(length: Fraction, excesses: Sequence[Poly]) -> Formula:
    """That there is a time in [0, length] at which one of these is positive."""
    low, high = _ends(length)
    inside = (atom(low, Relation.GE), atom(high, Relation.LE))
    return exists(("t",), conj((*inside, disj(atom(p, Relation.GT) for p in excesses))))


def claims(
    trajectory: Trajectory, limits: Sequence[Limit], factor: Fraction
) -> Iterator[tuple[str, list[Poly], Formula]]:
    """Of each piece: its label, by how much limits are exceeded, and the sentence that one is."""
    for i, length in enumerate(trajectory.lengths):
        excesses = [
            whole(limited(trajectory, limit, i), sign, bound * factor ** (limit.order * limit.power))
            for limit in limits
            for sign, bound in limit.sides
        ]
        slower = "" if factor == 1 else f", {factor} times as slow"
        yield f"piece {i + 1}{slower}", excesses, exceeding(length, excesses)


def _broken(trajectory: Trajectory, outcome: Outcome) -> tuple[str, list[Poly], Formula]:
    limit, peak = outcome.limit, outcome.peak
    excess = whole(limited(trajectory, limit, peak.piece), peak.sign, outcome.bound)
    label = f"{limit.words(trajectory.names)} is exceeded in piece {peak.piece + 1}"
    return label, [excess], exceeding(trajectory.lengths[peak.piece], [excess])


def members(verdict: Verdict) -> list[tuple[str, Certificate]]:
    """Of what is broken, that it is; and that at the repairing factor, 1 where nothing is broken, all limits are kept.

    Raises ``Unable`` where there is no such proof: jumps have no sentence, and a proof may be too long.
    """
    trajectory, listed = verdict.trajectory, list[tuple[str, Certificate]]()
    for outcome in verdict.outcomes:
        if not outcome.is_kept:
            label, _, sentence = _broken(trajectory, outcome)
            evidence: Evidence = {"order": ["t"], "values": [str(_time(trajectory, outcome))]}
            listed.append((label, Certificate.step("instance", RING.names, sentence, TRUE, evidence)))
    if verdict.factor is not None:
        limits = [outcome.limit for outcome in verdict.outcomes]
        every = claims(trajectory, limits, verdict.factor)
        for (label, excesses, sentence), length in zip(every, trajectory.lengths, strict=True):
            listed.append((label, refuted(sentence, excesses, length)))
    if not listed:
        raise Unable("nothing that is proved has a certificate: the trajectory is not continuous")
    return listed


def _time(trajectory: Trajectory, outcome: Outcome) -> Fraction:
    """A rational time at which the limit of the outcome is exceeded."""
    limit, peak = outcome.limit, outcome.peak
    p = limited(trajectory, limit, peak.piece)
    for bits in (16, 32, 64, 128, 256, 512, 1024, 2048):
        low, high = peak.at.interval(bits)
        middle = (low + high) / 2
        short = middle.limit_denominator(1 << bits)
        for t in (short, middle):
            if 0 <= t <= trajectory.lengths[peak.piece] and peak.sign * p(t) > outcome.bound:
                return t
    raise Unable("a limit is exceeded by too little for a certificate")


def refuted(sentence: Formula, excesses: Sequence[Poly], length: Fraction) -> Certificate:
    """That the sentence about these polynomials is false. Raises ``Unable``."""
    if sentence == FALSE:
        return Certificate.derivation(RING.names, FALSE, [], FALSE)
    lemmas, ends = Lemmas(RING), _ends(length)
    for poly in dict.fromkeys(excesses):
        if poly.is_constant:
            continue
        listed = in_bernstein(poly, 0, poly.degree(0), (Fraction(0), length))
        if all(c.constant_value() <= 0 for c in listed.coefficients):
            listed.say(lemmas, [(-listed.power, ((poly, 1),))])
            continue
        unit, factors = poly.factors()
        if len(factors) > 1 or factors[0][1] > 1:
            lemmas.identity([(1, ((poly, 1),)), (-unit, factors)])
        lemmas.line(list(dict.fromkeys((*(e.normal()[1] for e in ends), *(f for f, _ in factors)))), 0)
    if (certificate := by_signs(sentence, lemmas, Budget())) is None:
        raise Unable("a piece has no certificate")
    return certificate


def stated(verdict: Verdict) -> list[Said]:
    """What a certificate has to say about a trajectory: the sentences, made anew from it and its limits."""
    listed: list[Said] = [(*_broken(verdict.trajectory, o)[::2], TRUE) for o in verdict.outcomes if not o.is_kept]
    if verdict.factor is None:
        return listed
    every = claims(verdict.trajectory, [o.limit for o in verdict.outcomes], verdict.factor)
    return [*listed, *((label, sentence, FALSE) for label, _, sentence in every)]
