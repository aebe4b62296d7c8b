"""The one exception of the package."""


class PointFrontError(RuntimeError):
    """Something asked of PointFront did not happen. The message says what, where, what to try."""
