"""Work in processes: under hard limits, side by side, raced. What is worked on is a value that can be pickled, and not
known here.
"""
