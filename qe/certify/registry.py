"""The rules of derivations, each with its checker. A rule that is not here proves nothing."""

from __future__ import annotations

from collections.abc import Mapping

from qe.expert.rules import EXPERT
from qe.kernel.primitives import PRIMITIVES
from qe.kernel.step import Check

RULES: Mapping[str, Check] = {**PRIMITIVES, **EXPERT}
