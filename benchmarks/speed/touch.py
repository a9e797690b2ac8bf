"""A throw-away process that uses some memory once: ``python -m benchmarks.speed.touch GIGABYTES``.

A virtual machine gets memory from its host at the first touch, slowly. Without this the first contestant to need so
much would pay for it and the others would not.
"""

from __future__ import annotations

import sys

if __name__ == "__main__":
    used = b"\1" * int(float(sys.argv[1]) * 1e9)
