"""The .lcm files as data: read, fingerprinted, and turned into tables. Python's standard library only."""
