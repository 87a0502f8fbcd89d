"""The readers under atheris, instrumented: ``python -m tests.guided_fuzz SECONDS``, for ``tests.fuzz --guided``."""

import sys

import atheris  # type: ignore[import-not-found,unused-ignore]

if __name__ == "__main__":
    hook = atheris.instrument_imports(
        include=["qe.io", "qe.cli", "qe.arguments", "qe.proof", "bezier.arm", "bezier.input"]
    )
    hook.__enter__()  # for good: modules are loaded when they are first needed
    from tests.fuzz import guided

    guided(float(sys.argv[1]))
