"""``bezier route``: start and goal of the scene in a file, joined or separated; or a certificate about it, checked."""

from __future__ import annotations

from pathlib import Path

from bezier.input import stored
from bezier.scenes.route import Wish, checked, decided
from bezier.scenes.scene import load_scene
from qe.extras import wanted
from qe.options import Budget
from qe.processes.channel import Channel


def run(
    channel: Channel,
    file: Path,
    *,
    against: Path | None = None,
    picture: str = "",
    page: bool = False,
    wish: Wish | None = None,
) -> tuple[dict[str, object], list[str], str, bytes, str, bool]:
    """What to print, as data and as lines, the certificate, a ``picture`` of this kind (svg, png, pdf) and a ``page``
    where they are wanted, and whether there is a way.

    ``against``: the file of a certificate that is checked about this scene, in place of a search. Raises
    ``CertificateRejected`` where it is not about it.
    """
    scene = load_scene(file)
    if against is None:
        known = decided(scene, Budget(), wish=wish)
    else:
        known = checked(scene, stored.certificate(against))
    data, lines = known.to_json(), str(known).splitlines()
    if against is not None:
        data["checked"] = True
        lines.append("accepted")
    drawn, shown = b"", ""
    with wanted():
        if picture:
            from bezier.pictures.route import drawing

            drawn = drawing(known, picture)
        if page:
            from bezier.report import html, route

            shown = html.document(route.page(known, lines, file.name))
    proof = "" if known.certificate is None else known.certificate.to_json()
    return data, lines, proof, drawn, shown, not known.blocked
