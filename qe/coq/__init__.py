"""Certificates as files for the proof assistant Coq: what is wrong in one, ``coqc`` refuses. Only derivations are
written; what makes them is in ``qe.proving``.
"""
