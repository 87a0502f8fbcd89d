"""``python -m paper_repro [--out FOLDER] [--only KEY ...] [--list]``: run the checks and write the page.

Exit status: 0 all verdicts borne out, 1 some check failed, 2 bad input.
"""

from __future__ import annotations

import argparse
import platform
import sys
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

import qe
from bezier.planner.outputs import all_or_none
from paper_repro import markdown, page
from paper_repro.claim import Asked, Claim, Entry, Picture, Verdict, examine_all
from paper_repro.claims import CLAIMS


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; returns the exit status."""
    parser = argparse.ArgumentParser("paper_repro", description="The paper, claim by claim.")
    parser.add_argument("--out", type=Path, default=Path("out/paper"), help="folder for the page (default: out/paper)")
    parser.add_argument("--only", metavar="KEY", action="append", help="only this entry (may be given several times)")
    parser.add_argument("--list", action="store_true", help="list the entries as a table and stop")
    options = parser.parse_args(arguments)
    if options.list:
        print("\n".join(markdown.summary(CLAIMS)))
        return 0
    try:
        entries = examine_all(_chosen(options.only), _tell)
        write(entries, options.out)
    except qe.InputError as error:
        print(error, file=sys.stderr)
        return 2
    print(f"written: {options.out / 'index.html'}")
    return int(any(e.verdict is Verdict.FAILED for e in entries))


def _chosen(keys: Sequence[str] | None) -> tuple[Claim, ...]:
    known = {c.key: c for c in CLAIMS}
    unknown = [key for key in keys or () if key not in known]
    if unknown:
        raise qe.InputError(f"--only {unknown[0]}: no such entry; --list shows them")
    return CLAIMS if keys is None else tuple(known[key] for key in keys)


def _tell(entry: Entry) -> None:
    print(f"{entry.claim.key:24}{entry.verdict.value:30}{entry.seconds:6.1f} s", flush=True)
    for text in entry.failures:
        print(f"    not borne out: {text}")


def write(entries: Sequence[Entry], folder: Path) -> None:
    """``index.html``, ``paper.md``, and the pictures and certificates as files; all of them or none."""
    made = (
        f"Made by bezier-qe {qe.__version__} with Python {platform.python_version()} on {platform.machine()}, "
        f"{datetime.now(UTC):%Y-%m-%d}."
    )
    with all_or_none(folder) as fresh:
        (fresh / "index.html").write_text(page.render(entries, made), encoding="utf-8")
        (fresh / "paper.md").write_text(markdown.render(entries, made), encoding="utf-8")
        for entry in entries:
            for item in entry.evidence:
                if isinstance(item, Picture):
                    (fresh / page.picture_name(entry, item)).write_text(item.svg, encoding="utf-8")
                elif isinstance(item, Asked) and item.certificate is not None:
                    (fresh / page.certificate_name(entry, item)).write_text(
                        item.certificate.to_json(), encoding="utf-8"
                    )


if __name__ == "__main__":
    sys.exit(main())
