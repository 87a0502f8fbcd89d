"""Writes the tables of all grammars: ``python -m qe.io.store_tables``, to be run after a change of a grammar."""

from __future__ import annotations

from qe.io import lalr, qepcad, redlog, text_parser

GRAMMARS = {
    "text": (text_parser.GRAMMAR, "start"),
    "text_term": (text_parser.GRAMMAR, "term"),
    "qepcad": (qepcad.GRAMMAR, "start"),
    "redlog": (redlog.GRAMMAR, "start"),
}
"""By the name of its tables: the grammar, and where it starts."""


def main() -> None:
    """Store every table."""
    for name, (grammar, start) in GRAMMARS.items():
        lalr.store(name, grammar, start)


if __name__ == "__main__":
    main()
