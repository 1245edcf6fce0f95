"""Several ranks of a program under mpirun: the same bytes as one process, one line where something is wrong, and a journal that no
kill loses. FOLK_BIN names the folder of the programs; skipped where there is no mpirun or no component for MPI."""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"]).resolve()
TOURNAMENT = BIN / "ipd-tournament"
MPIRUN = shutil.which("mpirun")
COMPONENTS = list(BIN.parent.glob("lib*/**/libfolk_mpi.so"))
# As the tests may be run by anybody on any machine.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl": "self,vader"}
TREE = Path(__file__).resolve().parents[3]


def run(ranks, *arguments, program=TOURNAMENT, **environment):
    launcher = (MPIRUN, "-n", str(ranks)) if ranks > 1 else ()
    return subprocess.run([*launcher, program, *arguments], capture_output=True, text=True, timeout=120,
                          env={**os.environ, **MPI, **environment}, stdin=subprocess.DEVNULL)


def said(done, program="ipd-tournament"):
    """Folk's own lines among mpirun's."""
    return [line for line in done.stderr.split("\n") if line.startswith(program + ": ")]


class Scratch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class WithoutTheComponent(Scratch):
    """What a launcher says in the environment is enough to see that there are others."""

    def environments(self):
        yield {"OMPI_COMM_WORLD_SIZE": "4", "OMPI_COMM_WORLD_RANK": "{rank}", "OMPI_COMM_WORLD_LOCAL_RANK": "{rank}"}
        yield {"PMIX_RANK": "{rank}", "SLURM_STEP_NUM_TASKS": "4", "SLURM_LOCALID": "{rank}"}

    def test_one_line_instead_of_as_many_tournaments(self):
        program = self.folder / "ipd-tournament"
        shutil.copy(TOURNAMENT, program)
        for names in self.environments():
            for rank in (0, 1):
                done = run(1, program=program, **{name: text.format(rank=rank) for name, text in names.items()})
                self.assertEqual((done.returncode, done.stdout), (4, ""), done)
                self.assertEqual(len(done.stderr.splitlines()), 1 if rank == 0 else 0, done)
                self.assertTrue(rank == 1 or "FOLK_MPI=ON" in done.stderr, done)
        alone = run(1, program=program)
        for plain in ({"SLURM_NTASKS": "4", "SLURM_PROCID": "0"}, {"OMPI_COMM_WORLD_SIZE": "1", "OMPI_COMM_WORLD_RANK": "0"},
                      {"OMPI_COMM_WORLD_SIZE": "4", "OMPI_COMM_WORLD_RANK": "0", "FOLK_MPI": "off"}):
            done = run(1, program=program, **plain)
            self.assertEqual((done.returncode, done.stdout), (0, alone.stdout), done)


@unittest.skipUnless(MPIRUN and COMPONENTS, "no mpirun here, or Folk's component for MPI is not built")
class SameBytes(Scratch):
    def test_of_any_ranks_and_threads(self):
        for form, arguments in (("text", ("--strategies", "memory(1,1)", "--noise", "0.01", "--include", "random(0.3)")),
                                ("csv", ("--strategies", "memory(1,2)", "--by-behaviour", "--criterion", "discounted:0.9")),
                                ("json", ("--class", "memory(3,3)", "--entrants", "pavlov,all_d,per_ddc,gradual",
                                          "--most-kinds", "5000"))):
            asked = (*arguments, "--format", form, "--output", "out")
            folders = {}
            for ranks, threads in ((1, 2), (2, 1), (4, 2)):
                folder = self.folder / f"{form} {ranks}"
                folder.mkdir()
                with_threads = (*asked, "--threads", str(threads)) if form == "csv" else asked  # JSON and text show the command
                done = subprocess.run([*((MPIRUN, "-n", str(ranks)) if ranks > 1 else ()), TOURNAMENT, *with_threads],
                                      cwd=folder, capture_output=True, text=True, timeout=120, env={**os.environ, **MPI})
                self.assertEqual((done.returncode, done.stderr), (0, ""), done)
                files = {path.name: path.read_text() for path in sorted((folder / "out").iterdir())}
                if form == "csv":
                    del files["summary.json"]
                folders[ranks] = (done.stdout, files)
            self.assertIn("per_ddc" if form == "json" else "memory" if form == "text" else "mem12", folders[1][0])
            self.assertGreater(len(folders[1][1]), 0)
            for ranks in (2, 4):
                self.assertEqual(folders[ranks], folders[1], form)

    def test_players_on_pipes_and_policies(self):
        asked = ("--strategies", "tit_for_tat,all_d,sct", "--include",
                 f'exec:"python3 {TREE / "examples" / "tit_for_tat.py"}"', "--repetitions", "1")
        alone, ranks = run(1, *asked), run(2, *asked)
        self.assertEqual((ranks.returncode, ranks.stdout), (0, alone.stdout), ranks)

    def test_populations(self):
        for asked in (("--strategies", "memory(2,1)", "--rounds", "100", "--generations", "30"),
                      ("--strategies", "all_c,all_d,tit_for_tat", "--fixation")):
            alone, ranks = (run(n, *asked, program=BIN / "ipd-evolve") for n in (1, 2))
            self.assertEqual((ranks.returncode, ranks.stdout), (0, alone.stdout), ranks)


@unittest.skipUnless(MPIRUN and COMPONENTS, "no mpirun here, or Folk's component for MPI is not built")
class WhatIsWrong(Scratch):
    def test_is_said_once(self):
        missing = str(self.folder / "missing.machines")
        for code, word, arguments in ((3, "missing", ("--include", "@" + missing)), (2, "standard input", ("--include", "@-")),
                                      (4, "exit status 7", ("--include", 'exec:"exit 7"', "--repetitions", "1"))):
            done = run(3, *arguments)
            self.assertEqual((done.returncode, done.stdout), (code, ""), done)
            self.assertEqual(len(said(done)), 1, done)
            self.assertIn(word, said(done)[0])

    def test_another_command(self):
        done = subprocess.run([MPIRUN, "-n", "1", TOURNAMENT, ":", "-n", "1", TOURNAMENT, "--seed", "2"], text=True,
                              capture_output=True, timeout=60, env={**os.environ, **MPI})
        self.assertEqual((done.returncode, done.stdout, len(said(done))), (2, "", 1), done)
        self.assertIn("rank 1 was given another command", said(done)[0])


@unittest.skipUnless(MPIRUN and COMPONENTS, "no mpirun here, or Folk's component for MPI is not built")
class Kills(Scratch):
    ASKED = ("--strategies", "memory(2,2)", "--criterion", "discounted:0.999", "--no-self-play", "--format", "csv")

    def ranks_of(self, launcher):
        """The ranks that a launcher has started, in order."""
        found = []
        for process in Path("/proc").iterdir():
            try:
                stat = (process / "stat").read_text().rsplit(") ", 1)[1].split()
                environment = (process / "environ").read_bytes().split(b"\0")
            except (OSError, IndexError):
                continue
            if stat[0] != "Z" and int(stat[1]) == launcher:
                rank = [int(text.split(b"=")[1]) for text in environment if text.startswith(b"OMPI_COMM_WORLD_RANK=")]
                found += [(rank[0], int(process.name))] if rank else []
        return [pid for _, pid in sorted(found)]

    def alive(self, pid):
        try:
            return Path(f"/proc/{pid}/stat").read_text().rsplit(") ", 1)[1][0] != "Z"
        except OSError:
            return False

    def end(self, which, number, journal, asked=ASKED):
        """Starts three ranks and sends one of them, or the launcher, a signal once some pieces are kept."""
        with open(self.folder / "said", "w+") as errors:
            process = subprocess.Popen([MPIRUN, "-n", "3", TOURNAMENT, *asked, "--threads", "1", "--journal", str(journal)],
                                       stdout=subprocess.DEVNULL, stderr=errors, env={**os.environ, **MPI})
            while process.poll() is None and not journal.exists():
                time.sleep(0.005)
            ranks = self.ranks_of(process.pid)
            while process.poll() is None and journal.stat().st_size < 150_000:
                time.sleep(0.002)
            try:
                os.kill(process.pid if which is None else ranks[which], number)
            except (ProcessLookupError, IndexError):
                pass  # it was faster
            process.wait(60)
            for _ in range(400):
                if not any(self.alive(pid) for pid in ranks):
                    break
                time.sleep(0.02)
            self.assertFalse([pid for pid in ranks if self.alive(pid)], "nobody stays behind")
            errors.seek(0)
            return process.returncode, errors.read()

    def test_lose_nothing_that_was_kept(self):
        journal = self.folder / "j"
        uninterrupted = run(1, *self.ASKED).stdout
        for which in (0, 1, None):
            journal.unlink(missing_ok=True)
            self.end(which, signal.SIGKILL, journal)
            kept = journal.read_bytes()[:-70_000]  # the last record may be cut off
            self.assertGreater(len(kept), 0)
            # One process goes on, or other ranks.
            done = run(2 if which is None else 1, *self.ASKED, "--journal", str(journal))
            self.assertEqual((done.returncode, done.stdout == uninterrupted), (0, True), done.stderr)
            self.assertTrue(journal.read_bytes().startswith(kept), "it does not start over")
        begun = journal.stat().st_mtime_ns
        self.assertEqual(run(1, *self.ASKED, "--journal", str(journal)).stdout, uninterrupted)
        self.assertEqual(journal.stat().st_mtime_ns, begun, "nothing was played again")

    def test_an_interruption_is_said_once(self):
        code, errors = self.end(None, signal.SIGTERM, self.folder / "j", ("--strategies", "memory(3,1)", "--rounds", "1000"))
        self.assertNotEqual(code, 0)
        self.assertEqual(errors.count("ipd-tournament: interrupted after "), 1, errors)
        self.assertIn("the same command goes on from there", errors)


class Journals(Scratch):
    """Of one process: no launcher is needed."""
    ASKED = ("--strategies", "memory(1,1)", "--rounds", "50")

    def kept(self, *arguments):
        return run(1, *arguments, "--journal", str(self.folder / "j"), "--quiet")

    def test_of_other_work_and_damaged_ones_are_refused(self):
        whole = self.kept(*self.ASKED, "--format", "csv")
        self.assertEqual(whole.returncode, 0, whole)
        journal = self.folder / "j"
        bytes_ = journal.read_bytes()
        for other in (("--strategies", "memory(1,1)", "--rounds", "51"), ("--strategies", "memory(1,2)", "--by-behaviour"),
                      (*self.ASKED, "--no-self-play"), (*self.ASKED, "--include", "random(0.1)")):
            done = self.kept(*other)
            self.assertEqual((done.returncode, done.stdout), (3, ""), done)
            self.assertIn("the journal of another run", done.stderr)
        middle = len(bytes_) // 2
        journal.write_bytes(bytes_[:middle] + bytes([bytes_[middle] ^ 1]) + bytes_[middle + 1:])
        self.assertEqual(self.kept(*self.ASKED).returncode, 3)
        for cut in (len(bytes_) - 1, middle, 100):
            journal.write_bytes(bytes_[:cut])
            self.assertEqual(self.kept(*self.ASKED, "--format", "csv").stdout, whole.stdout)
            self.assertEqual(len(journal.read_bytes()), len(bytes_))


if __name__ == "__main__":
    unittest.main()
