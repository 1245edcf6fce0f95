"""mpe-train collect and mpe-train inspect as their users see them: the files, the same bytes after kill -9 and on any
number of threads, full disks, refusals. FOLK_BIN names the folder of the programs."""

import array
import json
import math
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "mpe-train"
WIDTHS = {"simple_tag": (16, 16, 16, 14), "simple_world": (24, 24, 24, 22)}
# Players that need no file.
PLAYERS = ("--predators", "lead_pursuit", "--prey", "random")

# A prey that stands still. While the file 'slow' exists, it takes its time; while 'hang' does, it waits in its tenth episode.
PREY = """
import os, sys, time
episodes = 0
for line in sys.stdin:
    if line.startswith("end"):
        break
    if line.startswith("episode"):
        episodes += 1
        continue
    if episodes == 10 and os.path.exists("hang"):
        open("hanging", "w").close()
        while os.path.exists("hang"):
            time.sleep(0.01)
    if os.path.exists("slow"):
        time.sleep(0.002)
    print("0 0", flush=True)
"""


def npy(descr, shape, values, fortran=False):
    """The bytes that numpy.save writes."""
    text = f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape!r}, }}"
    text = text.ljust(-(len(text) + 11) % 64 + len(text)) + "\n"
    code = {"<f4": "f", "<f8": "d", "|u1": "B"}[descr]
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode() + array.array(code, values).tobytes()


def numbers(path):
    """(descr, shape, values) of an .npy file."""
    content = path.read_bytes()
    length = struct.unpack("<H", content[8:10])[0]
    header = eval(content[10:10 + length])  # a dictionary of Python
    assert not header["fortran_order"]
    values = array.array({"<f4": "f", "<f8": "d"}[header["descr"]])
    values.frombytes(content[10 + length:])
    return header["descr"], header["shape"], values


class Collecting(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments, **how):
        how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "cwd": self.folder, **how}
        return subprocess.run([PROGRAM, *map(str, arguments)], text=True, timeout=120, **how)

    def start(self, *arguments):
        """A run that goes on beside the test."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        # A program that it plays with outlives it, and holds its stderr, as long as it hangs.
        self.addCleanup(lambda: (self.folder / "hang").unlink(missing_ok=True))
        return process

    def collected(self, *arguments, **how):
        done = self.run_program("collect", *arguments, "--quiet", **how)
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def inspected(self, folder, *arguments):
        done = self.run_program("inspect", folder, *arguments, "--format", "json")
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(done.stderr, "")
        return json.loads(done.stdout)

    def refused(self, code, verb, *arguments, says=(), **how):
        """One line on stderr that names the program and holds `says`, nothing on stdout, the exit code."""
        done = self.run_program(verb, *arguments, **how)
        self.assertEqual(done.returncode, code, done)
        self.assertEqual(done.stdout, "", done)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done)
        self.assertTrue(lines[0].startswith(f"mpe-train {verb}: "), lines[0])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, lines[0])

    def files(self, name):
        return {path.name: path.read_bytes() for path in (self.folder / name).iterdir()}

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def prey(self):
        (self.folder / "prey.py").write_text(PREY)
        return ("--predators", "lead_pursuit", "--prey", f'exec:"{sys.executable} prey.py"')

    def wait_for(self, name, process):
        while not (self.folder / name).exists():
            self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
            time.sleep(0.002)


class Files(Collecting):
    def test_the_layout(self):
        for scenario, widths in WIDTHS.items():
            for dtype, descr in (("float32", "<f4"), ("float64", "<f8")):
                with self.subTest(scenario=scenario, dtype=dtype):
                    name = f"{scenario}-{dtype}"
                    told = json.loads(self.collected("--scenario", scenario, *PLAYERS, "--transitions", 5000, "--dtype", dtype,
                                                     "--output", name, "--format", "json"))
                    folder = self.folder / name
                    expected = {f"{field}_{i}.npy" for field in ("obs", "acs", "rews", "next_obs", "dones") for i in range(4)}
                    self.assertEqual({path.name for path in folder.iterdir()}, expected | {"metadata.json"})
                    for i, width in enumerate(widths):
                        _, shape, now = numbers(folder / f"obs_{i}.npy")
                        self.assertEqual(shape, (5000, width))
                        _, shape, after = numbers(folder / f"next_obs_{i}.npy")
                        self.assertEqual(shape, (5000, width))
                        self.assertEqual(numbers(folder / f"acs_{i}.npy")[:2], (descr, (5000, 2)))
                        self.assertEqual(numbers(folder / f"rews_{i}.npy")[:2], (descr, (5000,)))
                        _, shape, dones = numbers(folder / f"dones_{i}.npy")
                        self.assertEqual((shape, set(dones)), ((5000,), {0}))
                        for row in range(0, 4999):
                            same = after[row * width:(row + 1) * width] == now[(row + 1) * width:(row + 2) * width]
                            self.assertEqual(same, row % 25 != 24, row)
                    metadata = json.loads((folder / "metadata.json").read_text())
                    self.assertEqual((metadata["format"], metadata["format_version"]), ("folk-mpe-data", 1))
                    self.assertEqual((metadata["predators"], metadata["prey"]), ("lead_pursuit", "random"))
                    self.assertEqual((metadata["scenario"], metadata["dtype"]), (scenario, dtype))
                    self.assertEqual((metadata["transitions"], metadata["episodes"], metadata["episode_steps"]), (5000, 200, 25))
                    rewards = numbers(folder / "rews_0.npy")[2]
                    returns = [sum(rewards[k:k + 25]) for k in range(0, 5000, 25)]
                    mean = sum(returns) / 200
                    error = math.sqrt(sum((value - mean)**2 for value in returns) / 199 / 200)
                    for where in (metadata, told, self.inspected(name)):
                        self.assertAlmostEqual(where["predator_return"]["mean"], mean, places=3)
                        self.assertAlmostEqual(where["predator_return"]["standard_error"], error, places=3)
                        self.assertEqual(where["signature"], metadata["signature"])
                    self.assertEqual(told, self.inspected(name))

    def test_the_text(self):
        text = self.collected(*PLAYERS, "--transitions", 2500, "--noise", "0.1", "--output", "set")
        for words in ("set: simple_tag, 2500 transitions, 100 episodes of 25 steps", "20 files of float32, 1.4 MB",
                      "played by lead_pursuit against random, noise 0.1", "seed 1, episodes from 0 on", "predator 0", "signature "):
            self.assertIn(words, text)
        self.assertEqual(self.run_program("inspect", "set").stdout, text)

    def test_threads_do_not_matter(self):
        for dtype in ("float32", "float64"):
            run = (*PLAYERS, "--transitions", 20000, "--noise", "0.2", "--dtype", dtype)
            self.collected(*run, "--threads", 1, "--output", f"one-{dtype}")
            for threads in (2, 3):
                self.collected(*run, "--threads", threads, "--output", f"{threads}-{dtype}")
                self.assertEqual(self.files(f"{threads}-{dtype}"), self.files(f"one-{dtype}"))
        self.assertNotEqual(self.files("one-float32")["obs_0.npy"], self.files("one-float64")["obs_0.npy"])

    def test_episodes_have_their_numbers(self):
        run = (*PLAYERS, "--noise", "0.1")
        self.collected(*run, "--transitions", 5000, "--output", "all")
        self.collected(*run, "--transitions", 2500, "--first-episode", 100, "--output", "second")
        for i in range(4):
            whole = numbers(self.folder / "all" / f"acs_{i}.npy")[2]
            self.assertEqual(whole[5000:], numbers(self.folder / "second" / f"acs_{i}.npy")[2])

    def test_noise_is_the_predators(self):
        still = ("--predators", "still", "--prey", "still", "--transitions", 25000)
        self.collected(*still, "--noise", "0.3", "--output", "noisy")
        actions = [numbers(self.folder / "noisy" / f"acs_{i}.npy")[2] for i in range(4)]
        self.assertEqual(set(actions[3]), {0})
        for predator in actions[:3]:
            self.assertLessEqual(max(map(abs, predator)), 1)
            self.assertAlmostEqual(math.sqrt(sum(u * u for u in predator) / len(predator)), 0.3, delta=0.01)

    def test_levels(self):
        data = self.folder / "data" / "mpe"
        data.mkdir(parents=True)
        header = {"__metadata__": {"format": "folk-mpe-1", "scenario": "simple_tag", "side": "predators", "squash": "tanh"}}
        body = b""
        for agent in range(3):
            for tensor, shape in (("weight", (2, 16)), ("bias", (2,))):
                size = 4 * math.prod(shape)
                header[f"agent{agent}.fc1.{tensor}"] = {"dtype": "F32", "shape": shape, "data_offsets": [len(body), len(body) + size]}
                body += struct.pack(f"<{size // 4}f", *(0.5 if tensor == "bias" else 0 for _ in range(size // 4)))
        text = json.dumps(header).encode()
        policy = struct.pack("<Q", len(text)) + text + body
        (data / "simple_tag_expert.safetensors").write_bytes(policy)
        environment = {**os.environ, "FOLK_DATA": str(self.folder / "data")}
        run = ("--prey", "random", "--transitions", 50, "--format", "json")
        told = json.loads(self.collected(*run, "--level", "expert", "--output", "expert", env=environment))["made"]
        self.assertEqual((told["level"], told["predators"]), ("expert", "expert"))
        self.assertAlmostEqual(numbers(self.folder / "expert" / "acs_0.npy")[2][7], math.tanh(0.5), places=6)
        self.refused(3, "collect", *run, "--level", "medium", "--output", "medium", env=environment,
                     says="simple_tag_medium.safetensors")
        made = [json.loads(self.collected(*run, "--level", "random", "--seed", seed, "--output", f"random-{seed}"))["made"]
                for seed in (1, 2)]
        self.assertEqual([(told["level"], told["predators"]) for told in made],
                         [("random", "untrained(1)"), ("random", "untrained(2)")])
        self.assertNotEqual(self.files("random-1")["acs_0.npy"][:200], self.files("random-2")["acs_0.npy"][:200])
        # A policy of another scenario, or of no scenario at all.
        (self.folder / "policy.safetensors").write_bytes(policy)
        self.refused(3, "collect", "--scenario", "simple_world", "--predators", "policy.safetensors", "--prey", "still", "--output",
                     "wrong", says="a policy for simple_tag, not for simple_world")
        (self.folder / "policy.safetensors").write_bytes(policy[:-4])
        self.refused(3, "collect", "--predators", "policy.safetensors", "--prey", "still", "--output", "wrong",
                     says="policy.safetensors: ")


class Resuming(Collecting):
    RUN = (*PLAYERS, "--transitions", 100000, "--noise", "0.1")

    def test_killed_at_random_and_resumed_it_is_the_same_files(self):
        self.collected(*self.RUN, "--threads", 1, "--output", "whole")
        whole = self.files("whole")
        moments = random.Random(1)
        kills = 0
        for attempt in range(6):
            shutil.rmtree(self.folder / "set", ignore_errors=True)
            process = self.start("collect", *self.RUN, "--output", "set", "--resume", "--threads", attempt % 3 + 1)
            # Where in the work it dies differs from time to time: before the first row, among them, or at the end.
            time.sleep(moments.uniform(0.0, 0.25))
            process.kill()
            kills += process.wait() == -signal.SIGKILL
            if (self.folder / "set").exists():  # whole or not there
                self.assertEqual(self.files("set"), whole)
        self.assertGreater(kills, 0)
        self.collected(*self.RUN, "--output", "set", "--resume", "--threads", 3)
        self.assertEqual(self.files("set"), whole)
        self.assertEqual(self.names(), ["set", "whole"])

    def test_what_was_written_is_kept(self):
        """A program that hangs in its tenth episode holds the run where it can be killed."""
        run = (*self.prey(), "--transitions", 750)
        self.collected(*run, "--output", "whole")
        (self.folder / "hang").touch()
        process = self.start("collect", *run, "--output", "set")
        self.wait_for("hanging", process)
        process.kill()
        process.wait()
        self.assertFalse((self.folder / "set").exists())
        (self.folder / "hang").unlink()
        done = self.run_program("collect", *run, "--output", "set", "--resume", "--threads", 2)
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(done.stderr, "mpe-train collect: 9 of 30 episodes were there already\n")
        self.assertEqual(self.files("set"), self.files("whole"))

    def test_players_that_have_changed(self):
        run = (*self.prey(), "--transitions", 750)
        (self.folder / "hang").touch()
        process = self.start("collect", *run, "--output", "set")
        self.wait_for("hanging", process)
        process.kill()
        process.wait()
        (self.folder / "hang").unlink()
        (self.folder / "prey.py").write_text(PREY.replace("0 0", "0 1"))
        self.refused(2, "collect", *run, "--output", "set", "--resume", says="episode 0 is played otherwise now")
        self.refused(2, "collect", *run, "--output", "set", "--resume", "--seed", 2, says="seed = 1 there, 2 here")
        self.collected(*run, "--output", "set")  # without --resume it begins anew
        self.assertNotIn("set.partial", self.names())
        self.assertEqual(set(numbers(self.folder / "set" / "acs_3.npy")[2]), {0, 1})

    def interrupted(self, number):
        run = (*self.prey(), "--transitions", 25000)
        (self.folder / "slow").touch()
        process = self.start("collect", *run, "--output", "set")
        self.wait_for("set.partial/description.json", process)
        time.sleep(0.2)
        process.send_signal(number)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, err)
        self.assertEqual(out, "")
        self.assertRegex(err, r"^mpe-train collect: interrupted with \d+ of 1000 episodes written; the same command with --resume "
                              r"goes on from there\n$")
        self.assertFalse((self.folder / "set").exists())
        (self.folder / "slow").unlink()
        kept = err.split("with ")[1].split(" of")[0]
        done = self.run_program("collect", *run, "--output", "set", "--resume")
        self.assertEqual(done.returncode, 0, done)
        self.assertIn(f"{kept} of 1000 episodes were there already", done.stderr)

    def test_sigint_leaves_no_folder(self):
        self.interrupted(signal.SIGINT)

    def test_sigterm_leaves_no_folder(self):
        self.interrupted(signal.SIGTERM)

    def test_two_runs_with_one_name(self):
        run = (*self.prey(), "--transitions", 750)
        (self.folder / "hang").touch()
        process = self.start("collect", *run, "--output", "set")
        self.wait_for("hanging", process)
        for resume in ((), ("--resume",)):
            self.refused(4, "collect", *run, "--output", "set", *resume, says="set.partial: another run is writing it")

    def test_a_finished_one(self):
        run = (*PLAYERS, "--transitions", 2500, "--output", "set")
        text = self.collected(*run)
        before = self.files("set")
        self.refused(2, "collect", *run, says="set: it is there already")
        done = self.run_program("collect", *run, "--resume")
        self.assertEqual((done.returncode, done.stdout), (0, text))
        self.assertEqual(done.stderr, "mpe-train collect: set: this very data set is there already\n")
        self.refused(2, "collect", *run, "--resume", "--noise", "0.1", says="noise = 0.0 there, 0.1 here")
        self.assertEqual(self.files("set"), before)
        path = self.folder / "set" / "rews_1.npy"
        path.write_bytes(path.read_bytes()[:-2] + b"\0\0")
        self.refused(3, "collect", *run, "--resume", says="the numbers' signature is")
        self.refused(3, "inspect", "set", says="the numbers' signature is")
        (self.folder / "file").touch()
        self.refused(2, "collect", *PLAYERS, "--output", "file", says="file: it is there already")


class FullDisks(Collecting):
    def test_a_full_disk_leaves_nothing(self):
        small = self.folder / "small"
        small.mkdir()
        mount = shutil.which("mount")
        if os.geteuid() != 0 or mount is None or subprocess.run(
                [mount, "-t", "tmpfs", "-o", "size=1m", "tmpfs", small], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("no small disk can be mounted here")
        self.addCleanup(subprocess.run, ["umount", small], check=True)
        run = (*PLAYERS, "--output", "small/set")
        for resume in ((), ("--resume",)):
            self.refused(4, "collect", *run, "--transitions", 25000, *resume, says=("set.partial/", "make room", "No space left"))
            self.assertEqual(list(small.iterdir()), [])
        self.collected(*run, "--transitions", 250)
        self.assertEqual([path.name for path in small.iterdir()], ["set"])

    def test_files_that_may_not_grow(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))

        self.refused(4, "collect", *PLAYERS, "--output", "set", "--transitions", 25000, preexec_fn=limit,
                     says=("set.partial/obs_0.npy", "make room", "File too large"))
        self.assertEqual(self.names(), [])

    def test_places_that_cannot_be_written(self):
        (self.folder / "file").touch()
        self.refused(4, "collect", *PLAYERS, "--output", "file/set", says="file/set.partial: cannot be made")
        self.refused(4, "collect", *PLAYERS, "--output", "/proc/set", says="/proc/set.partial: cannot be made")

    def test_a_player_that_fails_leaves_nothing(self):
        self.refused(4, "collect", "--predators", "lead_pursuit", "--prey", 'exec:"false"', "--output", "set", says='exec:"false"')
        self.assertEqual(self.names(), [])


class Usage(Collecting):
    def test_bad_options(self):
        for arguments, says in (((), "--level or --predators"), (("--level", "expert", "--predators", "still"), "give one of them"),
                                (("--level", "best"), "--level 'best': expected random, medium or expert"),
                                (("--predators", "lead_pursit"), "lead_pursuit"),
                                (("--predators", "still", "--prey", "lead_pursuit"), "the prey"),
                                ((*PLAYERS, "--scenario", "simple_spread"), "simple_tag or simple_world"),
                                ((*PLAYERS, "--transitions", "26"), "a multiple of it is needed: 25"),
                                ((*PLAYERS, "--transitions", "24"), "--transitions '24'"),
                                ((*PLAYERS, "--transitions", "1e30"), "--transitions '1e30'"),
                                ((*PLAYERS, "--noise", "-0.1"), "--noise '-0.1'"), ((*PLAYERS, "--noise", "nan"), "--noise 'nan'"),
                                ((*PLAYERS, "--dtype", "float16"), "expected float32 or float64"),
                                ((*PLAYERS, "--reward-rule", "mine"), "expected program or paper"),
                                ((*PLAYERS, "--seed", "-1"), "--seed '-1'"), ((*PLAYERS, "--threads", "0"), "--threads '0'"),
                                ((*PLAYERS, "--format", "csv"), "--format 'csv'"), ((*PLAYERS, "extra"), "unexpected argument 'extra'"),
                                ((*PLAYERS, "--frobnicate"), "frobnicate")):
            with self.subTest(arguments=arguments):
                self.refused(2, "collect", "--output", "set", *arguments, says=says)
        self.refused(2, "collect", *PLAYERS, says="Give --output DIR")
        self.refused(2, "inspect", says="give its folder")
        self.refused(2, "inspect", "a", "b", says="unexpected argument 'b'")
        self.refused(2, "inspect", "a", "--scenario", "tag", says="simple_tag or simple_world")
        self.assertEqual(self.names(), [])

    def test_help(self):
        for verb in ("collect", "inspect"):
            done = self.run_program(verb, "--help")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(done.stdout.startswith(f"Usage: mpe-train {verb} "), done.stdout)


class OthersData(Collecting):
    """Data sets that another program has written."""

    def write(self, **changes):
        """Two episodes of simple_tag as numpy would store them; `changes` replace files by their bytes or remove them."""
        source = random.Random(4)
        folder = self.folder / "set"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for i, width in enumerate(WIDTHS["simple_tag"]):
            episodes = [[[source.uniform(-1, 1) for _ in range(width)] for _ in range(26)] for _ in range(2)]
            now = [x for episode in episodes for row in episode[:-1] for x in row]
            after = [x for episode in episodes for row in episode[1:] for x in row]
            made = {f"obs_{i}": npy("<f8", (50, width), now), f"next_obs_{i}": npy("<f4", (50, width), after),
                    f"acs_{i}": npy("<f4", (50, 2), [0.5] * 100), f"rews_{i}": npy("<f8", (50, 1), range(50)),
                    f"dones_{i}": npy("|u1", (50,), [0] * 50)}
            for name, content in made.items():
                (folder / f"{name}.npy").write_bytes(content)
        for name, content in changes.items():
            path = folder / name.replace("__", ".")
            if content is None:
                path.unlink()
            else:
                path.write_bytes(content)

    def test_they_are_read(self):
        self.write()
        told = self.inspected("set")
        self.assertEqual((told["scenario"], told["transitions"], told["episodes"]), ("simple_tag", 50, 2))
        self.assertIsNone(told["made"])
        self.assertEqual(told["predator_return"]["mean"], sum(range(50)) / 2)
        self.assertEqual([file["dtype"] for file in told["files"][:5]], ["float64", "float32", "float64", "float32", "|u1"])
        self.assertIn("it does not say who played", self.run_program("inspect", "set").stdout)
        self.assertEqual(self.inspected("set", "--scenario", "simple_tag", "--threads", 2), told)

    def test_what_is_wrong_is_named(self):
        short = range(40)
        for changes, says in (({"acs_1__npy": None}, "1 of the 20 files of a data set is missing: acs_1.npy"),
                              ({"obs_0__npy": None, "dones_3__npy": None}, "missing: obs_0.npy, dones_3.npy"),
                              ({"acs_2__npy": npy("<f4", (50, 5), [0] * 250)}, "set/acs_2.npy: shape (50, 5): expected (50, 2)"),
                              ({"rews_0__npy": npy("<f4", (40,), short)}, "set/rews_0.npy: shape (40): expected (50)"),
                              ({"obs_3__npy": npy("<f4", (50, 15), [0] * 750)}, "are of no scenario"),
                              ({"rews_2__npy": npy("<f4", (50,), [0] * 7 + [math.nan] + [0] * 42)}, "set/rews_2.npy: nan at [7]"),
                              ({"acs_0__npy": npy("<f8", (50, 2), [0] * 99 + [math.inf])}, "set/acs_0.npy: inf at [49, 1]"),
                              ({"dones_1__npy": npy("<f4", (50,), [2] * 50)}, "set/dones_1.npy: 2 at [0]: expected 0 or 1"),
                              ({"acs_3__npy": npy("<f4", (50, 2), [0] * 100, True)}, "set/acs_3.npy: in Fortran order"),
                              ({"acs_3__npy": npy("|u1", (50, 2), [0] * 100)}, "set/acs_3.npy: numbers of type |u1"),
                              ({"next_obs_1__npy": npy("<f4", (50, 16), [0] * 800)},
                               "set/next_obs_1.npy: row 0 is not row 1 of obs_1.npy"),
                              ({"rews_1__npy": b""}, "set/rews_1.npy: an empty file"),
                              ({"rews_1__npy": b"\x93NUMPY"}, "set/rews_1.npy: ends within its header"),
                              ({"rews_1__npy": bytes(range(256))}, "set/rews_1.npy: no .npy file"),
                              ({"rews_1__npy": npy("<f4", (50,), [0] * 50)[:-1]}, "set/rews_1.npy: 199 bytes of numbers"),
                              ({"metadata__json": b"{"}, "set/metadata.json: no JSON object")):
            with self.subTest(says=says):
                self.write(**changes)
                self.refused(3, "inspect", "set", says=says)
        self.refused(3, "inspect", "nowhere", says="nowhere: no such folder")
        self.write()
        self.refused(3, "inspect", "set", "--scenario", "simple_world", says="a data set of simple_tag: expected one of simple_world")

    def test_episodes_of_another_length(self):
        """Fifty steps in one episode; said to be so, they are taken on request, and then refused for their signature."""
        self.write()
        for i, width in enumerate(WIDTHS["simple_tag"]):
            rows = [[random.Random(100 * i + t).uniform(-1, 1)] * width for t in range(51)]
            for name, part in (("obs", rows[:-1]), ("next_obs", rows[1:])):
                (self.folder / "set" / f"{name}_{i}.npy").write_bytes(npy("<f4", (50, width), [x for row in part for x in row]))
        self.refused(3, "inspect", "set", says="an episode goes on beyond 25 steps")
        self.collected(*PLAYERS, "--transitions", 50, "--output", "made")
        metadata = json.loads((self.folder / "made" / "metadata.json").read_text())
        metadata.update(episode_steps=50, episodes=1)
        (self.folder / "set" / "metadata.json").write_text(json.dumps(metadata))
        self.refused(3, "inspect", "set", says="metadata.json: episodes of 50 steps: expected 25")
        self.refused(3, "inspect", "set", "--any-length", says="the numbers' signature is")
        del metadata["format"]
        (self.folder / "set" / "metadata.json").write_text(json.dumps(metadata))
        self.refused(3, "inspect", "set", "--any-length", says="an episode goes on beyond 25 steps")


if __name__ == "__main__":
    unittest.main()
