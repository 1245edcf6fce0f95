"""ipd-tournament against complete classes that are not listed. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])


def run(*arguments, program="ipd-tournament"):
    return subprocess.run([BIN / program, *arguments], capture_output=True, text=True, timeout=120)


def output(*arguments, **how):
    done = run(*arguments, **how)
    assert done.returncode == 0 and done.stderr == "", done
    return done.stdout


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


class RankingOfAClass(unittest.TestCase):
    def test_the_same_as_a_listed_roster(self):
        for criterion in ("finite:1000", "discounted:0.9", "mean"):
            for extra in ((), ("--no-self-play",)):
                asked = ("--strategies", "memory(1,2)", "--criterion", criterion, "--format", "csv", *extra)
                listed = {row["strategy"]: row for row in rows(output(*asked))}
                whole = rows(output(*asked, "--by-behaviour"))
                self.assertEqual(sum(int(row["genotypes"]) for row in whole), 1024)
                for row in whole:
                    other = listed[row["strategy"]]
                    self.assertEqual(row["wins"], other["wins"], row)
                    for column in ("total", "mean", "cooperation_rate"):
                        self.assertAlmostEqual(float(row[column]), float(other[column]), 8, (row, other))

    @unittest.skipIf("FOLK_SANITIZED" in os.environ, "a minute here; smaller classes take the same way")
    def test_memory_2_2(self):
        with tempfile.TemporaryDirectory() as folder:
            text = output("--strategies", " Memory(2, 2) ", "--rounds", "1000", "--threads", "2", "--output", folder)
            self.assertIn("Round robin of all 262144 members of memory(2,2)", text)
            self.assertIn("... the first 100 of 262144", text)
            ranking = rows((Path(folder) / "ranking.csv").read_text())
            summary = json.loads((Path(folder) / "summary.json").read_text())
        self.assertEqual(len(ranking), 262144)
        first = {row["strategy"]: row for row in ranking[:4]}
        self.assertEqual(first["mem22_ddCDCDDDDDCDDCDDDC"]["total"], "854961408")
        self.assertEqual({row["rank"] for row in first.values()}, {"1"})
        self.assertEqual((summary["class"], summary["class_size"]), ("memory(2,2)", "262144"))
        self.assertIn("memory(2,2)", summary["command"].lower().replace(" ", ""))
        self.assertEqual(text, output("--strategies", "memory(2,2)", "--rounds", "1000", "--threads", "1"))

    def test_what_does_not_go_with_it(self):
        for extra in (("--include", "pavlov"), ("--exclude", "pavlov"), ("--invasion",), ("--repetitions", "3"),
                      ("--sub-rosters", "5"), ("--noise", "0.1"), ("--plot", "--output", "x")):
            done = run("--strategies", "memory(2,2)", *extra)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn(extra[0], done.stderr)
        done = run("--strategies", "memory(2,2)", "--rounds", "1e15")
        self.assertEqual(done.returncode, 2)
        self.assertIn("too much", done.stderr)
        for spec in ("memory(3,3)", "memory(2,2),pavlov"):
            done = run("--strategies", spec)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn("--class", done.stderr)
        done = run("--by-behaviour")
        self.assertEqual(done.returncode, 2)


class EntrantsAgainstAClass(unittest.TestCase):
    def scores(self, *arguments):
        found = json.loads(output("--class", *arguments, "--format", "json"))
        return found, {entry["name"]: entry for entry in found["entrants"]}

    def test_the_four_means(self):
        found, by_name = self.scores("memory(3,3)", "--entrants", "tit_for_tat,pavlov,spiteful,winner12", "--rounds",
                                     "1000")
        self.assertEqual(found["class_size"], "147573952589676412928")
        self.assertEqual([entry["name"] for entry in found["entrants"]],
                         ["spiteful", "winner12", "pavlov", "tit_for_tat"])
        for name, mean in (("tit_for_tat", "2.2745798168182373046875"), ("pavlov", "2.3538803768157958984375"),
                           ("spiteful", "2.9971875"), ("winner12", "2.7222284908294677734375")):
            self.assertEqual(by_name[name]["exact_mean"], mean)
        for entry in by_name.values():
            counts = sum(int(entry[key]) for key in ("members_beaten", "members_tied", "members_lost_to"))
            self.assertEqual(counts, 2**67)
            self.assertAlmostEqual(entry["beats"] + entry["ties"] + entry["loses"], 1)

    def test_the_same_as_a_tournament(self):
        listed = {row["strategy"]: row for row in rows(output("--strategies", "memory(1,1)", "--rounds", "200",
                                                              "--format", "csv"))}
        _, by_name = self.scores("memory(1,1)", "--entrants", "memory(1,1)", "--rounds", "200")
        for name, row in listed.items():
            self.assertAlmostEqual(by_name[name]["mean"], float(row["mean"]), 12)
            self.assertAlmostEqual(by_name[name]["cooperation_rate"], float(row["cooperation_rate"]), 12)
            self.assertEqual(by_name[name]["members_beaten"], row["wins"])

    def test_text_and_csv(self):
        text = output("--class", "memory(3,3)", "--entrants", "pavlov,all_d")
        self.assertIn("2 strategies against all 2^67 members of memory(3,3)", text)
        self.assertEqual(text, output("--class", "memory(3,3)", "--entrants", "pavlov,all_d", "--threads", "1"))
        table = rows(output("--class", "memory(2,2)", "--entrants", "pavlov,all_d", "--format", "csv"))
        self.assertEqual([row["strategy"] for row in table], ["all_d", "pavlov"])

    def test_too_many_kinds_leave_an_entrant_out(self):
        found, by_name = self.scores("memory(3,3)", "--entrants", "all_d,gradual,pavlov", "--most-kinds", "3000")
        self.assertEqual(set(by_name), {"all_d"})
        self.assertEqual([entry["name"] for entry in found["left_out"]], ["gradual", "pavlov"])
        text = output("--class", "memory(3,3)", "--entrants", "all_d,pavlov", "--most-kinds", "3000")
        self.assertIn("note: pavlov is left out: it tells more than 3000 kinds of opponents in memory(3,3) apart", text)
        done = run("--class", "memory(3,3)", "--entrants", "pavlov", "--most-kinds", "3000")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done)

    def test_what_cannot_meet_a_class(self):
        for arguments, word in ((("memory(3,3)", "--entrants", "gtft(1/3)"), "random"),
                                (("memory(3,3)", "--entrants", "soft_majo", "--criterion", "mean"), "--rounds"),
                                (("memory(9,9)",), "X + Y"), (("classics",), "memory(X,Y)"),
                                (("memory(3,3)", "--strategies", "classics"), "--entrants"),
                                (("memory(3,3)", "--noise", "0.01"), "--noise"),
                                (("memory(3,3)", "--invasion",), "--invasion"),
                                (("memory(3,3)", "--sub-rosters", "5"), "--sub-rosters")):
            done = run("--class", *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn(word, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        done = run("--entrants", "pavlov")
        self.assertEqual(done.returncode, 2)


class TheChampion(unittest.TestCase):
    def champion(self, *arguments):
        return json.loads(output("champion", *arguments, "--quiet", "--format", "json", program="ipd-strategies"))

    def test_is_proved_in_small_classes(self):
        found = self.champion("--class", "memory(1,2)", "--rounds", "1000")
        self.assertEqual((found["member"], found["proved"], found["equals"]), ("mem12_ddCCDDDDDC", True, 4))
        self.assertEqual(found["exact_mean"], "3.3169296875")

    def test_is_found_in_large_ones(self):
        asked = ("--class", "memory(2,3)", "--rounds", "50", "--evaluations", "300", "--most-kinds", "5000")
        found = self.champion(*asked)
        self.assertFalse(found["proved"])
        self.assertEqual(found["evaluations"] + found["passed_over"], 300)
        again = json.loads(output("--class", "memory(2,3)", "--entrants", found["member"], "--rounds", "50", "--format",
                                  "json"))
        self.assertEqual(again["entrants"][0]["exact_mean"], found["exact_mean"])
        self.assertEqual(found, self.champion(*asked, "--threads", "1"))

    def test_of_a_sample(self):
        asked = ("--class", "memory(2,3)", "--rounds", "100", "--sample", "40", "--seed", "2")
        found = self.champion(*asked)
        self.assertEqual((found["sample"], found["class_size"]), (40, str(2**35)))
        winner = found["winners"][0]
        self.assertLessEqual(winner["population"], found["individuals"])
        against = json.loads(output("--class", "memory(2,3)", "--entrants", winner["member"], "--rounds", "100",
                                    "--format", "json"))
        self.assertEqual(against["entrants"][0]["exact_mean"], winner["exact_mean"])
        table = rows(output("champion", *asked, "--most-kinds", "1", "--quiet", "--format", "csv",
                            program="ipd-strategies"))
        self.assertEqual((table[0]["member"], table[0]["mean"]), (winner["member"], ""))
        text = output("champion", *asked, "--most-kinds", "1", "--quiet", program="ipd-strategies")
        self.assertTrue(text.startswith(winner["member"] + "\nnot scored against memory(2,3): it tells more than 1 "))

    def test_wrong_usage(self):
        for arguments in (("champion",), ("champion", "--class", "classics"), ("champion", "x", "--class", "memory(1,1)"),
                          ("champion", "--class", "memory(1,1)", "--evaluations", "0"),
                          ("champion", "--class", "memory(1,1)", "--sample", "33"),
                          ("champion", "--class", "memory(1,1)", "--sample", "3", "--evaluations", "5"),
                          ("champion", "--class", "memory(1,1)", "--generations", "5")):
            done = run(*arguments, program="ipd-strategies")
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)


if __name__ == "__main__":
    unittest.main()
