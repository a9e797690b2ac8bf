"""How good the maps are on every mesh at hand, and whether what must hold does: ``python -m benchmarks.quality``."""
