"""Obstacles, clearance of whole curves, and plans around them. Clearances of arms are in ``bezier.arm``."""
