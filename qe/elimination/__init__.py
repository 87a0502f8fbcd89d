"""The elimination methods, which never import each other."""
