"""ipd-match as its user sees it: results, defaults, refusals. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import pty
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "ipd-match"

# A player that cooperates and believes so of the other, for the line protocol of exec:.
BELIEVER = """
import sys
for line in sys.stdin:
    if line.split()[0] == "move":
        print("C 0.75", flush=True)
"""

STAG_HUNT = 'NFG 1 R "Stag hunt" { "Row" "Column" } { { "stag" "hare" } { "stag" "hare" } } "" 4 4 3 0 0 3 3 3\n'


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)


def result(*arguments):
    done = run(*arguments, "--format", "json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def on_a_terminal(environment):
    """What ipd-match prints when its stdout is a terminal."""
    try:
        ours, theirs = pty.openpty()
    except OSError as error:  # a bare chroot has no /dev/pts
        raise unittest.SkipTest(str(error)) from error
    clean = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")}
    program = subprocess.run(
        [PROGRAM, "all_c", "all_d"], stdout=theirs, stderr=subprocess.DEVNULL, env={**clean, **environment}, timeout=60
    )
    assert program.returncode == 0
    os.close(theirs)
    try:
        return os.read(ours, 65536).decode()
    finally:
        os.close(ours)


class Results(unittest.TestCase):
    def test_tit_for_tat_loses_one_round_to_all_d(self):
        match = result("tit_for_tat", "all_d", "--rounds", "10")
        self.assertEqual(match["players"], ["tit_for_tat", "all_d"])
        self.assertEqual(match["moves"], ["CDDDDDDDDD", "DDDDDDDDDD"])
        self.assertEqual(match["scores"], [9, 14])
        self.assertEqual(match["running_scores"], [list(range(10)), list(range(5, 15))])
        self.assertEqual(match["cooperation_rates"], [0.1, 0])
        self.assertEqual(match["means"], [0.9, 1.4])

    def test_every_default_is_stated(self):
        match = result("all_c", "all_c")
        self.assertEqual(match["rounds"], 30)
        self.assertEqual(match["noise"], 0)
        self.assertEqual(match["seed"], 1)
        self.assertEqual(match["payoffs"], {"T": 5, "R": 3, "P": 1, "S": 0})
        text = run("all_c", "all_c").stdout
        self.assertIn("T=5,R=3,P=1,S=0; 30 rounds; noise 0; seed 1", text)

    def test_a_player_against_itself_is_two_players(self):
        match = result("prober", "prober", "--rounds", "6")
        self.assertEqual(match["moves"][0], match["moves"][1])
        mixed = result("random(0.5)", "random(0.5)", "--rounds", "200")
        self.assertNotEqual(mixed["moves"][0], mixed["moves"][1])

    def test_scores_follow_from_moves_and_payoffs(self):
        match = result("gradual", "random(0.5)", "--rounds", "300", "--noise", "0.1", "--payoffs", "T=1.5,R=1,P=0.1,S=-1")
        worth = {"CC": 1, "CD": -1, "DC": 1.5, "DD": 0.1}
        sums = [0, 0]
        for first, second in zip(*match["moves"]):
            sums[0] += worth[first + second]
            sums[1] += worth[second + first]
        for seat in (0, 1):
            self.assertAlmostEqual(match["scores"][seat], sums[seat], places=9)
            self.assertEqual(match["scores"][seat], match["running_scores"][seat][-1])
            self.assertAlmostEqual(match["cooperation_rates"][seat], match["moves"][seat].count("C") / 300)

    def test_decimals_are_exact(self):
        match = run("all_c", "all_c", "--rounds", "3", "--payoffs", "T=2,R=1.1,P=1,S=0", "--format", "json").stdout
        self.assertIn('"scores": [3.3, 3.3]', match)
        text = run("all_d", "all_d", "--rounds", "4", "--payoffs", "T=2,R=1,P=1/3,S=0").stdout
        self.assertIn("4/3", text)

    def test_noise_flips_and_says_where(self):
        match = result("all_c", "all_d", "--rounds", "500", "--noise", "0.2")
        flipped = [[t + 1 for t, m in enumerate(moves) if m != own] for moves, own in zip(match["moves"], "CD")]
        self.assertEqual(match["slips"], flipped)
        self.assertTrue(50 < len(flipped[0]) < 150)
        text = run("all_c", "all_d", "--noise", "1").stdout
        self.assertIn("d" * 30, text)
        self.assertIn("c" * 30, text)
        self.assertIn("lower case", text)

    def test_the_seed_decides(self):
        once = run("random(0.5)", "gradual", "--noise", "0.1", "--seed", "7", "--format", "json")
        again = run("random(0.5)", "gradual", "--noise", "0.1", "--seed", "7", "--format", "json")
        other = run("random(0.5)", "gradual", "--noise", "0.1", "--seed", "8", "--format", "json")
        self.assertEqual(once.stdout, again.stdout)
        self.assertNotEqual(json.loads(once.stdout)["moves"], json.loads(other.stdout)["moves"])

    def test_csv_has_a_line_a_round(self):
        rows = list(csv.DictReader(io.StringIO(run("tit_for_tat", "all_d", "--rounds", "2", "--format", "csv").stdout)))
        self.assertEqual(list(rows[0].values()), ["1", "C", "D", "0", "5", "", ""])
        self.assertEqual(list(rows[1].values()), ["2", "D", "D", "1", "1", "", ""])

    def test_lines_fit_the_width(self):
        text = run("tit_for_tat", "mistrust", "--rounds", "100", "--width", "50").stdout
        moves = [line for line in text.splitlines() if line.startswith(("tit_for_tat  ", "mistrust ", "round"))]
        self.assertTrue(all(len(line) <= 50 for line in moves))
        self.assertEqual(sum(line.startswith("tit_for_tat  CDCDCDCDCD") for line in moves), 4)

    def test_nothing_is_coloured_off_a_terminal(self):
        self.assertNotIn("\x1b", run("tit_for_tat", "mistrust").stdout)

    def test_colours_on_a_terminal_unless_refused(self):
        self.assertIn("\x1b[38;5;33mCCC", on_a_terminal({}))
        self.assertNotIn("\x1b", on_a_terminal({"NO_COLOR": "1"}))
        self.assertNotIn("\x1b", on_a_terminal({"TERM": "dumb"}))

    def test_another_game(self):
        with tempfile.TemporaryDirectory() as folder:
            game = Path(folder) / "stag_hunt.nfg"
            game.write_text(STAG_HUNT)
            match = result("tit_for_tat", "all_d", "--rounds", "2", "--game", str(game))
        self.assertEqual(match["game"], "Stag hunt")
        self.assertEqual(match["scores"], [3, 6])


class Beliefs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        script = Path(folder.name) / "believer.py"
        script.write_text(BELIEVER)
        self.believer = f'exec:"python3 {script}"'

    def test_beliefs_are_told_and_judged(self):
        match = result(self.believer, "per_ccd", "--rounds", "6")
        self.assertEqual(match["moves"], ["CCCCCC", "CCDCCD"])
        self.assertEqual(match["beliefs"], [[0.75] * 6, None])
        self.assertAlmostEqual(match["belief_accuracy"][0], 4 / 6)
        self.assertIsNone(match["belief_accuracy"][1])
        self.assertEqual(match["notes"], [])
        rows = csv.DictReader(io.StringIO(run("per_ccd", self.believer, "--rounds", "6", "--format", "csv").stdout))
        self.assertEqual([(row["belief1"], row["belief2"]) for row in rows], [("", "0.75")] * 6)

    def test_wrong_beliefs_are_marked(self):
        text = run(self.believer, "per_ccd", "--rounds", "6").stdout
        line = next(line for line in text.splitlines() if line.startswith("  believes"))
        self.assertEqual(line.split()[1], "CCcCCc")
        self.assertIn("66.67 %", text)
        self.assertNotIn("believes", run("all_c", "per_ccd").stdout)


class Refusals(unittest.TestCase):
    def refused(self, code, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(done.stdout, "")
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("ipd-match: "), lines[0])
        return lines[0]

    def test_wrong_usage(self):
        self.refused(2)
        self.refused(2, "all_c")
        self.refused(2, "all_c", "all_d", "all_c")
        self.assertIn("tit_for_tat", self.refused(2, "all_c", "tit_for_tut"))
        self.refused(2, "classics", "all_d")
        self.refused(2, "all_c", "all_d", "--no-such-option")
        self.refused(2, "all_c", "all_d", "--format", "xml")

    def test_wrong_numbers(self):
        for rounds in ("0", "-1", "1e30", "1.5", "", "nan", "99999999999999999999999"):
            self.refused(2, "all_c", "all_d", "--rounds=" + rounds)
        self.assertIn("ipd-tournament", self.refused(2, "all_c", "all_d", "--rounds", "1000001"))
        for noise in ("1.5", "-0.1", "nan", "inf", "x"):
            self.refused(2, "all_c", "all_d", "--noise=" + noise)
        self.refused(2, "all_c", "all_d", "--payoffs", "T=1,R=2,P=3,S=4")
        self.refused(2, "all_c", "all_d", "--seed=-1")
        self.refused(2, "all_c", "all_d", "--width", "3")

    def test_two_games_at_once(self):
        self.refused(2, "all_c", "all_d", "--payoffs", "T=5,R=3,P=1,S=0", "--game", "x.nfg")

    def test_bad_files(self):
        self.refused(3, "all_c", "all_d", "--game", "no_such_file.nfg")
        self.refused(3, "all_c", "@no_such_file")
        with tempfile.TemporaryDirectory() as folder:
            self.refused(3, "all_c", "all_d", "--game", folder)

    def test_a_dead_program(self):
        self.refused(4, "all_c", 'exec:"exit 3"')


if __name__ == "__main__":
    unittest.main()
