"""What an answer rests on, as plain data: cell tables, multipliers, certificates, the log of a run. What makes it is in
``qe.proving``, what checks it in ``qe.kernel``.
"""
