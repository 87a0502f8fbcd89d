"""The paper, claim by claim: what it says, how it was tested, what came out, with evidence and code to run it again.

``python -m paper_repro`` (or ``make paper``) writes the page. The claims are in ``paper_repro.claims``.
"""
