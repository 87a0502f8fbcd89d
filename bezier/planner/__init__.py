"""Planning as a whole: the table of methods, ways around obstacles, what is decided about every plan, its files. How a
method finds its path is in ``bezier.methods``.
"""
