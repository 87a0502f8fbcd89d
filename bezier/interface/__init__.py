"""Planning from Python: the function ``bezier.plan`` and what it gives back."""
