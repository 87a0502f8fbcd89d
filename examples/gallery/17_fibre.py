"""Cutting a region
================

The fibre over x = 3/4 of a ring with a piece cut out, as exact intervals.
"""

import qe

ring = qe.region("x^2 + y^2 <= 4 and x^2 + y^2 >= 1 and not (x > 0 and y > 2*x)")
for interval in ring.fibre({"x": "3/4"}):
    print(interval.lower, interval.upper)
print(qe.verify(ring.certificate))

# %%
ring.plot("ring.png")
