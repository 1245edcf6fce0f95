"""sce-check as its users type it."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["FOLK_BIN"])


def run(*arguments):
    return subprocess.run([BIN / "sce-check", *arguments], capture_output=True, text=True, check=False)


def check(*arguments):
    done = run(*arguments, "--format", "json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def itself(name, *arguments):
    """The one report of a strategy against itself."""
    return check(name, name, *arguments)["opponents"][0]


class KnownEquilibria(unittest.TestCase):
    """At T,R,P,S = 5,3,1,0, each against itself: what a student can work out by hand (docs/equilibrium.md)."""

    def thresholds(self, name, *arguments):
        return itself(name, "--criterion", "discounted:0.6", *arguments)["thresholds_exact"]

    def test_spiteful_is_subgame_perfect_from_one_half(self):
        self.assertEqual(self.thresholds("spiteful")["subgame_perfect"], [["1/2", "1"]])

    def test_tit_for_tat_is_nash_from_two_thirds_and_never_perfect(self):
        sets = self.thresholds("tit_for_tat")
        self.assertEqual(sets["nash"], [["2/3", "1"]])
        self.assertEqual(sets["subgame_perfect"], [])

    def test_pavlov_is_never_nash_but_its_path_is_self_confirming(self):
        sets = self.thresholds("pavlov")
        self.assertEqual(sets["nash"], [])
        self.assertEqual(sets["self_confirming_unrestricted"], [["1/2", "1"]])
        verdict = itself("pavlov", "--criterion", "discounted:0.6", "--class", "classics")["verdicts"]
        self.assertEqual(verdict["self_confirming_class"]["word"], "certified")
        self.assertEqual(verdict["self_confirming_class"]["witness"], "spiteful")
        self.assertEqual(verdict["nash"]["word"], "refuted")

    def test_all_d_is_everything(self):
        sets = self.thresholds("all_d")
        for notion in ("nash", "subgame_perfect", "self_confirming_unrestricted"):
            self.assertEqual(sets[notion], [["0", "1"]])

    def test_grudger_is_nash_from_one_half_and_never_perfect(self):
        sets = self.thresholds("grudger")
        self.assertEqual(sets["nash"], [["1/2", "1"]])
        self.assertEqual(sets["subgame_perfect"], [])

    def test_pavlov_is_perfect_where_temptation_is_small(self):
        sets = self.thresholds("pavlov", "--payoffs", "T=4,R=3,P=1,S=0")
        self.assertEqual(sets["subgame_perfect"], [["1/2", "1"]])

    def test_cooperation_that_ends_is_not_self_confirming(self):
        report = itself("tit_for_tat", "--criterion", "finite:100")
        self.assertEqual(report["gaps"]["own"]["self_confirming_unrestricted"], 2)
        self.assertEqual(report["rounds"], 100)
        self.assertEqual(itself("all_d")["gaps"]["own"]["self_confirming_unrestricted"], 0)

    def test_pavlov_is_nash_under_the_mean(self):
        self.assertEqual(itself("pavlov", "--criterion", "mean")["gaps"]["own"]["nash"], 0)


class Report(unittest.TestCase):
    def test_side_own_asks_for_the_policy_alone(self):
        both = check("all_d", "all_c")["opponents"][0]["verdicts"]["nash"]
        own = check("all_d", "all_c", "--side", "own")["opponents"][0]["verdicts"]["nash"]
        self.assertEqual((both["word"], both["side"]), ("refuted", "theirs"))
        self.assertEqual(own["word"], "certified")

    def test_require_decides_the_exit_code(self):
        nash = ("--criterion", "discounted:0.7", "--require", "nash")
        self.assertEqual(run("tit_for_tat", "tit_for_tat", *nash).returncode, 0)
        failed = run("pavlov", "pavlov", *nash)
        self.assertEqual(failed.returncode, 1)
        self.assertIn("nash does not hold", failed.stderr)
        self.assertIn("refuted", failed.stdout)

    def test_mixing_machines_list_their_situations(self):
        report = check("random(0.5)", "tit_for_tat", "--criterion", "discounted:0.9")["opponents"][0]
        self.assertIsNone(report["path"])
        self.assertEqual(len(report["information_states"]), 2)
        self.assertIsNone(report["thresholds"])
        self.assertGreater(report["gaps"]["own"]["nash"], 0)

    def test_equal_samples_refute_nothing(self):
        # A program that always defects is a best reply; samples without variance must not say otherwise.
        always = "while read a b; do case $a in move) echo D;; end) exit;; esac; done"
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "always.sh"
            script.write_text(always)
            done = run(f'exec:"sh {script}"', "random(0.001)", "--rounds", "20", "--repetitions", "40", "--require", "nash")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("not refuted", done.stdout)

    def test_the_reply_that_gains_is_a_machine(self):
        verdict = itself("pavlov", "--criterion", "discounted:0.6")["verdicts"]["nash"]
        self.assertTrue(verdict["witness_machine"].startswith("machine best_reply"))

    def test_gains_of_fractions_are_compared_exactly(self):
        # pavlov gains exactly 1/2 by the best reply at d = 0.6.
        for epsilon, word in (("1/2", "certified"), ("0.4999999999999999999", "refuted")):
            verdict = itself("pavlov", "--criterion", "discounted:0.6", "--epsilon-payoff", epsilon)["verdicts"]["nash"]
            self.assertEqual(verdict["word"], word)

    def test_csv_has_a_row_for_each_opponent(self):
        done = run("tit_for_tat", "--opponents", "classics", "--format", "csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = done.stdout.splitlines()
        self.assertEqual(len(rows), 18)
        self.assertTrue(all(row.count(",") == rows[0].count(",") for row in rows))

    def test_labels_and_fractions(self):
        found = check("mine=pavlov", "theirs=Tit For Tat", "--criterion", "discounted:3/5", "--epsilon-payoff", "1/3",
                      "--epsilon-belief", "1/20")
        self.assertEqual((found["policy"], found["opponents"][0]["opponent"]), ("mine", "theirs"))

    def test_policy_without_metadata_of_its_own_meets_the_classics(self):
        report = check("tit_for_tat", "--criterion", "finite:10")
        self.assertEqual(len(report["opponents"]), 17)


class Noise(unittest.TestCase):
    """--noise P: every history is on the path, so that Nash, perfect and self-confirming are one."""

    SMALL = ("--payoffs", "T=4,R=3,P=1,S=0", "--criterion", "discounted:0.9", "--noise", "0.01")

    def test_pavlov_is_an_equilibrium_and_tit_for_tat_is_none(self):
        report = check("pavlov", "pavlov", *self.SMALL, "--class", "classics")
        self.assertEqual(report["noise"], 0.01)
        verdicts = report["overall"]["verdicts"]
        for notion in ("nash", "subgame_perfect", "self_confirming_unrestricted", "self_confirming_class"):
            self.assertEqual(verdicts[notion]["word"], "certified", notion)
        self.assertEqual(verdicts["self_confirming_class"]["witness"], "pavlov")
        one = report["opponents"][0]
        self.assertEqual((one["path"], one["thresholds"], one["figures"]), (None, None, "markov"))
        gaps = itself("tit_for_tat", *self.SMALL)["gaps"]["own"]
        self.assertGreater(gaps["nash"], 0.01)
        self.assertGreater(gaps["subgame_perfect"], 0.01)
        self.assertEqual(gaps["self_confirming_unrestricted"], gaps["nash"])

    def test_head_of_text_and_page(self):
        self.assertIn("discounted:0.9, noise 0.01, class pavlov", run("pavlov", "pavlov", *self.SMALL).stdout)
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run("pavlov", "pavlov", *self.SMALL, "--output", folder).returncode, 0)
            page = pathlib.Path(folder, "report.html").read_text(encoding="utf-8")
            self.assertIn("<dt>noise</dt><dd>each move flips with probability 0.01</dd>", page)
            self.assertEqual(json.loads(pathlib.Path(folder, "report.json").read_text())["noise"], 0.01)

    def test_noise_0_changes_nothing(self):
        for words in (("random(0.5)", "pavlov", "--criterion", "mean"), ("tit_for_tat", "pavlov", "--rounds", "20")):
            for form in ("text", "csv", "json"):
                plain = run(*words, "--format", form)
                self.assertEqual(run(*words, "--noise", "0", "--format", form).stdout, plain.stdout)

    def test_every_criterion_and_the_default_opponents(self):
        for criterion in ("finite:20", "mean", "ending:0.1"):
            report = check("tit_for_tat", "--noise", "0.1", "--criterion", criterion)
            for one in report["opponents"]:
                self.assertIsNotNone(one["gaps"]["own"]["nash"], one["opponent"])

    def test_refusals(self):
        player = 'exec("false")'
        for words, part in ((("bayes(classics)", "all_d"), "bayes(classics) is played, not enumerated"),
                            (("all_d", "bayes(classics)"), "bayes(classics) is played, not enumerated"),
                            (("all_d", player), "is played, not enumerated: claims about it need noise 0"),
                            (("all_d", "all_d", "--noise", "1"), "noise 1"),
                            (("all_d", "all_d", "--noise", "1.5"), "--noise '1.5'"),
                            (("all_d", "gradual", "--criterion", "mean"), "a pair that slips")):
            noise = () if "--noise" in words else ("--noise", "0.1")
            with tempfile.TemporaryDirectory() as folder:
                output = pathlib.Path(folder, "report")
                done = run(*words, *noise, "--output", output)
                self.assertEqual(done.returncode, 2, words)
                self.assertIn(part, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
                if part != "a pair that slips":
                    self.assertFalse(output.exists())


class FromARoundOn(unittest.TestCase):
    SPITE = ("spiteful", "all_d", "--criterion", "discounted:0.9", "--class", "tit_for_tat,spiteful")

    def test_from_a_round(self):
        report = check(*self.SPITE, "--from", "2")
        self.assertEqual(report["from"], 2)
        one = report["opponents"][0]
        self.assertEqual(one["before"], {"own": "C", "theirs": "D"})
        self.assertEqual(one["path"], {"own": "D", "theirs": "D", "cycle_from": 2, "cut": False})
        self.assertEqual(one["verdicts"]["nash"]["word"], "certified")
        self.assertEqual(run(*self.SPITE, "--require", "nash").returncode, 1)
        text = run(*self.SPITE, "--require", "nash", "--from", "2")
        self.assertEqual(text.returncode, 0)
        self.assertIn("discounted:0.9, from round 2 on, class", text.stdout)
        self.assertIn("path      DD, again and again from round 2", text.stdout)
        late = check("tit_for_tat", "tit_for_tat", "--rounds", "9", "--from", "8")["opponents"][0]
        self.assertIn("in round 9, after (CC)x8, plays D", late["verdicts"]["nash"]["witness"])

    def test_settled(self):
        with tempfile.TemporaryDirectory() as folder:
            report = check(*self.SPITE, "--from", "settled", "--output", folder)
            page = pathlib.Path(folder, "report.html").read_text(encoding="utf-8")
        self.assertEqual(report["from"], "settled")
        settled = report["opponents"][0]["settled"]
        self.assertEqual(settled["nash"], {"from": 2, "word": "certified"})
        self.assertIsNone(settled["beliefs"])
        self.assertEqual(report["overall"]["settled"], settled)
        self.assertIn("From which round on it holds for good", page)
        self.assertEqual(report["opponents"][0]["verdicts"]["nash"]["word"], "refuted")  # of the whole match
        self.assertEqual(run(*self.SPITE, "--from", "settled", "--require", "nash").returncode, 0)
        never = run("pavlov", "--opponents", "pavlov,all_d", "--rounds", "9", "--from", "settled", "--require", "nash")
        self.assertEqual(never.returncode, 1)
        self.assertRegex(never.stdout, r"\nall of them +never")
        rows = run(*self.SPITE, "--from", "settled", "--format", "csv").stdout.splitlines()
        self.assertTrue(rows[0].endswith("settled_self_confirming_own,settled_beliefs"))
        self.assertTrue(rows[1].endswith(",2,2,2,2,,"), rows[1])

    def test_refusals(self):
        for words, part in (((*self.SPITE, "--from", "0"), "--from"), ((*self.SPITE, "--from", "late"), "'late'"),
                            (("pavlov", "pavlov", "--from", "101"), "expected round 1 to 100"),
                            ((*self.SPITE, "--from", "2", "--noise", "0.1"), "random under noise"),
                            (("pavlov", "random(0.5)", "--from", "settled"), "random(0.5) may draw"),
                            (("bayes(classics)", "pavlov", "--from", "2", "--extract"), "contradict"),
                            (("pavlov", "pavlov", "--from", "settled", "--rounds", "5000"), "more rounds than")):
            done = run(*words)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), words)
            self.assertIn(part, done.stderr)


class Planners(unittest.TestCase):
    """Who plans is examined by what it claims: the best reply to its beliefs, as far ahead as it looks."""

    def own(self, policy, *options):
        report = check(policy, "--side", "own", *options)
        return report["depth"], [pair["gaps"]["own"]["self_confirming_own"] for pair in report["opponents"]]

    def test_at_its_own_depth(self):
        for policy, depth in (("bayes(sct2025;depth=4)", 4), ("bayes(2*classics,memory(1,1);depth=3;slip=0.01)", 3)):
            told, gaps = self.own(policy, "--opponents", "classics")
            self.assertEqual(told, depth)
            self.assertEqual(gaps, [0] * 17, policy)

    def test_further_than_it_looks(self):
        self.assertEqual(self.own("bayes(classics;depth=1)", "--opponents", "all_d"), (1, [0]))
        depth, gaps = self.own("bayes(classics;depth=1)", "--opponents", "all_d", "--depth", "6")
        self.assertEqual(depth, 6)
        self.assertGreater(gaps[0], 1)


@unittest.skipIf("FOLK_SANITIZED" in os.environ, "ten thousand thoughts of a transformer; sce_page_test has fewer")
class Transformer(unittest.TestCase):
    """The shipped policy on a few opponents; the whole reports are in docs/."""

    @classmethod
    def setUpClass(cls):
        cls.report = check("sct", "--opponents", "all_d,pavlov", "--depth", "3")

    def test_beliefs_and_their_effect(self):
        all_d, pavlov = self.report["opponents"]
        self.assertEqual(pavlov["belief"]["accuracy"], 1)
        self.assertEqual(pavlov["belief"]["wrong_rounds"], [])
        self.assertLess(all_d["belief"]["accuracy"], 1)
        self.assertEqual(all_d["belief_effect"]["rounds"], 100)
        self.assertEqual(len(pavlov["path"]["own"]), 100)

    def test_gaps(self):
        all_d, pavlov = self.report["opponents"]
        self.assertEqual(pavlov["gaps"]["own"]["nash"], 2)
        self.assertEqual(all_d["gaps"]["own"]["nash"], 100 - all_d["score"]["own"])
        for report in (all_d, pavlov):
            self.assertIsNone(report["gaps"]["own"]["subgame_perfect"])
            self.assertGreaterEqual(report["gaps"]["own"]["self_confirming_own"], 0)
            self.assertLessEqual(report["gaps"]["own"]["self_confirming_unrestricted"], report["gaps"]["own"]["nash"])
        self.assertIsNone(pavlov["thresholds"])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("sct", "tit_for_tat", "--depth", "1", "--extract", "--output", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            names = {path.name for path in pathlib.Path(folder).iterdir()}
            self.assertIn("report.html", names)
            self.assertIn("sct_extracted.machines", names)
            json.loads((pathlib.Path(folder) / "report.json").read_text())
            again = run(f"@{folder}/sct_extracted.machines", "tit_for_tat", "--criterion", "discounted:0.9")
            self.assertEqual(again.returncode, 0, again.stderr)


class Defaults(unittest.TestCase):
    def test_a_criterion_without_end_leaves_out_who_has_none(self):
        done = run("tit_for_tat", "--criterion", "discounted:0.9")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("tit_for_tat against the 14 of classics", done.stdout)
        self.assertIn("left out of the default opponents, machines without end: soft_majo, hard_majo, gradual\n", done.stdout)
        self.assertRegex(done.stdout, r"hard_tft +\[0\.8165 \(root of 3 d\^2 - 2\), 1\)")
        asked = run("tit_for_tat", "--criterion", "discounted:0.9", "--opponents", "gradual")
        self.assertEqual(asked.returncode, 2)

    def test_numbers_of_a_column_have_one_form(self):
        table = run("pavlov", "--criterion", "discounted:0.9").stdout.split("believed to be\n")[1].split("\n\n")[0]
        for column in (1, 3, 4, 5):
            numbers = [line.split()[column] for line in table.splitlines() if ">=" not in line]
            self.assertEqual(len({"." in number for number in numbers}), 1, numbers)

    def test_what_is_unknown_is_not_said_to_hold(self):
        done = run('exec:"while read -r a b c; do if [ $a = move ]; then echo C; fi; done"', "pavlov", "--rounds", "3", "--repetitions", "2")
        self.assertRegex(done.stdout, r"own beliefs +does not apply\n")
        self.assertNotIn("no deviation gains", done.stdout)


class BadInput(unittest.TestCase):
    def refused(self, code, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_a_name_with_a_slash_is_a_name(self):
        for policy in ("gtft(1/3)", "x=gtft(1/3)", "mem1(c;1/2,0,1,0)"):
            done = run(policy, "all_d", "--criterion", "mean")
            self.assertEqual(done.returncode, 0, done.stderr)
        done = run("gtft(1/0)", "all_d")
        self.assertEqual(done.returncode, 2)
        self.assertNotIn("no such file", done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            done = run(f"sct:{folder}/none.bin", "all_d")
            self.assertEqual((done.returncode, done.stderr), (3, f"sce-check: {folder}/none.bin: no such file; check the name\n"))

    def test_what_is_refused_leaves_no_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder, "a", "b")
            done = run("sct", "all_d", "--rounds", "3", "--extract", "--sample", "--depth", "1", "--output", output)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertFalse(output.parent.exists())

    def test_policy_file_by_its_path(self):
        done = run("sct:nowhere.bin")
        self.assertEqual(done.returncode, 3)
        with tempfile.TemporaryDirectory() as folder:
            broken = pathlib.Path(folder) / "broken.bin"
            broken.write_bytes(b"\x00" * 100)
            done = run(str(broken))
            self.assertEqual(done.returncode, 3)
            self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_one_line_each(self):
        self.assertIn("no policy named", self.refused(2))
        self.assertIn("--horizon", self.refused(2, "gradual", "pavlov", "--criterion", "discounted:0.9"))
        self.assertIn("gradual", self.refused(2, "gradual", "pavlov", "--criterion", "discounted:0.9"))
        self.assertIn("--extrapolate", self.refused(2, "sct", "all_d", "--rounds", "200"))
        self.assertIn("--extrapolate", self.refused(2, "sct", "all_d", "--payoffs", "T=4,R=3,P=1,S=0"))
        self.assertIn("finite:T", self.refused(2, "sct", "all_d", "--criterion", "mean"))
        self.assertIn("no machine", self.refused(2, "pavlov", "--class", "sct"))
        self.assertIn("empty", self.refused(2, "pavlov", "--class", ""))
        self.assertIn("discount factor", self.refused(2, "pavlov", "--criterion", "discounted:1.5"))
        self.assertIn("discount factor", self.refused(2, "pavlov", "--criterion", "discounted:nan"))
        self.assertIn("discount factor", self.refused(2, "pavlov", "--criterion", "discounted:3/2"))
        self.assertIn("--epsilon-belief", self.refused(2, "pavlov", "--epsilon-belief", "-1"))
        self.assertIn("--depth", self.refused(2, "pavlov", "--depth", "10"))
        self.assertIn("--epsilon-payoff", self.refused(2, "pavlov", "--epsilon-payoff", "-1"))
        self.assertIn("of the class", self.refused(2, "spiteful", "spiteful", "--rounds", "1000000", "--class", "soft_majo"))
        self.assertIn("--require", self.refused(2, "pavlov", "--require", "peace"))
        self.assertIn("contradict", self.refused(2, "pavlov", "pavlov", "--opponents", "classics"))
        self.assertIn("machine already", self.refused(2, "pavlov", "pavlov", "--extract"))
        self.assertIn("pavlov", self.refused(2, "pavlow"))


if __name__ == "__main__":
    unittest.main()
