"""Which points can a stone reach?
===============================

Speed 2, gravity 2, any upward angle: the envelope of all parabolas of throw is a parabola itself.
"""

import qe

answer = qe.eliminate(
    "ex c, s. c^2 + s^2 = 1 and c > 0 and y*c^2 = x*s*c - x^2/4 and x > 0",
    check=True,
)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
# Above the ground:
qe.region(f"({answer.formula}) and y >= 0").plot("throw.png")
