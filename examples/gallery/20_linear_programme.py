"""A linear programme
==================

With a strict bound: the least value is a limit that is not attained, and the answer says so.
"""

import qe

corner = qe.minimize("2*x + 3*y", "x + y >= 4 and x + 3*y >= 6 and x >= 0 and y >= 0")
print(corner.value, corner.attained, {name: str(value) for name, value in corner.point.items()})
strict = qe.minimize("2*x + 3*y", "x + y > 4 and x + 3*y > 6 and x > 0 and y > 0")
print(strict.value, strict.attained)
print(qe.verify(strict.certificate))

# %%
axes = qe.region("x + y >= 4 and x + 3*y >= 6 and x >= 0 and y >= 0 and x <= 8 and y <= 6").plot()
axes.scatter(float(corner.point["x"]), float(corner.point["y"]), color="black", zorder=3)
axes.figure.savefig("programme.png")
