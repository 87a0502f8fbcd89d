"""Three balls in space
====================

The region of formula (8) of the paper for three balls: exact, certified, and a picture in space.
"""

import qe

balls = qe.region("x^2 + y^2 + z^2 <= 9 and (x - 2)^2 + y^2 + z^2 <= 9 and (x - 1)^2 + (y - 2)^2 + z^2 <= 9")
print(balls.bounds("z").lower, balls.bounds("z").upper, len(balls.cells))
print(qe.verify(balls.certificate))

# %%
balls.plot("balls.png")
