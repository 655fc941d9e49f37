"""Starts the services of a system, watches them and brings them back."""
