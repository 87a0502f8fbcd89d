"""One module per kind of solver: a formula of this project goes in, an answer in the text syntax comes out. Limits and
processes are the runner's.
"""
