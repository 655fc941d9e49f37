"""Logs turned into files for other programs' viewers."""
