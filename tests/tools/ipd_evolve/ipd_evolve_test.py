"""ipd-evolve as its user sees it: published populations, formulas, contradictions, files, pictures, journals that a kill does
not lose. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from fractions import Fraction
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "ipd-evolve"
TOURNAMENT = PROGRAM.with_name("ipd-tournament")
DATA = Path(__file__).resolve().parents[2] / "data"
THREE = ("--strategies", "all_c,all_d,tit_for_tat")


def run(*arguments, program=PROGRAM, **how):
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=60, **how)


def output(*arguments, **how):
    done = run(*arguments, **how)
    assert done.returncode == 0, done
    return done.stdout


def result(*arguments):
    return json.loads(output(*arguments, "--format", "json"))


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


class Scratch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def refused(self, code, *arguments, says=()):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(done.stdout, "", done)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done)
        self.assertTrue(lines[0].startswith("ipd-evolve: "))
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, lines[0])


class Published(Scratch):
    def test_complete_families_row_for_row(self):
        for family in ("memory(1,1)", "memory(1,2)"):
            name = family.replace("(", "_").replace(",", "_").rstrip(")")
            printed = output("--strategies", family, "--rounds", "1000", "--format", "csv")
            golden = (DATA / f"{name}_ecological.csv").read_text().splitlines()
            self.assertEqual(printed.splitlines()[1:], golden[1:])
            self.assertEqual(printed.splitlines()[0], "rank,name,population,extinct_at_generation")

    def test_the_classics_generation_for_generation(self):
        output("--rounds", "1000", "--output", str(self.folder))
        golden = list(csv.reader((DATA / "ecological17.csv").read_text().splitlines()))
        found = list(csv.reader((self.folder / "populations.csv").read_text().splitlines()))
        self.assertEqual(found[0], golden[0])
        self.assertEqual([[int(cell) for cell in row] for row in found[1:]],
                         [[int(float(cell)) for cell in row] for row in golden[1:]])
        golden = rows((DATA / "ecological17_cooperation.csv").read_text())
        found = rows((self.folder / "cooperation.csv").read_text())
        for ours, theirs in zip(found, golden):
            self.assertAlmostEqual(float(ours["percent_cooperation"]), float(theirs["percent_cooperation"]), 10)
        summary = json.loads((self.folder / "summary.json").read_text())
        self.assertEqual((summary["generations"], summary["fixed_point"], len(summary["survivors"])), (25, True, 10))
        self.assertIn("--rounds 1000", summary["command"])

    @unittest.skipIf("FOLK_SANITIZED" in os.environ, "a thousand generations; the test before has all the rest")
    def test_memory_2_1_says_that_it_is_not_at_a_fixed_point_and_runs_on(self):
        family = ("--strategies", "memory(2,1)", "--rounds", "1000")
        self.assertIn("after 1000 generations not at a fixed point", output(*family))
        on = result(*family, "--generations", "20000")
        self.assertTrue(on["fixed_point"])
        self.assertGreater(on["generations"], 1000)
        self.assertFalse(result(*family)["fixed_point"])


class Models(Scratch):
    def test_every_model_keeps_its_total(self):
        for model in ("ecological", "integer", "encounter", "moran", "fermi", "birth-death", "pairwise"):
            found = result(*THREE, "--model", model, "--generations", "200", "--seed", "3")
            total = sum(entry["population"] for entry in found["ranking"])
            self.assertEqual(total, found["individuals"])
            self.assertLessEqual(total, 300, model)
            if model not in ("ecological", "integer"):
                self.assertEqual(total, 300, model)
        for model in ("real", "replicator"):
            found = result(*THREE, "--model", model, "--generations", "200")
            self.assertAlmostEqual(sum(entry["population"] for entry in found["ranking"]), 1, 12)

    def test_the_same_seed_gives_the_same_bytes(self):
        for model in ("encounter", "birth-death"):
            how = (*THREE, "--model", model, "--generations", "500", "--format", "json")
            self.assertEqual(output(*how, "--seed", "5", "--threads", "1"), output(*how, "--seed", "5", "--threads", "2"))
            self.assertNotEqual(output(*how, "--seed", "5"), output(*how, "--seed", "6"))

    def test_start(self):
        found = result(*THREE, "--start", "all_d=7,Tit For Tat=0", "--generations", "0")
        self.assertEqual(found["start"], {"all_c": 100, "all_d": 7, "tit_for_tat": 0})
        self.assertEqual(found["generations"], 0)
        found = result(*THREE, "--individuals", "20", "--generations", "0")
        self.assertEqual(found["start"], {"all_c": 7, "all_d": 7, "tit_for_tat": 6})
        found = result(*THREE, "--model", "replicator", "--population", "1", "--start", "all_d=0.5", "--generations", "0")
        self.assertEqual(found["ranking"][2]["population"], 0.2)

    def test_integers_beyond_128_bits_are_exact(self):
        found = result(*THREE, "--population", "1e14", "--rounds", "1000000", "--generations", "1")
        n, s = 10**14, {"all_c": 6 * 10**6, "all_d": 7 * 10**6 + 4, "tit_for_tat": 7 * 10**6 - 1}
        self_scores = {"all_c": 3 * 10**6, "all_d": 10**6, "tit_for_tat": 3 * 10**6}
        each = {name: n * s[name] - self_scores[name] for name in s}
        # all_c: 3 + 0 + 3 a round; all_d: 5 + 1 and 5 + (T-1); tit_for_tat: 3 + (T-1) + 3.
        total = sum(n * value for value in each.values())
        for entry in found["ranking"]:
            self.assertEqual(entry["population"], 3 * n * n * each[entry["name"]] // total, entry)


class Fixation(Scratch):
    def test_fractions_are_those_of_the_formula(self):
        w, n, t = Fraction(1, 10), 20, 100
        a = {("c", "c"): 3, ("c", "d"): 0, ("d", "c"): 5, ("d", "d"): 1}
        def rho(mutant, resident):
            total, product = Fraction(1), Fraction(1)
            for j in range(1, n):
                f = 1 - w + w * Fraction(a[mutant, mutant] * (j - 1) + a[mutant, resident] * (n - j), n - 1)
                g = 1 - w + w * Fraction(a[resident, mutant] * j + a[resident, resident] * (n - j - 1), n - 1)
                product *= g / f
                total += product
            return 1 / total
        found = result("--strategies", "all_c,all_d", "--fixation", "--individuals", str(n), "--intensity", "1/10", "--exact",
                       "--rounds", str(t))
        for pair in found["fixation"]:
            key = {"all_c": "c", "all_d": "d"}
            expected = rho(key[pair["mutant"]], key[pair["resident"]])
            self.assertEqual(Fraction(pair["exact"]), expected)
            self.assertAlmostEqual(pair["probability"], float(expected), delta=1e-12 * float(expected))

    def test_the_stationary_distribution_is_stationary_in_fractions(self):
        found = result(*THREE, "--stationary", "--individuals", "20", "--exact")
        share = {entry["name"]: Fraction(entry["exact"]) for entry in found["ranking"]}
        self.assertEqual(sum(share.values()), 1)
        for name in share:
            flows = [share[pair["resident"]] * Fraction(pair["exact"]) * (1 if pair["mutant"] == name else -1)
                     for pair in found["fixation"] if name in (pair["mutant"], pair["resident"])]
            self.assertEqual(sum(flows), 0)

    def test_simulations_are_within_four_standard_errors(self):
        for model in ("birth-death", "pairwise"):
            found = rows(output("--strategies", "all_d,tit_for_tat", "--start", "all_d=8,tit_for_tat=2", "--runs", "2048",
                                "--model", model, "--format", "csv"))
            for row in found:
                p = float(row["exact"])
                self.assertLess(abs(float(row["share"]) - p), 4 * (p * (1 - p) / 2048) ** 0.5)

    def test_tables(self):
        self.assertEqual(len(rows(output(*THREE, "--fixation", "--format", "csv"))), 6)
        table = rows(output(*THREE, "--stationary", "--format", "csv"))
        self.assertAlmostEqual(sum(float(row["share"]) for row in table), 1, 12)
        self.assertIn("favoured", output(*THREE, "--fixation"))


class TournamentFiles(Scratch):
    def test_a_file_gives_what_is_played_on_the_spot(self):
        directly = output(*THREE, "--rounds", "50", "--format", "csv")
        text = output(*THREE, "--rounds", "50", "--format", "json", program=TOURNAMENT)
        (self.folder / "t.json").write_text(text)
        self.assertEqual(output("--tournament", str(self.folder / "t.json"), "--format", "csv"), directly)
        output(*THREE, "--rounds", "50", "--output", str(self.folder), program=TOURNAMENT)
        self.assertEqual(output("--tournament", str(self.folder / "scores.csv"), "--format", "csv"), directly)
        fixation = output(*THREE, "--rounds", "50", "--fixation", "--exact", "--format", "csv")
        self.assertEqual(output("--tournament", str(self.folder / "t.json"), "--fixation", "--exact", "--format", "csv"), fixation)

    def test_bad_files(self):
        def file(text):
            path = self.folder / "bad"
            path.write_text(text)
            return ("--tournament", str(path))
        good = json.loads(output(*THREE, "--format", "json", program=TOURNAMENT))
        for text, says in (("", "no table of scores"), ("{", "not well-formed JSON"), ("{}", 'no "strategies"'),
                           ("row\\col,a,b\na,1,2\n", "1 rows for 2 columns"), ("row\\col,a\na,x\n", ":2: 'x' against 'a'"),
                           (json.dumps({**good, "scores": [[1]]}), "3 rows of 3 numbers"),
                           (json.dumps({**good, "scores": [[None] * 3] * 3}), "self-play"),
                           (json.dumps({**good, "strategies": ["a", "a", "b"]}), "twice"),
                           ('{"strategies": ["a"], "scores": [[' + 200000 * "[" + 200000 * "]" + "]]}", "holds a array"),
                           (json.dumps({**good, "criterion": "finite:x"}), "x"),
                           (json.dumps({**good, "method_rows": ["cbc"] * 3}), "bounded")):
            self.refused(3, *file(text), says=says)
        self.refused(3, "--tournament", str(self.folder / "none"), says="none")
        (self.folder / "ok").write_text("row\\col,a\na,1\n")
        self.refused(2, "--tournament", str(self.folder / "ok"), "--rounds", "3", says="--rounds contradict")
        self.refused(2, "--tournament", str(self.folder / "ok"), "--strategies", "pavlov", says="--strategies contradict")


class Refusals(Scratch):
    def test_what_contradicts(self):
        for arguments, says in (
                (("--mutation", "0.1"), "--mutation does not belong to --model ecological"),
                (("--model", "real", "--individuals", "9"), "--individuals does not belong"),
                (("--model", "moron"), "expected ecological"),
                (("--fixation", "--stationary"), "two questions"),
                (("--fixation", "--runs", "3"), "two questions"),
                (("--fixation", "--model", "encounter"), "birth-death or pairwise"),
                (("--fixation", "--population", "3"), "contradict"),
                (("--stationary", "--mutation", "0.1"), "contradict"),
                (("--runs", "3", "--mutation", "0.1"), "contradict"),
                (("--runs", "3", "--model", "ecological"), "is not"),
                (("--exact",), "--fixation"),
                (("--individuals", "9", "--population", "3"), "contradict"),
                (("--model", "encounter", "--income", "me"), "ind or com"),
                (("--model", "birth-death", "--fitness", "flat"), "linear"),
                (("--model", "birth-death", "--intensity", "2"), "0 to 1"),
                (("--start", "nobody=3"), "not in the roster"), (("--start", "all_d"), "NAME=N"),
                (("--start", "all_d=1.5"), "1.5"), (("--start", "all_d=1,all_d=2"), "twice"),
                (("--population", "0"), "nobody"), (("--generations", "-1"), "-1"),
                (("--fixation", "--exact", "--criterion", "discounted:0.9", *THREE), "exact scores"),
                (("--fixation", "--exact", "--model", "pairwise"), "fractions"),
                (("--plot",), "--output DIR"), (("--plot=gif", "--output", str(self.folder)), "svg, png or pdf"),
                (("--payoffs", "T=5,R=3,P=1,S=-1"), "negative")):
            self.refused(2, *arguments, says=says)

    def test_classes_too_large_to_list_and_infinite_machines_without_a_horizon(self):
        self.refused(2, "--strategies", "memory(3,3)", says=("2^67", "X + Y = 4"))
        self.refused(2, "--strategies", "pavlov,memory(2,2)", says=("262144", "20000", "--class"))
        for extra in (("--include", "pavlov"), ("--model", "moran"), ("--noise", "0.1"), ("--fixation",), ("--runs", "3"),
                      ("--start", "pavlov=3"), ("--plot",), ("--population", "1e15")):
            self.refused(2, "--strategies", "memory(2,2)", *extra, says=extra[0] if extra[0] != "--population" else "too much")
        self.refused(2, "--criterion", "mean", says=("gradual", "no limit", "give a horizon"))
        self.assertIn("fixed point", output("--criterion", "mean", "--exclude", "gradual,hard_majo,soft_majo"))


class Journals(Scratch):
    LONG = (*THREE, "--model", "birth-death", "--mutation", "0.01", "--seed", "2", "--generations")

    def journal(self):
        return ("--journal", str(self.folder / "j"))

    def killed(self, *arguments):
        """Kills the program once its journal is there."""
        process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 50
        while not (self.folder / "j").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        self.assertEqual(process.wait(), -signal.SIGKILL)

    def test_after_a_kill_the_same_command_goes_on(self):
        # So many generations that it cannot have ended; then as many as were there, and some more.
        self.killed(*self.LONG, "1e12", *self.journal())
        lines = (self.folder / "j").read_text().splitlines()
        there = int(lines[2].split()[1])
        self.assertGreater(there, 0)
        more = (*self.LONG, str(there + 1000), "--format", "json")
        done = run(*more, *self.journal())
        self.assertIn(f"going on from generation {there} ", done.stderr)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stdout, output(*more))

    def test_parts_make_the_whole(self):
        for n in ("300", "700", "1000"):
            last = output(*self.LONG, n, *self.journal(), "--quiet", "--format", "json")
        self.assertEqual(last, output(*self.LONG, "1000", "--format", "json"))
        runs = ("--strategies", "all_d,tit_for_tat", "--individuals", "10", "--format", "csv", "--quiet")
        for n in ("256", "300", "600"):
            last = output(*runs, "--runs", n, "--journal", str(self.folder / "r"))
        self.assertEqual(last, output(*runs, "--runs", "600"))

    def test_an_interrupted_run_says_how_to_go_on(self):
        process = subprocess.Popen([PROGRAM, *self.LONG, "1e12", *self.journal()], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(0.3)
        process.send_signal(signal.SIGTERM)
        out, errors = process.communicate(timeout=30)
        if process.returncode == -signal.SIGTERM:
            self.skipTest("it had not begun")
        self.assertEqual((process.returncode, out), (4, ""))
        self.assertIn("the same command goes on from there", errors)
        self.assertTrue((self.folder / "j").exists())

    def test_journals_that_are_not_its_own(self):
        output(*self.LONG, "100", *self.journal(), "--quiet")
        other = tuple("3" if word == "2" else word for word in self.LONG)
        self.refused(3, *other, "100", *self.journal(), says="another run")
        self.refused(2, *self.LONG, "50", *self.journal(), says="beyond --generations 50")
        text = (self.folder / "j").read_text()
        for bad in (text[:-30], text.replace("row 7 ", "row 8 "), "", "x" * 100):
            (self.folder / "j").write_text(bad)
            self.refused(3, *self.LONG, "100", *self.journal(), says="journal")
        self.refused(2, *THREE, "--fixation", "--journal", str(self.folder / "f"), says="contradict")


@unittest.skipUnless(shutil.which("gnuplot") and shutil.which("dot"), "nothing draws")
class Pictures(Scratch):
    def test_are_drawn(self):
        output(*THREE, "--plot", "--output", str(self.folder))
        output(*THREE, "--stationary", "--plot=svg", "--output", str(self.folder))
        for name in ("populations", "stack", "cooperation", "simplex", "fixation"):
            self.assertTrue((self.folder / f"{name}.svg").read_text().rstrip().endswith("</svg>"), name)


if __name__ == "__main__":
    unittest.main()
