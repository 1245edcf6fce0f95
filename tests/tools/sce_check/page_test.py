"""The page that sce-check --output writes: whole, by itself, safe whatever the names are. FOLK_BIN names the folder of
the programs."""

import base64
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "sce-check"
TREE = Path(__file__).resolve().parents[3]
VOID = {"meta", "img", "br"}
ROUNDS = "7" if "FOLK_SANITIZED" in os.environ else "12"
SHORT = ("--rounds", "6", "--repetitions", "2", "--depth", "1")


class Page(HTMLParser):
    """The elements of a page; anything left open or closed wrongly is an error."""

    def __init__(self, source):
        super().__init__()
        self.source = source
        self.open = []
        self.errors = []
        self.elements = []  # (name, attributes)
        self.texts = []
        self.feed(source)
        self.close()
        self.errors += [f"<{name}> is never closed" for name in self.open]

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append(f"</{tag}> in line {self.getpos()[0]}")

    def handle_data(self, data):
        self.texts.append(data)

    def text(self):
        return "".join(self.texts)

    def all(self, name):
        return [attributes for tag, attributes in self.elements if tag == name]

    def pictures(self):
        start = "data:image/svg+xml;base64,"
        sources = [image["src"] for image in self.all("img")]
        assert all(source.startswith(start) for source in sources), sources
        return [base64.b64decode(source[len(start):], validate=True).decode() for source in sources]


def page(*arguments, **how):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([PROGRAM, *arguments, "--quiet", "--output", folder], capture_output=True, timeout=120,
                              **how)
        assert done.returncode == 0, done.stderr
        return Page((Path(folder) / "report.html").read_text(encoding="utf-8"))


class Whole(unittest.TestCase):
    def check(self, found):
        self.assertEqual(found.errors, [])
        ids = [attributes["id"] for _, attributes in found.elements if "id" in attributes]
        self.assertEqual(len(ids), len(set(ids)))
        for anchor in found.all("a"):
            self.assertIn(anchor["href"][1:], ids)
        # Nothing is fetched and nothing runs.
        self.assertNotRegex(found.source, r"https?:|//\w|url\(|@import")
        self.assertFalse({"script", "link", "iframe", "object"} & {tag for tag, _ in found.elements})
        self.assertFalse([name for _, attributes in found.elements for name in attributes if name.startswith("on")])
        for image in found.all("img"):
            self.assertTrue(image["alt"])

    def test_a_pair_of_machines(self):
        found = page("pavlov", "pavlov", "--criterion", "discounted:0.6", "--class", "classics")
        self.check(found)
        shown = found.text()
        for part in ("pavlov against pavlov", "discounted:0.6", "T=5,R=3,P=1,S=0", "refuted", "certified",
                     "believes the other to be spiteful", "[1/2, 1)", "at 1/2: the first, in round 1, plays D"):
            self.assertIn(part, shown)

    def test_several_opponents_each_have_a_section(self):
        names = ("spiteful", "tit_for_tat", "pavlov", "gradual")
        found = page("spiteful", "--rounds", "20", "--opponents", ",".join(names))
        self.check(found)
        self.assertEqual([a["id"] for a in found.all("section")], [f"opponent-{i}" for i in (1, 2, 3, 4)])
        for name in names:
            self.assertIn("Against " + name, found.text())
        self.assertIn("gradual has infinitely many states", found.text())

    def test_machines_that_mix(self):
        found = page("random(0.5)", "tit_for_tat", "--rounds", "20")
        self.check(found)
        self.assertIn("2 situations have positive probability", found.text())

    def test_a_policy_with_beliefs(self):
        found = page("sct", "--opponents", "all_d,per_cd,random(0.7)", *SHORT)
        self.check(found)
        for part in ("Beliefs", "farthest from truth", "wrong in rounds", "log loss", "depth 1"):
            self.assertIn(part, found.text())

    def test_whether_the_belief_matters(self):
        # Asked in the matches that the policy was trained for, of 100 rounds.
        found = page("sct", "random(0.7)", "--repetitions", "1")
        self.check(found)
        self.assertRegex(found.text(), r"forced to C, to D\d+ and \d+ of 100 moves change")

    def test_the_page_is_the_same_again(self):
        arguments = ("sct", "--opponents", "all_d,random(0.7)", *SHORT)
        one, three = (page(*arguments, "--threads", number).source for number in "13")
        command = re.compile(r"<dd>Folk [0-9.]+: sce-check sct [^<]*</dd>")
        self.assertEqual(len(command.findall(one)), 1)
        self.assertEqual(command.sub("", one), command.sub("", three))


@unittest.skipUnless(shutil.which("gnuplot") and shutil.which("dot"), "gnuplot or Graphviz is not installed")
class Drawn(unittest.TestCase):
    def test_pictures_are_inside(self):
        pictures = page("sct", "--opponents", "all_d,random(0.7)", *SHORT).pictures()
        # Accuracy, calibration, and of each opponent beliefs and an automaton.
        self.assertEqual(len(pictures), 6)
        for picture in pictures:
            self.assertIn("</svg>", picture)
        self.assertIn("all_d", pictures[0])
        self.assertIn("match 1 of 2", pictures[4])
        for picture in pictures:
            self.assertIn("Folk 0.", picture)
            self.assertNotIn("<title>Gnuplot", picture)
        for picture in pictures[:2] + pictures[2::2]:
            self.assertRegex(picture, r"prisoner's dilemma \(T=5,R=3,P=1,S=0\) · finite:\d+ · Folk ")

    def test_the_extracted_automaton_is_drawn(self):
        found = page("sct", "--opponents", "all_c,all_d", "--rounds", ROUNDS, "--depth", "1", "--extract")
        self.assertIn("sct_extracted · edges: their move", found.pictures()[-1])
        self.assertIn("What fewer states cost", found.text())
        self.assertIn("machine sct_extracted", found.text())


class Hostile(unittest.TestCase):
    COMMAND = f"python3 {TREE / 'examples' / 'tit_for_tat.py'} # <script>alert('1')</script> & <b>`date`é"

    def test_names_are_text(self):
        name = f'exec:"{self.COMMAND}"'
        found = page("pavlov", "--opponents", f"all_d,{name}", "--rounds", "5", "--repetitions", "2")
        self.assertEqual(found.errors, [])
        self.assertFalse(found.all("script"))
        self.assertIn("<script>alert('1')</script> & <b>`date`é", found.text())
        self.assertIn("&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt; &amp; &lt;b&gt;", found.source)

    def test_bytes_that_are_no_text(self):
        name = b'exec:"' + self.COMMAND.encode() + b' \xff\xc3"'
        found = page("pavlov", name, "--rounds", "3", "--repetitions", "2")
        self.assertEqual(found.errors, [])
        self.assertIn("é \ufffd", found.text())


class Undrawn(unittest.TestCase):
    def test_without_gnuplot_and_dot(self):
        with tempfile.TemporaryDirectory() as empty:
            found = page("sct", "--opponents", "all_d,pavlov", *SHORT, env={**os.environ, "PATH": empty})
        self.assertEqual(found.errors, [])
        self.assertEqual(found.pictures(), [])
        self.assertEqual(len(re.findall("gnuplot is not installed: apt-get install gnuplot-nox", found.text())), 4)
        self.assertEqual(len(re.findall("dot is not installed: apt-get install graphviz", found.text())), 2)
        for part in ("Against all_d", "Against pavlov", "refuted"):
            self.assertIn(part, found.text())

    def test_a_temporary_folder_that_is_not_there(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, "pavlov", "pavlov", "--output", folder], capture_output=True, text=True,
                                  timeout=60, env={**os.environ, "TMPDIR": "/nowhere"})
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"^sce-check: .*temporary.*TMPDIR")
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
