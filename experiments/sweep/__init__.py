"""Sweeps: a grid of planning problems solved by many workers, and the atlas drawn from it. Single plans are
``bezier``'s.
"""
