"""Drawings as the library makes them, into files, and as a notebook shows them."""

import os
import tempfile

from folk import _folk


class Picture:
    """A drawing: a notebook shows it, save(path) keeps it; svg is its text."""

    def __init__(self, svg):
        self.svg = svg

    def _repr_svg_(self):
        return self.svg

    def __repr__(self):
        return "<folk.Picture>"

    def save(self, path) -> None:
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.svg)


def svg_drawn(draw, name="picture") -> str:
    """The text of the file of this name, NAME.svg, that draw(folder) makes in a folder of its own. Raises UsageError for
    a name of which there is none."""
    with tempfile.TemporaryDirectory() as folder:
        draw(folder)
        drawn = {os.path.splitext(file)[0]: os.path.join(folder, file) for file in sorted(os.listdir(folder))}
        if name not in drawn:
            raise _folk.UsageError(f"plot '{name}': there are {', '.join(drawn)}")
        with open(drawn[name], encoding="utf-8") as file:
            return file.read()


def svg_drawn_to(draw) -> str:
    """The same of a drawing that is told its path."""
    return svg_drawn(lambda folder: draw(os.path.join(folder, "picture.svg")))
