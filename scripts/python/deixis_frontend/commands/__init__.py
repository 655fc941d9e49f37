"""One module per command of the front end: add_arguments(parser) and run(arguments) -> int."""
