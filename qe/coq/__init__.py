"""Certificates as files for the proof assistant Coq: what is wrong in one, ``coqc`` refuses."""
