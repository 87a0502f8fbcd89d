"""Paths of several curves: what is proved about them, their certificates, speed, heights and the origin. Single curves
are in ``bezier.curves``; what joints do along a path is in ``bezier.arm``.
"""
