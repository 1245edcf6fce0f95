"""ipd-tournament as its user sees it: published tables, the same bytes again, options, files. FOLK_BIN names the
folder of the programs."""

import csv
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

PROGRAM = Path(os.environ["FOLK_BIN"]) / "ipd-tournament"
TREE = Path(__file__).resolve().parents[3]
DATA = TREE / "tests" / "data"
TIT_FOR_TAT = f'exec:"python3 {TREE / "examples" / "tit_for_tat.py"}"'

STAG_HUNT = 'NFG 1 R "Stag hunt" { "Row" "Column" } { { "stag" "hare" } { "stag" "hare" } } "" 4 4 3 0 0 3 3 3\n'
MACHINES = "machine grim  # never forgives\nok C ok bad\nbad D bad bad\nmachine nice; c C c c\n"


def run(*arguments, **how):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, **how)


def output(*arguments, **how):
    done = run(*arguments, **how)
    assert done.returncode == 0, done
    assert done.stderr == "", done.stderr
    return done.stdout


def result(*arguments):
    return json.loads(output(*arguments, "--format", "json"))


def by_name(tournament):
    return {entry["name"]: entry for entry in tournament["ranking"]}


def table(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def matrix(path):
    """Names, cells and totals of a golden table."""
    header, *rows = table(path)
    return header[1:-1], [[int(cell) for cell in row[1:-1]] for row in rows], [int(row[-1]) for row in rows]


class NumbersAndNames(unittest.TestCase):
    def test_fractions_are_numbers(self):
        few = ("--strategies", "tit_for_tat,pavlov,all_d")
        for option, fraction, decimal in (("--noise", "1/8", "0.125"), ("--end-probability", "1/4", "0.25"),
                                          ("--criterion", "discounted:9/10", "discounted:0.9")):
            self.assertEqual(output(*few, option, fraction), output(*few, option, decimal))
        self.assertIn("noise 1/3,", output(*few, "--noise", "1/3"))
        self.assertIn("ending:1/3,", output(*few, "--end-probability", "1/3"))
        self.assertEqual(set(by_name(result("--strategies", "gtft(1/3),all_d"))), {"all_d", "gtft(1/3)"})

    def test_whole_numbers_may_have_an_exponent(self):
        few = ("--strategies", "tit_for_tat,pavlov,all_d")
        self.assertEqual(output(*few, "--rounds", "1e3"), output(*few, "--criterion", "finite:1000"))
        self.assertEqual(output(*few, "--seed", "2.5e3", "--repetitions", "1e2", "--threads", "1e0"),
                         output(*few, "--seed", "2500"))

    def test_blanks_in_names(self):
        self.assertEqual(set(by_name(result("--strategies", "Tit For Tat,Win-Stay Lose-Shift"))), {"tit_for_tat", "pavlov"})

    def test_rosters_and_families_that_overlap_merge(self):
        names = by_name(result("--strategies", "classics,periodic(2)", "--rounds", "10"))
        self.assertEqual(len(names), 17 + 6 - 1)  # per_cd
        merged = result("--strategies", "classics", "--include", "sct2025,periodic(2)", "--rounds", "10")
        self.assertEqual(len(by_name(merged)), 17 + 2 + 5)

    def test_labels_are_what_is_shown(self):
        found = by_name(result("--strategies", "hard=random(0.2),soft=random(0.8),pavlov"))
        self.assertEqual(set(found), {"hard", "soft", "pavlov"})
        self.assertNotEqual(output("--strategies", "a=all_c").splitlines()[-1],
                            output("--strategies", "all_c").splitlines()[-1])  # the signature
        self.assertEqual(set(by_name(result("--strategies", "hard=random(0.2),classics", "--exclude", "hard,all_c"))),
                         set(by_name(result())) - {"all_c"})
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "one").write_text("machine same; c C c c\n")
            (Path(folder) / "two").write_text("machine same; d D d d\nmachine other; c C c c\n")
            ranking = by_name(result("--strategies", f"x=@{folder}/one,y=@{folder}/two#same"))
            self.assertEqual(list(ranking), ["y", "x"])
            self.assertIn("'same' is given twice", run("--strategies", f"@{folder}/one,@{folder}/two").stderr)
            self.assertIn("not 2 (of a file: y=@FILE#NAME)", run("--strategies", f"y=@{folder}/two").stderr)

    def test_the_standard_input_is_a_file(self):
        self.assertEqual(set(by_name(json.loads(output("--strategies", "@-,pavlov", "--format", "json", input=MACHINES)))),
                         {"grim", "nice", "pavlov"})
        self.assertIn("Stag hunt", output("--game", "-", "--strategies", "all_c,all_d", input=STAG_HUNT))


class Published(unittest.TestCase):
    @staticmethod
    def in_tables(name):
        """The tables of the transformer paper call its variants of two strategies by the plain names."""
        return name.removesuffix("_sct")

    def agrees(self, tournament, scores_file):
        names, scores, totals = matrix(DATA / scores_file)
        self.assertEqual([self.in_tables(name) for name in tournament["strategies"]], names)
        self.assertEqual(tournament["scores"], scores)
        ranked = {self.in_tables(entry["name"]): entry["total"] for entry in tournament["ranking"]}
        self.assertEqual(ranked, dict(zip(names, totals)))

    def test_the_seventeen_classics(self):
        tournament = result("--strategies", "classics", "--rounds", "100")
        self.agrees(tournament, "classics17_100.csv")
        names, cooperations, _ = matrix(DATA / "classics17_100_coop.csv")
        self.assertEqual(tournament["strategies"], names)
        self.assertEqual(tournament["cooperations"], cooperations)

    def test_the_roster_of_the_transformer_paper(self):
        tournament = result("--strategies", "sct2025", "--rounds", "100")
        self.agrees(tournament, "sct2025_100.csv")
        with open(DATA / "sct_reconstructed_17.csv", newline="") as file:
            paper = {row["opponent"]: row for row in csv.DictReader(file)}
        self.assertEqual(len(paper), 17)
        for column, name in enumerate(tournament["strategies"]):
            row = paper[self.in_tables(name)]
            scores = [scores[column] for scores in tournament["scores"]]
            mean = sum(scores) / len(scores)
            self.assertEqual(f"{mean:.4f}", row["mean17_authors_code"], name)
            normalised = 100 * int(row["recovered_raw"]) / mean
            self.assertEqual(f"{normalised:.3f}", row["100*raw/mean"], name)
            # The paper's normalisation is the program's.
            for own, normal in zip(scores, (cells[column] for cells in tournament["normalised"])):
                self.assertAlmostEqual(normal, 100 * own / mean, places=9)

    def complete_family(self, family, size):
        golden = {}
        with open(DATA / f"{family.replace('(', '_').replace(',', '_').rstrip(')')}_1000.csv", newline="") as file:
            for row in csv.DictReader(file):
                golden[row["name"]] = (int(row["total"]), int(row["cooperations"]))
        self.assertEqual(len(golden), size)
        rows = list(csv.DictReader(io.StringIO(output("--strategies", family, "--rounds", "1000", "--format", "csv"))))
        self.assertEqual(len(rows), size)
        meets = 1000 * size
        for row in rows:
            total, cooperations = golden[row["strategy"]]
            self.assertEqual(int(row["total"]), total, row)
            self.assertEqual(round(float(row["cooperation_rate"]) * meets), cooperations, row)
        totals = [int(row["total"]) for row in rows]
        self.assertEqual(totals, sorted(totals, reverse=True))
        for row, total in zip(rows, totals):
            self.assertEqual(int(row["rank"]), totals.index(total) + 1)  # equal totals share a rank

    def test_complete_memory_1_1(self):
        self.complete_family("memory(1,1)", 32)

    def test_complete_memory_1_2(self):
        self.complete_family("memory(1,2)", 1024)


# Counts for ever and slips: a long run that can only be sampled.
SAMPLED = ("--strategies", "all_c,gradual_soft", "--criterion", "mean", "--noise", "0.01", "--repetitions", "10")


class SameBytes(unittest.TestCase):
    def same(self, *arguments):
        for form in ("text", "csv", "json"):
            first = output(*arguments, "--format", form, "--threads", "1")
            for threads in ("2", "1", "2", "5"):
                self.assertEqual(first, output(*arguments, "--format", form, "--threads", threads))

    def test_exact(self):
        self.same()
        self.same("--strategies", "memory(1,1)", "--criterion", "discounted:0.9", "--no-self-play")

    @unittest.skipIf("FOLK_SANITIZED" in os.environ, "half a minute here; the library has tests of threads")
    def test_markov(self):
        self.same("--strategies", "tit_for_tat,pavlov,gtft(0.3),random(0.5),all_d", "--noise", "0.01")
        self.same("--noise", "0.05")

    @unittest.skipIf("FOLK_SANITIZED" in os.environ, "half a minute here; the library has tests of threads")
    def test_sampled(self):
        self.same(*SAMPLED)
        self.same("--include", "gradual_soft", "--criterion", "discounted:0.9", "--noise", "0.01", "--repetitions", "5")

    def test_a_program(self):
        roster = "all_d,pavlov," + TIT_FOR_TAT
        self.same("--strategies", roster, "--rounds", "5", "--repetitions", "2", "--noise", "0.1")

    def test_the_seed_decides_what_is_sampled(self):
        one, again, other = (result(*SAMPLED, "--seed", seed) for seed in ("1", "1", "2"))
        self.assertEqual(one, again)
        self.assertNotEqual(one["scores"], other["scores"])
        self.assertNotEqual(one["signature"], other["signature"])


class Results(unittest.TestCase):
    def test_json_has_what_readers_expect(self):
        tournament = result("--strategies", "tit_for_tat,all_d,AllC", "--rounds", "10")
        self.assertEqual(tournament["strategies"], ["tit_for_tat", "all_d", "all_c"])
        self.assertEqual(tournament["rounds"], 10)
        self.assertEqual(tournament["criterion"], "finite:10")
        self.assertEqual(tournament["payoffs"], {"T": 5, "R": 3, "P": 1, "S": 0})
        self.assertEqual(tournament["noise"], 0)
        self.assertEqual(tournament["seed"], 1)
        self.assertEqual(tournament["methods"], {"cycle": 6})
        self.assertRegex(tournament["signature"], "^[0-9a-f]{16}$")
        self.assertEqual(tournament["scores"], [[30, 9, 30], [14, 10, 50], [30, 0, 30]])
        self.assertEqual(tournament["cooperations"], [[10, 1, 10], [0, 0, 0], [10, 10, 10]])
        first = tournament["ranking"][0]
        self.assertLessEqual({"rank", "name", "total", "mean", "cooperation_rate", "normalised"}, set(first))
        self.assertEqual((first["rank"], first["name"], first["total"], first["wins"]), (1, "all_d", 74, 2))
        self.assertAlmostEqual(first["mean"], 74 / 30)
        self.assertAlmostEqual(first["median"], 1.4)
        normalised = [100 * 14 / (74 / 3), 100 * 10 / (19 / 3), 100 * 50 / (110 / 3)]
        for cell, expected in zip(tournament["normalised"][1], normalised):
            self.assertAlmostEqual(cell, expected)
        self.assertAlmostEqual(first["normalised"], sum(normalised) / 3)

    def test_equal_totals_share_a_rank(self):
        ranking = result("--strategies", "all_c,tit_for_tat,tf2t,all_d", "--criterion", "mean")["ranking"]
        self.assertEqual(
            [(entry["rank"], entry["name"]) for entry in ranking],
            [(1, "tit_for_tat"), (1, "tf2t"), (3, "all_c"), (4, "all_d")],
        )

    def test_csv_is_the_ranking_alone(self):
        rows = list(csv.DictReader(io.StringIO(output("--format", "csv"))))
        ranking = result()["ranking"]
        self.assertEqual(len(rows), 17)
        for row, entry in zip(rows, ranking):
            self.assertEqual(row["strategy"], entry["name"])
            self.assertEqual(int(row["total"]), entry["total"])
            for key in ("rank", "mean", "median", "wins", "cooperation_rate", "normalised"):
                self.assertEqual(float(row[key]), entry[key])

    def test_text_states_every_default(self):
        text = output()
        self.assertIn("Round robin of 17 strategies: classics\n", text)
        self.assertIn("(T=5,R=3,P=1,S=0), finite:100, noise 0, self-play included, seed 1\n", text)
        self.assertIn(f"signature {result()['signature']}\n", text)
        self.assertEqual(text, output("--strategies", "classics", "--rounds", "100", "--noise", "0", "--seed", "1"))

    def test_each_figure_says_how_it_was_obtained(self):
        tournament = result("--strategies", "tit_for_tat,random(0.5)")
        self.assertEqual(tournament["methods"], {"cycle": 1, "markov": 2})
        self.assertEqual({entry["method"] for entry in tournament["ranking"]}, {"markov"})
        bounded = result("--strategies", "gradual,all_d,tit_for_tat", "--criterion", "mean")
        self.assertEqual(bounded["methods"]["bounded"], 1)
        sampled = result(*SAMPLED)
        self.assertEqual(sampled["methods"], {"markov": 1, "sampled": 2})
        for entry in sampled["ranking"]:
            self.assertEqual(entry["method"], "sampled")
            self.assertGreater(entry["confidence_95"], 0)

    def test_players_with_beliefs_are_judged(self):
        roster = ("--strategies", "all_c,all_d,per_cd", "--rounds", "30")
        tournament = result(*roster, "--include", "bayes(classics;slip=0.01)")
        self.assertEqual(tournament["methods"], {"cycle": 6, "played": 4})
        self.assertEqual(tournament["method_rows"][3], "pppp")
        self.assertEqual(tournament["belief_accuracy"][0], [None] * 4)
        believer = by_name(tournament)["bayes(classics;depth=5;slip=0.01)"]
        accuracies = tournament["belief_accuracy"][3]
        self.assertAlmostEqual(believer["belief_accuracy"], sum(accuracies) / 4)
        self.assertAlmostEqual(believer["belief_log_loss"], sum(tournament["belief_log_loss"][3]) / 4)
        self.assertEqual((believer["method"], believer["confidence_95"]), ("played", None))
        # What ipd-match shows of the same match.
        match = subprocess.run(
            [PROGRAM.with_name("ipd-match"), "bayes(classics;slip=0.01)", "per_cd", "--rounds", "30", "--format", "json"],
            capture_output=True, text=True, timeout=60, check=True,
        )
        self.assertEqual(json.loads(match.stdout)["belief_accuracy"][0], accuracies[2])
        self.assertEqual(json.loads(match.stdout)["scores"][0], tournament["scores"][3][2])
        # And the log loss that sce-check finds.
        check = subprocess.run(
            [PROGRAM.with_name("sce-check"), "bayes(classics;slip=0.01)", "--opponents", "per_cd", "--criterion", "finite:30",
             "--format", "json"], capture_output=True, text=True, timeout=60)
        self.assertAlmostEqual(json.loads(check.stdout)["opponents"][0]["belief"]["log_loss"],
                               tournament["belief_log_loss"][3][2])
        text = output(*roster, "--include", "bayes(classics;slip=0.01)")
        self.assertRegex(text, rf"{100 * believer['belief_accuracy']:.2f} %  +{believer['belief_log_loss']:.4f}  played\n")
        self.assertNotIn("belief", output(*roster))

    def test_guests_totals_against_the_roster(self):
        tournament = result("--include", "grudger,mem01_cCD")
        scores = tournament["scores"]
        for entry in tournament["ranking"]:
            i = tournament["strategies"].index(entry["name"])
            self.assertEqual(entry["total_against_roster"], sum(scores[i][j] for j in range(17) if j != i))
        guest = by_name(tournament)["mem01_cCD"]
        self.assertRegex(output("--include", "grudger,mem01_cCD"),
                         rf"mem01_cCD +{guest['total']} +{guest['total_against_roster']} ")
        self.assertNotIn("v roster", output())

    def test_one_repetition_claims_no_confidence(self):
        for entry in result(*SAMPLED[:-1], "1")["ranking"]:
            self.assertIsNone(entry["confidence_95"])

    def test_confidence_covers_the_exact_figure(self):
        # tit_for_tat as a program is sampled, as a table it is solved.
        exact = result("--strategies", "tit_for_tat,random(0.5)", "--rounds", "20")["scores"][0][1]
        sampled = result("--strategies", f"{TIT_FOR_TAT},random(0.5)", "--rounds", "20", "--no-self-play")
        entry = next(entry for entry in sampled["ranking"] if entry["name"] == TIT_FOR_TAT)
        self.assertGreater(entry["confidence_95"], 0)
        self.assertLess(abs(entry["total"] - exact), 2 * entry["confidence_95"])


class Options(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return str(path)

    def test_rounds_and_criterion(self):
        plain = output("--rounds", "7", "--format", "json")
        self.assertEqual(plain, output("--criterion", "finite:7", "--format", "json"))
        self.assertEqual(plain, output("--rounds", "7", "--criterion", "finite:7", "--format", "json"))
        ending = output("--end-probability", "0.25", "--format", "json")
        self.assertEqual(ending, output("--criterion", "ending:0.25", "--format", "json"))
        self.assertEqual(ending, output("--criterion", "ending:0.25", "--end-probability", "0.25", "--format", "json"))

    def test_options_that_contradict_are_refused(self):
        pairs = (
            ("--rounds", "10", "--criterion", "finite:20"),
            ("--rounds", "10", "--criterion", "mean"),
            ("--rounds", "10", "--end-probability", "0.1"),
            ("--criterion", "ending:0.2", "--end-probability", "0.1"),
        )
        for pair in pairs:
            done = run(*pair)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn("give one of them", done.stderr)

    def test_criteria_by_hand(self):
        # tit_for_tat against all_d: S in the first round, P ever after.
        cell = {name: result("--strategies", "tit_for_tat,all_d", "--criterion", name) for name in (
            "finite:10", "discounted:0.9", "mean", "ending:0.25")}
        self.assertEqual(cell["finite:10"]["scores"][0][1], 9)
        self.assertAlmostEqual(cell["discounted:0.9"]["scores"][0][1], 0.9)
        self.assertAlmostEqual(cell["discounted:0.9"]["scores"][1][0], 0.1 * 5 + 0.9)
        self.assertEqual(cell["mean"]["scores"], [[3, 1], [1, 1]])
        self.assertAlmostEqual(cell["ending:0.25"]["scores"][0][1], 3)  # four rounds are expected
        self.assertAlmostEqual(cell["ending:0.25"]["cooperations"][0][1], 1)
        self.assertAlmostEqual(cell["ending:0.25"]["ranking"][1]["mean"], (8 + 4) / 2 / 4)
        self.assertIsNone(cell["mean"]["rounds"])
        self.assertEqual(cell["mean"]["criterion"], "mean")

    def test_noise_by_hand(self):
        cells = result("--strategies", "all_c,all_d", "--rounds", "10", "--noise", "0.1")["scores"]
        self.assertAlmostEqual(cells[0][1], 10 * (0.09 * 3 + 0.81 * 0 + 0.01 * 5 + 0.09 * 1))

    def test_exclude(self):
        names = result()["strategies"]
        self.assertEqual(result("--exclude", "Gradual,per_cd")["strategies"],
                         [name for name in names if name not in ("gradual", "per_cd")])
        done = run("--exclude", "gtft(0.3)")
        self.assertEqual(done.returncode, 2)
        self.assertIn("not in the roster", done.stderr)

    def test_included_entrants_play_but_do_not_normalise(self):
        roster = result()
        more = result("--include", "gtft(0.3)")
        self.assertEqual(more["strategies"], roster["strategies"] + ["gtft(0.3)"])
        for before, after in zip(roster["normalised"], more["normalised"]):
            for cell, same in zip(before, after):
                self.assertAlmostEqual(cell, same, places=9)
        guest = more["scores"][-1]
        for j in range(17):
            mean = sum(row[j] for row in roster["scores"]) / 17
            self.assertAlmostEqual(more["normalised"][-1][j], 100 * guest[j] / mean, places=6)
        total = next(entry["total"] for entry in more["ranking"] if entry["name"] == "gtft(0.3)")
        self.assertAlmostEqual(total, sum(guest), places=6)

    def test_no_self_play(self):
        tournament = result("--strategies", "tit_for_tat,all_d,all_c", "--rounds", "10", "--no-self-play")
        self.assertEqual(tournament["scores"], [[None, 9, 30], [14, None, 50], [30, 0, None]])
        self.assertEqual(tournament["cooperations"], [[None, 1, 10], [0, None, 0], [10, 10, None]])
        self.assertFalse(tournament["self_play"])
        first = tournament["ranking"][0]
        self.assertEqual((first["name"], first["total"], first["mean"]), ("all_d", 64, 3.2))
        self.assertAlmostEqual(tournament["normalised"][0][1], 100 * 9 / (9 / 2))
        self.assertIsNone(tournament["normalised"][1][1])
        self.assertIn("self-play left out", output("--no-self-play"))

    def test_payoffs(self):
        tournament = result("--strategies", "all_c,all_d", "--rounds", "3", "--payoffs", "S=-1,P=0.1,R=1,T=1.5")
        self.assertEqual(tournament["scores"], [[3, -3], [4.5, 0.3]])
        self.assertEqual(tournament["payoffs"], {"T": 1.5, "R": 1, "P": 0.1, "S": -1})
        # -3 and 0.3 have a negative mean: nothing is normalised by it.
        self.assertEqual([row[1] for row in tournament["normalised"]], [None, None])
        self.assertIsNone(tournament["ranking"][0]["normalised"])

    def test_taking_turns_is_noted_once(self):
        done = run("--payoffs", "T=9,R=3,P=1,S=0")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("note:", done.stderr)
        self.assertEqual(run("--payoffs", "T=9,R=3,P=1,S=0", "--quiet").stderr, "")

    def test_another_game(self):
        game = self.file("stag_hunt.nfg", STAG_HUNT)
        tournament = result("--strategies", "all_c,all_d", "--rounds", "2", "--game", game)
        self.assertEqual(tournament["game"], "Stag hunt")
        self.assertEqual(tournament["scores"], [[8, 0], [6, 6]])
        untitled = self.file("untitled.nfg", STAG_HUNT.replace("Stag hunt", ""))
        self.assertIn("game without a title (T=3,R=4,P=3,S=0)", output("--game", untitled))
        done = run("--game", game, "--payoffs", "T=5,R=3,P=1,S=0")
        self.assertEqual(done.returncode, 2)

    def test_machines_of_a_file(self):
        path = self.file("my.machines", MACHINES)
        tournament = result("--strategies", f"all_d,@{path}", "--rounds", "10")
        self.assertEqual(tournament["strategies"], ["all_d", "grim", "nice"])
        self.assertEqual(tournament["scores"], [[10, 14, 50], [9, 30, 30], [0, 30, 30]])
        one = result("--include", f"@{path}#grim")
        spiteful = one["strategies"].index("spiteful")
        self.assertEqual(one["scores"][-1], one["scores"][spiteful])

    def test_a_program_scores_as_its_table_does(self):
        tournament = result("--include", TIT_FOR_TAT, "--rounds", "20", "--repetitions", "2")
        known = tournament["strategies"].index("tit_for_tat")
        self.assertEqual(tournament["strategies"][-1], TIT_FOR_TAT)
        self.assertEqual(tournament["scores"][-1], tournament["scores"][known])
        self.assertEqual(tournament["cooperations"][-1], tournament["cooperations"][known])
        self.assertEqual([row[-1] for row in tournament["scores"]], [row[known] for row in tournament["scores"]])
        by_name = {entry["name"]: entry for entry in tournament["ranking"]}
        self.assertEqual(by_name[TIT_FOR_TAT]["confidence_95"], 0)
        self.assertEqual(by_name[TIT_FOR_TAT]["rank"], by_name["tit_for_tat"]["rank"])

    def test_many_rounds_cost_what_few_do(self):
        few = result("--exclude", "gradual", "--criterion", "mean")
        many = result("--exclude", "gradual", "--rounds", "1000000000000")
        for row, sums in zip(few["scores"], many["scores"]):
            for mean, total in zip(row, sums):
                self.assertIsInstance(total, int)
                self.assertAlmostEqual(total / 10**12, mean, places=9)
        total = {entry["name"]: entry["total"] for entry in many["ranking"]}
        self.assertEqual(total["all_d"], sum(many["scores"][many["strategies"].index("all_d")]))
        done = run("--rounds", "1000000000000")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done)
        self.assertRegex(done.stderr, "all_d against gradual: .*leave one of them out")

    def test_help_and_version(self):
        text = output("--help")
        for option in ("--strategies", "--include", "--exclude", "--rounds", "--criterion", "--noise",
                       "--end-probability", "--repetitions", "--payoffs", "--game", "--no-self-play", "--seed",
                       "--threads", "--output", "--plot", "--format", "--quiet"):
            self.assertIn(option, text)
        self.assertTrue(all(len(line) <= 120 for line in text.splitlines()))
        self.assertTrue(output("--version").startswith("ipd-tournament (Folk "))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name) / "deep" / "results"

    def test_four_files(self):
        text = output("--output", str(self.folder))
        self.assertEqual(text, output())
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["cooperation.csv", "pairs.csv", "ranking.csv", "scores.csv", "summary.json"])
        for name, golden in (("scores.csv", "classics17_100.csv"), ("cooperation.csv", "classics17_100_coop.csv")):
            self.assertEqual(table(self.folder / name), [row[:-1] for row in table(DATA / golden)])  # but their totals
        self.assertEqual((self.folder / "ranking.csv").read_text(), output("--format", "csv"))
        summary = json.loads((self.folder / "summary.json").read_text())
        full = result()
        self.assertIsNone(full["belief_accuracy"])
        for streamed in ("scores", "cooperations", "normalised", "method_rows", "belief_accuracy", "belief_log_loss"):
            del full[streamed]
        self.assertRegex(summary.pop("folk_version"), r"^\d+\.\d+\.\d+$")
        self.assertEqual(shlex.split(summary.pop("command")), ["ipd-tournament", "--output", str(self.folder)])
        self.assertEqual(summary, full)

    def test_beliefs_have_a_file_of_their_own(self):
        arguments = ("--strategies", "all_d,per_cd", "--include", "bayes(classics)", "--rounds", "40")
        output(*arguments, "--output", str(self.folder))
        full = result(*arguments)
        for name, figure in (("beliefs.csv", "belief_accuracy"), ("belief_log_loss.csv", "belief_log_loss")):
            header, *rows = table(self.folder / name)
            self.assertEqual(header[1:], full["strategies"] + ["all"])
            self.assertEqual([row[0] for row in rows], ["bayes(classics)"])
            # A move that was held impossible costs without end, and JSON has a word for that.
            self.assertEqual([float(cell) for cell in rows[0][1:-1]], [float(cell) for cell in full[figure][2]])
            self.assertEqual(float(rows[0][-1]), float(by_name(full)["bayes(classics)"][figure]))
            self.assertEqual("infinity" in full[figure][2], figure == "belief_log_loss")

    def test_what_was_not_played_is_empty(self):
        output("--strategies", "all_c,all_d", "--no-self-play", "--rounds", "2", "--output", str(self.folder))
        self.assertEqual(table(self.folder / "scores.csv")[1:], [["all_c", "", "0"], ["all_d", "10", ""]])
        self.assertEqual(table(self.folder / "pairs.csv")[1:],
                         [["all_c", "all_d", "0", "10", "0", "1", "0", "0", "b", "cycle", "0", "0"]])

    def test_pairs(self):
        """Each pair once, its shares adding up to what both score and how often they cooperate."""
        payoffs = {"CC": (3, 3), "CD": (0, 5), "DC": (5, 0), "DD": (1, 1)}
        for options in (("--rounds", "37"), ("--noise", "0.1", "--criterion", "discounted:0.9"), ("--criterion", "mean")):
            with self.subTest(options=options):
                output("--strategies", "tit_for_tat,pavlov,all_d,random(0.3)", *options, "--output", str(self.folder))
                scores, cooperation, pairs = (table(self.folder / f"{name}.csv") for name in ("scores", "cooperation", "pairs"))
                names = scores[0][1:]
                rows = [dict(zip(pairs[0], row)) for row in pairs[1:]]
                self.assertEqual([(row["a"], row["b"]) for row in rows],
                                 [(a, b) for i, a in enumerate(names) for b in names[i:]])
                weight = 37 if "--rounds" in options else 1
                for row in rows:
                    i, j = names.index(row["a"]) + 1, names.index(row["b"]) + 1
                    share = {outcome: float(row[outcome]) for outcome in payoffs}
                    self.assertAlmostEqual(sum(share.values()), 1, places=12)
                    for seat, (score, cell, move) in enumerate((("score_a", scores[i][j], "CD"), ("score_b", scores[j][i], "DC"))):
                        self.assertEqual(row[score], cell)
                        self.assertAlmostEqual(sum(share[o] * payoffs[o][seat] for o in payoffs) * weight, float(cell), places=9)
                        self.assertAlmostEqual((share["CC"] + share[move]) * weight,
                                               float(cooperation[i][j] if seat == 0 else cooperation[j][i]), places=9)

    def test_names_with_commas_are_quoted(self):
        names = ["zd_extort(3)", "mem1(c;0.9,0.1,0.8,0.3)"]
        output("--strategies", ",".join(names), "--output", str(self.folder))
        header, *rows = table(self.folder / "scores.csv")
        self.assertEqual(header[1:], names)
        self.assertEqual([row[0] for row in rows], names)

    def test_an_older_result_is_replaced(self):
        output("--rounds", "5", "--output", str(self.folder))
        output("--rounds", "6", "--output", str(self.folder))
        self.assertEqual(json.loads((self.folder / "summary.json").read_text())["rounds"], 6)
        self.assertEqual(len(list(self.folder.iterdir())), 5)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_pictures(self):
        for plot, extension, magic in (("--plot", "svg", b"<?xml"), ("--plot=png", "png", b"\x89PNG"),
                                       ("--plot=pdf", "pdf", b"%PDF")):
            output("--output", str(self.folder), plot)
            for name in ("payoffs", "cooperation", "scores"):
                picture = (self.folder / f"{name}.{extension}").read_bytes()
                self.assertTrue(picture.startswith(magic))
        self.assertEqual(len(list(self.folder.iterdir())), 5 + 9)

    @unittest.skipUnless(shutil.which("gnuplot") and shutil.which("dot"), "gnuplot or Graphviz is not installed")
    def test_every_picture_says_what_was_played(self):
        """Also the graph and the matrix of invasions, and by its own title."""
        version = run("--version").stdout.split("(")[1].split(")")[0]
        titles = {"payoffs": "Payoff a round", "cooperation": "Cooperation rate", "scores": "Payoff a round over", "invasion": "Who can"}
        for roster in ("all_c,all_d,pavlov", "classics"):
            output("--strategies", roster, "--noise", "0.01", "--criterion", "discounted:0.9", "--payoffs", "T=4,R=3,P=1,S=0",
                   "--repetitions", "2", "--invasion", "--output", str(self.folder), "--plot")
            for name, title in titles.items():
                root = ElementTree.parse(self.folder / f"{name}.svg").getroot()
                said = "\n".join(text.strip() for text in root.itertext() if text.strip())  # a small picture's caption has two lines
                self.assertRegex(said, rf"prisoner's dilemma \(T=4,R=3,P=1,S=0\)( · |\n)discounted:0.9 · noise 0.01 · {version}")
                self.assertIn(title, said)
                self.assertNotIn("Gnuplot", said)
        output("--strategies", "all_c,all_d", "--output", str(self.folder), "--plot")
        said = (self.folder / "payoffs.svg").read_text()
        self.assertIn("<title>Payoff a round, row against column</title>", said)
        self.assertIn(f"finite:100 · {version}", said)
        self.assertNotIn("noise", said)

    @unittest.skipUnless(shutil.which("gnuplot") and shutil.which("dot"), "gnuplot or Graphviz is not installed")
    def test_many_are_drawn_as_a_matrix_of_invasions(self):
        for count, drawn in ((16, "its colour only tells it"), (17, "mutant")):
            roster = ",".join(f"per_{'c' * i}d" for i in range(1, count + 1))
            output("--strategies", roster, "--invasion", "--rounds", "7", "--output", str(self.folder), "--plot")
            self.assertIn(drawn, (self.folder / "invasion.svg").read_text())

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_a_scale_is_kept(self):
        few = ("--strategies", "all_c,all_d", "--output", str(self.folder), "--plot")
        output(*few, "--scale", "-1/2,7.5")
        picture = (self.folder / "payoffs.svg").read_text()
        self.assertTrue("<text>7</text>" in picture and "beyond" not in picture)
        output(*few, "--scale", " 0 , 4")
        self.assertIn("beyond the scale: the colour of its end", (self.folder / "payoffs.svg").read_text())

    def test_what_is_no_scale(self):
        for scale in ("1", "1,2,3", "2,1", "1,1", "a,b", "nan,1", "0,inf", ",", "1,", "1e999,2", "0,1e16", "1,1.0000000001", "1 2,50", ""):
            done = run("--plot", "--output", str(self.folder / "none"), "--scale", scale)
            self.assertEqual((done.returncode, done.stdout), (2, ""), scale)
            self.assertEqual(done.stderr, f"ipd-tournament: --scale '{scale}': expected MIN,MAX, two finite numbers, the second the "
                             "greater, as in 0,5\n")
        done = run("--strategies", "all_c", "--scale", "0,5")
        self.assertEqual(done.stderr, "ipd-tournament: --scale is about the heat map of payoffs: draw it with --plot --output DIR\n")
        self.assertEqual(done.returncode, 2)
        self.assertFalse((self.folder / "none").exists())

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_a_picture_of_two_without_self_play(self):
        output("--strategies", "all_c,all_d", "--no-self-play", "--output", str(self.folder), "--plot")
        self.assertIn("all_c", (self.folder / "payoffs.svg").read_text())


class Invasion(unittest.TestCase):
    ROSTER = ("--strategies", "all_c,all_d,tit_for_tat", "--rounds", "10", "--invasion")

    def test_stability_in_every_form(self):
        stability = ["invaded", "evolutionarily stable", "neutrally stable"]
        invasion = result(*self.ROSTER)["invasion"]
        self.assertEqual(invasion["stability"], stability)
        self.assertEqual(invasion["rows"], [".sw", "-.-", "w-."])
        rows = {row["strategy"]: row for row in csv.DictReader(io.StringIO(output(*self.ROSTER, "--format", "csv")))}
        self.assertEqual([rows[name]["stability"] for name in ("all_c", "all_d", "tit_for_tat")], stability)
        self.assertEqual((rows["all_c"]["invaded_strictly"], rows["all_c"]["invaded_weakly"]), ("1", "1"))
        self.assertRegex(output(*self.ROSTER), r"\nall_c +invaded +1 +0 +all_d\n")

    def test_without_it_nothing_changes(self):
        plain = ("--strategies", "all_c,all_d,tit_for_tat", "--rounds", "10")
        self.assertNotIn("invasion", result(*plain))
        self.assertTrue(output(*self.ROSTER).startswith(output(*plain)))

    def test_files_and_graph(self):
        with tempfile.TemporaryDirectory() as folder:
            drawn = shutil.which("gnuplot") and shutil.which("dot")
            output(*self.ROSTER, "--output", folder, *(["--plot"] if drawn else []))
            rows = table(Path(folder) / "invasion.csv")
            self.assertEqual(rows[0], ["resident\\mutant", "all_c", "all_d", "tit_for_tat", "stability"])
            self.assertEqual(rows[1], ["all_c", "", "strictly", "weakly", "invaded"])
            self.assertIn("invasion", json.loads((Path(folder) / "summary.json").read_text()))
            if drawn:
                self.assertIn("all_d", (Path(folder) / "invasion.svg").read_text())

    def test_it_needs_self_play(self):
        done = run(*self.ROSTER, "--no-self-play")
        self.assertEqual(done.returncode, 2)
        self.assertIn("own copy", done.stderr)


class SubRosters(unittest.TestCase):
    FEW = ("--strategies", "all_c,all_d,tit_for_tat", "--rounds", "10")

    def test_every_form(self):
        with tempfile.TemporaryDirectory() as folder:
            text = output(*self.FEW, "--sub-rosters", "2", "--output", folder)
            header, *rows = table(Path(folder) / "sub_rosters.csv")
            found = json.loads((Path(folder) / "summary.json").read_text())["sub_rosters"]
        self.assertTrue(text.startswith(output(*self.FEW)))
        self.assertIn("Ranks in all 3 sub-rosters of 2 of the 3 strategies", text)
        self.assertRegex(text, r"\nall_c +1.5000 +0.5000 +1 +1 +1 +2 +2 +50.00 +2\n")
        self.assertEqual(rows[1], ["all_c", "2", "1.5", "0.5", "1", "1", "1", "2", "2", "0.5"])
        self.assertEqual((found["possible"], found["looked_at"], found["all"]), ("3", 3, True))
        self.assertEqual([list(entry) for entry in found["ranking"]], [["name", *header[1:]]] * 3)
        self.assertEqual([str(value) for value in found["ranking"][1].values()], rows[1])
        with_columns = list(csv.reader(io.StringIO(output(*self.FEW, "--sub-rosters", "2", "--format", "csv"))))
        self.assertEqual(with_columns[0][-9:], header[1:])
        self.assertEqual(next(row for row in with_columns if row[1] == "all_c")[-9:], rows[1][1:])

    def test_a_sample_is_the_seeds(self):
        asked = ("--rounds", "10", "--sub-rosters", "4:3")
        first = result(*asked, "--threads", "1")["sub_rosters"]
        self.assertEqual((first["looked_at"], first["all"], first["possible"]), (3, False, "2380"))
        self.assertEqual(sum(entry["sub_rosters"] for entry in first["ranking"]), 12)
        self.assertIsNone(first["ranking"][-1]["mean_rank"])  # in none of the three
        self.assertNotEqual(first, result(*asked, "--seed", "2")["sub_rosters"])
        self.assertIn("3 sub-rosters of 4 of the 17 strategies, drawn with seed 1", output(*asked))

    def test_what_is_refused(self):
        for size in ("1", "4", "2:0", "2:", ":2", "2:1:1", "x"):
            done = run(*self.FEW, "--sub-rosters", size)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn("--sub-rosters", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


class Documentation(unittest.TestCase):
    def test_its_page_has_every_option(self):
        page = (TREE / "docs" / "ipd-tournament.md").read_text()
        for option in re.findall(r"^  (--[a-z-]+)", output("--help"), re.MULTILINE):
            self.assertIn(f"`{option}", page)


if __name__ == "__main__":
    unittest.main()
