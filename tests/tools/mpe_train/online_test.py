"""mpe-train online as its users run it: results, interruptions, refusals. (collect and inspect have tests of their own.)"""

import json
import os
import random
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
SMALL = ["--episodes", "640", "--hidden", "8", "--batch", "64", "--first-update", "1600", "--update-every", "100",
         "--evaluate-every", "128", "--evaluation-episodes", "50"]


def train(*arguments, **options):
    return subprocess.run([BIN / "mpe-train", "online", *arguments], capture_output=True, text=True, timeout=300, **options)


class MpeTrainTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_small(self, name, *more):
        return train(*SMALL, "--output", self.folder / f"{name}.safetensors", "--quiet", *more)

    def files(self, name):
        return {path.name.replace(name, "NAME"): path.read_bytes() for path in sorted(self.folder.glob(f"{name}.*"))
                if path.is_file()}

    def test_writes_policy_curve_and_picture(self):
        run = self.run_small("a", "--format", "json", "--medium", self.folder / "a.medium")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        report = json.loads(run.stdout)
        self.assertEqual(report["settings"]["algorithm"], "matd3")
        self.assertEqual([row["episodes"] for row in report["evaluations"]], [0, 128, 256, 384, 512, 640])
        returns = [row["return"] for row in report["evaluations"]]
        self.assertEqual(report["kept"]["return"], max(returns))
        lines = (self.folder / "a.csv").read_text().splitlines()
        self.assertEqual(lines[0], "episodes,updates,return,standard_error,prey_return,critic_loss,value")
        self.assertEqual([float(line.split(",")[2]) for line in lines[1:]], returns)
        self.assertIn(b"</svg>", (self.folder / "a.svg").read_bytes())
        evaluate = subprocess.run([BIN / "mpe-evaluate", "--predators", self.folder / "a.safetensors", "--prey", "released",
                                   "--episodes", "50", "--seed", "1000003", "--format", "json", "--quiet"],
                                  capture_output=True, text=True)
        self.assertAlmostEqual(json.loads(evaluate.stdout)["results"][0]["return"]["mean"], max(returns), places=9)

    def test_the_same_bytes_whatever_the_threads(self):
        for name, threads in (("one", "1"), ("three", "3")):
            self.assertEqual(self.run_small(name, "--threads", threads).returncode, 0)
        self.assertEqual(self.files("one"), self.files("three"))

    def test_goes_on_after_kill_9(self):
        """Whenever it is killed, and with other threads: the same files."""
        whole = self.run_small("whole", "--medium", self.folder / "whole.medium")
        self.assertEqual(whole.returncode, 0)
        chance = random.Random(1)
        command = [BIN / "mpe-train", "online", *SMALL, "--output", self.folder / "killed.safetensors", "--quiet", "--medium",
                   self.folder / "killed.medium", "--checkpoint", self.folder / "checkpoints", "--checkpoint-every", "64",
                   "--resume"]
        for attempt in range(5):
            process = subprocess.Popen([*command, "--threads", str(1 + attempt % 3)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            time.sleep(chance.uniform(0.01, 0.3))
            process.kill()
            process.wait()
        run = subprocess.run([*command, "--threads", "2"], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stdout.replace("killed", "whole")), (0, whole.stdout))
        self.assertEqual(self.files("whole"), self.files("killed"))

    def test_an_interruption_is_one_line_and_loses_nothing(self):
        process = subprocess.Popen(
            [BIN / "mpe-train", "online", "--episodes", "100000000", *SMALL[2:], "--output", self.folder / "i.safetensors",
             "--checkpoint", self.folder / "checkpoints"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not (self.folder / "i.csv").exists():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=120)
        self.assertEqual((process.returncode, out), (4, ""))
        self.assertRegex(error, r"^mpe-train online: interrupted after episode \d+; the same command with --resume goes on from "
                                r"there\n$")
        self.assertTrue(list((self.folder / "checkpoints").glob("*.checkpoint")))
        self.assertFalse((self.folder / "i.safetensors").exists())

    def test_all_four_together(self):
        run = self.run_small("t", "--prey", "learn", "--prey-output", self.folder / "t.prey", "--scenario", "simple_world")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        evaluate = subprocess.run([BIN / "mpe-evaluate", "--scenario", "simple_world", "--predators",
                                   self.folder / "t.safetensors", "--prey", self.folder / "t.prey", "--episodes", "5", "--quiet"],
                                  capture_output=True, text=True)
        self.assertEqual((evaluate.returncode, evaluate.stderr), (0, ""))

    def test_refusals_are_one_line(self):
        here = self.folder / "x.safetensors"
        (self.folder / "junk").write_bytes(b"junk")
        cases = [
            (["--scenario", "simple_spread"], 2, "scenario 'simple_spread': expected simple_tag or simple_world"),
            (["--algorithm", "ppo"], 2, "--algorithm 'ppo': expected matd3 or maddpg"),
            (["--critic", "both"], 2, "--critic 'both'"),
            (["--prey", "releasd"], 2, "did you mean released?"),
            (["--prey", self.folder / "none.safetensors"], 3, "no such file"),
            (["--prey", self.folder / "junk"], 3, "junk"),
            (["--prey", "lead_pursuit"], 2, "'lead_pursuit'"),
            (["--prey", "exec:\"cat\""], 2, "cannot be trained against"),
            (["--learning-rate", "nan"], 2, "--learning-rate"),
            (["--discount", "1"], 2, "--discount 1: expected a number from 0 to 0.99999"),
            (["--batch", "0"], 2, "--batch 0"),
            (["--episodes", "1e30"], 2, "--episodes '1e30'"),
            (["--seed", "-1"], 2, "--seed '-1'"),
            (["--resume"], 2, "--resume needs the folder of the checkpoints"),
            (["--prey-output", here], 2, "the prey does not learn in this run"),
            (["--prey", "learn", "--medium", self.folder / "m"], 2, "--medium"),
            (["--medium", here], 2, "two results would go to this file"),
            (["--output", self.folder / "no" / "x"], 4, "there is no such folder"),
            (["--picture", self.folder / "x.gif"], 2, ".svg, .png or .pdf"),
            (["extra"], 2, "unexpected argument 'extra'"),
        ]
        for arguments, code, words in cases:
            output = [] if "--output" in arguments else ["--output", here]
            run = train(*SMALL, *output, *arguments) if "--episodes" not in arguments and "--batch" not in arguments \
                else train(*output, *arguments)
            with self.subTest(arguments=arguments):
                self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (code, "", 1), run.stderr)
                self.assertIn(words, run.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["junk"])

    def test_a_checkpoint_of_another_run_is_refused(self):
        keep = ["--checkpoint", self.folder / "checkpoints"]
        self.assertEqual(self.run_small("a", *keep).returncode, 0)
        run = self.run_small("a", *keep)
        self.assertEqual(run.returncode, 2)
        self.assertIn("give --resume to go on with it", run.stderr)
        run = self.run_small("a", *keep, "--resume", "--seed", "2")
        self.assertEqual(run.returncode, 2)
        self.assertIn("seed = 1 there, 2 here", run.stderr)

    def test_curves_of_several_runs(self):
        rows = "episodes,return,prey_return\n0,-3.5,1\n640,20,-20\n"
        for name in ("a", "b"):
            (self.folder / f"{name}.csv").write_text(rows)
        draw = lambda *arguments: subprocess.run([BIN / "mpe-train", "curve", *arguments], capture_output=True, text=True,
                                                 cwd=self.folder)
        run = draw("a.csv", "b.csv", "--output", "c.svg", "--mark", "published=185.6", "--title", "two")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        picture = (self.folder / "c.svg").read_text()
        for words in (">a<", ">b<", "published (185.6)", ">two<", "<title>two</title>", ">Folk 0."):
            self.assertIn(words, picture.replace("</tspan>", "<").replace("\n", ""))
        (self.folder / "broken.csv").write_text(rows + "1280,nan,3\n")
        (self.folder / "back.csv").write_text(rows + "640,1,3\n")
        for arguments, code, words in [(["--output", "d.svg"], 2, "which runs?"), (["a.csv"], 2, "--output"),
                                       (["none.csv", "--output", "d.svg"], 3, "no such file"),
                                       (["broken.csv", "--output", "d.svg"], 3, "broken.csv:4: return 'nan'"),
                                       (["back.csv", "--output", "d.svg"], 3, "back.csv:4: 640 episodes after 640"),
                                       (["a.csv", "--output", "d.svg", "--mark", "x"], 2, "NAME=RETURN"),
                                       (["a.csv", "--output", "d.gif"], 2, ".svg, .png or .pdf")]:
            run = draw(*arguments)
            with self.subTest(arguments=arguments):
                self.assertEqual((run.returncode, run.stderr.count("\n")), (code, 1), run.stderr)
                self.assertIn(words, run.stderr)
        self.assertFalse((self.folder / "d.svg").exists())

    def test_without_a_verb(self):
        run = subprocess.run([BIN / "mpe-train"], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr),
                         (2, "mpe-train: what to do? give online, curve, collect, inspect, offline or study; see mpe-train --help\n"))
        run = subprocess.run([BIN / "mpe-train", "fly"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)


if __name__ == "__main__":
    unittest.main()
