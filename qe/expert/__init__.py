"""The second ring: checkers that are procedures of their own, believed only where ``qe check --core`` is not asked for.

What can be said in the primitives of the kernel does not belong here.
"""
