"""Obstacles, clearance of whole curves, and plans around them."""
