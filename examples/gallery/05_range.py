"""The range of a function
=======================

Which values does x/(x² + 1) take? Written without a quotient: y(x² + 1) = x.
"""

import qe

answer = qe.eliminate("ex x. y*(x^2 + 1) = x", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
answer.plot("range.png")
