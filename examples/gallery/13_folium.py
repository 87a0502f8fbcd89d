"""A loop from its parameters
==========================

x = t(1 − t²), y = t²: a curve with a double point at (0, 1).
"""

import qe

answer = qe.eliminate("ex t. x = t*(1 - t^2) and y = t^2 and y <= 3/2", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
qe.region(answer.formula).plot("loop.png")
