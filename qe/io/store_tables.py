"""Writes the tables of all grammars: ``python -m qe.io.store_tables``, to be run after a change of a grammar."""

from __future__ import annotations

from qe.io import lalr, qepcad, redlog, smtlib_parser, text_parser

GRAMMARS = {
    "text": text_parser.GRAMMAR,
    "qepcad": qepcad.GRAMMAR,
    "redlog": redlog.GRAMMAR,
    "smtlib": smtlib_parser.GRAMMAR,
}
START = "start"


def main() -> None:
    """Store every table."""
    for name, grammar in GRAMMARS.items():
        lalr.store(name, grammar, START)


if __name__ == "__main__":
    main()
