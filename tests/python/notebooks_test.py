"""The notebooks of docs/notebooks: each runs from its first cell to its last, and says what is stored in it.

FOLK_DOCS_UPDATE=1 stores what comes out instead. Pictures need only be there: fonts and versions of what draws differ.
"""

import os
import re
import tempfile
import unittest
from pathlib import Path

try:
    import nbformat
    from nbclient import NotebookClient
except ImportError:
    NotebookClient = None

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "notebooks"
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # a kernel's debugger would warn
UPDATE = os.environ.get("FOLK_DOCS_UPDATE") == "1"


def said(cell):
    """What a cell put out: text as it is, of a picture that there is one. The last bits of what was rounded depend on the
    processor, and with them a signature."""
    told = []
    for output in cell.get("outputs", ()):
        if output.get("name") == "stderr":
            continue
        shown = output.get("data", {"text/plain": output.get("text")})
        picture = [kind for kind in shown if kind.startswith("image/")]
        told.append(picture or re.sub(r"(?<=signature )[0-9a-f]{16}", "...", shown["text/plain"]))
    return told


@unittest.skipUnless(NotebookClient, "without python3-nbclient and python3-ipykernel")
class Notebooks(unittest.TestCase):
    maxDiff = None

    def runs(self, path):
        stored = nbformat.read(path, as_version=4)
        book = nbformat.from_dict(stored)
        with tempfile.TemporaryDirectory() as folder:
            NotebookClient(book, timeout=300, resources={"metadata": {"path": folder}}, record_timing=False).execute()
        if UPDATE:
            for cell in book.cells:  # how far work has got is nothing to keep
                if "outputs" in cell:
                    cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
            nbformat.write(book, path)
            return
        for before, now in zip(stored.cells, book.cells):
            self.assertEqual(said(now), said(before), now.source)


for notebook in sorted(FOLDER.glob("*.ipynb")):
    setattr(Notebooks, f"test_{notebook.stem}", lambda self, path=notebook: self.runs(path))


if __name__ == "__main__":
    unittest.main()
