"""Certificates for the runs of a path, and of all its motions, which ``qe.verify`` checks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import ceil, floor, tau

from bezier.arm.continuous import ContinuousMotions
from bezier.arm.critical import Number
from bezier.arm.follow import SPARE, Branch
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.model import Arm
from bezier.arm.motion_chain import ProvedPiece
from bezier.arm.motion_chain import piece as proved_piece
from bezier.arm.roots_of_squares import arm_json, common_factor
from bezier.arm.vertical import SignsAlong
from bezier.curves.curve import Bezier
from bezier.curves.scalar import exactly
from bezier.proofs import branch as checked
from bezier.proofs import inverse_position, joint_motions
from bezier.proofs.course import Course, coefficients
from bezier.proofs.square_roots import ONE, Polynomial, Surd
from qe.certify.verify import verify
from qe.errors import BudgetExceeded, CertificateRejected, Unable
from qe.expert.sentences import Sentence
from qe.kernel.verdict import Verdict
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, Json


def curve_json(curve: Bezier) -> Json:
    """The control points of a curve."""
    return [[str(exactly(c)) for c in point] for point in curve.points]


LEAST = Fraction(1, 1 << 40)
ROUNDING = 1e-14


def limited_pieces(
    arm: Arm, curves: Sequence[Bezier], parts: Sequence[tuple[int, Branch]], turns: Sequence[int]
) -> Iterator[tuple[int, ProvedPiece]]:
    """Pieces with the index of their curve, ``turns`` full turns added. Raises ``Unable`` where a joint comes closer to
    a limit than boxes can resolve."""
    if not arm.has_limits:
        yield from ((k, piece) for k, branch in parts for piece in branch.pieces)
        return
    points = [[tuple(exactly(c) for c in p) for p in curve.points] for curve in curves]
    tubes = checked.Tubes(Entry(arm_json(arm), "arm"), points, [joint.limits for joint in arm.joints])
    courses = [Course(arm.chain, coefficients(curve.points)) for curve in curves]
    for k, branch in parts:
        open_ones = [_turned(piece, turns) for piece in reversed(branch.pieces)]
        while open_ones:
            piece = open_ones.pop()
            if _keeps(tubes, k, piece):
                yield k, piece
                continue
            middle = (piece.low + piece.high) / 2
            halves = [
                proved_piece(courses[k], low, high, [float(v) for v in piece.at((low + high) / 2)])
                for low, high in ((middle, piece.high), (piece.low, middle))
            ]
            if piece.high - piece.low < LEAST or None in halves:
                raise Unable(f"near s = {float(middle):.9g} a joint is closer to a limit than boxes can resolve")
            open_ones += [half for half in halves if half is not None]


def _turned(piece: ProvedPiece, turns: Sequence[int]) -> ProvedPiece:
    """Moved by full turns, rounded: the boxes have room for that."""
    centre = tuple(c + tau * k for c, k in zip(piece.centre, turns, strict=True))
    inner = tuple(r + ROUNDING * abs(k) for r, k in zip(piece.inner, turns, strict=True))
    return replace(piece, centre=centre, inner=inner)


def _keeps(tubes: checked.Tubes, curve: int, piece: ProvedPiece) -> bool:
    centre, slope, radius = (tuple(map(Fraction, values)) for values in (piece.centre, piece.slope, piece.radius))
    given = checked.Tube(curve, piece.low, piece.high, centre, slope, radius, Entry(None, "piece"))
    return tubes.unlimited(given, [SPARE * Fraction(r) for r in piece.inner]) is None


ATTEMPTS = (16, 40, 100, 250)
"""Binary places of the intervals around what is special: more where such places lie close together."""


def motions_certificate(motions: ContinuousMotions) -> Certificate:
    """The certificate that these are all continuous motions, accepted. Raises ``Unable`` where there is none."""
    factors = [[(s, _factor(signs, s)) for s in signs.places] for signs in motions.curves]

    def payloads() -> Iterator[dict[str, Json]]:
        for bits in ATTEMPTS:
            yield {
                "arm": arm_json(motions.arm),
                "curves": [curve_json(signs.curve) for signs in motions.curves],
                "places": [[_place(s, factor, bits) for s, factor in places] for places in factors],
                "solutions": [len(arcs.labels) for arcs in motions.arcs],
                "through": [len(junction.passes) for junction in motions.junctions],
                "motions": motions.count,
            }

    return MOTIONS.accepted(payloads())


@dataclass(frozen=True, slots=True)
class SentenceRule:
    """A rule, and the sentence that its evidence proves where it is accepted."""

    rule: str
    sentence: Callable[[Entry], Sentence]

    def certificate(self, evidence: Entry) -> Certificate:
        """The sentence, by one step with this evidence. Raises ``CertificateRejected`` where it is malformed."""
        assert isinstance(evidence.value, dict)
        return Certificate.step(self.rule, (), *self.sentence(evidence), evidence.value)

    def accepted(self, listed: Iterable[dict[str, Json]]) -> Certificate:
        """That of the first evidence that the checker accepts. Raises ``Unable`` with its last reason without one."""
        reason = "the last joint is undetermined"
        for evidence in listed:
            try:
                certificate = self.certificate(Entry(evidence, "evidence"))
            except CertificateRejected as error:
                reason = error.reason
                continue
            verdict = verify(certificate)
            if verdict.accepted:
                return certificate
            reason = verdict.reason
        raise Unable(f"no certificate was found: {reason}")


POSITIONS = SentenceRule("joint positions", inverse_position.sentence)
MOTIONS = SentenceRule("joint motions", joint_motions.sentence)
LIMITED = SentenceRule("joints along curves", checked.sentence)


def _place(s: Number, factor: Json, bits: int) -> Json:
    """An interval around s."""
    low, high = (s, s) if isinstance(s, Fraction) else s.interval(bits + 4)
    unit = Fraction(1, 1 << bits)
    ends = floor(low / unit - 1) * unit, ceil(high / unit + 1) * unit
    return {"low": str(ends[0]), "high": str(ends[1]), "factor": factor}


def _factor(signs: SignsAlong, s: Number) -> Json:
    """A polynomial with a simple zero at s that divides W, N and A as often as they vanish there; None for N itself."""
    if isinstance(s, Fraction):
        return _written(Polynomial((Surd.rational(-s), ONE)))
    sign, quality, norm = partial(signs.sign, s), signs.signs.quality, signs.signs.norm
    if norm is not None and not signs.vanishes(s)[0] and sign(norm.derivative):
        return None
    result = Polynomial(tuple(map(Surd.rational, s.minimal_polynomial)))
    for p in (signs.signs.w, norm, None if quality is None else quality[0]):
        while p and not sign(p):
            result = common_factor(result, p)
            p = p.derivative
    return _written(result)


def _written(p: Polynomial) -> Json:
    return [[[str(q), d] for d, q in c.terms] for c in p]


ALL = "all continuous joint motions"
Labelled = list[tuple[str, Certificate]]


def certificates(path: JointPath) -> Labelled:
    """Labelled certificates: of every run that keeps the limits of the joints, unless a joint comes closer to one than
    boxes tell; and of all continuous motions, limits left aside, where their number is decided by signs."""
    of_runs = ((_label(path, run), partial(_branch_certificate, path, run)) for run in path.runs if not run.excesses)
    of_all = [] if path.motions is None else [(ALL, partial(motions_certificate, path.motions))]
    listed = Labelled()
    for label, made in (*of_runs, *of_all):
        try:
            listed.append((label, made()))
        except BudgetExceeded:
            raise
        except Unable:
            continue
    return listed


def without_certificate(path: JointPath, listed: Labelled) -> dict[str, str]:
    """The motions, by their numbers, that keep the limits of the joints without a certificate of that, and why."""
    labels = {label for label, _ in listed}
    runs = {run.number: run for run in path.runs if not run.excesses}
    close = "a joint comes closer to a limit than boxes tell"
    missing = {n: close for n, run in runs.items() if _label(path, run) not in labels}
    if path.arm.has_limits:
        boxless = "it goes where boxes do not: that it keeps the limits is decided, and not certified"
        missing |= dict.fromkeys(sorted(path.kept_numbers - {*runs}), boxless)
    return {str(n): why for n, why in missing.items()}


def in_words(path: JointPath, listed: Labelled, verdict: Verdict) -> list[str]:
    """What certificates there are, whether they are accepted, and what they claim and do not claim."""
    of_all = [label for label, _ in listed if label == ALL]
    limits = (", within the limits", ", limits left aside") if path.arm.has_limits else ("", "")
    text = f"{len(listed) - len(of_all) or 'none'} of motions held by boxes{limits[0]}; "
    text += f"one of the number of all motions{limits[1]}" if of_all else "none of the number of motions"
    state = "accepted" if verdict.accepted else f"REJECTED at {verdict.step}: {verdict.reason}"
    lines = [f"certificates of the joint motions: {f'{state} ({text})' if listed else 'none'}"]
    return lines + [f"  none of motion {n}: {why}" for n, why in without_certificate(path, listed).items()]


def _label(path: JointPath, run: Run) -> str:
    return f"motion {run.number}" + (", the whole path" if run.covers(len(path.curves)) else "")


def _branch_certificate(path: JointPath, run: Run) -> Certificate:
    curves = list(path.curves.values())
    used = sorted({k for k, _ in run.parts})
    pieces = list[Json]()
    for k, piece in limited_pieces(path.arm, curves, run.parts, run.turns):
        triples = {"centre": piece.centre, "slope": piece.slope, "radius": piece.radius}
        numbers: dict[str, Json] = {key: [str(Fraction(v)) for v in values] for key, values in triples.items()}
        pieces.append({"curve": k - used[0], "low": str(piece.low), "high": str(piece.high), **numbers})
    payload: dict[str, Json] = {
        "arm": arm_json(path.arm),
        "curves": [curve_json(curves[k]) for k in used],
        "limits": [None if j.limits is None else [str(v) for v in j.limits] for j in path.arm.joints],
        "pieces": pieces,
    }
    return LIMITED.certificate(Entry(payload, "evidence"))
