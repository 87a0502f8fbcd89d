"""``python -m qe.plain FILE``: the plain reader; see ``qe.plain.reader``."""

import sys

from qe.plain import flint

sys.modules.setdefault("flint", flint)  # before the kernel, which imports it by this name

from qe.plain.reader import main  # noqa: E402

if __name__ == "__main__":
    main()
