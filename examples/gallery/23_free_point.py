"""One free control point
======================

Three control points of a path depend on one free point (a, b); all must lie in a disc. For which c can the free
point be chosen? A question of the kind of formula (7) of the paper, with a parameter.
"""

import qe

answer = qe.eliminate(
    "ex a, b. a^2 + b^2 <= 9 and (4 - a)^2 + (2 - b)^2 <= 9 and (2*a - 4 + c)^2 + (2*b - 1)^2 <= 9",
    check=True,
)
print(answer.formula)
print(qe.verify(answer.certificate))
print(qe.find_instance(f"({answer.formula}) and c > 3/2")["c"])

# %%
answer.plot("free.png")
