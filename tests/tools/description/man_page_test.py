"""The pages of man as they are read at 80 columns. FOLK_BIN names the folder of the programs; the pages are in share/ beside it."""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"]).resolve()
PAGES = sorted((BIN.parent / "share/man/man1").glob("*.1"))
COMMANDS = ("ipd-tournament", "ipd-match", "ipd-strategies", "ipd-evolve", "ipd-judge", "strategy-graph", "sct-train", "payoff-region", "sce-check",
            "mpe-train", "mpe-evaluate", "mpe-train online", "mpe-train curve", "mpe-train collect", "mpe-train inspect",
            "mpe-train offline", "mpe-train study")
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "ENVIRONMENT", "FILES", "EXAMPLES", "SEE ALSO"]


def words(text):
    return re.sub(r"\s+", " ", text)


def shown(page):
    """What `man` shows at 80 columns, and what groff has to say of the page."""
    done = subprocess.run(["groff", "-man", "-Tutf8", "-P-cbou", "-rLL=80n", "-ww", "-Kutf8", page], capture_output=True, text=True, timeout=60,
                          check=True)
    return done.stdout.replace("‐", "-").replace("−", "-").replace("’", "'"), done.stderr


class Pages(unittest.TestCase):
    def test_there_is_one_for_each_program_and_each_verb_of_its_own(self):
        self.assertEqual(sorted(page.stem for page in PAGES), sorted(command.replace(" ", "-") for command in COMMANDS))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_they_fit_and_say_what_the_help_says(self):
        for command in COMMANDS:
            with self.subTest(command):
                program, *verb = command.split()
                text, complaints = shown(BIN.parent / f"share/man/man1/{command.replace(' ', '-')}.1")
                self.assertEqual(complaints, "")
                self.assertLessEqual(max(map(len, text.split("\n"))), 80)
                self.assertEqual(re.findall(r"^(\S.*)$", text, re.MULTILINE)[1:-1], SECTIONS)
                text = words(text)
                page = subprocess.run([BIN / program, *verb, "--help"], capture_output=True, text=True, check=True).stdout
                summary = re.search(r"\n\n(.*?)\n\nOptions:", page, re.DOTALL)[1]
                self.assertIn(words(summary), text)
                for option in re.findall(r"^  (?:-. \[ )?(--\S+)", page, re.MULTILINE):
                    self.assertIn(option, text)
                for example in re.search(r"^Examples:\n((?:  .*\n)+)", page, re.MULTILINE)[1].strip().split("\n"):
                    self.assertIn(words(example.strip()), text.replace(" \\ ", " "))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_they_point_to_each_other(self):
        names = {page.stem for page in PAGES}
        for page in PAGES:
            others = set(re.findall(r"([a-z-]+)\(1\)", shown(page)[0].split("SEE ALSO")[1]))
            self.assertLessEqual(others, names)
            self.assertGreaterEqual(others | {page.stem}, {command for command in COMMANDS if " " not in command})


if __name__ == "__main__":
    unittest.main()
