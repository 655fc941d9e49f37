"""The demonstration: a clip of a person who points at things, played through all services."""
