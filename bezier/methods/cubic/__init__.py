"""Method 2 with three cubic curves: formula (7). It knows no other method; what is the same for all is in
``bezier.planner``.
"""
