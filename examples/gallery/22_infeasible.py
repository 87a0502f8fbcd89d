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

# %%
# Where at least two of them meet:
one, two, three = "x^2 + y^2 <= 1", "(x - 19/10)^2 + y^2 <= 1", "(x - 19/20)^2 + (y - 8/5)^2 <= 1"
qe.region(f"{one} and {two} or {two} and {three} or {one} and {three}").plot("discs.png")
