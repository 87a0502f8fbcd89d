"""Paths of several curves: what is proved about them, their certificates, speed, heights and the origin."""
