"""Certificates that a method can make, and makes only where somebody asks for proofs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from qe.proof.certificate import Certificate


@dataclass(frozen=True)
class OnDemand:
    """``make``: the certificates that a step rests on. It may raise ``Unable``."""

    make: Callable[[], list[Certificate]]
