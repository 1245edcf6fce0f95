"""The notebooks as pages: their text, code and stored outputs in Markdown, pictures beside it."""

from nbconvert import MarkdownExporter


def notebook_pages(root, source):
    """A page a notebook of docs/notebooks, in SOURCE/notebooks."""
    pages = source / "notebooks"
    pages.mkdir()
    for path in sorted((root / "docs" / "notebooks").glob("*.ipynb")):
        text, resources = MarkdownExporter().from_filename(str(path), {"unique_key": path.stem, "output_files_dir": "."})
        # Links are written for a notebook that stands in docs/notebooks.
        (pages / f"{path.stem}.md").write_text(text.replace("](../", "](../docs/"), encoding="utf-8")
        for name, picture in resources["outputs"].items():
            (pages / name).write_bytes(picture)
