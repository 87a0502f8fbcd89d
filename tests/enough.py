"""Property tests of two sizes, and a floor under those that may leave examples undecided."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st


def sized(
    few: int, many: int, *drawn: st.SearchStrategy[Any], **named: st.SearchStrategy[Any]
) -> Callable[[Callable[..., None]], Callable[[int], None]]:
    """Turn a function into a test over ``few`` examples on every day, and over ``many`` in the deep tests."""

    def made(body: Callable[..., None]) -> Callable[[int], None]:
        @pytest.mark.parametrize("examples", [few, pytest.param(many, marks=pytest.mark.deep)])
        def test(examples: int) -> None:
            settings(max_examples=examples)(given(*drawn, **named)(body))()

        test.__name__, test.__doc__ = body.__name__, body.__doc__
        return test

    return made


def enough(
    at_least: int, of: int, *drawn: st.SearchStrategy[Any]
) -> Callable[[Callable[..., bool]], Callable[[], None]]:
    """Turn a function into a test over ``of`` examples, at least ``at_least`` of which it decides.

    The function returns whether a limit left it time to test anything. The floor lies far below what a quiet machine
    decides: it is there for a test that has become empty, not for a slow one.
    """

    def made(body: Callable[..., bool]) -> Callable[[], None]:
        decided: list[bool] = []

        @settings(max_examples=of)
        @given(st.tuples(*drawn))
        def examples(values: tuple[Any, ...]) -> None:
            decided.append(body(*values))

        def test() -> None:
            decided.clear()
            examples()
            assert sum(decided) >= at_least, f"only {sum(decided)} of {len(decided)} examples were decided"

        test.__name__, test.__doc__ = body.__name__, body.__doc__
        return test

    return made
