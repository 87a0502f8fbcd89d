"""The rules of derivations that the kernel decides: one line a checker, with the rules that it knows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module

from qe.kernel.step import Check

_QUANTIFIERS = ("quantifiers", "renaming", "duality", "negation normal form", "independent parts and miniscoping")
_RULES = {
    # frame
    "nested.check_steps": ("steps", "virtual substitution", "equations taken apart"),
    "nested.check_converse": ("converse",),
    "nested.check_no_exception": ("no exception",),
    "parts.check_parts": ("parts",),
    "witness.check_instance": ("instance",),
    # signs
    "block.check_block": ("signs",),
    "quantifiers.check_quantifiers": (*_QUANTIFIERS, "nested blocks of one kind gathered"),
    # terms, and roots that exist
    "terms.check_terms": ("terms",),
    "root.check_root": ("root",),
    "linear_equation.check_linear": ("linear equation solved",),
    # test points
    "elimination_set.check_elimination_set": ("elimination set",),
    # cylinders
    "table.check_table": ("cells", "shorter", "covering"),
    # open sets
    "open_block.check_inequations": ("inequations that remove no interior",),
    "open_block.check_open_block": ("open block",),
    "theorem.check_theorem": ("theorem",),
}
_CHECKERS = {rule: checker for checker, rules in _RULES.items() for rule in rules}


class _Primitives(Mapping[str, Check]):
    """A checker is loaded when its rule is named: most certificates name few."""

    def __getitem__(self, rule: str) -> Check:
        module, name = _CHECKERS[rule].split(".")
        check: Check = getattr(import_module(f"qe.kernel.{module}"), name)
        return check

    def __iter__(self) -> Iterator[str]:
        return iter(_CHECKERS)

    def __len__(self) -> int:
        return len(_CHECKERS)


PRIMITIVES: Mapping[str, Check] = _Primitives()
