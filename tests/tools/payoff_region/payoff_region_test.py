"""payoff-region as its user sees it: sets, equilibria, dots, pictures, refusals. FOLK_BIN names the folder of the
programs."""

import csv
import io
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "payoff-region"
TREE = Path(__file__).resolve().parents[3]
ARTICLE = TREE / "examples" / "abreu_sannikov.nfg"
DILEMMA = TREE / "tests" / "data" / "dilemma_9_10.nfg"
EMPTY = TREE / "tests" / "data" / "no_pure_equilibrium.nfg"


def run(*arguments, **how):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **how)


def text(*arguments, **how):
    done = run(*arguments, **how)
    assert done.returncode == 0, done.stderr
    return done.stdout


def report(*arguments):
    return json.loads(text(*arguments, "--format", "json"))


class Input(unittest.TestCase):
    def test_the_game_may_come_on_the_standard_input(self):
        self.assertEqual(text("--game", "-", input=open(ARTICLE).read()), text("--game", ARTICLE))


class Sets(unittest.TestCase):
    def assert_corners(self, found, expected, tolerance):
        """The same corners in the same order round the polygon, wherever it begins."""
        self.assertEqual(len(found), len(expected))
        start = min(range(len(found)), key=lambda i: sum(abs(a - b) for a, b in zip(found[i], expected[0])))
        for one, other in zip(found[start:] + found[:start], expected):
            for a, b in zip(one, other):
                self.assertAlmostEqual(a, b, delta=tolerance)

    def test_abreu_and_sannikov(self):
        found = report("--game", ARTICLE, "--discount", "0.3")["equilibria"]
        self.assert_corners(found["corners"], [(1.1256824, 2.8), (7.33770472, 0), (7.86308964, 0), (19.7917977, 2.8),
                                               (15.5630896, 9.1), (7.33770472, 10.9826253)], 5e-8)
        shown = text("--game", ARTICLE, "--discount", "3/10")
        for corner in ("(1.1256824, 2.8)", "(7.33770472, 0)", "(7.33770472, 10.9826253)"):
            self.assertIn(corner, shown)

    def test_the_dilemma(self):
        found = report("--game", DILEMMA, "--discount", "0.9")["equilibria"]
        self.assert_corners(found["corners"], [(3, 3), (9.75, 3), (9, 9), (3, 9.75)], 1e-9)

    def test_next_to_one(self):
        for discount in ("0.9999992", "0.9999999999999", "0.9999999999999999"):
            found = report("--discount", discount)["equilibria"]
            self.assert_corners(found["corners"], [(1, 1), (13 / 3, 1), (3, 3), (1, 13 / 3)], 1e-14)
            self.assertEqual(found["worst"], [1, 1])
            self.assertFalse(report("--game", EMPTY, "--discount", discount)["equilibria"]["exists"])
            found = report("--game", ARTICLE, "--discount", discount)
            self.assert_corners(found["equilibria"]["corners"], found["pure_individually_rational"], 1e-5)
            for row, column in found["equilibria"]["corners"]:
                self.assertGreaterEqual(min(row, column), 0)

    def test_small_payoffs_beside_large_ones(self):
        found = report("--quiet", "--payoffs", "T=1e13,R=3,P=1,S=0", "--discount", "0.6")["equilibria"]
        self.assertEqual(found["worst"], [1, 1])
        self.assertEqual(found["corners"][0], [1, 1])

    def test_no_pure_equilibrium(self):
        shown = text("--game", EMPTY, "--discount", "0.05")
        self.assertIn("2/5 T + 3/5 B  2/5 L + 3/5 R", shown)
        self.assertIn("there is no such equilibrium", shown)
        found = report("--game", EMPTY, "--discount", "0.05")
        self.assertFalse(found["equilibria"]["exists"])
        self.assertEqual(found["equilibria"]["corners"], [])
        mixed = found["stage_equilibria"]["extreme"]
        self.assertEqual([(e["row"], e["column"], e["pure"]) for e in mixed], [(["2/5", "3/5"], ["2/5", "3/5"], False)])
        self.assertEqual(found["minmax"]["pure"], [1, 2])
        self.assertEqual(found["minmax"]["mixed_exact"], ["-1/5", "4/5"])

    def test_without_a_discount_factor(self):
        found = report()
        self.assertIsNone(found["equilibria"])
        self.assertIsNone(found["tournament"])
        self.assertEqual(found["feasible"], [[0, 5], [1, 1], [5, 0], [3, 3]])
        self.assertEqual(found["individually_rational"][1], [13 / 3, 1])
        self.assertIn("(13/3, 1)", text())
        self.assertEqual(found["actions"], [["C", "D"], ["C", "D"]])

    def test_degenerate_games_are_said_to_be_so(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "flat.nfg"
            path.write_text('NFG 1 R "Flat" { "A" "B" } { 2 2 }\n1 1 1 1 1 1 1 1\n')
            self.assertIn("the game is degenerate", text("--game", path, "--discount", "0.5"))
            found = report("--game", path, "--discount", "0.5")
        self.assertTrue(found["stage_equilibria"]["degenerate"])
        self.assertEqual(found["equilibria"]["corners"], [[1, 1]])

    def test_csv(self):
        rows = list(csv.DictReader(io.StringIO(text("--game", DILEMMA, "--discount", "0.9", "--format", "csv"))))
        self.assertEqual(list(rows[0]), ["kind", "first", "second", "row", "column"])
        self.assertEqual(sum(row["kind"] == "equilibrium" for row in rows), 4)
        self.assertEqual([(row["row"], row["column"]) for row in rows if row["kind"] == "mixed_minmax"], [("3", "3")])


class Dots(unittest.TestCase):
    def test_the_pairs_of_a_tournament(self):
        found = report("--strategies", "tit_for_tat,all_d", "--include", "all_c", "--rounds", "10")["tournament"]
        self.assertEqual(found["criterion"], "finite:10")
        payoffs = {(pair["first"], pair["second"]): pair["payoffs"] for pair in found["pairs"]}
        self.assertEqual(len(payoffs), 6)
        self.assertEqual(payoffs["tit_for_tat", "all_d"], [0.9, 1.4])
        self.assertEqual(payoffs["all_d", "all_c"], [5, 0])

    def test_policies_among_them(self):
        rounds = "20" if "FOLK_SANITIZED" in os.environ else "100"
        shown = text("--strategies", "classics", "--include", "sct", "--rounds", rounds)
        self.assertRegex(shown, rf"tournament: 18 strategies \(classics, with sct\), finite:{rounds}, .*: 171 pairs at \d+ points")
        self.assertLess(len(shown.splitlines()), 40)

    def test_results_do_not_depend_on_threads(self):
        arguments = ("--strategies", "random(0.5),tit_for_tat,pavlov", "--criterion", "discounted:0.9", "--noise",
                     "0.01", "--format", "csv")
        self.assertEqual(text(*arguments, "--threads", "1"), text(*arguments, "--threads", "4"))


@unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
class Pictures(unittest.TestCase):
    def test_formats(self):
        with tempfile.TemporaryDirectory() as folder:
            for extension, magic in ((".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")):
                path = Path(folder) / ("region" + extension)
                text("--discount", "0.6", "--strategies", "classics", "--output", path)
                self.assertTrue(path.read_bytes().startswith(magic))
            self.assertEqual(len(list(Path(folder).iterdir())), 3)
            svg = (Path(folder) / "region.svg").read_text()
        for name in ("payoff of Row", "pure-strategy equilibria at d = 0.6", "mixed minmax point", "153 pairs",
                     "prisoner's dilemma (T=5,R=3,P=1,S=0) · discounted:0.6, pairs finite:100 · Folk ",
                     "<title>prisoner's dilemma (T=5,R=3,P=1,S=0): payoffs a round</title>"):
            self.assertTrue(name in svg, name)


class Refusals(unittest.TestCase):
    def refused(self, code, message, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("payoff-region: "), done.stderr)
        self.assertIn(message, done.stderr)

    def test_discount_factors(self):
        for discount in ("0", "1", "1.5", "-0.1", "nan", "inf", "x", "", "1/0", "3/2"):
            self.refused(2, "", "--discount=" + discount)
        self.refused(2, "more than once", "--discount", "0.5", "--discount", "0.6")

    def test_what_cannot_be_decided(self):
        self.refused(4, "common denominator", "--quiet", "--payoffs", "T=1e99,R=3,P=1,S=0", "--discount", "0.6")

    def test_games(self):
        self.refused(2, "--game and --payoffs contradict", "--game", DILEMMA, "--payoffs", "T=5,R=3,P=1,S=0")
        self.refused(2, "is 3x3: expected a symmetric 2x2 game", "--game", ARTICLE, "--strategies", "classics")
        self.refused(2, "is not symmetric", "--game", EMPTY, "--strategies", "classics")
        self.refused(3, "no such file", "--game", "nothing.nfg")

    def test_options_of_a_tournament_that_is_not_played(self):
        for option, value in (("include", "sct"), ("rounds", "5"), ("criterion", "mean"), ("seed", "2"), ("noise", "0")):
            self.refused(2, f"--{option} is about a tournament", f"--{option}", value)

    def test_rosters(self):
        self.refused(2, "did you mean pavlov", "--strategies", "pavlo")
        self.refused(2, "pavlov", "--strategies", "pavlov", "--include", "Pavlov")

    def test_outputs(self):
        self.refused(2, "ends in .svg, .png or .pdf", "--output", "region.gif")
        if shutil.which("gnuplot"):
            self.refused(4, "cannot be written", "--output", "/nowhere/region.svg")

    def test_too_large_a_game(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "large.nfg"
            path.write_text('NFG 1 R "" { "A" "B" } { 41 41 }\n' + "0 " * 3362)
            self.refused(2, "a 41x41 game is too large", "--game", path)


if __name__ == "__main__":
    unittest.main()
