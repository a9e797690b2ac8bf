"""Numbers typed while a tool runs, as Blender's own transforms take them; no bpy."""

from __future__ import annotations

from collections.abc import Sequence

DIGITS = set("0123456789.,")
LONGEST = 12  # characters


class TypedNumbers:
    """Fields that are typed into, one at a time.

    Parameters
    ----------
    names : sequence of str
        The fields; Tab goes to the next one, and its first letter to a field.

    Attributes
    ----------
    field : str
        The one typed into.
    text : str
        What was typed into it; empty: nothing.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self._names = tuple(names)
        self.field, self.text = self._names[0], ""

    @property
    def value(self) -> float | None:
        """The number typed, None where there is none yet."""
        try:
            return float(self.text.replace(",", "."))
        except ValueError:
            return None

    def take(self, kind: str, character: str) -> bool:
        """Take a key press: its type, and the character that it writes; whether it was one for us."""
        if kind == "TAB":
            self._go_to(self._names[(self._names.index(self.field) + 1) % len(self._names)])
        elif kind in {name[0].upper() for name in self._names} and len(kind) == 1:
            self._go_to(next(name for name in self._names if name[0].upper() == kind))
        elif kind == "BACK_SPACE":
            self.text = self.text[:-1]
        elif character == "-":
            self.text = self.text[1:] if self.text.startswith("-") else f"-{self.text}"
        elif character and character in DIGITS:
            self.text = (self.text + character)[:LONGEST]
        else:
            return False
        return True

    def shown(self, name: str, value: float, digits: int = 3) -> str:
        """A field's text for the header: what is being typed into it, else the value."""
        return f"[{self.text}|]" if name == self.field and self.text else f"{value:.{digits}f}"

    def _go_to(self, name: str) -> None:
        self.field, self.text = name, ""
