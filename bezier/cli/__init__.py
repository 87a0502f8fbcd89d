"""The command line."""

from bezier.cli.app import main

__all__ = ["main"]
