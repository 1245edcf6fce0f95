"""Every program's exact runs against tests/data/signatures.txt: no change of what they compute passes unsaid.
FOLK_BIN names the folder of the programs. With --record the file gets the signatures of these programs instead; see
scripts/record-signatures."""

import hashlib
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"]).resolve()
ROOT = Path(__file__).resolve().parents[3]
RECORD = ROOT / "tests" / "data" / "signatures.txt"
PRINTED = re.compile(r'^signature ([0-9a-f]{16})$|^ *"signature": "([0-9a-f]{16})"', re.MULTILINE)


def signature(command, folder):
    """What a program says is its signature, or else the beginning of the SHA-256 of all that it prints; of a command
    that begins with "rounded" the latter without the former. A run happens in an empty folder; ROOT/ in a command is
    this tree."""
    rounded = command.startswith("rounded ")
    program, *arguments = shlex.split(command)[rounded:]
    arguments = [argument.replace("ROOT/", f"{ROOT}/") for argument in arguments]
    done = subprocess.run([BIN / program, *arguments], cwd=folder, capture_output=True, timeout=120, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\nended with {done.returncode}: {done.stderr.decode()}")
    printed = done.stdout.decode()
    if not rounded and (found := PRINTED.search(printed)):
        return "".join(filter(None, found.groups()))
    return hashlib.sha256(PRINTED.sub("", printed).encode()).hexdigest()[:16]


def recorded():
    """The lines of the record, as (signature, command) or as they are."""
    lines = RECORD.read_text(encoding="utf-8").splitlines()
    return [line if not line or line.startswith("#") else tuple(line.split(None, 1)) for line in lines]


def runs():
    """(command, recorded signature, signature now)"""
    for line in recorded():
        if isinstance(line, tuple):
            with tempfile.TemporaryDirectory() as folder:
                yield line[1], line[0], signature(line[1], folder)


class Signatures(unittest.TestCase):
    def test_are_the_recorded_ones(self):
        for command, before, now in runs():
            with self.subTest(command):
                self.assertEqual(now, before, "if it should be another now, say why and run scripts/record-signatures")

    def test_are_recorded_of_every_program_that_has_exact_runs(self):
        programs = {line[1].removeprefix("rounded ").split()[0] for line in recorded() if isinstance(line, tuple)}
        there = {path.name for path in BIN.iterdir() if path.is_file() and os.access(path, os.X_OK)}
        self.assertEqual(there - programs - {"folk-bench"}, {"sct-train"}, "see tests/data/signatures.txt for why this one has none")


def record():
    now = {command: signature for command, _, signature in runs()}
    lines = [line if isinstance(line, str) else f"{now[line[1]]}  {line[1]}" for line in recorded()]
    changed = sum(now[line[1]] != line[0] for line in recorded() if isinstance(line, tuple))
    RECORD.write_text("".join(line + "\n" for line in lines), encoding="utf-8")
    print(f"{changed} of {len(now)} signatures are new in {RECORD}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--record"]:
        record()
    else:
        unittest.main()
