"""Theorems as data: statements with letters, each with its source and a proof or the word axiom. No code belongs here.

``qe.kernel.statements`` says how they are read, ``qe.kernel.theorem`` what it means to use one.
"""
