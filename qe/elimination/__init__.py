"""The elimination methods, which never import each other. What all of them see is ``protocol``; which is tried when is
the engine's.
"""
