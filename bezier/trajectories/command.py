"""``bezier certify``: a trajectory of any origin against limits and a scene, for all t."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import qe
from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.scalar import described
from bezier.input import stored
from bezier.input.numbers import describe
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.reader import read_obstacles
from bezier.trajectories.evidence import check, members
from bezier.trajectories.limits import Limit, Outcome, Verdict, decided, from_values
from bezier.trajectories.piecewise import QUANTITIES, Trajectory
from bezier.trajectories.readers import load
from qe.errors import InputError
from qe.processes.channel import Channel

if TYPE_CHECKING:
    from bezier.report.html import Page

KEYS = (*QUANTITIES, *(f"{name}_norm" for name in QUANTITIES[1:]))


def read_limits(file: Path, axes: int) -> list[Limit]:
    """A TOML file with ``velocity``, ``acceleration``, ``jerk``: one number, or a list of one for each axis;
    ``velocity_norm``, ...; and ``position``: a pair, or a list of one for each axis. Raises ``InputError``."""
    table = Table.load(file)
    table.only(KEYS)
    values: dict[str, Any] = {}
    for key in table.values:
        raw = table.values[key]
        if key == "position":
            values[key] = _pairs(table, raw, axes)
        elif key.endswith("_norm"):
            values[key] = table.positive(key)
        elif not isinstance(raw, list):
            values[key] = [table.positive(key)] * axes
        elif len(raw) != axes:
            raise table.error(key, f"a number, or one for each of {axes} axes", describe(raw))
        else:
            parts = [Table({f"{key}[{k}]": item}, table.source, table.lines) for k, item in enumerate(raw)]
            values[key] = [part.positive(f"{key}[{k}]") for k, part in enumerate(parts)]
    return from_values(values, axes)


def _pairs(table: Table, raw: object, axes: int) -> list[tuple[Fraction, Fraction]]:
    listed = raw if isinstance(raw, list) and raw and isinstance(raw[0], list) else [raw] * axes
    if len(listed) != axes or not all(isinstance(pair, list) and len(pair) == 2 for pair in listed):
        raise table.error("position", f"a pair, or a pair for each of {axes} axes", describe(raw))
    keys = [(f"position[{k}][0]", f"position[{k}][1]") for k in range(axes)]
    tables = [Table(dict(zip(k, p, strict=True)), table.source, table.lines) for k, p in zip(keys, listed, strict=True)]
    pairs = [(t.number(low), t.number(high)) for t, (low, high) in zip(tables, keys, strict=True)]
    for low, high in pairs:
        if low > high:
            raise table.error("position", "the lower limit first", f"{low} before {high}")
    return pairs


def curves(trajectory: Trajectory) -> dict[str, Bezier]:
    """Each piece as a curve in space; a third coordinate that is missing is 0. Raises ``InputError`` for other axes."""
    if len(trajectory.names) not in (2, 3):
        raise InputError(f"--scene: expected a trajectory of 2 or 3 axes, found {len(trajectory.names)}")
    result = {}
    for i, (row, h) in enumerate(zip(trajectory.pieces, trajectory.lengths, strict=True)):
        degree = max(0, *(p.degree for p in row))
        columns = []
        for p in row:
            scaled = [c * h**k for k, c in enumerate(p.coefficients())]
            columns.append(bs.from_power([*scaled, *[Fraction(0)] * (degree + 1 - len(scaled))]))
        columns += [(Fraction(0),) * (degree + 1)] * (3 - len(row))
        result[f"piece {i + 1}"] = Bezier.of(list(zip(*columns, strict=True)))
    return result


def certify(
    channel: Channel,
    file: Path,
    limits: Path | None,
    scene: Path | None,
    interpolation: str | None,
    tolerance: Fraction,
    *,
    evidence: Path | None = None,
    against: Path | None = None,
    page: Path | None = None,
    as_json: bool = False,
) -> tuple[str, str]:
    """What to print, and the certificate's text where ``evidence`` is wanted.

    ``page``: a file for the page with a chart of each quantity. ``against``: a certificate that is checked. Raises
    ``InputError``, and ``CertificateRejected`` for that certificate.
    """
    trajectory = load(file, interpolation)
    listed = [] if limits is None else read_limits(limits, len(trajectory.names))
    try:
        verdict = decided(trajectory, listed, tolerance)
        data, lines = to_json(verdict), in_words(verdict)
    except OverflowError:
        raise InputError(f"{file}: expected quantities of usual size, found one beyond 10^308") from None
    obstacles = () if scene is None else read_obstacles(Table.load(scene))
    findings = survey.survey(curves(trajectory), obstacles, distances=False) if obstacles else ()
    clear = survey.certificates(findings)
    if against is not None:
        check(verdict, qe.Certificate.from_json(stored.text(against)), clear)
    proof = ""
    if evidence is not None:
        proof = qe.Certificate.bundle([*(members(verdict) if listed else ()), *clear]).to_json()
    if scene is not None:
        data["scene"] = [survey.to_json(f) for f in findings]
    data["kept"] = data["kept"] and not survey.contacts(findings)
    lines += [survey.in_words(f) for f in survey.contacts(findings)]
    if findings and not survey.contacts(findings):
        lines.append(f"clear of all obstacles for all t: {len(findings)} pairs of pieces and obstacles")
    if against is not None:
        lines.append("the certificate proves it: accepted")
    if page is not None:
        from bezier.report.trajectory import page as made

        _write_page(page, made(verdict, lines, file.name, clear=not survey.contacts(findings)))
    return json.dumps(data, indent=1, ensure_ascii=False) if as_json else "\n".join(lines), proof


def _write_page(file: Path, page: Page) -> None:
    from bezier.report.html import document

    try:
        file.write_text(document(page), encoding="utf-8")
    except OSError as error:
        raise InputError(f"--page {file}: expected a writable file, found: {error.strerror}") from None


def to_json(verdict: Verdict) -> dict[str, Any]:
    """Everything, with exact numbers."""
    names, factor = verdict.trajectory.names, verdict.factor
    return {
        "status": "solved",
        "kept": verdict.is_kept,
        "limits": [_outcome(o, verdict.trajectory) for o in verdict.outcomes],
        "jumps": [
            {"of": QUANTITIES[j.order], "axis": names[j.axis], "time": described(j.time), "size": described(j.size)}
            for j in verdict.jumps
        ],
        "broken by jumps": bool(verdict.breaking),
        "slower by": None if factor is None else described(factor),
    }


def _outcome(outcome: Outcome, trajectory: Trajectory) -> dict[str, Any]:
    limit, time = outcome.limit, outcome.time(trajectory)
    return {
        "of": limit.words(trajectory.names),
        "limit": [str(limit.high)] if limit.low is None else [str(limit.low), str(limit.high)],
        "kept": outcome.is_kept,
        "worst": outcome.value,
        "time": {"exact": str(time), "decimal": f"{float(time):.12g}"},
    }


def in_words(verdict: Verdict) -> list[str]:
    """A line for each limit, and what follows."""
    trajectory, names = verdict.trajectory, verdict.trajectory.names
    span = f"from t = {_decimal(trajectory.breaks[0])} to {_decimal(trajectory.breaks[-1])}"
    lines = [f"{len(trajectory.pieces)} pieces, {len(names)} axes, {span}"]
    for o in verdict.outcomes:
        state = "kept for all t, largest" if o.is_kept else "EXCEEDED, worst"
        lines.append(f"{o.limit.words(names)}: {state} {o.value:.10g} at t = {float(o.time(trajectory)):.10g}")
    for j in verdict.jumps:
        wrong = "NOT CONTINUOUS, a jump" if j in verdict.breaking else "joins with a difference"
        place = f"({names[j.axis]} at t = {_decimal(j.time)})"
        lines.append(f"{QUANTITIES[j.order]}: {wrong} of at most {_decimal(j.size)} {place}")
    if verdict.is_kept:
        return [*lines, "all limits are kept for all t"]
    if worst := verdict.worst:
        when = f"{float(worst.time(trajectory)):.12g}"
        lines.append(f"refuted: {worst.limit.words(names)} is {worst.value:.10g} at t = {when}")
    if verdict.factor is None:
        return [*lines, "going slower does not repair it"]
    return [*lines, f"{verdict.factor} = {_decimal(verdict.factor)} times as slow, all limits are kept for all t"]


def _decimal(value: Fraction) -> str:
    return f"{float(value):.10g}"
