"""Front end of Deixis: starts and watches the services, records, replays, measures."""

__version__ = "0.1.0"
