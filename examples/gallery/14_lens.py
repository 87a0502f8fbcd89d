"""Two discs
=========

A region knows its exact bounds and corners. The area is enclosed between two fractions.
"""

import qe

lens = qe.region("x^2 + y^2 <= 4 and (x - 2)^2 + (y - 1)^2 <= 2")
across = lens.bounds("x")
print(across.lower, across.upper)
low, high = lens.volume(0.001)
print(float(low), float(high))
print(qe.verify(lens.certificate))

# %%
lens.plot("lens.png")
