"""The command ``qe``. Each command reads its arguments and calls a public function of ``qe.api``, or one that could be
public.
"""
