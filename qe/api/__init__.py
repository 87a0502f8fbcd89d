"""The public functions, a file for each family. Formulas may be given as text, as ``Formula``, or as SymPy."""
