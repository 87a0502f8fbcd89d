"""The equation of Whitney's umbrella
==================================

From a parametrisation to an equation. The ideal alone would lose the half of the handle that carries no
surface; the condition z ≥ 0 is what elimination over the reals adds.
"""

import qe

answer = qe.eliminate("ex s, t. x = s*t and y = s and z = t^2", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
qe.region(f"({answer.formula}) and y >= -1 and y <= 1 and z <= 1", order="y, z, x").plot("umbrella.png")
