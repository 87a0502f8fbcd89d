"""Arithmetic and geometric mean
=============================

a³ + b³ + c³ ≥ 3abc for positive numbers, and where equality holds.
"""

import qe

answer = qe.eliminate("all a, b, c. a > 0 and b > 0 and c > 0 -> a^3 + b^3 + c^3 >= 3*a*b*c", check=True)
print(answer.truth)
print(qe.verify(answer.certificate))
print(qe.eliminate("ex c. a > 0 and b > 0 and c > 0 and a^3 + b^3 + c^3 = 3*a*b*c").formula)

# %%
# Where a³ + b³ + c³ ≤ 3abc, for c = 1: one point of equality, and a half-plane with negative numbers.
qe.region("a^3 + b^3 + 1 <= 3*a*b and a >= -3 and a <= 3 and b >= -3 and b <= 3").plot("means.png")
