"""``bezier retime``: the least time along the path in a file; or a certificate about it, checked."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

from bezier.input import stored
from bezier.input.toml_table import Table
from bezier.motion.timelaw import Law
from bezier.retiming.least_time import checked, least_time
from bezier.trajectories.command import limits_of
from bezier.trajectories.readers import load
from qe.processes.channel import ANSWERED, Channel


def run(
    channel: Channel,
    file: Path,
    limits: Path,
    *,
    law: Law = Law.LEAST,
    accuracy: Fraction,
    evidence: bool = False,
    against: Path | None = None,
    page: bool = False,
) -> tuple[dict[str, Any], list[str], str, str, str]:
    """What to print, as data and as lines, the motion as CSV, the certificate's text and the page where they are
    wanted.

    ``against``: a certificate that is checked about this path, in place of a search. Raises ``InputError``, ``Unable``,
    and ``CertificateRejected`` for that certificate.
    """
    path = load(file)
    listed = limits_of(Table.load(limits), len(path.names))

    def said(result: Any) -> tuple[dict[str, Any], list[str], str, str, str]:
        data, lines = result.to_json(), result.lines
        if against is not None:
            data["checked"] = True
            lines.append("accepted")
        proof = result.certificate.to_json() if evidence else ""
        return data, lines, result.to_csv(), proof, result.page(file.name) if page else ""

    if against is not None:
        return said(checked(path, listed, stored.certificate(against)))
    budget = channel.budget()
    budget.keep = lambda result: channel.fact(ANSWERED, said(result))
    return said(least_time(path, listed, budget, law=law, accuracy=accuracy))
