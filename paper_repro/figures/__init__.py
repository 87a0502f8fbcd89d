"""The paper's figures and those of the corrections, drawn from computed data as SVG."""
