"""The conformal-uv command."""
