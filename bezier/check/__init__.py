"""``bezier check`` and ``bezier clearance``: folders and curves examined from their exact numbers alone. Whatever plans
or draws does not belong here.
"""
