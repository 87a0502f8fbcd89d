"""``python -m qe`` is the command ``qe``."""

from __future__ import annotations

import sys

from qe.cli.app import main

if __name__ == "__main__":
    sys.exit(main())
