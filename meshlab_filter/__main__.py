"""``python -m meshlab_filter``."""

from .entry import main

main()
