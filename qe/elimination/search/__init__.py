"""Boolean search for sentences of many cases: a SAT solver proposes conjunctions, theories refuse them with reasons.
Questions with parameters do not belong here.
"""
