"""ipd-strategies as its user sees it: the list, what it shows, what it proves. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "ipd-strategies"

# The equalities of the literature, own moves being the strategy's own.
EQUAL = {
    "slow_tft": "mem12_ccCCCDCDDD",
    "hard_tft": "mem02_ccCDDD",
    "tf2t": "mem02_ccCCCD",
    "pavlov": "mem11_cCDDC",
    "spiteful": "mem11_cCDDD",
    "tit_for_tat": "mem01_cCD",
    "mistrust": "mem01_dCD",
}


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)


def text(*arguments):
    done = run(*arguments)
    assert done.returncode == 0, done.stderr
    assert done.stderr == "", done.stderr
    return done.stdout


def result(*arguments):
    return json.loads(text(*arguments, "--format", "json"))


class List(unittest.TestCase):
    def test_every_line_fits_120_columns(self):
        lines = text("list").splitlines()
        self.assertLessEqual(max(map(len, lines)), 120)
        self.assertTrue(any(line.startswith("pavlov ") for line in lines))
        self.assertTrue(any(line.startswith("classics ") for line in lines))

    def test_json_and_csv_hold_the_same(self):
        listed = result("list")
        rows = list(csv.DictReader(io.StringIO(text("list", "--format", "csv"))))
        self.assertEqual([s["name"] for s in listed["strategies"]], [r["name"] for r in rows if r["kind"] == "strategy"])
        self.assertEqual([g["name"] for g in listed["groups"]], [r["name"] for r in rows if r["kind"] == "group"])
        pavlov = next(s for s in listed["strategies"] if s["name"] == "pavlov")
        self.assertEqual((pavlov["memory"], pavlov["states"], pavlov["nice"]), (1, 2, True))
        self.assertIn("wsls", pavlov["aliases"])
        majo = next(s for s in listed["strategies"] if s["name"] == "soft_majo")
        self.assertEqual((majo["memory"], majo["states"]), ("unbounded", "infinite"))

    def test_a_spec_lists_whom_it_names(self):
        spec = "sample(memory(2,2);3;seed=7),soft_majo,exec:cat"
        strategies = result("list", spec)["strategies"]
        self.assertEqual([s["name"] for s in strategies][3:], ["soft_majo", 'exec:"cat"'])
        self.assertEqual([s["states"] for s in strategies][3:], ["infinite", None])
        lines = text("list", spec).splitlines()
        self.assertEqual([line.split()[0] for line in lines[1:]], [s["name"] for s in strategies])


class Show(unittest.TestCase):
    def test_what_is_shown_can_be_read_back(self):
        for name in ("pavlov", "prober", "mem12_ccCDCDDCDD", "gtft(0.3)"):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "machines"
                path.write_text(result("show", name)["machine"])
                found = result("diff", name, f"@{path}", "--any-own-moves")
                self.assertEqual(found["result"], "equivalent", name)
                self.assertTrue(text("show", name).endswith(path.read_text()))

    def test_fractions_are_kept_exactly(self):
        shown = result("show", "zd_extort(4;1/17)")
        self.assertEqual(shown["name"], "zd_extort(4;1/17)")
        probabilities = {line.split()[1] for line in shown["machine"].splitlines()[1:] if line[:5] != "start"}
        self.assertEqual(probabilities, {"C", "D", "0.6470588235294118", "0.47058823529411764"})  # 11/17, 0, 8/17, 0
        self.assertEqual(result("show", "gtft(2/6)")["name"], "gtft(1/3)")
        self.assertIn("0.3333333333333333", result("show", "gtft(1/3)")["machine"])

    def test_names_may_hold_blanks_and_labels(self):
        self.assertEqual(result("show", "Win-Stay Lose-Shift")["name"], "pavlov")
        shown = text("show", "mine=Tit For Tat")
        self.assertTrue(shown.startswith("mine\n  described as   tit_for_tat\n"), shown)
        self.assertIn("machine mine\n", shown)

    def test_what_other_projects_mean_by_a_name(self):
        self.assertIn("  elsewhere      Axelrod-Python's Alternator goes by its own last move", text("show", "per_cd"))
        self.assertEqual(result("show", "Alternator")["name"], "axelrod_alternator")
        self.assertEqual(result("diff", "Alternator", "mem1(c;0,0,1,1)", "--any-own-moves")["result"], "equivalent")
        for name, theirs in {"winner21": "axelrod_winner21", "spiteful_cc": "axelrod_spiteful_cc",
                             "spiteful": "mathieu_spiteful", "badbet": "mathieu_badbet"}.items():
            self.assertIn(theirs, result("show", name)["elsewhere"])
            self.assertIsNone(result("show", theirs)["elsewhere"])

    def test_machines_without_end_say_so(self):
        shown = text("show", "GoByMajority")
        self.assertIn("soft_majo\n  also known as  GoByMajority\n", shown)
        self.assertIn("strategy-graph soft_majo --horizon 6", shown)
        self.assertIsNone(result("show", "soft_majo")["machine"])

    def test_opaque_players_are_shown_without_facts(self):
        self.assertIn("none: an opaque player", text("show", "exec:cat"))
        self.assertIsNone(result("show", "exec:cat")["memory"])


class Diff(unittest.TestCase):
    def test_equalities_are_proved(self):
        for first, second in EQUAL.items():
            self.assertRegex(text("diff", first, second),
                             r"^equivalent: proved over \d+ joint states \(own moves its own\)\n$")

    def test_the_two_senses(self):
        self.assertEqual(text("diff", "spiteful", "mem11_cCDDD", "--any-own-moves"),
                         "different: after their moves D C (own C C): spiteful plays D, mem11_cCDDD plays C\n")

    def test_json_of_a_difference(self):
        found = result("diff", "spiteful", "tf2t")
        self.assertEqual(found["result"], "different")
        self.assertEqual(found["sense"], "own_moves_its_own")
        self.assertEqual(found["play"], {"own": "C", "theirs": "D"})
        self.assertEqual(found["answers"], {"first": 0, "second": 1})
        self.assertEqual(found["depth"], 1)

    def test_those_of_a_spec_that_are_the_same(self):
        spec = "spiteful,tit_for_tat,mem11_cCDDD,mem01_cCD,bayes(classics)"
        found = json.loads(run("same", spec, "--format", "json").stdout)
        self.assertEqual(found["groups"], [["spiteful", "mem11_cCDDD"], ["tit_for_tat", "mem01_cCD"]])
        self.assertEqual(found["undecided"], [])
        self.assertEqual(found["players"], ["bayes(classics)"])
        found = json.loads(run("same", spec, "--any-own-moves", "--format", "json").stdout)
        self.assertEqual(found["groups"], [["tit_for_tat", "mem01_cCD"]])
        self.assertEqual(run("same", "all_c,mem01_cCC", "--format", "csv").stdout,
                         "group,result,strategy\n1,equivalent,all_c\n1,equivalent,mem01_cCC\n")
        self.assertIn("\nnone\n", run("same", "all_c").stdout)

    def test_in_equilibrium_with_a_copy(self):
        found = {one["name"]: one for one in json.loads(run("equilibria", "tit_for_tat,spiteful,all_c,all_d,soft_majo,random(0.5)",
                                                            "--format", "json").stdout)["entrants"]}
        # By hand: a D gains 2 once; tit_for_tat answers it by turns of D and C, spiteful by D for ever.
        self.assertEqual(found["tit_for_tat"]["thresholds_exact"]["nash"], [["2/3", "1"]])
        self.assertEqual(found["spiteful"]["thresholds_exact"]["subgame_perfect"], [["1/2", "1"]])
        self.assertEqual(found["all_c"]["thresholds_exact"]["nash"], [])
        self.assertEqual(found["all_d"]["thresholds_exact"]["subgame_perfect"], [["0", "1"]])
        for name in ("soft_majo", "random(0.5)"):
            self.assertIsNone(found[name]["thresholds_exact"])
        # The same as sce-check says.
        done = subprocess.run([Path(os.environ["FOLK_BIN"]) / "sce-check", "pavlov", "pavlov", "--criterion", "discounted:0.9",
                               "--format", "json"], capture_output=True, text=True, timeout=60)
        whole = json.loads(run("equilibria", "pavlov", "--format", "json").stdout)["entrants"][0]
        self.assertEqual(whole["thresholds_exact"], json.loads(done.stdout)["opponents"][0]["thresholds_exact"])

    def test_first_moves(self):
        self.assertEqual(text("diff", "tit_for_tat", "mistrust"),
                         "different: in the first round tit_for_tat plays C, mistrust plays D\n")

    def test_mixing_strategies(self):
        self.assertEqual(text("diff", "tit_for_tat", "gtft(0.1)"), "different: after their moves D (own C): "
                         "tit_for_tat plays D, gtft(0.1) plays C with probability 0.1\n")

    def test_machines_without_end(self):
        self.assertEqual(text("diff", "soft_majo", "go-by-majority"), "equivalent: both are soft_majo\n")
        found = result("diff", "soft_majo", "gradual")
        self.assertEqual(found["result"], "different")
        with tempfile.TemporaryDirectory() as folder:
            # A finite copy of a majority: right until their lead is 60.
            states = [f"s{i} {'C' if i >= 60 else 'D'} s{min(i + 1, 120)} s{max(i - 1, 0)}" for i in range(121)]
            path = Path(folder) / "copy"
            path.write_text("machine copy\n" + "\n".join(states) + "\nstart s60\n")
            self.assertRegex(text("diff", "soft_majo", f"@{path}", "--most-pairs", "50"),
                             r"^not refuted \(depth \d+\): no play of up to \d+ rounds separates soft_majo and copy")
            # One C more than the copy can count, then as many D as were C: the copy has lost one.
            found = result("diff", "soft_majo", f"@{path}")
            self.assertEqual(found["result"], "different")
            self.assertGreater(found["depth"], 60)


class Reply(unittest.TestCase):
    def test_the_best_reply_is_exact_and_can_be_played(self):
        found = result("reply", "pavlov", "--criterion", "discounted:0.9")
        self.assertEqual((found["exact"], found["residual"], found["horizon"]), ("59/19", 0, None))
        found = result("reply", "gradual", "--rounds", "100")
        self.assertEqual(found["payoff"], 304)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "reply"
            path.write_text(found["machine"])
            match = subprocess.run([PROGRAM.parent / "ipd-match", f"@{path}", "gradual", "--rounds", "100", "--format",
                                    "json"], capture_output=True, text=True, timeout=60)
            self.assertIn("304", match.stdout)
        self.assertTrue(text("reply", "tit_for_tat").startswith("best reply to tit_for_tat (T=5,R=3,P=1,S=0, finite:100"))

    def test_a_machine_without_end_is_bounded_by_a_horizon(self):
        found = result("reply", "soft_majo", "--criterion", "discounted:0.9", "--horizon", "50")
        self.assertEqual((found["horizon"], found["exact"] is None), (50, False))
        self.assertIn("at least", text("reply", "soft_majo", "--criterion", "discounted:0.9", "--horizon", "50"))

    @unittest.skipIf("FOLK_SANITIZED" in os.environ, "searches three times; the next test searches once")
    def test_a_memory_one_reply_comes_with_what_was_searched(self):
        arguments = ("reply", "tit_for_tat,pavlov,all_d", "--memory-one", "--criterion", "mean")
        found = result(*arguments)
        self.assertEqual(found["strategy"], "mem1(c;1,0,1,0)")
        self.assertAlmostEqual(found["payoff"], 7 / 3)
        self.assertEqual([o["name"] for o in found["opponents"]], ["tit_for_tat", "pavlov", "all_d"])
        certificate = found["certificate"]
        self.assertEqual(certificate["faces"], 162)
        self.assertGreater(certificate["points"], 1000)
        self.assertAlmostEqual(certificate["unrestricted"], found["payoff"])
        shown = text(*arguments)
        self.assertTrue(shown.startswith("best memory-one reply found to tit_for_tat,pavlov,all_d ("))
        self.assertEqual(shown, text(*arguments, "--threads", "3"))
        row = next(csv.DictReader(io.StringIO(text(*arguments, "--format", "csv"))))
        self.assertEqual((row["strategy"], float(row["payoff"])), (found["strategy"], found["payoff"]))

    def test_the_reply_found_earns_its_payoff_in_a_tournament(self):
        spec = "hard_tft,slow_tft,gtft(0.3),zd_extort(3)"
        found = result("reply", spec, "--memory-one", "--criterion", "discounted:0.9")
        done = subprocess.run([PROGRAM.parent / "ipd-tournament", "--strategies", spec, "--include", found["strategy"],
                               "--criterion", "discounted:0.9", "--format", "json"], capture_output=True, text=True,
                              timeout=60)
        scores = json.loads(done.stdout)["scores"][-1][:-1]
        self.assertAlmostEqual(sum(scores) / len(scores), found["payoff"], places=9)
        self.assertGreaterEqual(found["payoff"], found["certificate"]["best_deterministic_payoff"])
        self.assertLessEqual(found["payoff"], found["certificate"]["unrestricted"])


class Refusals(unittest.TestCase):
    def refused(self, code, pattern, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertRegex(done.stderr, pattern)

    def test_wrong_usage(self):
        self.refused(2, "list, show NAME, diff A B, same SPEC, equilibria SPEC, reply OPPONENTS or champion")
        self.refused(2, "'draw': expected list, show NAME, diff A B, same SPEC, equilibria SPEC, reply OPPONENTS or champion", "draw")
        self.refused(2, "same takes one SPEC", "same")
        self.refused(2, "equilibria takes one SPEC", "equilibria", "pavlov", "all_d")
        self.refused(2, "reply takes one SPEC", "reply")
        self.refused(2, "stands for 17 strategies", "reply", "classics")
        self.refused(2, "give a --horizon", "reply", "soft_majo", "--criterion", "discounted:0.9")
        self.refused(2, "infinitely many states", "reply", "soft_majo", "--criterion", "mean", "--memory-one")
        self.refused(2, "--horizon does not go", "reply", "pavlov", "--horizon", "9", "--memory-one")
        self.refused(2, "opaque player", "reply", "pavlov,exec:cat", "--memory-one")
        self.refused(2, "--noise", "reply", "pavlov", "--noise", "2")
        self.refused(2, "show takes one name", "show")
        self.refused(2, "diff takes two names", "diff", "pavlov")
        self.refused(2, "did you mean mistrust", "show", "mistrst")
        self.refused(2, "stands for 17 strategies", "show", "classics")
        self.refused(2, "opaque player", "diff", "pavlov", "exec:cat")
        self.refused(2, "--most-pairs 'x': expected a whole number", "diff", "pavlov", "tf2t", "--most-pairs", "x")

    def test_bad_files(self):
        self.refused(3, "no such file", "show", "@nowhere")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "broken"
            path.write_text("machine a\nc C c\n")
            self.refused(3, f"{path}:2: ", "show", f"@{path}")


if __name__ == "__main__":
    unittest.main()
