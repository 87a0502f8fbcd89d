"""The former place of Method 1, kept for programs that import it: see ``bezier.methods.single``. Nothing new belongs
here.
"""
