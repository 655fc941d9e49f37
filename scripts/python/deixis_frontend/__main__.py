"""Entry point of `python -m deixis_frontend`."""

import sys

from deixis_frontend import interrupts

interrupts.end_at_once()  # Before the rest is loaded.

from deixis_frontend.cli import main  # noqa: E402

sys.exit(main(sys.argv[1:]))
