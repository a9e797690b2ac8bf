"""What stops a release."""

__all__ = ["ReleaseError"]


class ReleaseError(Exception):
    """Something that must be mended before there is a release; the message says what and where."""
