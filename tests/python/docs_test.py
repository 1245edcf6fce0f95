"""Docstrings: everything public has one, and what they show is what comes out. And the stubs name what there is."""

import ast
import doctest
import importlib
import inspect
import os
import pkgutil
import re
import tempfile
import unittest
from pathlib import Path

import folk

ROOT = Path(__file__).resolve().parents[2]
MODULES = [importlib.import_module("folk." + module.name) for module in pkgutil.iter_modules(folk.__path__)]


class Docstrings(unittest.TestCase):
    def test_everything_public_has_one(self):
        for name in folk.__all__:
            self.assertTrue(inspect.getdoc(getattr(folk, name)), name)

    def test_examples_come_out(self):
        for module in [folk, *MODULES]:
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0, module.__name__)


class Pages(unittest.TestCase):
    """The blocks of docs/python.md and README.md that begin with >>>."""

    def test_examples_come_out(self):
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        for page in ("docs/python.md", "README.md"):
            blocks = re.findall(r"^```python\n(>>> .*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.M | re.S)
            self.assertTrue(blocks, page)
            with tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                examples = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, page, page, 0)
                self.assertEqual(runner.run(examples).failed, 0, page)
                os.chdir(ROOT)


class Stubs(unittest.TestCase):
    def test_agree_with_the_module(self):
        stub = Path(folk.__file__).with_name("_folk.pyi")
        tree = ast.parse(stub.read_text(encoding="utf-8"))
        stubbed = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        there = {name: value for name, value in vars(folk._folk).items() if not name.startswith("_")}
        self.assertEqual(sorted(stubbed), sorted(there))
        for name, value in there.items():
            if inspect.isclass(value) and not issubclass(value, Exception):
                members = {node.name for node in stubbed[name].body if isinstance(node, ast.FunctionDef)}
                public = {member for member in vars(value) if not member.startswith("_")}
                self.assertEqual({member for member in members if not member.startswith("_")}, public, name)
                self.assertLessEqual(members, set(dir(value)), name)


if __name__ == "__main__":
    unittest.main()
