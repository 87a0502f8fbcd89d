"""The arithmetic of the second ring: ideals, algebraic numbers, signatures of forms. It shares none with the producers
of answers, nor is it used by the kernel.
"""
