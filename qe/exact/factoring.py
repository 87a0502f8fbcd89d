"""Factoring in FLINT, with a detour where its Python binding overflows."""

from __future__ import annotations

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_mpoly


def guarded_factor(p: fmpz_mpoly) -> tuple[fmpz, list[tuple[fmpz_mpoly, int]]]:
    """``p.factor()``, redone over Q where python-flint 0.9 overflows while sorting the factors."""
    try:
        unit, factors = p.factor()
        return unit, [(f, int(e)) for f, e in factors]
    except OverflowError:
        context = p.context()
        rational = fmpq_mpoly_ctx.get(context.names(), "lex")
        unit, factors = fmpq_mpoly(p, rational).factor()
        result: list[tuple[fmpz_mpoly, int]] = []
        constant = fmpq(unit)
        for factor, exponent in factors:
            scale = fmpz(1)
            for c in factor.coeffs():
                scale = scale * c.q // scale.gcd(c.q)
            integral = context.from_dict({m: int((c * scale).p) for m, c in factor.terms()})
            content = integral.content()
            constant = constant * (fmpq(content) / scale) ** int(exponent)
            result.append((integral / content, int(exponent)))
        return constant.p, result
