"""Hurwitz stability of a cubic
============================

All complex roots u + iv of x³ + ax² + bx + c lie left of the imaginary axis. Real and imaginary parts are
polynomials in u and v; the answer is the Routh–Hurwitz criterion.
"""

import qe

answer = qe.eliminate(
    "all u, v. u^3 - 3*u*v^2 + a*(u^2 - v^2) + b*u + c = 0 and 3*u^2*v - v^3 + 2*a*u*v + b*v = 0 -> u < 0",
)
print(answer.formula)

# %%
# The textbook's form is equivalent:
print(qe.equivalent(answer.formula, "a > 0 and c > 0 and a*b > c"))

# %%
# The slice a = 1 of the answer:
qe.region(answer.formula.substitute({"a": 1}), order="b, c").plot("stable.png")
