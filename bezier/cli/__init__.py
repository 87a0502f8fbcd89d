"""The command line: one file for each command, and ``app``, which lists them."""

from bezier.cli.app import main

__all__ = ["main"]
