"""sct-train as its user sees it: a run that is killed and resumed ends in the same bytes, checkpoints, config files,
refusals, output, and the names of policies in the other programs. FOLK_BIN names the folder of the programs."""

import csv
import io
import json
import os
import random
import resource
import shutil
import signal
import statistics
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
ROOT = Path(__file__).resolve().parents[3]
PROGRAM = BIN / "sct-train"

# A network and a roster so small that a run takes a second.
SMALL = ("--hidden", "8", "--layers", "1", "--batch", "8", "--learning-rate", "0.01", "--warmup", "5", "--averaging", "0.9",
         "--roster", "tit_for_tat,all_d,pavlov,spiteful", "--rounds", "30", "--targets", "70,90",
         "--validation-repetitions", "2")
RUN = (*SMALL, "--steps", "150", "--evaluate-every", "40", "--checkpoint-every", "7")
SLOW = "FOLK_SANITIZED" in os.environ


class Training(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, program="sct-train", **how):
        how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
        return subprocess.run([BIN / program, *map(str, arguments)], text=True, timeout=120, cwd=self.folder, **how)

    def start(self, *arguments):
        """A run that goes on beside the test."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def trained(self, *arguments):
        done = self.run_program(*arguments, "--quiet")
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def policy(self, name="policy.bin"):
        return (self.folder / name).read_bytes()

    def refused(self, code, *arguments, says=(), program="sct-train"):
        """One line on stderr that names the program and holds `says`, nothing on stdout, the exit code."""
        done = self.run_program(*arguments, program=program)
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(done.stdout, "", done)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done)
        self.assertTrue(lines[0].startswith(f"{program}: "), lines[0])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, lines[0])

    def file(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def wait_for_checkpoint(self, process, folder, other_than=()):
        """Until the run has written a checkpoint beside `other_than`."""
        while process.poll() is None:
            found = {path.name for path in folder.glob("step-*.checkpoint")} if folder.is_dir() else set()
            if found - set(other_than):
                return
            time.sleep(0.002)


class Resuming(Training):
    def killed_and_resumed(self, threads):
        self.trained(*RUN, "--output", "whole.bin")
        whole = self.policy("whole.bin")
        moments = random.Random(threads)
        command = (*RUN, "--checkpoint", "run", "--resume", "--threads", threads)
        kills = 0
        for attempt in range(12):
            written = {path.name for path in (self.folder / "run").glob("step-*.checkpoint")}
            process = self.start(*command)
            if attempt % 3 != 0:  # it goes on from where it was, however fast the machine
                self.wait_for_checkpoint(process, self.folder / "run", written)
            # Where in the work it dies differs from time to time: in a step, an evaluation, in the middle of a write.
            time.sleep(moments.uniform(0.0, 0.01))
            process.kill()
            kills += process.wait() == -signal.SIGKILL
            if process.returncode == 0:
                break
        self.assertGreater(kills, 0)
        done = self.run_program(*command)
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(self.policy(), whole)
        self.assertLessEqual(len(list((self.folder / "run").glob("step-*"))), 2)

    def test_killed_and_resumed_ends_in_the_same_bytes(self):
        self.killed_and_resumed(1)

    @unittest.skipIf(SLOW, "the test before has one thread")
    def test_killed_and_resumed_ends_in_the_same_bytes_with_two_threads(self):
        self.killed_and_resumed(2)

    def test_with_a_teacher(self):
        run = (*SMALL, "--data", "best-reply", "--aggregate-every", "8", "--steps", "60", "--evaluate-every", "25",
               "--checkpoint-every", "5", "--format", "json")
        whole = json.loads(self.trained(*run, "--output", "whole.bin"))
        self.assertEqual(whole["added_matches"], 7 * 4 * 5)
        self.assertIn(b'"data":"best-reply"', self.policy("whole.bin"))
        run = (*run, "--checkpoint", "run", "--resume")
        process = self.start(*run)
        self.wait_for_checkpoint(process, self.folder / "run", {f"step-{step}.checkpoint" for step in range(20)})
        process.kill()
        process.wait()
        self.assertEqual({**json.loads(self.trained(*run)), "output": "whole.bin"}, whole)
        self.assertEqual(self.policy(), self.policy("whole.bin"))

    def interrupted(self, number):
        process = self.start(*SMALL, "--steps", "1000000", "--evaluate-every", "1000000", "--checkpoint-every", "50",
                             "--checkpoint", "run")
        self.wait_for_checkpoint(process, self.folder / "run")
        process.send_signal(number)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, err)
        self.assertEqual(out, "")
        last = err.splitlines()[-1]
        self.assertRegex(last, r"^sct-train: interrupted after step \d+; the same command with --resume goes on")
        step = int(last.split("step ")[1].split(";")[0])
        self.assertTrue((self.folder / "run" / f"step-{step}.checkpoint").is_file())
        self.assertFalse((self.folder / "policy.bin").exists())
        return step

    def test_sigint_ends_with_a_checkpoint(self):
        step = self.interrupted(signal.SIGINT)
        # The steps may be fewer than were planned, as long as they are not behind the checkpoint.
        done = self.run_program(*SMALL, "--steps", step + 10, "--evaluate-every", "1000000", "--checkpoint", "run",
                                "--resume")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn(f"sct-train: resumed at step {step}", done.stderr)
        self.trained(*SMALL, "--steps", step + 10, "--evaluate-every", "1000000", "--output", "whole.bin")
        self.assertEqual(self.policy(), self.policy("whole.bin"))

    def test_sigterm_ends_with_a_checkpoint(self):
        self.interrupted(signal.SIGTERM)

    def test_interrupted_without_a_checkpoint_folder(self):
        process = self.start(*SMALL, "--steps", "1000000", "--evaluate-every", "1")
        process.stderr.readline()  # of the first evaluation
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4)
        self.assertIn("nothing is kept without --checkpoint DIR", err.splitlines()[-1])

    def test_a_finished_run_can_be_resumed_and_made_longer(self):
        short = (*SMALL, "--evaluate-every", "10", "--checkpoint", "run", "--steps")
        self.trained(*short, "25")
        first = self.policy()
        self.assertEqual(self.trained(*short, "25", "--resume"), self.trained(*short, "25", "--resume"))
        self.assertEqual(self.policy(), first)
        self.trained(*short, "45", "--resume")
        self.trained(*SMALL, "--evaluate-every", "10", "--steps", "45", "--output", "whole.bin")
        self.assertEqual(self.policy(), self.policy("whole.bin"))

    def test_a_damaged_checkpoint_gives_way_to_the_one_before(self):
        self.trained(*RUN, "--checkpoint", "run")
        first = self.policy()
        newest = self.folder / "run" / "step-150.checkpoint"
        newest.write_bytes(newest.read_bytes()[:-100])
        done = self.run_program(*RUN, "--checkpoint", "run", "--resume")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("step-150.checkpoint: damaged checkpoint", done.stderr)
        self.assertIn("resumed at step 147", done.stderr)
        self.assertEqual(self.policy(), first)

    def test_only_damaged_checkpoints(self):
        (self.folder / "run").mkdir()
        (self.folder / "run" / "step-10.checkpoint").write_bytes(b"FOLKCKPT")
        self.refused(3, *RUN, "--checkpoint", "run", "--resume", says="step-10.checkpoint: no checkpoint of sct-train")

    def test_a_checkpoint_of_another_run(self):
        self.trained(*RUN, "--checkpoint", "run")
        resume = (*RUN, "--checkpoint", "run", "--resume")
        self.refused(2, *resume, "--dropout", "0.2", says="dropout = 0.1 there, 0.2 here")
        self.refused(2, *resume, "--decay", "yes", says="decay = 0 there, 150 here")
        self.refused(2, *(("149" if word == "150" else word) for word in resume), says="step 150, beyond the last, 149")
        self.refused(2, *RUN, "--checkpoint", "run", says="give --resume to go on with it")

    def test_resuming_needs_a_folder(self):
        self.refused(2, *RUN, "--resume", says="--checkpoint DIR")

    def test_two_runs_in_one_folder(self):
        process = self.start(*SMALL, "--steps", "1000000", "--evaluate-every", "1000000", "--checkpoint", "run")
        self.wait_for_checkpoint(process, self.folder / "run")
        self.refused(4, *RUN, "--checkpoint", "run", "--resume", says="another run is using it")

    def test_a_full_disk_loses_nothing(self):
        """A limit on the size of files stands for a full disk: both fail in the middle of a write."""
        self.trained(*RUN, "--checkpoint", "run", "--output", "whole.bin")
        shutil.copytree(self.folder / "run", self.folder / "before")

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        longer = [("170" if word == "150" else word) for word in RUN]
        done = self.run_program(*longer, "--checkpoint", "run", "--resume", "--quiet", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done)
        self.assertRegex(done.stderr, r"^sct-train: run/step-154.checkpoint: cannot be written: .*\n$")
        for path in (self.folder / "before").iterdir():
            self.assertEqual((self.folder / "run" / path.name).read_bytes(), path.read_bytes())
        self.assertEqual(len(list((self.folder / "run").iterdir())), 3)
        done = self.run_program(*RUN, "--checkpoint", "run", "--resume", "--output", "whole.bin", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done)
        self.trained(*longer, "--checkpoint", "run", "--resume")


class Configuring(Training):
    def test_options_win_over_the_file(self):
        config = self.file("run.conf", "# small\nhidden = 8\n layers=1 # one block\n\nsteps = 30\nlearning-rate = 0.01\r\n"
                           "roster = tit_for_tat,all_d\nrounds = 10\nwarmup = 0\n")
        told = json.loads(self.trained("--config", config, "--steps", "5", "--format", "json"))["config"]
        self.assertEqual(told["hidden"], "8")
        self.assertEqual(told["layers"], "1")
        self.assertEqual(told["steps"], "5")
        self.assertEqual(told["learning-rate"], "0.01")
        self.assertEqual(told["targets"], "26:36:2")
        self.assertEqual(told["context"], "20")

    def test_the_defaults_are_the_papers(self):
        """What a run tells is what it was given, but for these."""
        told = json.loads(self.trained(*SMALL, "--steps", "2", "--format", "json"))["config"]
        expected = {"data": "tournament", "heads": "1", "context": "20", "weight-decay": "0.0001", "clip": "0.25",
                    "dropout": "0.1", "early": "0.4", "loss": "teacher", "payoffs": "T=5,R=3,P=1,S=0",
                    "held-out": "none", "patience": "0"}
        self.assertEqual({key: told[key] for key in expected}, expected)
        text = self.run_program("--help").stdout
        for key, default in (("hidden", 128), ("layers", 3), ("batch", 64), ("learning-rate", 0.0001),
                             ("warmup", 10000)):
            self.assertRegex(text, rf"--{key} [A-Z][^-]*\(default\s+{default}\)")

    def test_policies_are_judged_as_the_shipped_ones_were(self):
        told = json.loads(self.trained("--hidden", "8", "--layers", "1", "--steps", "2", "--roster", "tit_for_tat,all_d",
                                       "--format", "json"))["config"]
        for name in ("sct", "sct-bayes", "sct-plan"):
            lines = (ROOT / "data" / "policies" / f"{name}.conf").read_text().splitlines()
            shipped = {key.strip(): value.strip() for key, _, value in (line.split("#")[0].partition("=") for line in lines)}
            for key in ("validation-noise", "validation-repetitions"):
                self.assertEqual(told[key], shipped[key], (name, key))

    def test_what_a_misspelt_key_may_mean(self):
        for line, meant in (("hiden = 8", "hidden"), ("learning_rat = 1", "learning-rate"),
                            ("Validation_Noise = 0", "validation-noise"), ("heldout = all_c", "held-out")):
            with self.subTest(line=line):
                self.refused(3, "--config", self.file("bad.conf", line + "\n"),
                             says=(f"unknown key '{line.split()[0]}': did you mean {meant}", "--help"))
        self.refused(3, "--config", self.file("bad.conf", "qwertyuiop = 8\n"), says="unknown key 'qwertyuiop'; ")
        self.refused(2, "--hiden", "8", says="'--hiden': did you mean --hidden")
        self.refused(2, "--roster", "classics", "--learningrate=3", says="did you mean --learning-rate")
        self.refused(2, "--tournament", "classics", program="ipd-tournament", says="'--tournament'")
        self.refused(2, "--nois", "0.1", program="ipd-tournament", says="did you mean --noise")

    def test_the_told_config_gives_the_same_policy(self):
        told = json.loads(self.trained(*SMALL, "--steps", "12", "--format", "json"))["config"]
        self.file("again.conf", "".join(f"{key} = {value}\n" for key, value in told.items()))
        self.trained("--config", "again.conf", "--output", "again.bin")
        self.assertEqual(self.policy(), self.policy("again.bin"))

    def test_bad_lines_are_named(self):
        for line, says in (("hiden = 8", "unknown key 'hiden'"), ("hidden 8", "expected key = value"),
                           ("hidden = x", "hidden 'x': expected a whole number from 1 to 8192"),
                           ("steps = 0", "steps '0'"), ("dropout = 1", "dropout '1'"), ("early = nan", "early 'nan'"),
                           ("loss = best", "expected teacher, selfconf, rmadt or madt"),
                           ("decay = maybe", "expected yes, no or a number of steps"),
                           ("targets = 3:2:1", "FROM:TO:BY"), ("targets = 0:1000:1", "more than 100"),
                           ("targets = 1,x", "'x'"), ("payoffs = T=1,R=2,P=3,S=4", "T > R > P > S"),
                           ("layers = 1\nlayers = 1", "given twice"), ("data =", "expected a value"),
                           ("output = x", "unknown key 'output': it is an option")):
            with self.subTest(line=line):
                config = self.file("bad.conf", "\n# comment\n" + line + "\n")
                number = 2 + len(line.splitlines())
                self.refused(3, "--config", config, says=(f"bad.conf:{number}: ", says))

    def test_files_that_are_none(self):
        self.refused(3, "--config", "missing.conf", says="missing.conf: no such file")
        self.refused(3, "--config", ".", says="is a directory")

    def test_bad_options(self):
        for arguments, says in ((("--hidden", "0"), "--hidden '0'"), (("--steps", "1e30"), "--steps '1e30'"),
                                (("--heads", "3"), "not divided by heads"), (("--roster", "tit_for_tut"), "tit_for_tat"),
                                (("--payoffs", "T=3,R=4,P=2,S=0"), "T > R > P > S"), (("--threads", "0"), "--threads"),
                                (("--validation-seed", "1"), "numbers of their own"), (("--frobnicate",), "frobnicate"),
                                (("--data", "best-reply", "--roster", "random(0.5)"), "random(0.5) mixes"),
                                (("--data", "best-reply", "--roster", 'exec:"cat"'), "opaque player"),
                                (("--data", "folder", "--aggregate-every", "5"), "data = tournament or best-reply"),
                                (("extra",), "unexpected argument 'extra'"), (("--format", "xml"), "--format"),
                                (("--learning-rate", "-1"), "--learning-rate '-1'")):
            with self.subTest(arguments=arguments):
                self.refused(2, *arguments, says=says)

    def test_outputs_that_cannot_be_written_are_refused_before_the_work(self):
        self.refused(4, "--output", "missing/policy.bin", says="no such folder")
        self.refused(4, "--output", ".", says="it is a directory")
        self.file("file", "")
        self.refused(4, *SMALL, "--checkpoint", "file", says="name another")

    def test_what_is_refused_leaves_no_folder(self):
        for arguments in (("--roster", "tit_for_tut"), ("--roster", "tit_for_tut", "--seeds", "1..3"), ("--data", "best-reply", "--roster", "random(0.5)"),
                          ("--roster", "tit_for_tat,all_d", "--held-out", "all_d"), ("--data", ".")):
            with self.subTest(arguments=arguments):
                done = self.run_program(*arguments, "--checkpoint", "a/run", "--steps", "1")
                self.assertIn(done.returncode, (2, 3), done)
                self.assertEqual(list(self.folder.iterdir()), [])
        (self.folder / "run").mkdir()
        self.refused(2, "--roster", "tit_for_tut", "--checkpoint", "run", says="unknown strategy")
        self.assertTrue((self.folder / "run").is_dir())  # it was there before

    def test_an_empty_name_is_no_file(self):
        for option, kind in (("--config", "file"), ("--log", "file"), ("--output", "file"), ("--checkpoint", "folder")):
            self.refused(2, *SMALL, option, "", says=f"{option} '': expected the name of a {kind}")

    def test_training_that_diverges_says_so(self):
        self.refused(2, "--hidden", "8", "--layers", "1", "--learning-rate", "1", "--weight-decay", "1000", "--warmup", "0",
                     "--steps", "400", "--evaluate-every", "1000", "--rounds", "10", says="training has diverged")


class Games(Training):
    """Any symmetric 2x2 game: stag hunt, chicken, another dilemma."""

    # The same without targets: the game says which returns to ask for.
    PLAIN = tuple(word for word in SMALL if word not in ("--targets", "70,90")) + ("--steps", "12")
    CHICKEN = 'NFG 1 R "Chicken" { "A" "B" }\n{ { "Swerve" "Dare" }\n{ "Swerve" "Dare" }\n}\n""\n6 6 7 2 2 7 0 0\n'

    def parts(self, name):
        """What a policy says of itself, and the bytes of its parameters."""
        data = self.policy(name)
        end = 8 + int.from_bytes(data[:8], "little")
        return json.loads(data[8:end])["__metadata__"], data[end:]

    def test_stag_hunt(self):
        game = ROOT / "examples" / "stag_hunt.nfg"
        told = self.trained(*self.PLAIN, "--game", game, "--output", "stag.bin", "--format", "json")
        config = json.loads(told)["config"]
        # Both C pays 4, the most there is; the payoffs range over 4.
        self.assertEqual((config["targets"], config["return-scale"], config["payoffs"]),
                         ("110.4:120:4.8", "80", "T=3,R=4,P=3,S=0"))
        said, _ = self.parts("stag.bin")
        self.assertEqual((said["action_names"], said["payoffs"]), ('["Stag","Hare"]', "T=3,R=4,P=3,S=0"))
        self.file("again.conf", "".join(f"{key} = {value}\n" for key, value in config.items()))
        shown = self.trained("--config", "again.conf", "--output", "again.bin")
        self.assertEqual(self.policy("stag.bin"), self.policy("again.bin"))
        self.assertIn("game: stag hunt, its actions Stag (C) and Hare (D)\n", shown)
        self.assertRegex(shown, r"belief token forced to Stag changes \d+ of its 120 moves, forced to Hare \d+")
        match = ("sct:stag.bin", "all_d", "--rounds", "30")
        self.assertIn("C is Stag, D is Hare", self.run_program(*match, "--game", game, program="ipd-match").stdout)
        self.refused(2, *match, program="ipd-match", says=("T=3,R=4,P=3,S=0", "--extrapolate"))
        self.assertIn("it was trained on 30 rounds of T=3,R=4,P=3,S=0",
                      self.run_program(*match, "--extrapolate", program="ipd-match").stdout)
        claims = self.run_program("stag.bin", "all_d", "--depth", "1", program="sce-check").stdout
        self.assertIn("game stag hunt (T=3,R=4,P=3,S=0), finite:30", claims)
        self.assertIn("C is Stag, D is Hare", claims)

    def test_chicken_with_a_teacher(self):
        self.file("chicken.nfg", self.CHICKEN)
        told = json.loads(self.trained(*self.PLAIN, "--game", "chicken.nfg", "--data", "best-reply", "--targets", "100",
                                       "--format", "json"))
        self.assertEqual(told["config"]["payoffs"], "T=7,R=6,P=0,S=2")
        scores = {one["name"]: one["score"] for one in told["kept"]["opponents"]}
        self.assertTrue(0 <= scores["all_d"] <= 60, scores)  # against Dare for ever at most 2 a round

    def test_payoffs_of_another_size_train_the_same_network(self):
        """Returns are divided by a scale that goes with the payoffs: at twice the payoffs the same numbers come in."""
        self.trained(*self.PLAIN, "--output", "one.bin")
        self.trained(*self.PLAIN, "--payoffs", "T=10,R=6,P=2,S=0", "--output", "two.bin")
        (one, parameters), (two, others) = self.parts("one.bin"), self.parts("two.bin")
        self.assertEqual(parameters, others)
        self.assertEqual((one["return_scale"], two["return_scale"]), ("100", "200"))
        self.assertEqual(2 * float(one["return_target"]), float(two["return_target"]))

    def test_refusals(self):
        self.file("chicken.nfg", self.CHICKEN)
        self.refused(2, "--game", "chicken.nfg", "--payoffs", "T=5,R=3,P=1,S=0", says="contradict")
        self.refused(3, "--config", self.file("bad.conf", "steps = 1\npayoffs = T=7,R=6,P=0,S=2\n"),
                     says=("bad.conf:2: ", "T > R > P > S"))
        self.refused(2, "--game", self.file("same.nfg", self.CHICKEN.replace("6 6 7 2 2 7 0 0", "1 1 1 1 1 1 1 1")),
                     says="no move earns more than another")
        self.refused(2, "--game", self.file("long.nfg", self.CHICKEN.replace("Dare", "D" * 101)), says="cannot be kept")
        self.refused(2, "--game", self.file("other.nfg", self.CHICKEN.replace("7 0 0", "8 0 0")), says="not symmetric")
        self.refused(3, "--game", "nowhere.nfg", says="nowhere.nfg")


class Exploring(Training):
    PLAN = (*SMALL[:-4], "--targets", "0", "--data", "explore", "--opponents", "2*tit_for_tat,all_d,3*memory(1,1)",
            "--return-token", "hidden", "--remembered", "3", "--time-rows", "1", "--plan-depth", "2", "--explore-every", "10",
            "--explore-matches", "12", "--steps", "60", "--evaluate-every", "30", "--checkpoint-every", "5")

    def test_a_planner_is_trained_and_plays(self):
        told = json.loads(self.trained(*self.PLAN, "--format", "json"))
        self.assertEqual(told["matches"], (6 + 2) * 12)
        self.assertEqual((told["config"]["opponents"], told["config"]["plan-depth"]),
                         ("2*tit_for_tat,all_d,3*memory(1,1)", "2"))
        metadata = self.policy()
        for key in (b'"format":"folk-sct-2"', b'"plan_depth":"2"', b'"return_token":"hidden"', b'"time_rows":"1"',
                    b'"observation":"start CC CD DC DD, of each of the last 3 rounds"'):
            self.assertIn(key, metadata)
        match = ("--rounds", "30", "--format", "json")
        scores = [json.loads(self.run_program(player, "all_d", *match, program="ipd-match").stdout)["scores"][0]
                  for player in ("sct:policy.bin", "sct-plan(policy.bin;depth=2)", "sct-plan(policy.bin)")]
        self.assertEqual(len(set(scores)), 1, scores)

    def test_killed_and_resumed_ends_in_the_same_bytes(self):
        self.trained(*self.PLAN, "--output", "whole.bin")
        run = (*self.PLAN, "--checkpoint", "run", "--resume", "--threads", "2")
        process = self.start(*run)
        self.wait_for_checkpoint(process, self.folder / "run", {f"step-{step}.checkpoint" for step in range(20)})
        process.kill()
        process.wait()
        self.trained(*run)
        self.assertEqual(self.policy(), self.policy("whole.bin"))

    def test_refusals(self):
        explore = ("--data", "explore", "--return-token", "hidden")
        self.refused(2, "--data", "explore", says="return-token = hidden")
        self.refused(2, *explore, "--aggregate-every", "5", says="leave aggregate-every")
        self.refused(2, *explore, "--opponents", "0*all_d", says="0*all_d")
        self.refused(2, *explore, "--opponents", "exec:\"cat\"", says="only machines can be learnt about")
        self.refused(2, *explore, "--opponents", "nobody", says="nobody")
        self.refused(2, "--plan-depth", "3", "--loss", "madt", says="no beliefs to plan on")
        self.refused(2, "--return-token", "lost", says="expected shown or hidden")
        self.refused(2, *explore, "--opponents", "all_d,memory(1,2)", "--held-out", "tit_for_tat",
                     says=("tit_for_tat", "may be trained on"))
        self.refused(2, *explore, "--opponents", "all_d", "--held-out", "all_d", says="all_d is met in training")


class Data(Training):
    def arrays(self, rewards=(3, 0), fortran=False):
        """Two matches of two rounds: C C against C D. In Fortran order as Python 2's NumPy wrote it."""
        header = b"\x93NUMPY\x01\x00" + (118).to_bytes(2, "little")

        def array(name, values):
            text = b"{'descr': '|i1', 'fortran_order': False, 'shape': (2, 2), }"
            if fortran:
                text = text.replace(b"False", b"True").replace(b"(2, 2)", b"(2L, 2L)")
                values = (values[0], values[2], values[1], values[3])
            (self.folder / "data" / name).write_bytes(header + text.ljust(117) + b"\n" + bytes(values))

        (self.folder / "data").mkdir(exist_ok=True)
        array("actions.npy", (0, 0, 0, 0))
        array("opponent_actions.npy", (0, 1, 0, 1))
        array("rewards.npy", rewards * 2)

    def test_a_folder(self):
        self.arrays()
        told = json.loads(self.trained("--data", "data/", "--hidden", "8", "--layers", "1", "--steps", "3", "--warmup", "0",
                                       "--format", "json"))
        self.assertEqual(told["matches"], 2)
        self.assertEqual(told["config"]["rounds"], "2")
        self.assertIn(b'"data":"data"', self.policy())
        expected = self.policy()
        self.arrays(fortran=True)  # the same matches, whatever the order of their numbers and the Python that wrote them
        self.trained("--data", "data/", "--hidden", "8", "--layers", "1", "--steps", "3", "--warmup", "0")
        self.assertEqual(self.policy(), expected)
        self.refused(2, "--data", "data", "--rounds", "3", says="have 2: leave rounds out")
        self.refused(2, "--data", "data", "--data-repetitions", "4", says="data-repetitions = 4: the matches of a folder")
        self.trained("--data", "data", "--data-repetitions", "1", "--hidden", "8", "--layers", "1", "--steps", "1")

    def test_regret_weights_need_names(self):
        """Which matches have the same opponent, and so who lost what, only the names say."""
        self.arrays()
        weighed = ("--data", "data", "--hidden", "8", "--layers", "1", "--steps", "3", "--regret-temperature", "3")
        self.refused(2, *weighed, says=("regret-temperature", "data does not name them", "names.json"))
        self.file("data/names.json", '{"players": ["", ""], "opponents": ["x", ""]}')
        self.refused(2, *weighed, says="data does not name them")
        self.file("data/names.json", '{"players": ["", ""], "opponents": ["x", "y"]}')
        self.trained(*weighed)
        self.refused(2, "--data", "best-reply", "--regret-temperature", "3", says="leave it out")

    def test_bad_folders(self):
        self.refused(3, "--data", "nowhere", says="nowhere")
        self.arrays(rewards=(3, 1))
        self.refused(3, "--data", "data", says=("the reward at [0, 1] is 1", "pays 0"))


class HeldOut(Training):
    RUN = (*SMALL, "--steps", "40", "--evaluate-every", "10")

    def test_is_played_and_decides(self):
        plain = json.loads(self.trained(*self.RUN, "--format", "json"))
        told = json.loads(self.trained(*self.RUN, "--held-out", "all_c,per_cd", "--format", "json"))
        self.assertEqual(told["config"]["held-out"], "all_c,per_cd")
        for entry, other in zip(told["evaluations"], plain["evaluations"], strict=True):
            self.assertEqual(entry["action_loss"], other["action_loss"])  # nothing is learnt from it
            for score, alone in zip(entry["targets"], other["targets"], strict=True):
                self.assertEqual({key: score[key] for key in alone}, alone)
            self.assertEqual(entry["best"], max(entry["targets"], key=lambda score: score["held_out_total"]))
        kept = told["kept"]
        self.assertEqual(kept["held_out"]["validation_total"],
                         max(entry["best"]["held_out_total"] for entry in told["evaluations"]))
        self.assertEqual([entry["name"] for entry in kept["held_out"]["opponents"]], ["all_c", "per_cd"])
        rows = list(csv.DictReader(io.StringIO(self.trained(*self.RUN, "--held-out", "all_c,per_cd", "--format", "csv"))))
        self.assertEqual([float(row["held_out_total"]) for row in rows],
                         [entry["best"]["held_out_total"] for entry in told["evaluations"]])
        text = self.run_program(*self.RUN, "--held-out", "all_c,per_cd")
        self.assertIn("the highest held-out total", text.stdout)
        self.assertIn(", held out ", text.stderr)

    def test_what_training_meets_is_refused(self):
        for spec, says in (("all_c,TFT", "tit_for_tat is met in training"), ("Pavlov", "pavlov is met"),
                           ("mem11_cCDCD", "mem11_cCDCD plays as tit_for_tat, which is met"),
                           ("memory(1,1)", "which is met in training"), ("tit_for_tut", "tit_for_tat")):
            with self.subTest(spec=spec):
                self.refused(2, *SMALL, "--held-out", spec, says=says)

    def test_machines_from_files_are_met_as_they_play(self):
        self.file("my.machines", "machine mine\nc C c d\nd D c d\n")  # tit_for_tat
        self.refused(2, *SMALL[:-8], "--roster", "@my.machines,all_d", "--rounds", "30", "--held-out", "tit_for_tat",
                     says="tit_for_tat plays as mine, which is met")
        self.refused(2, *SMALL, "--held-out", "all_c,@my.machines", says="mine plays as tit_for_tat, which is met")

    def test_a_folder_says_whom_training_meets(self):
        """`roster` is played in the evaluations then, and the data's opponents are those that training meets."""
        Data.arrays(self)
        run = ("--data", "data", "--hidden", "8", "--layers", "1", "--steps", "3", "--roster", "all_d", "--held-out", "all_c")
        self.file("data/names.json", '{"players": ["x", "y"], "opponents": ["stranger", "ALL_C"]}')
        self.refused(2, *run, says="held-out: all_c is met in training")
        self.file("data/names.json", '{"players": ["x", "y"], "opponents": ["stranger", "all_d"]}')
        self.trained(*run)
        (self.folder / "data" / "names.json").unlink()
        done = self.run_program(*run)
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("note: data does not name its opponents", done.stderr)

    @unittest.skipIf(SLOW, "the run before this one evaluates as often")
    def test_patience(self):
        run = (*SMALL, "--evaluate-every", "10", "--checkpoint-every", "7", "--held-out", "all_c,per_cd", "--format", "json")
        patient = (*run, "--steps", "2000", "--patience", "2")
        whole = json.loads(self.trained(*patient, "--output", "whole.bin"))
        self.assertTrue(whole["stopped_early"])
        figures = [entry["best"]["held_out_total"] for entry in whole["evaluations"]]
        self.assertLess(whole["evaluations"][-1]["step"], 2000)
        self.assertLessEqual(max(figures[-2:]), max(figures[:-2]))
        end = whole["evaluations"][-1]["step"]
        # In two pieces, the first of which is a shorter run.
        self.trained(*run, "--steps", end - 5, "--checkpoint", "run")
        resumed = json.loads(self.trained(*patient, "--checkpoint", "run", "--resume"))
        self.assertEqual({**resumed, "output": "whole.bin"}, whole)
        self.assertEqual(self.policy(), self.policy("whole.bin"))
        self.trained(*run, "--checkpoint", "run", "--resume", "--steps", end + 10)
        self.refused(2, *patient, "--checkpoint", "run", "--resume", "--quiet", says=f"this run ends at step {end}")

    def test_checkpoints_of_runs_without_it_are_what_they_were(self):
        self.trained(*self.RUN, "--checkpoint", "run")
        data = (self.folder / "run" / "step-40.checkpoint").read_bytes()
        self.assertIn(b"validation-seed = 1000003\nthe data's signature", data)


class Log(Training):
    def test_is_the_table(self):
        run = (*SMALL, "--steps", "50", "--evaluate-every", "20", "--format", "csv")
        self.file("log.csv", "older\n" * 100)
        self.assertEqual(self.trained(*run, "--log", "log.csv"), (self.folder / "log.csv").read_text())
        held_out = self.trained(*run, "--held-out", "all_c", "--log", "log.csv")
        self.assertEqual(held_out, (self.folder / "log.csv").read_text())
        self.assertIn(",held_out_total,", held_out)

    @unittest.skipIf(SLOW, "ten seconds here; test_is_the_table writes the same rows")
    def test_has_its_rows_while_it_runs(self):
        """Killed at any moment it ends with a whole row; the run that goes on neither repeats nor loses one."""
        whole = (*SMALL, "--evaluate-every", "10", "--checkpoint-every", "7")
        self.trained(*whole, "--steps", "130", "--log", "whole.csv", "--output", "whole.bin")
        expected = (self.folder / "whole.csv").read_text()
        rows = [line.rsplit(",", 1)[0] for line in expected.splitlines()]
        log = self.folder / "log.csv"
        run = (*whole, "--log", "log.csv", "--checkpoint", "run", "--resume")
        for seen in (2, 5, 9):
            process = self.start(*run, "--steps", "130")
            while process.poll() is None and (not log.exists() or log.read_text().count("\n") < seen):
                time.sleep(0.001)
            process.kill()
            process.wait()
            text = log.read_text()
            self.assertTrue(text.endswith("\n"), text)
            self.assertEqual([line.rsplit(",", 1)[0] for line in text.splitlines()], rows[: text.count("\n")])
        self.trained(*run, "--steps", "130")
        self.assertEqual(log.read_text(), expected)
        self.assertEqual(self.policy(), self.policy("whole.bin"))
        # A longer run forgets the evaluation that a longer one does not have.
        self.trained(*run, "--steps", "135")
        self.trained(*run, "--steps", "140")
        steps = [row["step"] for row in csv.DictReader(io.StringIO(log.read_text()))]
        self.assertEqual(steps, [str(step) for step in range(10, 141, 10)])

    def test_goes_where_nothing_else_is(self):
        self.file("run.conf", "steps = 5\n")
        self.refused(2, "--log", "policy.bin", says=("--log policy.bin", "--output"))
        self.refused(2, "--config", "run.conf", "--log", "./run.conf", says="--config")
        self.refused(4, "--log", "missing/log.csv", says="--log missing/log.csv: cannot be written: there is no such folder")
        self.refused(4, "--log", ".", says="it is a directory")
        self.trained(*SMALL, "--steps", "5", "--log", "/dev/null")

    @unittest.skipIf(SLOW, "ten seconds here; Resuming has a full disk")
    def test_a_full_disk_ends_the_run_with_whole_rows(self):
        whole = (*SMALL, "--steps", "100", "--evaluate-every", "2")
        size = len(self.trained(*whole, "--format", "csv")) // 2

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        done = self.run_program(*whole, "--log", "log.csv", "--quiet", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done)
        self.assertRegex(done.stderr, r"^sct-train: --log log.csv: cannot be written: .*\n$")
        text = (self.folder / "log.csv").read_text()
        self.assertTrue(text.endswith(("yes\n", "no\n")))


class Seeds(Training):
    RUN = (*SMALL, "--steps", "30", "--evaluate-every", "10", "--checkpoint-every", "7")

    @unittest.skipIf(SLOW, "trains four times; the next test kills such a run")
    def test_are_the_single_runs(self):
        told = json.loads(self.trained(*self.RUN, "--seeds", "2..3,7", "--output", "sct.bin", "--log", "log.csv",
                                       "--checkpoint", "runs", "--format", "json"))
        self.assertEqual(told["seeds"], [2, 3, 7])
        self.assertNotIn("seed", told["config"])
        for run in told["runs"]:
            seed = run["seed"]
            alone = json.loads(self.trained(*self.RUN, "--seed", seed, "--output", "alone.bin", "--log", "alone.csv",
                                            "--format", "json"))
            self.assertEqual(run["output"], f"sct-{seed}.bin")
            del alone["config"]
            self.assertEqual({**run, "output": "alone.bin"}, {"seed": seed, **alone})
            self.assertEqual(self.policy(f"sct-{seed}.bin"), self.policy("alone.bin"))
            self.assertEqual(self.policy(f"log-{seed}.csv"), self.policy("alone.csv"))
            self.assertTrue((self.folder / "runs" / f"seed-{seed}" / "step-30.checkpoint").is_file())
        totals = [run["kept"]["total"] for run in told["runs"]]
        summary = told["summary"]["total"]
        self.assertAlmostEqual(summary["mean"], statistics.mean(totals))
        self.assertAlmostEqual(summary["deviation"], statistics.stdev(totals))
        self.assertEqual((summary["lowest"], summary["highest"]), (min(totals), max(totals)))
        resume = (*self.RUN, "--seeds", "2..3,7", "--output", "sct.bin", "--checkpoint", "runs")
        self.refused(2, *resume, says="give --resume")
        rows = list(csv.DictReader(io.StringIO(self.trained(*resume, "--resume", "--format", "csv"))))
        self.assertEqual([float(row["total"]) for row in rows], totals)
        text = self.trained(*resume, "--resume")
        self.assertRegex(text, r"seed +last step +kept step")
        self.assertRegex(text, r"\n +mean +deviation +lowest +highest\n")

    def test_go_on_where_they_were_killed(self):
        run = (*self.RUN, "--seeds", "4,1", "--checkpoint", "runs", "--resume", "--log", "log.csv")
        process = self.start(*run)
        self.wait_for_checkpoint(process, self.folder / "runs" / "seed-1")
        process.kill()
        process.wait()
        done = self.run_program(*run)
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("seed 1, step ", done.stderr)
        self.trained(*self.RUN, "--seeds", "1,4", "--output", "whole.bin", "--log", "whole.csv")
        for seed in (1, 4):
            self.assertEqual(self.policy(f"policy-{seed}.bin"), self.policy(f"whole-{seed}.bin"))
            self.assertEqual(self.policy(f"log-{seed}.csv"), self.policy(f"whole-{seed}.csv"))

    def test_one_seed_has_no_spread(self):
        told = json.loads(self.trained(*self.RUN, "--seeds", "5", "--loss", "madt", "--format", "json"))
        self.assertIsNone(told["summary"]["total"]["deviation"])
        self.assertIsNone(told["summary"]["belief_accuracy"]["mean"])
        self.assertTrue((self.folder / "policy-5.bin").is_file())

    def test_bad_lists(self):
        for seeds, says in (("", "expected whole numbers"), ("x", "as 1..5 or 1,4,9"), ("1..", "expected whole"),
                            ("..3", "expected whole"), ("1...3", "expected whole"), ("-1", "expected whole"),
                            ("5..3", "the lower seed comes first"), ("1,2,1..3", "1 is there twice"),
                            ("0..18446744073709551615", "more than 1000"), ("1..5000", "more than 1000"),
                            ("1,,2", "expected whole"), ("1000000..1000005", "numbers of their own")):
            with self.subTest(seeds=seeds):
                self.refused(2, *SMALL, "--seeds", seeds, says=says)
        self.refused(2, *SMALL, "--seeds", "1..2", "--seed", "1", says="the one or the other")
        self.refused(4, *SMALL, "--seeds", "1..2", "--output", ".", says="it is a directory")
        self.refused(4, *SMALL, "--seeds", "1..2", "--output", "missing/a.bin", says="missing/a-1.bin")


class Output(Training):
    def test_json(self):
        told = json.loads(self.trained(*SMALL, "--steps", "50", "--evaluate-every", "20", "--format", "json"))
        self.assertEqual([entry["step"] for entry in told["evaluations"]], [20, 40, 50])
        for entry in told["evaluations"]:
            self.assertEqual([score["target"] for score in entry["targets"]], [70, 90])
            self.assertEqual(entry["best"], max(entry["targets"], key=lambda score: score["total"]))
            self.assertGreater(entry["belief_loss"], 0)
            self.assertGreater(entry["action_loss"], 0)
        kept = told["kept"]
        best = max(told["evaluations"], key=lambda entry: (entry["best"]["total"], entry["step"]))  # of equal ones the latest
        self.assertEqual((kept["step"], kept["target"]), (best["step"], best["best"]["target"]))
        self.assertEqual(kept["validation_total"], best["best"]["total"])
        self.assertEqual([entry["name"] for entry in kept["opponents"]], ["tit_for_tat", "all_d", "pavlov", "spiteful"])
        self.assertEqual(kept["total"], sum(entry["score"] for entry in kept["opponents"]))
        self.assertEqual(told["output"], "policy.bin")
        # What it says of its policy is what the tournament says.
        roster = ("--strategies", "tit_for_tat,all_d,pavlov,spiteful", "--rounds", "30", "--include", "sct:policy.bin")
        done = self.run_program(*roster, "--format", "json", program="ipd-tournament")
        tournament = json.loads(done.stdout)
        entry = next(entry for entry in tournament["ranking"] if entry["name"] == "sct:policy.bin")
        self.assertEqual(entry["total_against_roster"], kept["total"])
        accuracies = tournament["belief_accuracy"][4][:4]
        self.assertAlmostEqual(sum(accuracies) / 4, kept["belief_accuracy"], places=12)

    def test_csv(self):
        text = self.trained(*SMALL, "--steps", "50", "--evaluate-every", "20", "--format", "csv")
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual([row["step"] for row in rows], ["20", "40", "50"])
        self.assertEqual(sum(row["kept"] == "yes" for row in rows), 1)

    def test_text_and_progress(self):
        done = self.run_program(*SMALL, "--steps", "20", "--evaluate-every", "10")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("written to policy.bin", done.stdout)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2, lines)
        self.assertRegex(lines[0], r"^step 10 of 20: belief loss 0\.\d+, action loss 0\.\d+; asked for \d+ it earns .* left$")
        self.assertIn("tokens/s", lines[1])

    def test_losses(self):
        """The ablations: which of them have beliefs."""
        for loss, believes in (("teacher", True), ("selfconf", True), ("rmadt", True), ("madt", False)):
            with self.subTest(loss=loss):
                told = json.loads(self.trained(*SMALL, "--steps", "5", "--loss", loss, "--format", "json"))
                self.assertEqual(told["kept"]["belief_accuracy"] is not None, believes)
                layout = b"return observation belief action" if loss != "madt" else b"return observation action"
                self.assertIn(layout, self.policy())

    def test_an_older_policy_is_replaced_at_the_end_only(self):
        self.file("policy.bin", "older")
        process = self.start(*SMALL, "--steps", "1000000", "--evaluate-every", "5")
        process.stderr.readline()
        self.assertEqual(self.policy(), b"older")
        process.kill()
        process.wait()
        self.assertEqual(self.policy(), b"older")
        self.trained(*SMALL, "--steps", "5")
        self.assertNotEqual(self.policy(), b"older")

    def test_the_seed_decides(self):
        run = (*SMALL, "--steps", "10", "--output")
        for name, seed in (("a.bin", "1"), ("b.bin", "1"), ("c.bin", "2")):
            self.trained(*run, name, "--seed", seed)
        self.assertEqual(self.policy("a.bin"), self.policy("b.bin"))
        self.assertNotEqual(self.policy("a.bin"), self.policy("c.bin"))


class Names(Training):
    def setUp(self):
        super().setUp()
        self.trained(*SMALL, "--steps", "20")

    def data(self, name="sct"):
        """An environment in which the policy is a shipped one."""
        (self.folder / "data" / "policies").mkdir(parents=True)
        shutil.copy(self.folder / "policy.bin", self.folder / "data" / "policies" / f"{name}.bin")
        return {**os.environ, "FOLK_DATA": str(self.folder / "data")}

    def test_shipped_names(self):
        for name, typed in (("sct", "SCT"), ("sct-bayes", "SCT_Bayes"), ("sct-plan", "Sct Plan")):
            environment = self.data(name)
            done = self.run_program(typed, "pavlov", "--rounds", "30", "--format",
                                    "json", program="ipd-match", env=environment)
            self.assertEqual(done.returncode, 0, done)
            self.assertEqual(json.loads(done.stdout)["players"][0], name)
            shutil.rmtree(self.folder / "data")

    def test_shipped_names_without_their_files(self):
        (self.folder / "empty").mkdir()
        environment = {**os.environ, "FOLK_DATA": str(self.folder / "empty")}
        done = self.run_program("--include", "sct", program="ipd-tournament", env=environment)
        self.assertEqual(done.returncode, 3, done)
        self.assertRegex(done.stderr, r"^ipd-tournament: sct: there is no .*empty/policies/sct.bin; .* FOLK_DATA .*\n$")
        done = self.run_program("list", program="ipd-strategies", env=environment)
        self.assertEqual(done.returncode, 0, done)
        for name in ("sct:FILE", "\nsct ", "\nsct-bayes ", "\nsct-plan "):
            self.assertIn(name, done.stdout)

    def test_files(self):
        shutil.copy(self.folder / "policy.bin", self.folder / "Policy.bin")
        both = "sct:policy.bin,sct:Policy.bin"  # paths are told apart by their letters
        done = self.run_program("--include", both, "--rounds", "30", "--format", "json", program="ipd-tournament")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("sct:Policy.bin", json.loads(done.stdout)["strategies"])
        twice = ("--include", "sct:policy.bin,sct:policy.bin")
        self.refused(2, *twice, program="ipd-tournament", says="given twice")
        self.refused(3, "--include", "sct:missing.bin", program="ipd-tournament", says="missing.bin: no such file")
        self.refused(2, "--include", "sct:", program="ipd-tournament", says="sct:policy.bin")
        self.file("bad.bin", "no policy")
        self.refused(3, "sct:bad.bin", "all_d", program="ipd-match", says="bad.bin: ")
        self.refused(2, "sct:policy.bin", "-o", "x.svg", program="strategy-graph", says="opaque player")

    def test_planners(self):
        plans = "sct-plan(policy.bin;depth=2),sct-plan(policy.bin)"
        done = self.run_program("--include", plans, "--rounds", "10", "--format", "json", program="ipd-tournament")
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(json.loads(done.stdout)["strategies"][-2:], ["sct-plan(policy.bin;depth=2)", "sct-plan(policy.bin;depth=4)"])
        match = ("--rounds", "10", "--format", "json", "sct-plan(policy.bin;depth=1)", "tit_for_tat")
        played = json.loads(self.run_program(*match, program="ipd-match").stdout)
        # One round ahead D is best whatever is believed, and the beliefs are the policy's own.
        self.assertEqual(played["moves"][0], "D" * 10)
        self.refused(2, "sct-plan(policy.bin;depth=0)", "all_d", program="ipd-match", says="sct-plan depth '0'")
        self.refused(2, "sct-plan(policy.bin;width=2)", "all_d", program="ipd-match", says="expected FILE;depth=H")
        self.refused(2, "sct-plan(;depth=2)", "all_d", program="ipd-match", says="name of a policy's file")
        self.refused(3, "sct-plan(missing.bin)", "all_d", program="ipd-match", says="missing.bin: no such file")
        self.refused(2, "sct-plan(policy.bin;depth=2)", "pavlov", "--rounds", "31", program="ipd-match", says="--extrapolate")

    def test_beyond_its_training(self):
        longer = ("sct:policy.bin", "pavlov", "--rounds", "31")
        self.refused(2, *longer, program="ipd-match", says="--extrapolate")
        done = self.run_program(*longer, "--extrapolate", program="ipd-match")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("extrapolates", done.stdout)
        self.refused(2, "--include", "sct:policy.bin", program="ipd-tournament", says="--extrapolate")
        done = self.run_program("--include", "sct:policy.bin", "--extrapolate", program="ipd-tournament")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("extrapolates", done.stdout)

    def test_sampled_moves(self):
        match = ("sct:policy.bin", "all_d", "--rounds", "30", "--format", "csv")
        moves = [self.run_program(*match, *more, program="ipd-match").stdout
                 for more in ((), ("--seed", "2"), ("--sample",), ("--sample", "--seed", "1"), ("--sample", "--seed", "2"))]
        self.assertEqual(moves[0], moves[1])
        self.assertEqual(moves[2], moves[3])
        self.assertNotEqual(moves[2], moves[4])


if __name__ == "__main__":
    unittest.main()
