"""When has a cubic one real root only?
====================================

A quantifier alternation: there is an x such that every root is x. The picture shows the set in the plane of p
and q; its border is the semicubical parabola 4p³ + 27q² = 0.
"""

import qe

answer = qe.eliminate("ex x. all y. y^3 + p*y + q = 0 <-> y = x", check=True)
print(answer.formula)
print(qe.verify(answer.certificate))

# %%
# The complement, where there are three roots counted with multiplicity:
qe.region(f"not ({answer.formula})", order="p, q").plot("one_root.png")
