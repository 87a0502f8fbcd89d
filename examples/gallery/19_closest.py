"""The closest point of an ellipse
===============================

Exact least value and point as algebraic numbers, with multipliers that prove them.
"""

import qe

nearest = qe.minimize("(x - 3)^2 + (y - 2)^2", "x^2 + 4*y^2 <= 4")
print(nearest.value, float(nearest.value))
print({name: float(value) for name, value in nearest.point.items()})
print(qe.verify(nearest.certificate))

# %%
axes = qe.region("x^2 + 4*y^2 <= 4").plot()
axes.scatter(*zip((3, 2), (float(nearest.point["x"]), float(nearest.point["y"])), strict=True), color="black")
axes.set(xlim=(-2.2, 3.3), ylim=(-1.3, 2.3))
axes.figure.savefig("closest.png")
