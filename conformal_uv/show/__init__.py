"""Results shown in notebooks, other programs and windows."""
