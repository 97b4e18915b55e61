"""The program ``gearwear``: the same commands as the one that Cargo builds."""

from __future__ import annotations

import signal
import sys

from gearwear import _native


def main() -> int:
    """Runs the command in ``sys.argv``; its exit status."""
    # Python would only note Ctrl-C, and look at it when the command has ended. Commands that keep what is finished listen themselves.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.program(["gearwear", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
