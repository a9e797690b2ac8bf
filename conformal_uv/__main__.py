"""``python -m conformal_uv``."""

from .cli.entry import main

main()
