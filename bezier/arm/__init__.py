"""Robot arms: models from Denavit-Hartenberg rows, their exact forward and inverse kinematics, paths and joint sequences."""
