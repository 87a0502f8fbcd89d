"""The planning methods; none imports another one. What every method shares is in ``bezier.methods.control``; what is
decided about every plan is in ``bezier.planner``.
"""
