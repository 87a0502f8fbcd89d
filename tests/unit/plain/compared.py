"""Random values for the plain arithmetic and for FLINT, and both results in one form."""

import random
from collections.abc import Callable
from typing import Any

import flint

import qe.plain.flint as plain

Terms = dict[tuple[int, ...], int]
EDGES = (0, 0, 1, -1, 2, -6, 2**64, -(2**64) + 1)


def number(rng: random.Random, bits: int = 12) -> int:
    """An integer: often small, 0 or at the edge of a machine word."""
    return rng.choice((*EDGES, rng.randint(-9, 9), rng.randint(-9, 9), rng.randint(-(2**bits), 2**bits)))


def coefficients(rng: random.Random, degree: int) -> list[int]:
    """Of a polynomial in one variable, from degree 0 up; the last one may be 0."""
    return [number(rng) for _ in range(rng.randint(0, degree) + 1)]


def terms(rng: random.Random, variables: int, count: int, degree: int) -> Terms:
    """Of a polynomial in several variables."""
    exponents = [tuple(rng.randint(0, degree) for _ in range(variables)) for _ in range(rng.randint(0, count))]
    return {e: rng.randint(-9, 9) for e in exponents}


def both(*data: Any) -> tuple[list[Any], list[Any]]:
    """The same polynomials of FLINT and of the plain arithmetic: lists in one variable, dictionaries in several."""
    return [_made(flint, d) for d in data], [_made(plain, d) for d in data]


def _made(library: Any, data: Any) -> Any:
    if isinstance(data, list):
        return library.fmpz_poly(data)
    names = tuple(f"v{i}" for i in range(len(next(iter(data), (0, 0, 0)))))
    return library.fmpz_mpoly_ctx.get(names, "lex").from_dict(data)


def shown(value: Any) -> Any:
    """A value of either library in one form."""
    if isinstance(value, tuple | list):
        return [shown(v) for v in value]
    if hasattr(value, "terms"):
        return [(tuple(map(int, e)), shown(c)) for e, c in value.terms()]
    if hasattr(value, "coeffs"):
        return [int(c) for c in value.coeffs()]
    if hasattr(value, "p"):
        return int(value.p), int(value.q)
    return int(value)


def same(operation: Callable[..., Any], *data: Any) -> bool:
    """Whether the operation has one result, or one kind of error, in both libraries."""
    results = [_result(operation, *given) for given in both(*data)]
    assert results[0] == results[1], (data, results)
    return True


def _result(operation: Callable[..., Any], *given: Any) -> Any:
    try:
        return shown(operation(*given))
    except (flint.utils.flint_exceptions.DomainError, ZeroDivisionError, ArithmeticError, RuntimeError) as error:
        return type(error).__name__


def factors(p: Any) -> Any:
    """The unit and the factors of a polynomial, in one order."""
    unit, parts = p.factor()
    return [unit, sorted([shown(f), int(e)] for f, e in parts)]
