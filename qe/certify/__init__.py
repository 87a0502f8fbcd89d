"""The entrance: certificates are read, their claims named, and every entry given to the checker of its ring."""
