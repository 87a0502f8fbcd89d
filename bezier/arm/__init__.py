"""Robot arms: models from Denavit-Hartenberg rows, exact kinematics, certified paths and joint sequences."""
