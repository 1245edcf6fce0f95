"""Drawings as the library makes them, into files, and as a notebook shows them."""

import os
import tempfile


class Picture:
    """A drawing: a notebook shows it, save(path) keeps it; svg is its text."""

    def __init__(self, svg):
        self.svg = svg

    def _repr_svg_(self):
        return self.svg

    def save(self, path) -> None:
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.svg)


def svg_drawn(draw, name="picture.svg") -> str:
    """The text of the file of this name that draw(folder) makes in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        draw(folder)
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            return file.read()


def svg_drawn_to(draw) -> str:
    """The same of a drawing that is told its path."""
    return svg_drawn(lambda folder: draw(os.path.join(folder, "picture.svg")))
