"""What has to be believed, in lines: each ring, and what it imports beside itself. None may grow unnoticed."""

from __future__ import annotations

import pytest

from tests.architecture.test_rows import MODULES, imports

FILES = dict(MODULES)
MOST = {"qe.kernel": 4_850, "qe.expert": 2_370, "qe.certify": 400, "bezier.proofs": 2_890}
"""Lines of the files of each ring; lowered whenever a ring becomes smaller."""
MOST_IMPORTED = 2_900
"""Lines of all other files that the kernel imports, directly or not: the ring of polynomials, formulas, entries."""


def lines(names: set[str]) -> int:
    return sum(FILES[name].read_text().count("\n") for name in names)


def ring_of(prefix: str) -> set[str]:
    return {name for name in FILES if name == prefix or name.startswith(f"{prefix}.")}


def imported(names: set[str]) -> set[str]:
    """All modules of the project that these import, directly or not."""
    pending, seen = list(names), set(names)
    while pending:
        module = pending.pop()
        for _, name in imports(FILES[module], module):
            if name in FILES and name not in seen:
                seen.add(name)
                pending.append(name)
    return seen


@pytest.mark.parametrize("ring", MOST)
def test_a_ring_does_not_grow(ring: str) -> None:
    assert MOST[ring] - 200 < lines(ring_of(ring)) <= MOST[ring]


def test_what_the_kernel_imports_does_not_grow() -> None:
    beside = imported(ring_of("qe.kernel")) - ring_of("qe.kernel")
    assert MOST_IMPORTED - 200 < lines(beside) <= MOST_IMPORTED
    assert not {name for name in beside if name.startswith(("qe.expert", "qe.proving", "qe.rules", "qe.elimination"))}
