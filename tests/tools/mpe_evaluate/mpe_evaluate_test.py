"""mpe-evaluate as its user sees it: returns, scores, records, replays, refusals. FOLK_BIN names the folder of the
programs."""

import csv
import io
import json
import math
import os
import shutil
import signal
import statistics
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "mpe-evaluate"
SOURCE = Path(__file__).resolve().parents[3]
GOLDEN = SOURCE / "tests" / "data" / "mpe"
SHIPPED = SOURCE / "data" / "mpe"

# A player that pushes to the right, for the line protocol of exec:.
PUSHER = """
import sys
for line in sys.stdin:
    if line.split()[0] == "act":
        print("1 0", flush=True)
"""


def run(*arguments, **how):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **how)


def result(*arguments, **how):
    done = run(*arguments, "--format", "json", **how)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def zero_policy(scenario, inputs):
    """A policy file of three predators that never move."""
    tensors, data = {}, b""
    for agent in range(3):
        for name, shape in (("fc1.weight", [2, inputs]), ("fc1.bias", [2])):
            size = 4 * math.prod(shape)
            tensors[f"agent{agent}.{name}"] = {
                "dtype": "F32", "shape": shape, "data_offsets": [len(data), len(data) + size]}
            data += bytes(size)
    tensors["__metadata__"] = {"format": "folk-mpe-1", "scenario": scenario, "side": "predators", "squash": "tanh"}
    header = json.dumps(tensors).encode()
    header += b" " * (-len(header) % 8)
    return struct.pack("<Q", len(header)) + header + data


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def data(self, expert):
        """The shipped prey and, where asked for, an expert that stands still, as an environment."""
        mpe = self.folder / "data" / "mpe"
        mpe.mkdir(parents=True, exist_ok=True)
        for scenario, inputs in (("simple_tag", 16), ("simple_world", 24)):
            shutil.copy(SHIPPED / f"{scenario}_released.safetensors", mpe)
            if expert:
                (mpe / f"{scenario}_expert.safetensors").write_bytes(zero_policy(scenario, inputs))
        return {**os.environ, "FOLK_DATA": str(mpe.parent)}


class Returns(InAFolder):
    def test_every_default_is_stated(self):
        found = result("--predators", "lead_pursuit")
        self.assertEqual(found["scenario"], "simple_tag")
        self.assertEqual(found["predators"], "lead_pursuit")
        self.assertEqual(found["episodes"], 100)
        self.assertEqual(found["steps"], 25)
        self.assertEqual(found["seed"], 1)
        self.assertEqual(found["reward_rule"], "program")
        self.assertEqual([one["prey"] for one in found["results"]], ["released"])
        text = run("--predators", "lead_pursuit").stdout
        self.assertIn("lead_pursuit in simple_tag: 100 episodes of 25 steps with each prey; rewards of the program; "
                      "seed 1\n", text)
        self.assertIn("signature " + found["signature"], text)

    def test_returns_of_the_published_environment(self):
        """Mean and standard error over 200 episodes of the authors' environment, ENVIRONMENT.md section 10."""
        reference = {
            ("simple_tag", "random", "released"): (-3.4, 0.8),
            ("simple_tag", "random", "random"): (-4.3, 0.8),
            ("simple_tag", "lead_pursuit", "released"): (231.7, 5.8),
            ("simple_world", "random", "released"): (-7.1, 0.4),
            ("simple_world", "random", "random"): (-7.6, 0.4),
            ("simple_world", "lead_pursuit", "released"): (123.5, 3.2),
        }
        for (scenario, predators, prey), (mean, error) in reference.items():
            found = result("--scenario", scenario, "--predators", predators, "--prey", prey, "--episodes", "2000")
            ours = found["results"][0]["return"]
            self.assertLess(abs(ours["mean"] - mean), 3 * math.hypot(error, ours["standard_error"]),
                            (scenario, predators, prey, ours))

    def test_the_means_are_those_of_the_episodes(self):
        out = self.folder / "out"
        found = result("--predators", "lead_pursuit", "--prey", "released,still", "--episodes", "70", "--output", out)
        self.assertEqual(sorted(path.name for path in out.iterdir()), ["episodes.csv", "results.csv", "results.json"])
        with open(out / "episodes.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["prey"] for row in rows], ["released"] * 70 + ["still"] * 70)
        self.assertEqual([int(row["episode"]) for row in rows], 2 * list(range(70)))
        for one in found["results"]:
            episodes = [row for row in rows if row["prey"] == one["prey"]]
            returns = [float(row["return"]) for row in episodes]
            self.assertAlmostEqual(one["return"]["mean"], statistics.mean(returns), places=9)
            self.assertAlmostEqual(one["return"]["sd"], statistics.stdev(returns), places=9)
            self.assertAlmostEqual(one["return"]["standard_error"], statistics.stdev(returns) / 70**0.5, places=9)
            # Student's t of 69 degrees of freedom at 0.975.
            self.assertAlmostEqual(one["return"]["ci95"] / one["return"]["standard_error"], 1.994945, places=5)
            for name in ("prey_return", "contacts", "caught_steps", "distance", "nearest", "outside_steps"):
                self.assertAlmostEqual(one[name], statistics.mean(float(row[name]) for row in episodes), places=9)
        self.assertEqual(json.loads((out / "results.json").read_text()), found)
        table = run("--predators", "lead_pursuit", "--prey", "released,still", "--episodes", "70", "--format", "csv")
        self.assertEqual((out / "results.csv").read_text(), table.stdout)
        for row, one in zip(csv.DictReader(io.StringIO(table.stdout)), found["results"], strict=True):
            self.assertEqual(row["prey"], one["prey"])
            self.assertEqual(row["scenario"], "simple_tag")
            self.assertEqual(float(row["return"]), one["return"]["mean"])
            self.assertEqual(float(row["ci95"]), one["return"]["ci95"])
            self.assertEqual(row["reference_source"], one["references"]["source"])
            self.assertEqual(float(row["outside_steps"]), one["outside_steps"])

    def test_one_episode_has_no_error(self):
        found = result("--predators", "lead_pursuit", "--episodes", "1")["results"][0]["return"]
        self.assertEqual((found["ci95"], found["sd"], found["standard_error"]), (None, None, None))
        row = next(csv.DictReader(io.StringIO(
            run("--predators", "lead_pursuit", "--episodes", "1", "--format", "csv").stdout)))
        self.assertEqual((row["ci95"], row["sd"], row["standard_error"]), ("", "", ""))

    def test_threads_change_nothing_and_the_seed_does(self):
        arguments = ("--predators", "blend(0.5;lead_pursuit)", "--prey", "random", "--episodes", "200")
        one = run(*arguments, "--threads", "1", "--format", "json").stdout
        self.assertEqual(one, run(*arguments, "--threads", "4", "--format", "json").stdout)
        other = result(*arguments, "--seed", "2")
        self.assertNotEqual(json.loads(one)["signature"], other["signature"])

    def test_the_first_episodes_of_more_are_the_same(self):
        few, many = self.folder / "few", self.folder / "many"
        run("--predators", "random", "--prey", "random", "--episodes", "10", "--output", few)
        run("--predators", "random", "--prey", "random", "--episodes", "100", "--output", many)
        self.assertEqual((few / "episodes.csv").read_text().splitlines(),
                         (many / "episodes.csv").read_text().splitlines()[:11])

    def test_episodes_placed_by_numpy(self):
        file = self.folder / "episode.csv"
        found = result("--predators", "still", "--prey", "still", "--episodes", "2", "--numpy-seed", "5",
                       "--references", "1,0", "--episode", "1", "--record", file)
        self.assertEqual(found["numpy_seed"], 5)
        with open(file, newline="") as recording, open(GOLDEN / "tag_reset_seeds.csv", newline="") as resets:
            first = next(csv.DictReader(recording))
            reset = next(row for row in csv.DictReader(resets) if (row["seed"], row["reset_no"]) == ("5", "1"))
        for column, value in reset.items():
            if "." in column:
                self.assertEqual(float(first[column]), float(value), column)
        text = run("--predators", "still", "--numpy-seed", "5").stdout
        self.assertIn("; seed 1; placed by numpy's seed 5\n", text)

    def test_rewards_by_the_papers_text(self):
        program = result("--predators", "lead_pursuit")["results"][0]
        paper = result("--predators", "lead_pursuit", "--reward-rule", "paper")
        self.assertEqual(paper["reward_rule"], "paper")
        self.assertNotEqual(paper["results"][0]["return"]["mean"], program["return"]["mean"])
        self.assertEqual(paper["results"][0]["contacts"], program["contacts"])
        self.assertEqual(paper["results"][0]["references"]["source"], "measured")


class Scores(InAFolder):
    def one(self, *arguments, **how):
        return result("--predators", "lead_pursuit", *arguments, **how)["results"][0]

    def test_published_for_the_released_prey(self):
        for scenario, expert, random in (("simple_tag", 185.6, -4.1), ("simple_world", 79.5, -6.8)):
            file = SHIPPED / f"{scenario}_released.safetensors"
            for prey in ("released", str(file)):
                one = self.one("--scenario", scenario, "--prey", prey)
                self.assertEqual(one["references"], {"expert": expert, "random": random, "source": "published"})
                self.assertAlmostEqual(one["score"], 100 * (one["return"]["mean"] - random) / (expert - random))

    def test_measured_for_others(self):
        environment = self.data(expert=True)
        for prey in ("still", "random"):
            one = self.one("--prey", prey, "--episodes", "150", env=environment)
            expert = result("--predators", "still", "--prey", prey, "--episodes", "150")["results"][0]["return"]["mean"]
            random = result("--predators", "random", "--prey", prey, "--episodes", "150")["results"][0]["return"]["mean"]
            self.assertEqual(one["references"], {"expert": expert, "random": random, "source": "measured"})
            self.assertAlmostEqual(one["score"], 100 * (one["return"]["mean"] - random) / (expert - random))
        text = run("--predators", "lead_pursuit", "--prey", "released,still", env=environment).stdout
        self.assertIn("published: ", text)
        self.assertIn("measured: ", text)
        self.assertNotIn("note: ", text)

    def test_a_hundred_and_nought(self):
        environment = self.data(expert=True)
        for predators, score in (("random", 0), ("expert", 100)):
            one = result("--predators", predators, "--prey", "still", env=environment)["results"][0]
            self.assertAlmostEqual(one["score"], score)

    def test_without_an_expert_there_is_none(self):
        found = result("--predators", "lead_pursuit", "--prey", "still", env=self.data(expert=False))
        self.assertIsNone(found["results"][0]["score"])
        self.assertIsNone(found["results"][0]["references"]["expert"])
        self.assertIsNotNone(found["results"][0]["references"]["random"])
        self.assertIn("no normalised score", found["notes"][0])
        text = run("--predators", "lead_pursuit", "--prey", "still", env=self.data(expert=False)).stdout
        self.assertIn("note: no normalised score", text)

    def test_as_the_user_says(self):
        self.assertEqual(self.one("--references", "100,0")["references"],
                         {"expert": 100, "random": 0, "source": "given"})
        one = self.one("--references", "100,0")
        self.assertAlmostEqual(one["score"], one["return"]["mean"])
        self.assertEqual(self.one("--references", "published", "--prey", "still")["references"]["source"], "published")
        measured = self.one("--references", "measured", env=self.data(expert=True))
        self.assertEqual(measured["references"]["source"], "measured")


class Episodes(InAFolder):
    def test_what_was_recorded_is_replayed_to_the_bit(self):
        file = self.folder / "episode.csv"
        for scenario in ("simple_tag", "simple_world"):
            out = self.folder / scenario
            done = run("--scenario", scenario, "--predators", "lead_pursuit", "--episodes", "5", "--episode", "3",
                       "--record", file, "--output", out)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(file, newline="") as recording, open(out / "episodes.csv", newline="") as scores:
                rows = list(csv.DictReader(recording))
                scored = list(csv.DictReader(scores))[3]
            self.assertEqual([(row["episode"], int(row["t"])) for row in rows], [("3", t) for t in range(26)])
            self.assertAlmostEqual(sum(float(row["rew0"]) for row in rows), float(scored["return"]), places=9)
            self.assertAlmostEqual(sum(float(row["rew3"]) for row in rows), float(scored["prey_return"]), places=9)
            for more in ((), ("--free-run",)):
                found = json.loads(run("--replay", file, "--tolerance", "0", "--format", "json", *more).stdout)
                self.assertTrue(found["within"])
                self.assertEqual(found["mode"], "free_run" if more else "one_step")
                self.assertEqual(found["files"][0]["scenario"], scenario)
                self.assertEqual(found["files"][0]["state"]["deviation"], 0)

    def test_an_episode_is_drawn(self):
        picture = self.folder / "episode.svg"
        done = run("--predators", "lead_pursuit", "--episodes", "2", "--episode", "1", "--render", picture)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("<svg", picture.read_text()[:500])
        other = self.folder / "other.svg"
        run("--predators", "lead_pursuit", "--episodes", "2", "--render", other)
        self.assertNotEqual(picture.read_text(), other.read_text())
        self.assertIn(">simple_tag · 25 steps · Folk ", picture.read_text())

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_an_episode_is_drawn_as_a_strip(self):
        for extension, magic in (("png", b"\x89PNG"), ("pdf", b"%PDF")):
            picture = self.folder / f"episode.{extension}"
            done = run("--predators", "lead_pursuit", "--episodes", "1", "--render", picture)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(picture.read_bytes().startswith(magic))

    def test_a_program_on_a_pipe(self):
        script = self.folder / "pusher.py"
        script.write_text(PUSHER)
        file = self.folder / "pushed.csv"
        found = result("--predators", f'exec:"python3 {script}"', "--prey", "still", "--episodes", "2",
                       "--references", "1,0", "--record", file)
        self.assertEqual(found["notes"], [])
        with open(file, newline="") as recording:
            for row in list(csv.DictReader(recording))[1:]:
                self.assertEqual([float(row[f"act{i}.x"]) for i in range(4)], [1, 1, 1, 0])

    def test_a_program_that_is_never_the_same(self):
        script = self.folder / "moody.py"
        count = self.folder / "count"
        script.write_text(f"""
import sys
open({str(count)!r}, "a").write("x")
push = len(open({str(count)!r}).read()) / 100
for line in sys.stdin:
    if line.split()[0] == "act":
        print(push, 0, flush=True)
""")
        found = result("--predators", f'exec:"python3 {script}"', "--prey", "still", "--episodes", "1",
                       "--references", "1,0", "--record", self.folder / "moody.csv")
        self.assertIn("was played again to be recorded and went otherwise", found["notes"][0])


class Replays(InAFolder):
    def changed(self, name, row, column, add):
        """A golden file with one number changed."""
        with open(GOLDEN / name, newline="") as file:
            rows = list(csv.reader(file))
        place = rows[0].index(column)
        rows[row + 1][place] = repr(float(rows[row + 1][place]) + add)
        path = self.folder / f"changed_{column}_{name}"
        path.write_text("".join(",".join(fields) + "\n" for fields in rows))
        return str(path)

    def test_golden_episodes(self):
        files = [str(path) for path in sorted(GOLDEN.glob("*_[0-9][0-9].csv"))]
        self.assertGreaterEqual(len(files), 4)
        done = run("--replay", ",".join(files))
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        self.assertIn("all within the tolerance", done.stdout)
        self.assertIn("tolerance 1e-12", done.stdout)
        for name in ("tag_14.csv", "world_08.csv"):
            self.assertEqual(run("--replay", GOLDEN / name, "--free-run", "--tolerance", "1e-9").returncode, 0)

    def test_actions_rounded_to_float(self):
        files = ",".join(str(GOLDEN / f"{name}_f32actions.csv") for name in ("tag", "world"))
        self.assertEqual(run("--replay", files, "--tolerance", "1e-6").returncode, 0)
        done = run("--replay", files)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("beyond the tolerance: 2 of 2 files", done.stdout)

    def test_a_number_that_is_wrong_is_found(self):
        for kind, row, column in (("observation", 7, "obs3.11"), ("reward", 25, "rew0"), ("observation", 0, "obs0.4"),
                                  ("reward", 0, "rew3"), ("state", 25, "agent3.px")):
            file = self.changed("tag_14.csv", row, column, 0.5)
            done = run("--replay", file, "--format", "json")
            self.assertEqual(done.returncode, 1)
            found = json.loads(done.stdout)
            self.assertFalse(found["within"])
            where = found["files"][0][kind]
            self.assertAlmostEqual(where.pop("deviation"), 0.5, places=9)
            self.assertEqual(where, {"episode": 14, "t": row, "column": column})
            self.assertIn(f"{column} at t = {row} of episode 14\n", run("--replay", file).stdout)
            self.assertEqual(run("--replay", file, "--tolerance", "0.6").returncode, 0)

    def test_the_worst_file_comes_last(self):
        good = str(GOLDEN / "world_08.csv")
        bad = self.changed("tag_14.csv", 5, "obs0.0", 1e-3)
        worst = self.changed("world_08.csv", 5, "obs2.3", 1)
        for order in ((worst, bad, good), (good, bad, worst), (bad, worst, good)):
            done = run("--replay", ",".join(order), "--format", "json")
            found = json.loads(done.stdout)
            self.assertEqual([file["file"] for file in found["files"]], [good, bad, worst])
            self.assertEqual([file["within"] for file in found["files"]], [True, False, False])
            self.assertEqual(done.returncode, 1)
        done = run("--replay", f"{worst},{good}", "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual([row["within"] for row in rows], ["true", "false"])
        self.assertEqual((rows[1]["observation_column"], rows[1]["observation_t"]), ("obs2.3", "5"))
        self.assertIn("beyond the tolerance: 1 of 2 files", run("--replay", f"{worst},{good}").stdout)

    def test_rewards_of_the_other_rule(self):
        file = str(GOLDEN / "tag_01.csv")
        done = run("--replay", file, "--reward-rule", "paper", "--format", "json")
        self.assertEqual(done.returncode, 1)
        found = json.loads(done.stdout)
        self.assertLess(found["files"][0]["state"]["deviation"], 1e-12)
        self.assertGreater(found["files"][0]["reward"]["deviation"], 1e-3)

    def test_several_episodes_in_a_file(self):
        rows = Path(self.changed("tag_14.csv", 4, "obs1.1", 0.5)).read_text().splitlines()
        good = (GOLDEN / "tag_14.csv").read_text().splitlines()
        file = self.folder / "two.csv"
        file.write_text("\n".join(rows + [f"3,{line.split(',', 1)[1]}" for line in good[1:4]]))
        done = run("--replay", file, "--format", "json")
        found = json.loads(done.stdout)["files"][0]
        self.assertEqual((found["episodes"], found["steps"], done.returncode), (2, 27, 1))
        self.assertEqual(found["observation"]["episode"], 14)
        table = list(csv.DictReader(io.StringIO(run("--replay", file, "--format", "csv").stdout)))
        self.assertEqual([(row["episode"], row["steps"], row["within"]) for row in table],
                         [("14", "25", "false"), ("3", "2", "true")])


class Refusals(InAFolder):
    def refused(self, code, *arguments, says=()):
        done = run(*arguments)
        self.assertEqual((done.returncode, done.stdout), (code, ""), done)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("mpe-evaluate: "), lines[0])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, lines[0])

    def test_wrong_usage(self):
        enough = ("--predators", "still")
        self.refused(2, says="--predators is missing")
        self.refused(2, "stray", *enough, says="'stray'")
        self.refused(2, "--predators", "lead_pursuid", says="lead_pursuit")
        self.refused(2, "--predators", "released")
        self.refused(2, *enough, "--prey", "lead_pursuit")
        self.refused(2, *enough, "--prey", "")
        self.refused(2, *enough, "--prey", "still,random,STILL", says="'still' is given twice")
        self.refused(2, *enough, "--scenario", "simple_spread", says=("simple_tag", "simple_world"))
        self.refused(2, *enough, "--reward-rule", "mine", says="program or paper")
        self.refused(2, *enough, "--format", "xml")
        for option in ("--episodes", "--threads"):
            for number in ("0", "-1", "x", "", "1.5", "99999999999999999999999"):
                self.refused(2, *enough, f"{option}={number}", says=option)
        self.refused(2, *enough, "--seed=-1", says="--seed")
        self.refused(2, *enough, "--numpy-seed=4294967296", says="--numpy-seed")
        self.refused(2, *enough, "--numpy-seed=1", "--episodes=1000001", says="at most 1000000")

    def test_references(self):
        enough = ("--predators", "still", "--references")
        for text in ("", "mine", "1", "1,", "nan,1", "1,2,3", "1,1", "inf,0", "1e400,0"):
            self.refused(2, *enough, text, says="--references '")
        self.refused(2, *enough, "published", "--reward-rule", "paper", says="--reward-rule paper")

    def test_options_that_contradict_each_other(self):
        replay = ("--replay", str(GOLDEN / "tag_14.csv"))
        for option in ("--scenario", "--predators", "--prey", "--episodes", "--seed", "--numpy-seed", "--threads", "--references",
                       "--output", "--record", "--render", "--episode"):
            self.refused(2, *replay, option, "1", says=(option, "--replay"))
        enough = ("--predators", "still")
        self.refused(2, *enough, "--free-run", says="--replay")
        self.refused(2, *enough, "--tolerance", "1", says="--replay")
        self.refused(2, *enough, "--episode", "1", says=("--record", "--render"))
        for option in ("--record", "--render"):
            file = str(self.folder / "x.svg")
            self.refused(2, *enough, "--prey", "still,random", option, file, says=(option, "a single --prey"))
            self.refused(2, *enough, option, file, "--episode", "100", says=("--episode", "from 0 to 99"))
        self.refused(2, *enough, "--record", "x.svg", "--render", "x.svg", says="the same file")
        self.refused(2, *enough, "--render", str(self.folder / "x.gif"), says=(".svg", ".png", ".pdf"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_tolerances(self):
        for tolerance in ("nan", "-1", "x", "", "inf"):
            self.refused(2, "--replay", str(GOLDEN / "tag_14.csv"), f"--tolerance={tolerance}", says="--tolerance")
        self.refused(2, "--replay", "", says="at least one")

    def test_bad_files(self):
        self.refused(3, "--replay", "no_such.csv", says="no_such.csv: no such file")
        self.refused(3, "--replay", str(self.folder), says="is a directory")
        self.refused(3, "--replay", f"{GOLDEN / 'tag_14.csv'},no_such.csv", says="no_such.csv")
        text = (GOLDEN / "tag_14.csv").read_text()
        file = self.folder / "bad.csv"
        faults = {
            "": ":1: empty",
            "hello\n": ":1: expected the names of columns",
            "\x00\x01\x02": ":1: ",
            text.split("\n")[0]: ":1: no rows",
            text[: len(text) // 2]: "fields, line 1 has 100",
            text.replace("14,3,", "14,4,", 1): ":5: t 4 of episode 14: expected 3",
            text.replace("14,3,", "14,3,nan,", 1): ":5: 101 fields",
            text.replace("rew3", "reward3", 1): ":1: no column 'rew3'",
        }
        for content, says in faults.items():
            file.write_text(content)
            self.refused(3, "--replay", str(file), says=str(file) + ":" if says.startswith("f") else str(file) + says)
        os.truncate(file, 10 * 2**30)  # a hole, it takes no room
        self.refused(3, "--replay", str(file), says="larger than 64 MiB")
        self.refused(3, "--predators", str(GOLDEN / "tag_14.csv"))

    def test_the_world_outside(self):
        occupied = self.folder / "occupied"
        occupied.write_text("a file")
        enough = ("--predators", "still", "--prey", "still")
        self.refused(4, *enough, "--output", str(occupied), says="--output")
        self.refused(4, *enough, "--record", str(self.folder / "no" / "x.csv"), says="--record")
        self.refused(4, *enough, "--render", str(self.folder / "no" / "x.svg"))
        self.refused(4, "--predators", 'exec:"exit 3"', "--prey", "still", "--output", str(self.folder / "a" / "b"))
        self.assertEqual(list(self.folder.iterdir()), [occupied])
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, *enough], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 4)
        self.assertIn("No space left", done.stderr)

    def test_an_interruption_leaves_nothing_behind(self):
        out = self.folder / "a" / "b"
        program = subprocess.Popen(
            [PROGRAM, "--predators", "lead_pursuit", "--prey", "released", "--episodes", "3000000", "--output", out],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(0.2)  # it plays by now; however far it is, nothing may be left
        program.send_signal(signal.SIGTERM)  # a shell's background work ignores SIGINT
        said, complained = program.communicate(timeout=60)
        self.assertEqual((program.returncode, said, complained), (-signal.SIGTERM, "", ""))
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
