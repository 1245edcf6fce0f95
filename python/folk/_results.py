"""What a program would have answered."""


class Result:
    """str() is the text that the program prints."""

    def __init__(self, held):
        self._held = held

    def json(self) -> str:
        """What the program prints with --format json."""
        return self._held.form("json")

    def __str__(self):
        return self._held.form("text")
