"""A planned path in the forms of other programs: numpy, SciPy, ROS 2, G-code, SVG. Floating point, rounded once.
Nothing is decided here.
"""
