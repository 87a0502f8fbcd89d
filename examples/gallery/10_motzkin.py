"""Motzkin's polynomial
====================

Never negative, yet no sum of squares of polynomials (Motzkin 1967): decided here by decomposition, with a
proof.
"""

import qe

answer = qe.eliminate("all x, y. x^4*y^2 + x^2*y^4 - 3*x^2*y^2 + 1 >= 0", check=True)
print(answer.truth)
print(qe.verify(answer.certificate))

# %%
# Where the polynomial is at most 1/2: around its four zeros.
qe.region("x^4*y^2 + x^2*y^4 - 3*x^2*y^2 + 1 <= 1/2 and x <= 2 and x >= -2 and y >= -2 and y <= 2").plot("motzkin.png")
