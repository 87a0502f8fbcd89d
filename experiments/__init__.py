"""Problem suites, solvers, runs under limits, and the tables and figures made of their results."""
