"""Programs on a pipe as users meet them: what is written unasked, who is slow, who stays, and what becomes of them when Folk is
killed. FOLK_BIN names the folder of the programs."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
OPENS_UNASKED = """
import sys
print("C", flush=True)
last = "C"
for line in sys.stdin:
    word = line.split()
    if word[0] == "round":
        last = word[2]
    elif word[0] == "move":
        print(last, flush=True)
    elif word[0] == "end":
        break
"""
# Answers C to each question once it has started, and stays when it is told to end.
STAYS = """
import os, sys, time
open("id", "w").write(str(os.getpid()))
time.sleep({start})
for line in sys.stdin:
    if line.startswith("move"):
        print("C", flush=True)
    elif line.startswith("end"):
        break
time.sleep({stay})
"""


def match(*arguments, **how):
    return subprocess.run([BIN / "ipd-match", *arguments, "--rounds", "5", "--quiet"], capture_output=True, text=True, timeout=60, **how)


def lives(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class PipePlayers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, text):
        (self.folder / "player.py").write_text(text)
        return f"{sys.executable} -S player.py"

    def id(self):
        while not (self.folder / "id").exists() or not (self.folder / "id").read_text():
            time.sleep(0.002)
        return int((self.folder / "id").read_text())

    def assertEnds(self, process):
        end = time.monotonic() + 20
        while lives(process):
            self.assertLess(time.monotonic(), end, "it still runs")
            time.sleep(0.005)

    def test_one_answer_too_many_is_always_found(self):
        name = f'exec:"{self.program(OPENS_UNASKED)}"'
        for _ in range(8):
            done = match(name, "pavlov", cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout), (4, ""))
            self.assertIn("only the line 'move' wants an answer", done.stderr)
        done = subprocess.run([BIN / "ipd-tournament", "--strategies", f"pavlov,{name}", "--rounds", "5"], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (4, ""))

    def test_who_starts_slowly_has_a_limit_of_its_own(self):
        command = self.program(STAYS.format(start=0.5, stay=0))
        self.assertEqual(match(f'exec("{command}";timeout=0.3;start=30)', "pavlov", cwd=self.folder).returncode, 0)
        done = match(f'exec("{command}";timeout=0.1;start=0.2)', "pavlov", cwd=self.folder)
        self.assertEqual(done.returncode, 4)
        self.assertIn("silent for 0.2 s", done.stderr)

    def test_who_stays_or_leaves_its_group_is_killed(self):
        for leave in ("", "import os; os.setpgid(0, os.getpgid(os.getppid()))\n"):
            done = match(f'exec:"{self.program(leave + STAYS.format(start=0, stay=1000))}"', "pavlov", cwd=self.folder)
            self.assertEqual(done.returncode, 0)
            self.assertEnds(self.id())

    def test_nobody_outlives_folk(self):
        """Nor does what it has started."""
        deaf = ("import os, signal, subprocess, time\nfor s in (signal.SIGINT, signal.SIGTERM): signal.signal(s, signal.SIG_IGN)\n"
                "other = subprocess.Popen(['sleep', '1000'])\nopen('other', 'w').write(str(other.pid))\n"
                "open('id', 'w').write(str(os.getpid()))\ntime.sleep(1000)\n")
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
            for program, arguments in (("ipd-match", ("pavlov",)), ("ipd-tournament", ("--strategies", "pavlov", "--include"))):
                with self.subTest(number=number, program=program):
                    (self.folder / "id").unlink(missing_ok=True)
                    process = subprocess.Popen([BIN / program, *arguments, f'exec:"{self.program(deaf)}"'], cwd=self.folder,
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                    players = [self.id(), int((self.folder / "other").read_text())]
                    process.send_signal(number)
                    process.wait(timeout=60)
                    for player in players:
                        self.assertEnds(player)

    def test_nothing_starts_before_the_command_line_is_understood(self):
        for arguments in (('exec:"touch STARTED"', "nonsense"), ("nonsense", 'exec:"touch STARTED"'),
                          ('exec:"touch STARTED"', "pavlov", "--noise", "2"), ('exec:"touch STARTED"', "pavlov", "--nosuch")):
            self.assertEqual(match(*arguments, cwd=self.folder).returncode, 2)
        self.assertFalse((self.folder / "STARTED").exists())

    def test_who_is_called_deterministic_is_treated_so(self):
        """Plays once, is judged as a policy is, and is made an automaton of."""
        name = f'exec("{self.program(STAYS.format(start=0, stay=0))}";deterministic)'
        done = subprocess.run([BIN / "ipd-tournament", "--strategies", f"pavlov,{name}", "--format", "csv"], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual(done.stdout.count(",played,"), 2, done)
        done = subprocess.run([BIN / "sce-check", name, "pavlov", "--rounds", "6", "--depth", "1", "--extract", "--output", "out"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("1      100.00 %    100.00 %", done.stdout)
        self.assertEqual(len(list((self.folder / "out").glob("*.machines"))), 1)


if __name__ == "__main__":
    unittest.main()
