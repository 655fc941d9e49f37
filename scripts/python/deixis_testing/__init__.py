"""Runs the C++ and the Python tests and adds up what came out."""
