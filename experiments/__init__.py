"""Problem suites, solvers, runs under limits, and the tables and figures made of their results. What users of the
packages need does not belong here; nothing in ``qe`` or ``bezier`` imports it.
"""
