"""The paper's figures and those of the corrections, drawn from computed data as SVG. What is claimed of them is in
``paper_repro.claims``.
"""
