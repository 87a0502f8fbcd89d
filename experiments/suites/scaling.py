"""The suite ``scaling``: families in which one number grows, for curves of time over size."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction

from experiments import formulas
from experiments.problem import Problem
from experiments.suites import families, paper

SEED = 7
DEGREES = (4, 8, 12, 16, 24, 32)
VIA_POINTS = (2, 3, 4, 6, 8, 12)
BALLS = range(2, 9)
BITS = (16, 64, 256, 1024, 4096)
HEIGHTS = (1, 2, 3, 4, 5)


def problems() -> list[Problem]:
    """All scaling families."""
    curves = [*_degrees(), *_via_points(), *_balls(2), *_balls(3), *_coefficients(), *_towers()]
    return [*curves, *families.problems()]


def _degrees() -> Iterator[Problem]:
    """Feasibility of (4) for growing degree of the curve: n - 1 variables."""
    for n in DEGREES:
        text = paper.single_curve(n)
        yield Problem("scaling/degree", f"degree-{n}", text, "true", size=n)


def _via_points() -> Iterator[Problem]:
    """The analogue of (8) for more via points on a slight bend: 3 variables for each are eliminated."""
    for k in VIA_POINTS:
        via = [(Fraction(i), Fraction(3 + i % 2), Fraction(3)) for i in range(k)]
        radius = 200 + 4 * k * k
        region = formulas.chain_region(via, radius)
        yield Problem("scaling/via", f"via-{k}", formulas.chain(via, radius), region, size=k)


def _balls(dimension: int) -> Iterator[Problem]:
    """Have k balls around points near the origin a common point? The origin is in all of them."""
    rng = random.Random(SEED)
    centres = [[Fraction(rng.randint(-30, 30), 10) for _ in range(dimension)] for _ in BALLS] * 2
    centres = [[c + Fraction(i, 7) for c in centre] for i, centre in enumerate(centres)]
    variables = formulas.coordinates("", dimension)
    for k in BALLS:
        radius = max(sum(c * c for c in centre) for centre in centres[:k])
        text = f"ex {', '.join(variables)}. {formulas.in_balls(variables, centres[:k], radius)}"
        yield Problem(f"scaling/balls-{dimension}d", f"balls-{dimension}d-{k}", text, "true", size=k)


def _coefficients() -> Iterator[Problem]:
    """The shadow of two discs with coordinates of growing size."""
    rng = random.Random(SEED)
    for bits in BITS:
        scale = 2**bits
        centres = [[Fraction(rng.randint(-scale, scale), scale - 1) for _ in range(2)] for _ in range(2)]
        text = f"ex y. {formulas.in_balls(['x', 'y'], centres, 4)}"
        yield Problem("scaling/bits", f"bits-{bits}", text, size=bits)


def _towers() -> Iterator[Problem]:
    """A sign at a sample point over a tower of square roots: x1^2 = 2, x(i+1)^2 = x(i) + i, all positive."""
    for height in HEIGHTS:
        names = [f"x{i}" for i in range(1, height + 1)]
        parts = ["x1^2 = 2", *(f"x{i + 1}^2 = x{i} + {i}" for i in range(1, height))]
        parts += [f"{name} > 0" for name in names]
        parts.append(f"y^2 <= {' * '.join(names)} and y > 1")
        text = f"ex {', '.join(names)}, y. {' and '.join(parts)}"
        yield Problem("scaling/tower", f"tower-{height}", text, "true", size=height)
