"""The loop from a formula to an answer, and the choice of methods. Methods are in ``qe.elimination``, rules of
preparation in ``qe.rules``: none of them knows the loop.
"""
