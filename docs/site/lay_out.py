"""lay_out.py ROOT BUILD: what Sphinx reads, in BUILD/source: the tree's pages by links, the gallery, the notebooks, the
pages of the C++ and of the Python reference."""

import sys
from pathlib import Path

from cpp_reference import Reference
from notebooks import notebook_pages
from python_reference import python_pages

WINGS = ("games", "strategies", "analysis", "sct", "mpe")  # in the order in which they include each other


def linked(root, source):
    """Everything at its own path, so that links between pages and into the sources hold."""
    source.mkdir(parents=True)
    for path in sorted(root.iterdir()):
        if not path.name.startswith((".", "build")):
            (source / path.name).symlink_to(path)
    (source / "index.md").symlink_to(root / "docs" / "site" / "index.md")


def cpp_pages(root, source, xml):
    """A page a folder that has headers."""
    pages = source / "cpp"
    pages.mkdir()
    reference = Reference(xml)
    names = []
    for wing in WINGS:
        for folder in sorted({path.parent for path in (root / wing).rglob("*.h")}):
            names.append(folder.relative_to(root).as_posix().replace("/", "-"))
            (pages / f"{names[-1]}.md").write_text(reference.page(root, folder), encoding="utf-8")
    listed = "\n".join(names)
    (pages / "index.md").write_text(
        "# C++ reference\n\nEvery header, folder by folder, with what it says of itself; how to build against Folk is"
        f" told [here](../docs/cpp.md).\n\n```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n", encoding="utf-8")


def gallery(root, source):
    """All pictures, each with its file's name as caption."""
    text = "# Gallery\n"
    for title, folder in (("Automata", "automata"), ("Tournaments, evolution, payoffs, the particle world", "pictures")):
        text += f"\n## {title}\n"
        for path in sorted((root / "docs" / folder).glob("*.svg")):
            text += f"\n### `{path.stem}`\n\n![{path.stem}](docs/{folder}/{path.name})\n"
    (source / "gallery.md").write_text(text, encoding="utf-8")


def main(root, build):
    source = build / "source"
    linked(root, source)
    cpp_pages(root, source, build / "xml")
    gallery(root, source)
    notebook_pages(root, source)
    python_pages(source)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
