"""One module per part that can be measured."""
