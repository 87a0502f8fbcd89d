"""Schur's inequality
==================

Degree one: x(x−y)(x−z) + y(y−x)(y−z) + z(z−x)(z−y) ≥ 0 on the positive orthant; false without it, with a
counterexample.
"""

import qe

schur = "x*(x - y)*(x - z) + y*(y - x)*(y - z) + z*(z - x)*(z - y) >= 0"
answer = qe.eliminate(f"all x, y, z. x >= 0 and y >= 0 and z >= 0 -> {schur}", check=True)
print(answer.truth)
print(qe.verify(answer.certificate))

# %%
everywhere = qe.eliminate(f"all x, y, z. {schur}")
print(everywhere.truth, {name: str(value) for name, value in everywhere.witness.items()})

# %%
# Where it is false, for z = 1:
negative = "x*(x - y)*(x - 1) + y*(y - x)*(y - 1) + (1 - x)*(1 - y) < 0"
qe.region(f"{negative} and x >= -3 and x <= 3 and y >= -3 and y <= 3").plot("schur.png")
