"""``bezier chain``: the chain of a file, planned; or a certificate about it, checked."""

from __future__ import annotations

import json
from pathlib import Path

import qe
from bezier.chains.checking import checked
from bezier.chains.plan import bundled, planned
from bezier.chains.reader import load_chain
from bezier.curves.scalar import described
from bezier.input import stored
from qe.errors import InputError
from qe.processes.channel import Channel


def run(
    channel: Channel,
    file: Path,
    *,
    evidence: bool = False,
    page: Path | None = None,
    region: str | None = None,
    as_json: bool = False,
) -> tuple[str, str, bool]:
    """What to print, the certificate's text where there is ``evidence`` wanted, and whether there is a chain."""
    made = planned(load_chain(file)).with_repairs()
    data, lines = made.to_json(), made.lines
    shown = None if region is None else made.region(region)
    if shown is not None:
        data["region"], lines = shown.to_json(), [*lines, str(shown)]
        if made.feasible and shown.name in made.chain.point_names:
            radius = made.validity(shown.name)
            data["region"]["may move by"] = [described(radius.low), described(radius.high)]
            lines.append(str(radius))
    if page is not None:
        try:
            page.write_text(made.page(file.name, shown), encoding="utf-8")
        except OSError as error:
            raise InputError(f"--page {page}: expected a writable file, found: {error.strerror}") from None
    proof = made.proof if shown is None or made.searched else bundled([made.proof, shown.certificate])
    text = json.dumps(data, indent=1, ensure_ascii=False) if as_json else "\n".join(lines)
    return text, proof.to_json() if evidence else "", made.feasible


def check(channel: Channel, file: Path, against: Path, *, as_json: bool = False) -> str:
    """What a certificate proves about the chain of the file. Raises ``CertificateRejected``."""
    lines = checked(load_chain(file), qe.Certificate.from_json(stored.text(against)))
    if as_json:
        return json.dumps({"status": "accepted", "checked": lines}, indent=1, ensure_ascii=False)
    return "\n".join([*lines, "accepted"])
