"""A condition on the sizes of roots
=================================

When is the largest root of x² + bx + c greater than one? Answered in the coefficients.
"""

import qe

answer = qe.eliminate("ex x. x^2 + b*x + c = 0 and x > 1", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
qe.region(f"({answer.formula}) and b >= -4 and b <= 4 and c >= -4 and c <= 4", order="b, c").plot("roots.png")
