"""A heart
=======

The curve (x² + y² − 1)³ = x²y³ and what it encloses.
"""

import qe

heart = qe.region("(x^2 + y^2 - 1)^3 <= x^2*y^3")
print(heart.bounds("x").upper, float(heart.bounds("x").upper))
print(heart.contains({"x": 0, "y": 1}), heart.contains({"x": 0, "y": "1.01"}))
print(qe.verify(heart.certificate))

# %%
heart.plot("heart.png")
