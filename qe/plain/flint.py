"""What the kernel uses of python-flint, in plain Python."""

from qe.plain.balls import arb, arb_poly, ctx
from qe.plain.multivariate import fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mpoly, fmpz_mpoly_ctx
from qe.plain.numbers import fmpq, fmpz, fmpz_mat
from qe.plain.roots import acb, acb_poly
from qe.plain.univariate import fmpz_poly

__all__ = [
    "acb",
    "acb_poly",
    "arb",
    "arb_poly",
    "ctx",
    "fmpq",
    "fmpq_mpoly",
    "fmpq_mpoly_ctx",
    "fmpz",
    "fmpz_mat",
    "fmpz_mpoly",
    "fmpz_mpoly_ctx",
    "fmpz_poly",
]
