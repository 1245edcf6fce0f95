"""Text that others wrote, in titles, names, commands and paths, as the programs print it: nothing of it acts on a terminal or
breaks a line or a table, CSV and JSON are well-formed UTF-8, and JSON has the whole of it. FOLK_BIN names the folder of the
programs."""

import csv
import io
import json
import os
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
CORPUS = Path(__file__).resolve().parents[2] / "fuzz/corpus"
TITLE = "first\nsecond\x1b[31m \u009b31m \u202etfel ]]> \u2028 end" + "." * 300
NAMES = ["A\x1b[31m", "B\nb, \"B\""]
ACTIONS = ["x\x1b[2J\uffff", "y\u0085]]>"]
# A player of C for ever, whose command holds what is no UTF-8 and what a terminal would act on.
COMMAND = b"exec:\"while read line; do [ $line = move ] && echo C; done # caf\xe9 \xc2\x9b31m\""


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def drawn(text):
    """True for lines of which nothing acts on a terminal."""
    return all(line.isprintable() for line in text.split("\n"))


class ForeignText(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.game = self.folder / "game.nfg"
        self.game.write_text("NFG 1 R %s { %s } { { %s } { %s } }\n3 3 5 0 0 5 1 1\n" % (
            quoted(TITLE), " ".join(map(quoted, NAMES)), " ".join(map(quoted, ACTIONS)), " ".join(map(quoted, ACTIONS))))

    def run_program(self, program, *arguments, code=0):
        done = subprocess.run([BIN / program, *arguments], capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, done)
        return done.stdout.decode(), done.stderr.decode()

    def shown(self, program, *arguments, what="text"):
        """What it prints, which must be drawn as it is and end in a line end."""
        out, errors = self.run_program(program, *arguments, "--format", what)
        self.assertTrue(drawn(out), out)
        self.assertTrue(drawn(errors), errors)
        self.assertTrue(out.endswith("\n"))
        return out

    def test_titles_in_text(self):
        for program, *arguments in (("payoff-region",), ("ipd-match", "all_c", "all_d", "--rounds", "3"),
                                    ("ipd-tournament", "--strategies", "all_c,all_d", "--rounds", "3"),
                                    ("sce-check", "pavlov", "all_d")):
            with self.subTest(program):
                out = self.shown(program, *arguments, "--game", self.game)
                self.assertIn(r"first\nsecond\x1b[31m \u{9b}31m \u{202e}tfel ]]> \u{2028} end...", out)
                self.assertNotIn("." * 250, out)

    def test_titles_in_json(self):
        for program, *arguments in (("payoff-region",), ("ipd-match", "all_c", "all_d", "--rounds", "3"),
                                    ("ipd-tournament", "--strategies", "all_c,all_d", "--rounds", "3")):
            with self.subTest(program):
                out, _ = self.run_program(program, *arguments, "--game", self.game, "--format", "json")
                self.assertEqual(json.loads(out)["game"], TITLE)

    def test_names_of_players_and_actions(self):
        out = self.shown("payoff-region", "--game", self.game)
        self.assertIn(r"""payoffs of (A\x1b[31m, B\nb, "B")""", out)
        self.assertIn(r"""  pure  y\u{85}]]>  y\u{85}]]>  (1, 1)""", out)
        table = self.shown("payoff-region", "--game", self.game, what="csv")
        rows = list(csv.DictReader(io.StringIO(table)))
        self.assertEqual(len(rows), table.count("\n") - 1)
        self.assertEqual(rows[0]["first"], r"y\u{85}]]>")
        out, _ = self.run_program("payoff-region", "--game", self.game, "--format", "json")
        found = json.loads(out)
        self.assertEqual((found["players"], found["actions"]), (NAMES, [ACTIONS, ACTIONS]))

    def test_commands(self):
        entrants = b"all_d,tit_for_tat," + COMMAND
        shown = r"done # caf\xe9 \u{9b}31m"
        self.assertIn(shown, self.shown("ipd-match", COMMAND, "all_d", "--rounds", "3"))
        self.assertIn(shown, self.shown("ipd-tournament", "--strategies", entrants, "--rounds", "3"))
        for arguments in (("ipd-tournament", "--strategies", entrants, "--rounds", "3"),
                          ("payoff-region", "--strategies", entrants, "--rounds", "3")):
            self.assertIn(shown, self.shown(*arguments, what="csv"))
            out, _ = self.run_program(*arguments, "--format", "json")
            self.assertIn("caf\ufffd", json.dumps(json.loads(out), ensure_ascii=False))

    def test_paths_in_policies(self):
        """A policy notes of what it was trained, and names of files need be no UTF-8."""
        prey, data = self.folder / os.fsdecode(b"caf\xe9.safetensors"), self.folder / os.fsdecode(b"s\xe9t")
        shutil.copy(CORPUS / "particle_policy/prey", prey)
        self.run_program("mpe-train", "online", "--scenario", "simple_world", "--prey", prey, "--episodes", "2", "--hidden", "4", "--batch", "4", "--memory", "1600", "--first-update", "25",
                         "--evaluation-episodes", "1", "--output", self.folder / "online.safetensors")
        self.run_program("mpe-train", "collect", "--scenario", "simple_world", "--predators", "lead_pursuit", "--prey", prey, "--transitions", "50", "--output", data)
        self.run_program("mpe-train", "offline", "--learner", "bc", "--data", data, "--steps", "1", "--hidden", "4", "--layers", "1", "--batch", "2", "--output",
                         self.folder / "bc.safetensors")
        for policy in ("online", "bc"):
            self.run_program("mpe-evaluate", "--predators", self.folder / f"{policy}.safetensors", "--scenario", "simple_world", "--prey", "still", "--episodes", "1")

    def test_refusals(self):
        for argument in (b"caf\xe9", "\u009b31m".encode(), "\u202eabc".encode(), b"a\x1b[31m"):
            _, errors = self.run_program("ipd-match", argument, "all_d", code=2)
            self.assertTrue(drawn(errors), errors)
            self.assertEqual(errors.count("\n"), 1)
            _, errors = self.run_program("ipd-match", "all_c", "all_d", "--rounds", argument, code=2)
            self.assertTrue(drawn(errors), errors)

    def test_players_without_names(self):
        self.game.write_text('NFG 1 D "" { "" "  " } { { "" "" } { "" " " } }\n9 0 0 1 0 1 1 0')
        out = self.shown("payoff-region", "--game", self.game)
        self.assertIn("payoffs of (the row player, the column player)", out)
        self.assertIn("the row player is held to 0.9 by", out)
        self.assertIn('1/10 1 + 9/10 " "', out)

    def test_corners_that_differ_are_shown_to_differ(self):
        self.game.write_text('NFG 1 R "far" { "A" "B" } { 2 2 }\n' + " ".join(str(10**9 + x) for x in (3, 3, 5, 0, 0, 5, 1, 1)))
        out = self.shown("payoff-region", "--game", self.game, "--discount", "0.6")
        self.assertIn("(1000000001, 1000000001) (1000000004.3333334, 1000000001) (1000000003, 1000000003)", out)
        self.game.write_text('NFG 1 R "near" { "A" "B" } { 2 2 }\n3 3 3.00000000001 0 0 3.00000000001 1 1/7')
        corners = [line for line in self.shown("payoff-region", "--game", self.game).splitlines() if line.startswith("  (")]
        self.assertIn("(3.00000000001, 0)", corners[0])

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_pictures_are_xml(self):
        picture = self.folder / "region.svg"
        self.run_program("payoff-region", "--game", self.game, "--output", picture)
        texts = "".join(xml.etree.ElementTree.parse(picture).getroot().itertext())
        self.assertIn("]]>", texts)
        self.run_program("ipd-tournament", "--strategies", b"all_d," + COMMAND, "--rounds", "3", "--game", self.game,
                         "--output", self.folder / "out", "--plot")
        for made in (self.folder / "out").glob("*.svg"):
            xml.etree.ElementTree.parse(made)


if __name__ == "__main__":
    unittest.main()
