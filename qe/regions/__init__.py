"""Regions: solution sets with membership, bounds, measures and pictures. How space is decomposed is in
``qe.decomposition``.
"""
