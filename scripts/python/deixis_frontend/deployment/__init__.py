"""The system file turned into what other process managers read."""
