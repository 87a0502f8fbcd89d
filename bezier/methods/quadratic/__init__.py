"""Method 2 with three quadratic curves: formula (8). It knows no other method; what is the same for all is in
``bezier.planner``.
"""
