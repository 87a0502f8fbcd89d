"""Planning from Python: the function ``bezier.plan`` and what it gives back. The command line and this call the same
planner; neither decides anything.
"""
