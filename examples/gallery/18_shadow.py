"""The shadow of a solid
=====================

Project a ball with a slanted cut: one quantifier, then a region of the plane.
"""

import qe

answer = qe.eliminate("ex z. x^2 + y^2 + z^2 <= 4 and x + z >= 1", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
qe.region(answer.formula).plot("shadow.png")
