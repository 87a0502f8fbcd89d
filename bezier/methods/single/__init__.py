"""Method 1: one curve of degree n, as printed and closed. It knows no other method; what is the same for all is in
``bezier.planner``.
"""
