"""Distance of two ellipses
========================

Four variables, two convex conditions, one exact distance.
"""

import qe

gap = qe.minimize(
    "(x - u)^2 + (y - v)^2",
    "x^2 + 4*y^2 <= 4 and (u - 5)^2 + (u - 5)*(v - 3) + (v - 3)^2 <= 1",
)
print(float(gap.value) ** 0.5)
print(qe.verify(gap.certificate))

# %%
axes = qe.region("x^2 + 4*y^2 <= 4 or (x - 5)^2 + (x - 5)*(y - 3) + (y - 3)^2 <= 1").plot()
ends = [[float(gap.point[name]) for name in pair] for pair in ("xu", "yv")]
axes.scatter(*ends, color="black", zorder=3)
axes.figure.savefig("ellipses.png")
