"""The public functions, a file for each family. Formulas may be given as text, as ``Formula``, or as SymPy. They check
arguments and limits and give values back; how a question is answered is the engine's.
"""
