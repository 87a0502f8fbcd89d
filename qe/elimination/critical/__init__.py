"""Critical-value elimination: one block over bounded fibres. What has no compact fibres belongs to other methods."""
