"""When does a quadratic have a real root?
=======================================

The discriminant, found by virtual substitution. Without ``a /= 0`` the line and the constant are covered too.
"""

import qe

answer = qe.eliminate("ex x. a*x^2 + b*x + c = 0", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
# The slice a = 1 of the answer: the points under the parabola 4c = b².
qe.region(answer.formula.substitute({"a": 1})).plot("quadratic.png")
