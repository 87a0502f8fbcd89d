"""The former place of the cubic method, kept for programs that import it: see ``bezier.methods.cubic``. Nothing new
belongs here.
"""
