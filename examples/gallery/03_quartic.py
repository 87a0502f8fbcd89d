"""Which quartics are never negative?
==================================

The classic of Lazard (1988) and Arnon and Mignotte (1988): x⁴ + px² + qx + r ≥ 0 for all x.
"""

import qe

answer = qe.eliminate("all x. x^4 + p*x^2 + q*x + r >= 0", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
# The slice p = −2 of the answer:
qe.region(answer.formula.substitute({"p": -2}), order="q, r").plot("quartic.png")
