"""Problems that no path of any method can solve: the start or the goal lies in an obstacle. Problems that one method
cannot solve are refused by that.
"""
