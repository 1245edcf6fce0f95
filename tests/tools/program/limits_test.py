"""Every program where the system gives it too little: memory, threads, open files, stack, file sizes, standard streams, disk.
It does its work or says in a line why not; it never dies of a signal, hangs, or leaves a file behind that is not whole.
FOLK_BIN names the folder of the programs."""

import os
import pwd
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
SLOW = "FOLK_SANITIZED" in os.environ
KB, MB = 1 << 10, 1 << 20
PLAYER = ("while read -r what own theirs rest; do case $what in game) answer=C;; round) answer=$theirs;;"
          " move) echo $answer;; end) exit 0;; esac; done")
# A short run of each program, and the files it leaves when all is well.
RUNS = {
    "ipd-tournament": (("--strategies", "classics", "--rounds", "20", "--threads", "4", "--output", "out"),
                       {"out/ranking.csv", "out/scores.csv", "out/cooperation.csv", "out/pairs.csv", "out/summary.json"}),
    "ipd-evolve": (("--strategies", "all_c,all_d,tit_for_tat", "--rounds", "20", "--threads", "4", "--output", "out", "--journal", "j"),
                   {"out/ranking.csv", "out/populations.csv", "out/cooperation.csv", "out/summary.json", "j"}),
    "ipd-judge": ((str(Path(__file__).resolve().parents[3] / "examples/language_model.csv"), "--threads", "4", "--output", "out"),
                  {"out/report.html", "out/report.json"}),
    "ipd-match": ((f'exec:"{PLAYER}"', "pavlov", "--rounds", "5"), set()),
    "ipd-strategies": (("list", "--format", "csv"), set()),
    "strategy-graph": (("mem2", "-o", "a.dot"), {"a.dot"}),
    "payoff-region": (("--discount", "0.6", "--format", "json"), set()),
    "sce-check": (("pavlov", "tit_for_tat", "--rounds", "10", "--threads", "4", "--output", "out"),
                  {"out/report.html", "out/report.json"}),
    "sct-train": (("--hidden", "8", "--layers", "1", "--steps", "4", "--batch", "4", "--roster", "all_c,all_d", "--rounds", "5",
                   "--evaluate-every", "2", "--quiet", "--checkpoint-every", "2", "--checkpoint", "run", "--threads", "4", "--output", "p.bin"),
                  {"p.bin", "run/lock", "run/step-2.checkpoint", "run/step-4.checkpoint"}),
    "mpe-evaluate": (("--predators", "lead_pursuit", "--prey", "still", "--episodes", "70", "--threads", "4", "--output", "out"),
                     {"out/results.csv", "out/results.json", "out/episodes.csv"}),
}


def processes():
    """Of programs that should be gone."""
    return [path for path in Path("/proc").glob("[0-9]*/cmdline") if PLAYER.encode() in reading(path)]


def reading(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""


@unittest.skipIf(SLOW, "each program starts hundreds of times")
class Limits(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.count = 0

    def fresh(self):
        self.count += 1
        folder = self.folder / str(self.count)
        folder.mkdir()
        folder.chmod(0o777)
        return folder

    def files(self, folder):
        return {str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir()}

    def sound(self, program, done, files):
        """What may come of a run."""
        code, error = done.returncode, done.stderr
        self.assertIn(code, (0, 4), (program, done))
        if code != 0:
            lines = [line for line in error.splitlines() if ": note: " not in line]
            self.assertEqual(len(lines), 1, (program, error))
            self.assertTrue(lines[0].startswith(f"{program}: "), error)
        self.assertLessEqual(files, RUNS[program][1], program)
        if code == 0:
            self.assertEqual(files, RUNS[program][1], program)

    def tried(self, program, limit=None, **how):
        """One run under a limit; nothing when the system cannot even start the program so."""
        def run(arguments, folder):
            return subprocess.run([BIN / program, *arguments], stdin=subprocess.DEVNULL, text=True, errors="replace", timeout=60,
                                  cwd=folder, preexec_fn=limit, **{"capture_output": True, **how})
        try:
            if limit is not None and not 0 <= run(("--version",), self.folder).returncode <= 4:
                return None
        except (OSError, subprocess.SubprocessError):
            return None
        folder = self.fresh()
        done = run(RUNS[program][0], folder)
        self.sound(program, done, self.files(folder))
        shutil.rmtree(folder)
        return done.returncode

    def under(self, what, amounts, becoming=None):
        """How each program ends under less and less of something."""
        ends = {}
        for program in RUNS:
            for amount in amounts:
                def limit(amount=amount):
                    resource.setrlimit(what, (amount, amount))
                    if becoming is not None:
                        os.setgid(becoming.pw_gid)
                        os.setuid(becoming.pw_uid)
                with self.subTest(program=program, amount=amount):
                    ends[program, amount] = self.tried(program, limit)
        return ends

    def test_all_is_well_without_limits(self):
        for program in RUNS:
            self.assertEqual(self.tried(program), 0)

    def test_memory(self):
        megabytes = (16, 20, 24, 28, 32, 60, 200, 2000)
        ends = self.under(resource.RLIMIT_AS, [n * MB for n in megabytes])
        self.assertIn(4, ends.values())
        self.assertEqual({ends[program, 2000 * MB] for program in RUNS}, {0})

    def test_threads(self):
        """Root may have any number: somebody else is asked."""
        nobody = pwd.getpwnam("nobody") if os.getuid() == 0 else None
        ends = self.under(resource.RLIMIT_NPROC, range(6), nobody)
        if set(ends.values()) == {None}:
            self.skipTest("the programs lie where nobody may look")
        self.assertIn(0, ends.values())

    def test_open_files(self):
        ends = self.under(resource.RLIMIT_NOFILE, (3, 4, 5, 6, 8, 11, 15))
        self.assertIn(4, ends.values())

    def test_stack(self):
        ends = self.under(resource.RLIMIT_STACK, [n * KB for n in (64, 128, 256, 512, 1024)])
        self.assertEqual({ends[program, 1024 * KB] for program in RUNS}, {0})

    def test_file_sizes(self):
        ends = self.under(resource.RLIMIT_FSIZE, [0, 1, 100, KB, 2 * KB, 4 * KB, 16 * KB, 64 * KB])
        self.assertEqual(ends["ipd-tournament", KB], 4)

    def test_closed_streams(self):
        for program in RUNS:
            for closed in range(1, 8):
                numbers = [number for number in range(3) if closed >> number & 1]
                with self.subTest(program=program, closed=numbers):
                    folder = self.fresh()
                    run = " ".join(f"{number}>&-" for number in numbers)
                    done = subprocess.run(["sh", "-c", f'exec "$0" "$@" {run}', BIN / program, *RUNS[program][0]], cwd=folder,
                                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
                    self.assertIn(done.returncode, (0, 4), done)
                    self.assertLessEqual(self.files(folder), RUNS[program][1])
                    for path in folder.rglob("lock"):
                        self.assertEqual(path.read_bytes(), b"")  # nothing is written where a stream should be
                    shutil.rmtree(folder)

    def test_full_disks(self):
        probe = subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "none", self.folder], capture_output=True)
        if probe.returncode != 0:
            self.skipTest("no small disk can be made here")
        ends = set()
        for program in RUNS:
            if not RUNS[program][1]:
                continue
            for size in (4, 8, 12, 20, 40, 60, 100, 200):
                with self.subTest(program=program, kilobytes=size):
                    folder = self.fresh()
                    script = (f'mount -t tmpfs -o size={size}k none "{folder}" && cd "{folder}" && "$0" "$@"; code=$?;'
                              ' find . ! -type d; exit $code')
                    done = subprocess.run(["unshare", "-m", "sh", "-c", script, BIN / program, *RUNS[program][0]], capture_output=True, text=True, timeout=60)
                    found = {line[2:] for line in done.stdout.splitlines() if line.startswith("./")}
                    self.sound(program, done, found)
                    ends.add(done.returncode)
        self.assertEqual(ends, {0, 4})

    def tearDown(self):
        self.assertEqual(processes(), [])


if __name__ == "__main__":
    sys.exit(unittest.main())
