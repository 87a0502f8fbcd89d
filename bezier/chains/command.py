"""``bezier chain``: the chain of a file, planned; or a certificate about it, checked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bezier.chains.checking import checked
from bezier.chains.plan import bundled, planned
from bezier.chains.reader import load_chain
from bezier.curves.scalar import described
from bezier.input import stored
from qe.processes.channel import Channel


def run(
    channel: Channel, file: Path, *, evidence: bool = False, page: bool = False, region: str | None = None
) -> tuple[dict[str, Any], list[str], str, str, bool]:
    """What to print, as data and as lines, the texts of certificate and page where they are wanted, and whether there
    is a chain."""
    made = planned(load_chain(file)).with_repairs()
    data, lines = made.to_json(), made.lines
    shown = None if region is None else made.region(region)
    if shown is not None:
        data["region"], lines = shown.to_json(), [*lines, str(shown)]
        if made.feasible and shown.name in made.chain.point_names:
            radius = made.validity(shown.name)
            data["region"]["may move by"] = [described(radius.low), described(radius.high)]
            lines.append(str(radius))
    proof = made.proof if shown is None or made.searched else bundled([made.proof, shown.certificate])
    return data, lines, proof.to_json() if evidence else "", made.page(file.name, shown) if page else "", made.feasible


def check(channel: Channel, file: Path, against: Path) -> tuple[dict[str, Any], list[str]]:
    """What a certificate proves about the chain of the file. Raises ``CertificateRejected``."""
    lines = checked(load_chain(file), stored.certificate(against))
    return {"status": "accepted", "checked": lines}, [*lines, "accepted"]
