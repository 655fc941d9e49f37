"""Messages that come live or stand in a log: what arrives, how often, how old, from whom."""
