"""strategy-graph as its user sees it: pictures, DOT text, refusals. FOLK_BIN names the folder of the programs."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "strategy-graph"


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, **options)


def text(*arguments):
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Drawings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_dot_on_stdout_and_in_a_file_are_the_same(self):
        path = self.folder / "pavlov.dot"
        self.assertEqual(text("pavlov", "-o", path), "")
        self.assertEqual(path.read_text(), text("pavlov"))
        self.assertTrue(text("pavlov").startswith('digraph "pavlov" {'))

    @unittest.skipUnless(shutil.which("dot"), "Graphviz is not installed")
    def test_pictures(self):
        for extension, magic in ((".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")):
            path = self.folder / ("picture" + extension)
            text("prober", "-o", path)
            self.assertTrue(path.read_bytes().startswith(magic))
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_the_senses(self):
        self.assertIn("edges: their move · own moves its own", text("pavlov"))
        self.assertIn("edges: own/their move · any own moves", text("pavlov", "--any-own-moves"))

    def test_a_horizon_cuts_machines_without_end(self):
        drawing = text("soft_majo", "--horizon", "6")
        self.assertIn("soft_majo · first 6 rounds", drawing)
        self.assertEqual(drawing.count('label="C"'), 6)  # leads of 0 to 5
        self.assertEqual(drawing.count('label="D"'), 5)

    def test_a_horizon_past_the_end_changes_nothing(self):
        self.assertEqual(text("prober", "--horizon", "50"), text("prober"))

    def test_one_machine_of_a_file(self):
        path = self.folder / "two.machines"
        path.write_text("machine one\nc C c c\nmachine two\nd D d d\n")
        self.assertIn('digraph "two"', text(f"@{path}#two"))

    MACHINES = ("machine three\ncalm C calm angry calm calm\nangry D calm angry angry wait\nwait D calm angry angry calm\n"
                "machine twice\none C one two\ntwo D one also_two\nalso_two D one two\n")

    def test_states_of_a_file_keep_their_names(self):
        path = self.folder / "own.machines"
        path.write_text(self.MACHINES)
        drawing = text(f"@{path}#three")
        for name in ("calm", "angry", "wait"):
            self.assertEqual(drawing.count(f">{name}<"), 1, drawing)
        drawing = text(f"@{path}#twice")  # two states that play alike are one, which has both names
        self.assertRegex(drawing, r"s1 \[label=<D<BR/>.*two.*<BR/>.*also_two")
        self.assertNotIn("FONT", text("pavlov"))

    def test_the_caption_says_only_what_applies(self):
        version = text("--version").split("(")[1].split(")")[0]
        self.assertIn(f"own moves its own\\n{version}\"", text("pavlov"))
        self.assertIn(f"\\nprisoner's dilemma (T=4,R=3,P=1,S=0) · {version}\"",
                      text("zd_extort(3)", "--payoffs", "T=4,R=3,P=1,S=0"))
        for name in ("zd_extort(3)", "equalizer(2)"):
            self.assertIn(f"\\nprisoner's dilemma (T=5,R=3,P=1,S=0) · {version}\"", text(name))
        for name in ("gtft(0.3)", "random(0.5)", "mem2"):
            self.assertNotIn("dilemma", text(name, "--payoffs", "T=4,R=3,P=1,S=0"))

    @unittest.skipUnless(shutil.which("dot"), "Graphviz is not installed")
    def test_no_label_lies_under_an_edge(self):
        """What is drawn later lies on top: the labels are, each on white."""
        path = self.folder / "own.machines"
        path.write_text(self.MACHINES)
        for arguments in (("mem2", "--any-own-moves"), ("tf2t", "--any-own-moves"), ("gradual", "--horizon", "6"), ("all_d",),
                          (f"@{path}#three", "--any-own-moves")):
            text(*arguments, "-o", self.folder / "a.svg")
            svg = (self.folder / "a.svg").read_text()
            edges = len(re.findall(r" -> .*label=", text(*arguments)))
            labels = re.findall(r'<g id="node\d+" class="node">\n<title>l\d+</title>\n<polygon fill="white"[^>]*/>\n<text ', svg)
            self.assertEqual(len(labels), edges)
            self.assertLess(svg.rfind('class="edge"'), svg.find("<title>l"))

    def refused(self, code, message, *arguments, **options):
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr, f"strategy-graph: {message}\n")

    def test_refusals(self):
        self.refused(2, "no strategy named: try strategy-graph pavlov -o pavlov.svg")
        self.refused(2, "soft_majo has infinitely many states: draw its first N rounds with --horizon N", "soft_majo")
        self.refused(2, "badbet has 40816 states, more than the 300 that make a picture: draw its first N rounds with "
                     "--horizon N", "badbet")
        self.refused(2, "-o a.gif: the extension says the format: .svg, .png, .pdf or .dot", "all_c", "-o", "a.gif")
        self.refused(2, "--horizon '0': expected a whole number from 1 to 100", "gradual", "--horizon", "0")
        self.refused(2, 'exec:"cat" is an opaque player: it can be played, but it has no machine that could be drawn',
                     "exec:cat")
        missing = self.folder / "none" / "a.svg"
        self.refused(4, f"{missing}: cannot be written: there is no such folder; make it or name another", "all_c", "-o", missing)

    def test_a_missing_dot(self):
        self.refused(4, "dot is not installed: apt-get install graphviz, or write a .dot file", "all_c", "-o",
                     self.folder / "a.svg", env={"PATH": str(self.folder)})
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
