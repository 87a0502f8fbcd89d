"""The entrance: certificates are read, their claims named, and every entry given to the checker of its ring. No theorem
is believed because of what stands here: those are in ``qe.kernel`` and ``qe.expert``.
"""
