"""Runs the command line for ``python -m drillctl``."""

import sys

from drillctl.cli import main

sys.exit(main())
