"""Arithmetic and geometric mean
=============================

a³ + b³ + c³ ≥ 3abc for positive numbers, and where equality holds.
"""

import qe

answer = qe.eliminate("all a, b, c. a > 0 and b > 0 and c > 0 -> a^3 + b^3 + c^3 >= 3*a*b*c", check=True)
print(answer.truth)
print(qe.verify(answer.certificate))
print(qe.eliminate("ex c. a > 0 and b > 0 and c > 0 and a^3 + b^3 + c^3 = 3*a*b*c").formula)
