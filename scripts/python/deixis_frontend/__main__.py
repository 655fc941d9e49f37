"""Entry point of `python -m deixis_frontend`."""

import sys

from deixis_frontend.cli import main

sys.exit(main(sys.argv[1:]))
