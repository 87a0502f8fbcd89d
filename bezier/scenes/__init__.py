"""Scenes: a domain with closed obstacles, and whether start and goal can be joined in what is free, with proof.

What is about one given curve belongs to ``bezier.obstacles``; what is about a timed one to ``bezier.trajectories``.
"""
