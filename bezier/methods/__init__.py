"""The planning methods; none imports another one."""
