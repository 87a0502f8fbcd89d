"""The command line. What its commands do stands with their subjects."""

from bezier.cli.app import main

__all__ = ["main"]
