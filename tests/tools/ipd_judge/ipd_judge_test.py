"""ipd-judge as its user sees it: what agrees, what is likely, refusals, the page. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "ipd-judge"
MATCH = Path(os.environ["FOLK_BIN"]) / "ipd-match"
EXAMPLE = Path(__file__).resolve().parents[3] / "examples/language_model.csv"
STAG_HUNT = 'NFG 1 R "Stag hunt" { "Row" "Column" } { { "stag" "hare" } { "stag" "hare" } } "" 4 4 3 0 0 3 3 3\n'


def run(*arguments, **how):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **how)


def judged(text, *arguments):
    done = run("-", "--format", "json", *arguments, input=text)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def table(*matches, header="match,round,own,theirs"):
    """Matches as pairs of strings."""
    lines = [header]
    for number, (own, theirs) in enumerate(matches, start=1):
        lines += [f"{number},{t},{a},{b}" for t, (a, b) in enumerate(zip(own, theirs), start=1)]
    return "\n".join(lines) + "\n"


def played(*arguments):
    """The moves of ipd-match as a record."""
    done = subprocess.run([MATCH, *arguments, "--format", "json"], capture_output=True, text=True, timeout=60, check=True)
    return json.loads(done.stdout)["moves"]


class Results(unittest.TestCase):
    def test_who_agrees_and_who_is_likely(self):
        found = judged(table(("CCDC", "CDCC")), "--strategies", "tit_for_tat,mem11_cCDCD,spiteful,random(0.5)")
        first = found["candidates"][0]
        self.assertEqual(first["strategies"], ["tit_for_tat", "mem11_cCDCD"])
        self.assertEqual((first["rank"], first["consistent"], first["otherwise"]), (1, True, 0))
        self.assertEqual(found["consistent"], ["tit_for_tat", "mem11_cCDCD", "random(0.5)"])
        spiteful = next(one for one in found["candidates"] if one["strategies"] == ["spiteful"])
        self.assertEqual(spiteful["first_otherwise"], {"match": "1", "round": 4})
        self.assertAlmostEqual(sum(one["posterior"] for one in found["candidates"]), 1)
        self.assertAlmostEqual(sum(found["slip_posterior"]), 1)

    def test_the_one_who_played_is_found(self):
        matches = [played(name, "random(0.5)", "--rounds", "60", "--seed", "5") for name in ("gradual", "gradual")]
        for one in judged(table(*matches))["candidates"]:
            self.assertEqual(one["rank"] == 1, one["strategies"] == ["gradual"])

    def test_a_class_is_counted_whatever_its_size(self):
        found = judged(table(("C", "D")), "--strategies", "memory(3,3)", "--opponents", "all_d")
        self.assertEqual(found["candidates"][0]["members"], str(2**67))
        self.assertEqual(found["candidates"][0]["consistent_members"], str(2**66))
        self.assertIn("2^66 of 2^67 members agree", run("-", "--strategies", "memory(3,3)", input=table(("C", "D"))).stdout)

    def test_equals_share_a_rank(self):
        rows = list(csv.DictReader(io.StringIO(run("-", "--format", "csv", input=table(("CC", "CC"))).stdout)))
        self.assertEqual([row["rank"] for row in rows if row["otherwise"] == "0"], ["1"] * 11)

    def test_regret_is_against_who_agrees(self):
        match = judged(table(("CCCC", "CCCC")), "--strategies", "all_c,tit_for_tat")["matches"][0]
        self.assertEqual({one["strategies"][0]: one["regret"]["exact"] for one in match["consistent"]},
                         {"all_c": "8", "tit_for_tat": "2"})
        self.assertEqual(match["gains"]["class_of_beliefs"]["belief"], "tit_for_tat")
        self.assertEqual(match["gains"]["free_beliefs"],
                         {"gain": 2, "exact": "2", "round": 4, "move": "D"})

    def test_beliefs_are_scored(self):
        text = "match,round,own,theirs,belief\n1,1,C,C,0.75\n1,2,D,D,0.25\n1,3,D,C,\n"
        found = judged(text)
        self.assertEqual((found["beliefs"]["accuracy"], found["matches"][0]["beliefs_stated"]), (1, 2))
        self.assertEqual(found["stage_replies"], {"rounds": 2, "best": 1, "loss": 1.75, "largest_loss": 1.75})
        self.assertIsNone(judged(table(("C", "C")))["beliefs"])

    def test_the_words_of_a_game(self):
        with tempfile.NamedTemporaryFile("w", suffix=".nfg") as game:
            game.write(STAG_HUNT)
            game.flush()
            found = judged("match,round,own,theirs\na,1,stag,hare\n", "--game", game.name)
        self.assertEqual((found["game"], found["matches"][0]["own_total"]), ("Stag hunt", 0))

    def test_threads_change_nothing(self):
        one, two = (run(EXAMPLE, "--format", "json", "--threads", threads).stdout for threads in "12")
        self.assertEqual(one, two)

    def test_players_of_unknown_chances_are_left_out(self):
        done = run("-", "--strategies", 'tit_for_tat,exec:"cat"', input=table(("CC", "CC")))
        self.assertEqual(done.returncode, 0)
        self.assertIn("left out", done.stderr)
        done = run("-", "--strategies", 'exec:"cat"', input=table(("CC", "CC")))
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))

    def test_a_deterministic_program_is_asked(self):
        found = judged(table(("CCD", "CDC")), "--opponents", "classics", "--strategies",
                       f'exec("python3 {EXAMPLE.parent}/tit_for_tat.py";deterministic)')
        self.assertTrue(found["candidates"][0]["consistent"])


class Refusals(unittest.TestCase):
    def refused(self, code, text, *arguments, says=()):
        done = run("-", *arguments, input=text)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, done.stderr)

    def test_files(self):
        self.refused(3, "", says="no recorded play")
        self.refused(3, "match,round,own\n", says=("-:1", "no column 'theirs'"))
        self.refused(3, table(("CX", "CC")), says=("-:3", "own 'X'"))
        self.refused(3, "match,round,own,theirs\n1,1,C,C\n1,3,C,C\n", says=("-:3", "round 2 is missing"))
        self.refused(3, "match,round,own,theirs\n1,1,C,C\n1,1,C,C\n", says=("-:3", "twice"))
        self.refused(3, "match,round,own,theirs,belief\n1,1,C,C,2\n", says=("-:2", "belief"))
        self.refused(3, "\x00\x01\x02", says="-:1")
        self.assertEqual(run("/nowhere/play.csv").returncode, 3)
        self.assertEqual(run(EXAMPLE.parent).returncode, 3)

    def test_options(self):
        good = table(("C", "C"))
        for slips in ("", "0.5", "-0.1", "x", "0.1,0.1", "nan"):
            self.refused(2, good, "--slips", slips, says="--slips")
        self.refused(2, good, "--strategies", "tit_for_tut", says="tit_for_tat")
        self.refused(2, good, "--strategies", "memory(9,9)")
        self.refused(2, good, "--show", "0", says="--show")
        self.assertEqual(run().returncode, 2)


class Page(HTMLParser):
    def __init__(self, source):
        super().__init__()
        self.open, self.tags, self.words = [], set(), []
        self.feed(source)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


class Files(unittest.TestCase):
    def test_the_page_is_whole_and_harmless(self):
        with tempfile.TemporaryDirectory() as folder:
            text = 'match,round,own,theirs,belief\n"<script>alert(1)</script>",1,C,D,0.5\n'
            done = run("-", "--output", folder, "--strategies", "classics,1*memory(2,2)", input=text)
            self.assertEqual(done.returncode, 0, done.stderr)
            source = (Path(folder) / "report.html").read_text()
            report = json.loads((Path(folder) / "report.json").read_text())
        page = Page(source)
        self.assertEqual(page.open, [])
        self.assertFalse({"script", "link", "img"} & page.tags)
        self.assertIn("<script>alert(1)</script>", page.words)
        self.assertNotRegex(source, r"https?:|url\(|@import")
        for words in ("Who played", "Whom it met", "Beliefs", "Self-confirming play", "memory(2,2)"):
            self.assertIn(words, "".join(page.words))
        self.assertEqual(report["matches"][0]["match"], "<script>alert(1)</script>")


if __name__ == "__main__":
    unittest.main()
