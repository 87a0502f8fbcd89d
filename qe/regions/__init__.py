"""Regions: solution sets with membership, bounds, measures and pictures."""
