"""``python -m bezier`` is the command ``bezier``."""

from __future__ import annotations

import sys

from bezier.cli import main

if __name__ == "__main__":
    sys.exit(main())
