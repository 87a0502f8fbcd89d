"""The least time along a given path under limits of velocity and acceleration: a motion whose limits are proved for all
t, and a number of seconds that no motion along the path can beat, proved too."""
