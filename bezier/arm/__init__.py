"""Robot arms: models from Denavit-Hartenberg rows, exact kinematics, certified paths and joint sequences. Curves for an
arm to follow are planned elsewhere; what checks its certificates is in ``bezier.proofs``.
"""
