"""mpe-train offline as its users run it, and mpe-evaluate with what it trains: results, interruptions, refusals, damaged files,
returns that are asked for, beliefs. FOLK_BIN names the folder of the programs."""

import csv
import fcntl
import io
import json
import math
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
LEARNERS = ("bc", "ma-bcq", "omar", "cql", "madt", "rmadt", "sct")
BELIEVERS = ("rmadt", "sct")
STEPS = 40
SLOW = "FOLK_SANITIZED" in os.environ
SCT_STEPS, BC_STEPS = (60, 800) if SLOW else (300, 8000)  # a second or more
MANY_STEPS = 101 if SLOW else 250
SMALL = ("--budget", "smoke", "--batch", "16", "--quiet")
SHARED = None


def setUpModule():
    """Data of both scenarios and a policy of each learner, for all tests to look at."""
    global SHARED
    scratch = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(scratch.cleanup)
    SHARED = Path(scratch.name)
    for name, scenario, transitions in (("tag", "simple_tag", 2500), ("world", "simple_world", 2500), ("tiny", "simple_tag", 25)):
        subprocess.run([BIN / "mpe-train", "collect", "--scenario", scenario, "--level", "expert", "--transitions", str(transitions),
                        "--output", SHARED / name, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    for learner in LEARNERS:
        subprocess.run([BIN / "mpe-train", "offline", *SMALL, "--steps", str(STEPS), "--learner", learner, "--data", SHARED / "tag",
                        "--threads", "1", "--output", SHARED / f"{learner}.safetensors"], check=True, stdout=subprocess.DEVNULL)


class Offline(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.tag = SHARED / "tag"

    def command(self, *arguments):
        return [BIN / "mpe-train", "offline", *map(str, arguments)]

    def offline(self, *arguments, **how):
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, timeout=120, cwd=self.folder, **how)

    def evaluate(self, *arguments, **how):
        return subprocess.run([BIN / "mpe-evaluate", *map(str, arguments), "--quiet"], capture_output=True, text=True, timeout=120,
                              cwd=self.folder, **how)

    def played(self, *arguments):
        done = self.evaluate(*arguments, "--format", "json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def one_line(self, done, code, words, program="mpe-train offline"):
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (code, "", 1), done)
        self.assertTrue(done.stderr.startswith(f"{program}: ") and done.stderr[:-1].isprintable(), done.stderr)
        self.assertIn(words, done.stderr)

    def results(self, name):
        """What a run wrote under a name."""
        return tuple((self.folder / f"{name}.{end}").read_bytes() for end in ("safetensors", "csv"))

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def small(self, learner, name, *more, steps=STEPS):
        return ("--learner", learner, "--data", self.tag, *SMALL, "--steps", steps, "--output", f"{name}.safetensors", *more)


class Training(Offline):
    @unittest.skipIf(SLOW, "the library has tests of threads")
    def test_the_same_bytes_whatever_the_threads(self):
        for learner in LEARNERS:
            with self.subTest(learner=learner):
                self.assertEqual(self.offline(*self.small(learner, "here", "--threads", 3)).returncode, 0)
                self.assertEqual(self.results("here"),
                                 tuple((SHARED / f"{learner}.{end}").read_bytes() for end in ("safetensors", "csv")))

    def test_the_seed_and_the_data_decide(self):
        one = self.small("sct", "a", steps=3)
        for name, more in (("a", ()), ("b", ("--seed", 2)), ("c", ("--loss", "selfconf")), ("d", ("--readout", "token"))):
            self.assertEqual(self.offline(*one[:-1], f"{name}.safetensors", *more).returncode, 0)
        self.assertEqual(len({self.results(name)[0] for name in "abcd"}), 4)

    def test_curve_and_formats(self):
        for learner in LEARNERS:
            with self.subTest(learner=learner):
                rows = list(csv.reader((SHARED / f"{learner}.csv").read_text().splitlines()))
                self.assertEqual([row[0] for row in rows], ["steps", *map(str, range(1, STEPS + 1))])
                self.assertTrue(all(math.isfinite(float(loss)) for row in rows[1:] for loss in row[1:]))
        table = self.offline(*self.small("omar", "a", "--format", "csv", steps=MANY_STEPS))
        self.assertEqual((table.returncode, table.stderr), (0, ""))
        self.assertEqual(table.stdout, (self.folder / "a.csv").read_text())
        self.assertEqual(table.stdout.splitlines()[-1].split(",")[0], str(MANY_STEPS))
        report = json.loads(self.offline(*self.small("omar", "a", "--format", "json", steps=MANY_STEPS)).stdout)
        self.assertEqual([list(row.values()) for row in report["losses"]],
                         [[float(field) for field in line.split(",")] for line in table.stdout.splitlines()[1:]])
        self.assertEqual((report["steps"], report["notes"]["learner"], report["files"]["curve"]), (MANY_STEPS, "omar", "a.csv"))
        text = self.offline(*self.small("omar", "a", steps=MANY_STEPS)).stdout
        self.assertIn("simple_tag, 2500 transitions), seed 1", text)
        self.assertIn("policy in a.safetensors\nlosses in a.csv\n", text)

    def test_one_episode_is_data_enough(self):
        for learner in LEARNERS:
            with self.subTest(learner=learner):
                done = self.offline("--learner", learner, "--data", SHARED / "tiny", *SMALL, "--steps", 2, "--output", "a.safetensors")
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_help_has_examples(self):
        text = self.offline("--help").stdout
        self.assertIn("Examples:\n  mpe-train offline --learner sct --data", text)
        self.assertEqual(self.names(), [])


class Interruptions(Offline):
    def test_goes_on_after_kill_9(self):
        """Whenever it is killed, and with other threads: the same files."""
        chance = random.Random(1)
        for learner in LEARNERS:
            with self.subTest(learner=learner):
                more = ("--checkpoint", f"kept-{learner}", "--checkpoint-every", 4, "--resume", "--threads")
                for attempt in range(4):
                    process = subprocess.Popen(self.command(*self.small(learner, learner, *more, 1 + attempt % 2)), cwd=self.folder,
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    time.sleep(chance.uniform(0, 0.15))
                    process.kill()
                    process.wait()
                done = self.offline(*self.small(learner, learner, *more, 2))
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertEqual(self.results(learner),
                                 tuple((SHARED / f"{learner}.{end}").read_bytes() for end in ("safetensors", "csv")))

    @unittest.skipIf(SLOW, "kill -9 takes the same way on")
    def test_a_signal_is_one_line_and_loses_nothing(self):
        for learner, number, steps in (("sct", signal.SIGINT, SCT_STEPS), ("bc", signal.SIGTERM, BC_STEPS)):
            with self.subTest(learner=learner):
                self.assertEqual(self.offline(*self.small(learner, "whole", steps=steps)).returncode, 0)
                kept = self.folder / f"kept-{learner}"
                more = ("--checkpoint", kept.name, "--checkpoint-every", 5, "--resume")
                # Nicer than this test, which is to see its first checkpoint.
                process = subprocess.Popen(self.command(*self.small(learner, "cut", *more, steps=steps)), cwd=self.folder, text=True,
                                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=lambda: os.nice(10))
                while not list(kept.glob("*.checkpoint")):
                    self.assertIsNone(process.poll())
                    time.sleep(0.005)
                process.send_signal(number)
                out, error = process.communicate(timeout=60)
                self.assertEqual((process.returncode, out), (4, ""))
                self.assertRegex(error, r"^mpe-train offline: interrupted after step \d+; the same command with --resume goes on from "
                                        r"there\n$")
                step = re.search(r"\d+", error).group()
                self.assertTrue((kept / f"step-{step}.checkpoint").exists())
                self.assertLessEqual(len(list(kept.glob("*.checkpoint"))), 2)
                self.assertFalse((self.folder / "cut.safetensors").exists() or (self.folder / "cut.csv").exists())
                rest = ("--checkpoint", kept.name, "--checkpoint-every", 1000, "--resume")  # each waits for the disk
                self.assertEqual(self.offline(*self.small(learner, "cut", *rest, steps=steps)).returncode, 0)
                self.assertEqual(self.results("cut"), self.results("whole"))
                for path in self.folder.glob("cut.*"):
                    path.unlink()

    def test_without_a_folder_nothing_is_kept_and_it_says_so(self):
        process = subprocess.Popen(self.command(*self.small("bc", "a", steps=100_000_000)), cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while b"SigCgt:\t0000000000000000" in (status := Path(f"/proc/{process.pid}/status").read_bytes()) or \
                not int(re.search(rb"SigCgt:\t(\w+)", status).group(1), 16) & 1 << (signal.SIGINT - 1):
            time.sleep(0.005)  # until it catches the signal
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out, error.count("\n")), (4, "", 1))
        self.assertIn("nothing is kept without --checkpoint DIR", error)
        self.assertEqual(self.names(), [])

    @unittest.skipIf(SLOW, "fuzz_checkpoint has thousands")
    def test_damaged_checkpoints(self):
        """Of the newest the one before is taken; when both are, it says which, and the results of before stay."""
        for learner in ("ma-bcq", "sct"):
            with self.subTest(learner=learner):
                more = ("--checkpoint", f"kept-{learner}", "--checkpoint-every", 20)
                self.assertEqual(self.offline(*self.small(learner, "a", *more)).returncode, 0)
                whole = self.results("a")
                newest, before = (self.folder / f"kept-{learner}" / f"step-{step}.checkpoint" for step in (STEPS, STEPS // 2))
                good, older = newest.read_bytes(), before.read_bytes()
                flipped = bytearray(good)
                flipped[len(good) // 3] ^= 4
                for damaged in (b"", good[:7], good[:100], good[:-1], good + b"x", bytes(flipped)):
                    before.write_bytes(older)  # which the run before took away
                    newest.write_bytes(damaged)
                    loud = [word for word in self.small(learner, "a", *more) if word != "--quiet"]
                    done = self.offline(*loud, "--resume")
                    self.assertEqual(done.returncode, 0)
                    self.assertIn(f"note: kept-{learner}/step-{STEPS}.checkpoint: ", done.stderr)
                    self.assertIn(f"resumed at step {STEPS // 2}\n", done.stderr)
                    self.assertEqual(self.results("a"), whole)
                newest.write_bytes(good[:50])
                before.write_bytes(b"")
                self.one_line(self.offline(*self.small(learner, "a", *more, "--resume")), 3,
                              f"kept-{learner}/step-{STEPS}.checkpoint: damaged checkpoint")
                self.assertEqual(self.results("a"), whole)

    def test_folders_of_others(self):
        more = ("--checkpoint", "kept")
        self.assertEqual(self.offline(*self.small("sct", "a", *more, steps=3)).returncode, 0)
        whole, kept = self.results("a"), {path.name: path.read_bytes() for path in (self.folder / "kept").iterdir()}
        self.one_line(self.offline(*self.small("sct", "a", *more, steps=3)), 2, "give --resume to go on with it")
        for arguments, words in (
                (self.small("sct", "a", "--seed", 2, steps=3), "seed = 1 there, 2 here"),
                (self.small("sct", "a", "--hidden", 8, steps=3), "hidden = 16 there, 8 here"),
                (self.small("sct", "a", "--loss", "selfconf", steps=3), "loss = teacher there, selfconf here"),
                (self.small("sct", "a", steps=4), "decay-steps = 3 there, 4 here"),
                (self.small("bc", "a", steps=3), "learner = sct there, bc here"),
                (("--learner", "sct", "--data", SHARED / "world", *SMALL, "--steps", 3, "--output", "a.safetensors"), "data = ")):
            with self.subTest(words=words):
                self.one_line(self.offline(*arguments, *more, "--resume"), 2, f"the checkpoint is of another run: {words}")
        with (self.folder / "kept" / "lock").open("r+") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.one_line(self.offline(*self.small("sct", "a", *more, "--resume", steps=3)), 4, "another run is using it")
        self.one_line(self.offline(*self.small("sct", "a", "--checkpoint", "a.csv")), 4, "a.csv: cannot be made")
        self.assertEqual(self.results("a"), whole)
        self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "kept").iterdir()}, kept)


class Refusals(Offline):
    def test_options(self):
        usual = ["--learner", "omar", "--data", self.tag]
        cases = [
            ([], 2, "which learner? Give --learner"), (["--learner", "sct"], 2, "from which data? Give --data"),
            (["--learner", "sct", "--data", ""], 2, "from which data?"), ([*usual, "extra"], 2, "unexpected argument 'extra'"),
            (["--learner", "ppo", "--data", self.tag], 2, "'ppo' is no learner: expected bc, ma-bcq, omar, cql, madt, rmadt, sct"),
            (["--learner", "", "--data", self.tag], 2, "'' is no learner"), ([*usual, "--budget", "big"], 2, "'big' is no budget"),
            ([*usual, "--level", "best"], 2, "--level 'best'"), ([*usual, "--format", "xml"], 2, "--format 'xml'"),
            ([*usual, "--resume"], 2, "--resume needs the folder of the checkpoints"),
            (["--learner", "omar", "--data", "none"], 3, "none: no such folder"),
            (["--learner", "omar", "--data", "empty"], 3, "empty: 20 of the 20 files of a data set are missing"),
            (["--learner", "sct", "--data", self.tag, "--loss", "x"], 2, "'x' is no loss mode"),
            (["--learner", "sct", "--data", self.tag, "--loss", "action_only"], 2, "it is madt"),
            (["--learner", "sct", "--data", self.tag, "--readout", "own"], 2, "--readout 'own': expected cat, add or token"),
        ]
        for option, ends in (("steps", "1 to 1000000000"), ("hidden", "1 to 4096"), ("layers", "1 to 16"), ("batch", "1 to 65536"),
                             ("seed", "0 to 18446744073709551615"), ("threads", "1 to 256"), ("checkpoint-every", "1 to 1000000000")):
            for text in ("", "nan", "-1", "1.5", " 3", "0x10", "1e30", "99999999999999999999999", *(["0"] if option != "seed" else [])):
                cases.append(([*usual, f"--{option}", text], 2, f"--{option} '{text}': expected a whole number from {ends}"))
        for option, ends in (("learning-rate", "1e-09 to 1"), ("dropout", "0 to 0.9"), ("conservatism", "0 to 1000"),
                             ("imitation", "0 to 1")):
            for text in ("", "nan", "inf", "-1", "1e999", "5000", "0x1p-3", "0.5x"):
                cases.append(([*usual, f"--{option}", text], 2, f"--{option} '{text}': expected a number from {ends}"))
        lacks = {"bc": "loss readout conservatism imitation", "ma-bcq": "layers dropout loss readout conservatism imitation",
                 "omar": "layers dropout loss readout", "cql": "layers dropout loss readout imitation",
                 "madt": "loss readout conservatism imitation", "rmadt": "loss readout conservatism imitation",
                 "sct": "conservatism imitation"}
        values = {"loss": "teacher", "readout": "cat", "layers": "1"}
        for learner, options in lacks.items():
            for option in options.split():
                cases.append((["--learner", learner, "--data", self.tag, f"--{option}", values.get(option, "0.5")], 2,
                              f"--{option}: {learner} has no such setting; leave it out"))
        # Networks that no program could read again are not trained.
        for learner, *size in (("sct", "--hidden", 4096, "--layers", 16), ("ma-bcq", "--hidden", 4096), ("omar", "--hidden", 4096),
                               ("bc", "--hidden", 4096, "--layers", 15)):
            cases.append((["--learner", learner, "--data", self.tag, *size], 2, "choose a smaller network"))
        (self.folder / "empty").mkdir()
        for arguments, code, words in cases:
            with self.subTest(arguments=arguments):
                self.one_line(self.offline(*arguments, "--output", "x.safetensors"), code, words)
        self.assertEqual(self.names(), ["empty"])

    def test_outputs(self):
        (self.folder / "sub").mkdir()
        (self.folder / "old.csv").write_text("mine")
        (self.folder / "link.csv").symlink_to("old.csv")
        run = ("--learner", "cql", "--data", self.tag, *SMALL, "--steps", 2)
        for arguments, code, words in (
                (("--output", ""), 2, "--output: name the file"), (("--output", "a.st", "--curve", ""), 2, "--curve: name the file"),
                (("--output", "none/a.st"), 4, "there is no such folder"), (("--output", "a.st", "--curve", "none/a"), 4, "--curve none/a"),
                (("--output", "sub"), 4, "it is a directory"), (("--output", "sub/"), 4, "it is a directory"),
                (("--output", "a.csv"), 2, "a.csv: two results would go to this file"),
                (("--output", "a.csv", "--curve", "./a.csv"), 2, "two results would go to this file"),
                (("--output", "old.csv", "--curve", "link.csv"), 2, "two results would go to this file"),
                (("--output", "sub/../a.csv", "--curve", self.folder / "a.csv"), 2, "two results would go to this file"),
                (("--output", "/dev/full", "--curve", "/dev/null"), 4, "/dev/full: cannot be written"),
                (("--output", "/proc/a.st"), 4, "/proc/a.")):
            with self.subTest(arguments=arguments):
                self.one_line(self.offline(*run, *arguments), code, words)
        self.assertEqual((self.names(), (self.folder / "old.csv").read_text()), (["link.csv", "old.csv", "sub"], "mine"))
        # A link stays one, odd names are names, a pipe takes the bytes.
        self.assertEqual(self.offline(*run, "--output", "a b\n'.st", "--curve", "link.csv").returncode, 0)
        self.assertTrue((self.folder / "link.csv").is_symlink())
        self.assertTrue((self.folder / "old.csv").read_text().startswith("steps,"))
        done = subprocess.run(self.command(*run, "--output", "/dev/stdout", "--curve", "/dev/null", "--format", "csv"),
                              capture_output=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stdout.startswith((self.folder / "a b\n'.st").read_bytes()))

    def test_data(self):
        def damage(name, change):
            folder = self.folder / "data"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(self.tag, folder)
            raw = bytearray((folder / name).read_bytes())
            (folder / name).write_bytes(change(raw))

        def number(value, at=300):
            def change(raw):
                raw[at:at + 4] = struct.pack("<f", value)
                return raw
            return change

        for name, change, words in (
                ("obs_0.npy", lambda raw: raw[:1000], "obs_0.npy"), ("acs_3.npy", lambda raw: b"", "acs_3.npy"),
                ("obs_0.npy", number(math.nan), "obs_0.npy: nan at"), ("rews_1.npy", number(math.inf), "rews_1.npy: inf at"),
                ("obs_3.npy", number(3e38), "next_obs_3.npy: row"), ("dones_2.npy", number(0.5), "expected 0 or 1"),
                ("metadata.json", lambda raw: raw[:30], "metadata.json: no JSON object"),
                ("metadata.json", lambda raw: raw.replace(b"simple_tag", b"simple_world"), "but the files are of simple_tag")):
            damage(name, change)
            for learner in ("bc", "ma-bcq", "omar", "sct"):
                with self.subTest(name=name, words=words, learner=learner):
                    self.one_line(self.offline("--learner", learner, "--data", "data", *SMALL, "--output", "x.st"), 3, words)
        damage("obs_0.npy", lambda raw: raw)
        (self.folder / "data" / "obs_0.npy").unlink()
        os.mkfifo(self.folder / "data" / "obs_0.npy")
        self.one_line(self.offline("--learner", "bc", "--data", "data", *SMALL, "--output", "x.st"), 3, "is no ordinary file")
        self.assertEqual(self.names(), ["data"])


class Playing(Offline):
    def policy(self, learner):
        return SHARED / f"{learner}.safetensors"

    def test_every_learner_plays(self):
        for learner in LEARNERS:
            with self.subTest(learner=learner):
                found = self.played("--predators", self.policy(learner), "--prey", "released,maddpg,still", "--episodes", 6)
                self.assertEqual([row["prey"] for row in found["results"]], ["released", "maddpg", "still"])
                for row in found["results"]:
                    self.assertTrue(math.isfinite(row["return"]["mean"]))
                    self.assertEqual("transformer" in row, learner in ("madt", *BELIEVERS))
                self.one_line(self.evaluate("--predators", self.policy(learner), "--scenario", "simple_world"), 3,
                              "a policy for simple_tag, not for simple_world", "mpe-evaluate")
                self.one_line(self.evaluate("--predators", "still", "--prey", self.policy(learner)), 3, "of the predators, not of the prey",
                              "mpe-evaluate")
        world = ("--learner", "sct", "--data", SHARED / "world", *SMALL, "--steps", 2, "--output", "world.st")
        self.assertEqual(self.offline(*world).returncode, 0)
        self.played("--predators", "world.st", "--scenario", "simple_world", "--episodes", 2, "--beliefs")
        self.one_line(self.evaluate("--predators", "world.st"), 3, "a policy for simple_world, not for simple_tag", "mpe-evaluate")

    def test_what_only_transformers_can_be_asked(self):
        for player in (*map(self.policy, LEARNERS), "lead_pursuit"):
            learner = Path(player).stem
            for option, takes, words in ((("--targets", "0,100"), ("madt", *BELIEVERS), "cannot be asked for a return"),
                                         (("--beliefs",), BELIEVERS, "has no beliefs"),
                                         (("--force-beliefs",), ("sct",), "does not act on beliefs")):
                with self.subTest(learner=learner, option=option):
                    done = self.evaluate("--predators", player, "--episodes", 2, *option)
                    if learner in takes:
                        self.assertEqual((done.returncode, done.stderr), (0, ""))
                    else:
                        self.one_line(done, 2, words, "mpe-evaluate")

    def test_beliefs(self):
        arguments = ("--predators", self.policy("sct"), "--episodes", 5, "--prey", "released,still", "--targets", "0:200:100",
                     "--beliefs", "--force-beliefs")
        found = self.played(*arguments, "--threads", 1)
        self.assertEqual(found, self.played(*arguments, "--threads", 3))
        self.assertEqual((found["seed"], found["selection_seed"]), (1, 1000001))
        for row in found["results"]:
            told = row["transformer"]
            shares = [right["mean"] for right in told["beliefs"]["right"]]
            self.assertEqual([right["radius"] for right in told["beliefs"]["right"]], [0.05, 0.1, 0.2, 0.5])
            self.assertEqual(shares, sorted(shares))
            self.assertTrue(0 <= shares[0] and shares[-1] <= 1)
            self.assertEqual([asked["target"] for asked in told["asked"]], [0, 100, 200])
            best = max(told["asked"], key=lambda asked: asked["return"]["mean"])
            self.assertEqual(told["target"], best["target"])
            own, *forced = told["forced"]
            self.assertEqual([one["belief"] for one in told["forced"]], ["none", "truth", "other-episode", "zero"])
            self.assertEqual((own["difference"]["mean"], own["change"]["mean"]), (0, 0))
            self.assertAlmostEqual(own["return"]["mean"], row["return"]["mean"], places=9)
            for one in forced:
                self.assertAlmostEqual(one["difference"]["mean"], one["return"]["mean"] - own["return"]["mean"], places=9)
                self.assertGreater(one["change"]["mean"], 0)
        # A still prey does nothing: what it will do, here or in another episode, is no action.
        truth, other, zero = (one["return"] for one in found["results"][1]["transformer"]["forced"][1:])
        self.assertTrue(truth == other == zero)
        table = list(csv.DictReader(io.StringIO(self.evaluate(*arguments, "--format", "csv").stdout)))
        self.assertEqual([float(row["return"]) for row in table], [row["return"]["mean"] for row in found["results"]])
        text = self.evaluate(*arguments).stdout
        for words in ("within 10 %", "of another episode", "other-episode", "played"):
            self.assertIn(words.split()[0], text)
        self.one_line(self.evaluate(*arguments[:2], "--force-beliefs", "--prey", 'exec:"cat"'), 2, "cannot be known", "mpe-evaluate")

    def test_targets(self):
        madt = ("--predators", self.policy("madt"), "--episodes", 2)
        for text, targets in (("0:480:240", [0, 240, 480]), ("0:0.3:0.1", [0, 0.1, 0.2, 0.3]), ("0:10:4", [0, 4, 8]), ("5:5:1", [5]),
                              ("-5:5:5", [-5, 0, 5]), ("1,250.5, -3", [1, 250.5, -3]), ("7:7:1e-300", [7]), ("1e6:1e6:1e-20", [1e6])):
            with self.subTest(targets=text):
                asked = self.played(*madt, f"--targets={text}")["results"][0]["transformer"]["asked"]
                self.assertEqual(len(asked), len(targets))
                for one, target in zip(asked, targets):
                    self.assertAlmostEqual(one["target"], target, places=9)
        for text in ("", ",", ":", "::", "1:2", "1:2:", "1:2:3:4", "0:10:0", "0:10:-1", "10:0:1", "0:10:nan", "0:1000:1", "0:1:1e-300",
                     "nan", "inf", "1e7", "1;2", "1 2", "x"):
            with self.subTest(targets=text):
                self.one_line(self.evaluate(*madt, "--targets", text), 2, "--targets", "mpe-evaluate")

    def test_the_choice_of_a_target_has_episodes_of_its_own(self):
        madt = ("--predators", self.policy("madt"), "--episodes", 4)
        self.one_line(self.evaluate(*madt, "--selection-seed", 5), 2, "give --targets", "mpe-evaluate")
        self.one_line(self.evaluate(*madt, "--targets", "0,1", "--selection-seed", 1), 2, "flatters", "mpe-evaluate")
        self.one_line(self.evaluate("--replay", "x.csv", "--targets", "0"), 2, "--targets", "mpe-evaluate")
        rows = {seed: self.played(*madt, "--targets", "50", "--selection-seed", seed)["results"][0] for seed in (7, 8)}
        self.assertEqual(rows[7]["return"], rows[8]["return"])
        self.assertNotEqual(rows[7]["transformer"]["asked"], rows[8]["transformer"]["asked"])
        # The episodes of the choice are those that another run reports for that seed.
        self.assertEqual(self.played(*madt, "--targets", "50", "--seed", 7)["results"][0]["return"]["mean"],
                         rows[7]["transformer"]["asked"][0]["return"]["mean"])

    def test_a_recorded_episode_is_what_the_world_does(self):
        for learner, more in (("bc", ()), ("ma-bcq", ()), ("omar", ()), ("madt", ()), ("sct", ("--targets", "0:200:100"))):
            with self.subTest(learner=learner):
                found = self.played("--predators", self.policy(learner), "--episodes", 3, "--episode", 2, "--record", "r.csv",
                                    "--render", "r.svg", "--output", "out", *more)
                self.assertEqual(found["notes"], [])
                replay = self.evaluate("--replay", "r.csv", "--free-run", "--format", "json")
                self.assertEqual((replay.returncode, json.loads(replay.stdout)["within"]), (0, True))
                self.assertIn("</svg>", (self.folder / "r.svg").read_text())
                self.assertEqual(json.loads((self.folder / "out" / "results.json").read_text()), found)
                rows = [list(csv.DictReader((self.folder / name).read_text().splitlines())) for name in ("out/episodes.csv", "r.csv")]
                self.assertEqual([len(table) for table in rows], [3, 26])
                earned = sum(float(row["rew0"] or 0) for row in rows[1])
                self.assertAlmostEqual(earned, float(rows[0][2]["return"]), places=9)

    def test_a_pipe_is_a_file_too(self):
        for learner in ("omar", "sct"):
            with self.subTest(learner=learner):
                with self.policy(learner).open("rb") as file:
                    piped = subprocess.run(f'cat | "{BIN}/mpe-evaluate" --predators /dev/stdin --episodes 2 --quiet --format csv',
                                           shell=True, stdin=file, capture_output=True, text=True, timeout=60)
                plain = self.evaluate("--predators", self.policy(learner), "--episodes", 2, "--format", "csv")
                self.assertEqual(piped.stdout.replace("/dev/stdin", "X"), plain.stdout.replace(str(self.policy(learner)), "X"))
                self.assertEqual(piped.returncode, 0)


class DamagedPolicies(Offline):
    """Of each kind of file; whatever is done to one, it plays or is refused in a line."""

    def tried(self, content):
        (self.folder / "f.st").write_bytes(content)
        done = subprocess.run([BIN / "mpe-evaluate", "--predators", "f.st", "--episodes", "1", "--threads", "1", "--quiet"],
                              capture_output=True, timeout=60, cwd=self.folder)
        if done.returncode == 0:
            self.assertNotIn(b"nan", done.stdout)
        else:
            self.assertIn(done.returncode, (2, 3))
            self.assertEqual((done.stdout, done.stderr.count(b"\n")), (b"", 1))
            self.assertTrue(done.stderr.startswith(b"mpe-evaluate: f.st: "), done.stderr)
        return done.returncode

    @unittest.skipIf(SLOW, "fuzz_particle_policy has thousands")
    def test_damage(self):
        chance = random.Random(7)
        for learner in ("bc", "omar", "sct") if SLOW else ("bc", "ma-bcq", "omar", "madt", "sct"):
            with self.subTest(learner=learner):
                good = (SHARED / f"{learner}.safetensors").read_bytes()
                length = struct.unpack("<Q", good[:8])[0]
                header, data = json.loads(good[8:8 + length]), good[8 + length:]
                checked = learner in ("madt", "sct")  # by a checksum

                def packed(header, data=data):
                    text = json.dumps(header).encode()
                    text += b" " * (-len(text) % 8)
                    return struct.pack("<Q", len(text)) + text + data

                self.assertEqual(self.tried(packed(header)), 0)
                for size in (0, 7, 8, 9, 100, 8 + length, len(good) - 1, *(chance.randrange(len(good)) for _ in range(3))):
                    self.assertEqual(self.tried(good[:size]), 3)
                self.assertEqual(self.tried(good + b"x"), 3)
                for _ in range(12):
                    flipped = bytearray(good)
                    at = chance.choice((chance.randrange(8 + length), chance.randrange(len(good))))
                    flipped[at] ^= 1 << chance.randrange(8)
                    code = self.tried(bytes(flipped))
                    if checked and at >= 8 + length:
                        self.assertEqual(code, 3)
                keys = ("format", "scenario", "context", "candidates", "perturbation", "hidden", "layers", "heads", "time_rows",
                        "observation_size", "return_scale", "return_target", "scale_deviation", "checksum", "side", "squash")
                for key in (key for key in keys if key in header["__metadata__"]):
                    for value in ("", "nan", "-1", "1e999", "99999999999999999999", "4294967296", "simple_spread", "x" * 3000):
                        changed = json.loads(json.dumps(header))
                        changed["__metadata__"][key] = value
                        self.assertEqual(self.tried(packed(changed)), 3, (key, value))
                    changed = json.loads(json.dumps(header))
                    del changed["__metadata__"][key]
                    self.assertEqual(self.tried(packed(changed)), 3, key)
                name = next(name for name in header if name.endswith("weight"))
                for field, value in (("shape", [2**63, 2]), ("shape", [2**32, 2**32]), ("shape", [4096, 4096]), ("shape", [0]),
                                     ("shape", []), ("dtype", "F64"), ("dtype", ""), ("data_offsets", [0, 2**63]),
                                     ("data_offsets", [2**64 - 1, 0]), ("data_offsets", [4, 4])):
                    changed = json.loads(json.dumps(header))
                    changed[name][field] = value
                    self.assertEqual(self.tried(packed(changed)), 3, (field, value))
                begin = header[name]["data_offsets"][0]
                for number in (math.nan, math.inf):
                    self.assertEqual(self.tried(packed(header, data[:begin] + struct.pack("<f", number) + data[begin + 4:])), 3)


if __name__ == "__main__":
    unittest.main()
