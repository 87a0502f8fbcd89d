"""No common point
===============

Three discs that meet in pairs and not together: a sentence that is false, with a proof.
"""

import qe

answer = qe.eliminate(
    "ex x, y. x^2 + y^2 <= 1 and (x - 19/10)^2 + y^2 <= 1 and (x - 19/20)^2 + (y - 8/5)^2 <= 1",
    check=True,
)
print(answer.truth)
print(qe.verify(answer.certificate))
