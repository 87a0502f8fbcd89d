"""A tour of the engine: eliminate, decide, find a point, describe a region, optimise, verify.

Run with ``python examples/first_steps.py``.
"""

import qe

# When does x^2 + b*x + c have a real root?
answer = qe.eliminate("ex x. x^2 + b*x + c = 0")
print("real root iff       ", answer.formula)

# Is there, for every real x, a real cube root?
print("cube roots exist    ", qe.decide("all x. ex y. y^3 = x"))

# A point, as exact numbers.
point = qe.find_instance("x^2 + y^2 = 2 and x = y and x > 0")
print("a point             ", {name: str(value) for name, value in (point or {}).items()})

# The lens between two discs: an exact description, membership of points, bounds, a certificate.
lens = qe.region("x^2 + y^2 <= 4 and (x - 1)^2 + y^2 <= 4")
print("lens: cells         ", len(lens.cells))
print("lens: x lies in     ", "[" + ", ".join(str(bound) for bound in lens.bounds("x")) + "]")
print("lens: has (1/2, 0)  ", lens.contains({"x": "1/2", "y": 0}))
print("lens: certificate   ", "accepted" if qe.verify(lens.certificate).accepted else "rejected")

# The nearest point of the unit disc to (3, 1), and the proof that it is the nearest.
nearest = qe.minimize("(x - 3)^2 + (y - 1)^2", "x^2 + y^2 <= 1")
print("least distance^2    ", nearest.value)
print("its certificate     ", "accepted" if qe.verify(nearest.certificate).accepted else "rejected")
