"""The x-axis ellipse problem (Kahan 1975): when does the ellipse with centre (c, 0) and half-axes a, b
lie in the unit disc? A classic test of quantifier elimination, with three parameters.

Run with ``python examples/ellipse_in_disc.py``.
"""

import qe

PROBLEM = """
a > 0 and b > 0 and
all x, y. b^2*(x - c)^2 + a^2*y^2 - a^2*b^2 = 0 -> x^2 + y^2 - 1 <= 0
"""

answer = qe.eliminate(PROBLEM)
print(answer.formula)
print(f"{answer.stats}")
