"""The problem of Davenport and Heintz
===================================

Two alternations (Davenport, Heintz 1988): which d can be reached?
"""

import qe

answer = qe.eliminate("ex c. all a, b. (a = d and b = c or a = c and b = 1) -> a^2 = b", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
answer.plot("reached.png")
