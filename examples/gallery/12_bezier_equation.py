"""The equation of a Bézier curve
==============================

The piece of a cubic curve with control points (0, 0), (0, 2), (2, 2), (1, 0), t in [0, 1], as an equation
with conditions.
"""

import qe

answer = qe.eliminate(
    "ex t. 0 <= t and t <= 1 and x = 6*t^2*(1 - t) + t^3 and y = 6*t*(1 - t)^2 + 6*t^2*(1 - t)",
    check=True,
)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
qe.region(answer.formula).plot("curve.png")
