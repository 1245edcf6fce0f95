"""mpe-train study as its users run it, with the budget smoke: the tables and the page, nothing done twice, the same files after
kill -9 in any phase, refusals, full disks. FOLK_BIN names the folder of the programs."""

import csv
import fcntl
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from html.parser import HTMLParser
from pathlib import Path

PROGRAM = Path(os.environ["FOLK_BIN"]) / "mpe-train"
SLOW = "FOLK_SANITIZED" in os.environ
JOBS = 64
# Three short jobs, one of each kind: a player, a learner, a transformer.
FEW = ("--only", "released,simple_tag,none,expert,random_play,omar,sct")
FEW_JOBS = ["released-simple_tag-expert-omar-1", "released-simple_tag-expert-sct-1", "released-simple_tag-none-random_play-1"]
SCENARIOS, LEVELS, PREYS = ("simple_tag", "simple_world"), ("expert", "medium", "random"), 5
LEARNERS = ("omar", "bc", "ma-bcq", "madt", "rmadt", "sct")


def study(folder, *arguments, **how):
    return subprocess.run([PROGRAM, "study", "--budget", "smoke", "--output", folder, *arguments], capture_output=True, text=True,
                          timeout=600, **how)


def files(folder, parts=("",)):
    """All that a study leaves, by name; locks are of processes."""
    return {str(path.relative_to(folder)): path.read_bytes() for part in parts for path in sorted((folder / part).rglob("*"))
            if path.is_file() and path.name != "lock"}


def results(folder):
    """The files of which a study's readers know."""
    return {name: content for name, content in files(folder).items() if not name.startswith("work/")}


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def done(self, *arguments, **how):
        run = study(*arguments, **how)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def one_line(self, run, code, words):
        self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (code, "", 1), run)
        self.assertTrue(run.stderr.startswith("mpe-train study: ") and run.stderr[:-1].isprintable(), run.stderr)
        self.assertIn(words, run.stderr)


class Page(HTMLParser):
    """Checks that every element ends where it should, and collects what is fetched from elsewhere."""
    VOID = {"meta", "img", "br", "hr", "link", "input", "source", "wbr"}

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.faults, self.fetched, self.tags, self.texts = [], [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        names = [name for name, _ in attributes]
        if len(names) != len(set(names)):
            self.faults.append(f"{tag}: an attribute twice")
        self.fetched += [value for name, value in attributes if name in ("src", "href", "srcset", "data", "action")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")

    def handle_data(self, text):
        if "style" not in self.open:
            self.texts.append(text)


@unittest.skipIf(SLOW, "the whole study takes minutes here")
class Whole(Study):
    """One complete study, which all look at."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.whole = Path(scratch.name) / "whole"
        cls.run_of_it = study(cls.whole, "--threads", "2")

    def rows(self, name):
        with (self.whole / name).open(newline="") as file:
            table = list(csv.reader(file))
        self.assertTrue(all(len(row) == len(table[0]) for row in table))
        return [dict(zip(table[0], row)) for row in table[1:]], table[0]

    def test_it_tells_what_it_does(self):
        self.assertEqual(self.run_of_it.returncode, 0)
        lines = self.run_of_it.stderr.splitlines()
        self.assertEqual(sum(line.endswith(": begun") for line in lines), JOBS)
        self.assertIn(f"{JOBS} of {JOBS} done, 0 running", lines[-1])
        self.assertEqual(self.run_of_it.stdout, (self.whole / "study.txt").read_text())

    def test_the_scores_are_complete(self):
        rows, header = self.rows("scores.csv")
        self.assertEqual(header[:8], ["scenario", "level", "learner", "prey", "score", "ci95", "seeds", "budget"])
        cells = [tuple(row.values())[:4] for row in rows if row["learner"] in LEARNERS]
        self.assertEqual((len(cells), len(set(cells))), (180, 180))
        self.assertEqual({cell[:3] for cell in cells}, {(s, l, n) for s in SCENARIOS for l in LEVELS for n in LEARNERS})
        self.assertEqual(len({cell[3] for cell in cells}), PREYS)
        self.assertEqual({row["learner"] for row in rows} - set(LEARNERS), {"sct-selfconf"})
        for row in rows:
            float(row["score"])
            self.assertGreaterEqual(float(row["ci95"]), 0)
            self.assertEqual((row["seeds"], row["budget"]), ("1", "smoke"))
            self.assertIn(row["to_paper"], ("", "alike", "above", "below"))
            self.assertEqual(bool(row["at_data_target"]), row["learner"] not in ("omar", "bc", "ma-bcq"))

    def test_the_other_tables_are_complete(self):
        rows, _ = self.rows("accuracy.csv")
        cells = {tuple(row.values())[:4] for row in rows}
        self.assertEqual(len(cells), len(rows))
        self.assertEqual({cell[:3] for cell in cells if cell[2] in ("rmadt", "sct")},
                         {(s, l, n) for s in SCENARIOS for l in LEVELS for n in ("rmadt", "sct")})
        for row in rows:
            shares = [float(row[name]) for name in ("within_5", "accuracy", "within_20", "within_50")]
            self.assertEqual(shares, sorted(shares))
            self.assertTrue(0 <= shares[0] and shares[-1] <= 1)
            float(row["distance"])
        rows, _ = self.rows("blend.csv")
        for p in ("1", "0.7", "0.5", "0.3", "0"):
            there = {tuple(row.values())[:3] for row in rows if row["p"] == p and row["score"] and row["ci95"]}
            self.assertLessEqual({(s, l, n) for s in SCENARIOS for l in LEVELS for n in LEARNERS}, there)
        for name in ("players", "beliefs_forced", "returns_asked", "returns", "trained_prey_scores", "trained_prey_players",
                     "trained_prey_accuracy", "trained_prey_blend", "trained_prey_beliefs_forced", "trained_prey_returns_asked",
                     "trained_prey_returns"):
            with self.subTest(name=name):
                rows, header = self.rows(f"{name}.csv")
                self.assertGreater(len(rows), 0)
                for row in rows:
                    float(row["return" if name.endswith("returns") else "accuracy" if name.endswith("accuracy") else "score"])
                    self.assertEqual((row["seeds"], row["budget"]), ("1", "smoke"))
        self.assertEqual(len(list((self.whole / "latex").glob("*.tex"))), 7)
        for path in (self.whole / "latex").glob("*.tex"):
            text = path.read_text()
            self.assertEqual(text.count("\\begin{"), text.count("\\end{"), path.name)

    def test_scores_are_those_of_the_records(self):
        rows, _ = self.rows("players.csv")
        record = json.loads((self.whole / "records" / "released-simple_tag-none-random_play-1.json").read_text())
        self.assertEqual([prey["prey"] for prey in record["preys"]][:3], ["released", "maddpg", "still"])
        self.assertEqual(record["budget"], "smoke")
        there = [row["prey"] for row in rows if row["scenario"] == "simple_tag" and row["learner"] == "random_play"]
        self.assertEqual(there, [prey["prey"] for prey in record["preys"]][:PREYS])

    def test_the_page_is_whole_and_needs_nothing_else(self):
        text = (self.whole / "study.html").read_text()
        page = Page(text)
        self.assertEqual((page.open, page.faults), ([], []))
        self.assertTrue(text.startswith("<!DOCTYPE html>"))
        self.assertEqual((page.tags.count("title"), page.tags.count("h1")), (1, 1))
        self.assertTrue(all(value.startswith("data:") for value in page.fetched), [v[:60] for v in page.fetched])
        self.assertNotIn("script", page.tags)
        self.assertNotRegex(text, r"@import|url\(")
        shown = " ".join(page.texts)
        self.assertIn("no number here says anything", shown)
        self.assertNotRegex(shown, r"\b(nan|inf)\b")
        self.assertEqual(shown.count("not run"), 2)  # what the words mean, twice, and no cell
        if shutil.which("gnuplot"):
            pictures = sorted((self.whole / "pictures").glob("*.svg"))
            self.assertEqual((len(pictures), page.tags.count("img")), (14, 14))
            self.assertTrue(all("</svg>" in path.read_text() for path in pictures))
            self.assertTrue(all(" · budget smoke · Folk " in path.read_text() for path in pictures))
            self.assertFalse(any("<title>Gnuplot" in path.read_text() for path in pictures))

    def test_what_is_done_is_not_done_again(self):
        before, times = files(self.whole), {path: path.stat().st_mtime_ns for path in (self.whole / "records").iterdir()}
        for more in ((), ("--threads", "1"), ("--tables",), ("--only", "sct,seed1")):
            run = self.done(self.whole, *more)
            self.assertEqual((run.stderr, run.stdout), ("", self.run_of_it.stdout))
        self.assertEqual(files(self.whole), before)
        self.assertEqual({path: path.stat().st_mtime_ns for path in (self.whole / "records").iterdir()}, times)
        status = self.done(self.whole, "--status").stdout
        self.assertTrue(status.endswith(f"\n{JOBS} of {JOBS} jobs done\n"))
        self.assertNotRegex(status, r"\b(left|begun)\n")
        self.assertFalse(any((self.whole / "work" / "runs").iterdir()))

    def test_the_records_are_all_that_the_tables_need(self):
        shutil.copytree(self.whole / "records", self.folder / "s" / "records")
        self.assertEqual(self.done(self.folder / "s", "--tables").stdout, self.run_of_it.stdout)
        self.assertEqual(results(self.folder / "s"), results(self.whole))

    def test_a_few_jobs_alone_are_the_same_jobs(self):
        """Whatever else is done beside them, on any number of threads; and their tables say what is missing."""
        self.done(self.folder / "s", *FEW, "--threads", "1")
        for name in FEW_JOBS:
            for path in (f"records/{name}.json", f"work/policies/{name}.safetensors"):
                if (self.whole / path).exists() or "none" not in name:
                    self.assertEqual((self.folder / "s" / path).read_bytes(), (self.whole / path).read_bytes(), path)
        with (self.folder / "s" / "scores.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len([row for row in rows if row["learner"] in LEARNERS]), 180)
        self.assertEqual(len([row for row in rows if row["score"]]), 2 * PREYS)
        self.assertEqual({row["seeds"] for row in rows if not row["score"]}, {"0"})
        page = Page((self.folder / "s" / "study.html").read_text())
        self.assertEqual((page.open, page.faults), ([], []))
        self.assertIn("not run", " ".join(page.texts))

    def test_records_that_are_none(self):
        root = self.folder / "s"
        shutil.copytree(self.whole / "records", root / "records")
        path = root / "records" / "released-simple_tag-expert-sct-1.json"
        good = path.read_bytes()
        record = json.loads(good)

        def changed(change):
            copy = json.loads(good)
            change(copy)
            return json.dumps(copy).encode()

        for content, code, words in (
                (b"", 3, "no record of a study (no JSON at its byte 1)"), (good[:-5], 3, "no JSON at its byte"),
                (good + b"x", 3, "no JSON at its byte"), (b"\xff\xfe\x1b[2J", 3, "no JSON at its byte"), (b"[" * 100000, 3, "no JSON"),
                (b"null", 3, "no record of a study"), (bytes(5 << 20), 3, "larger than 4 MiB"),
                (good.replace(b'"mean": 0.', b'"mean": NaN, "x": 0.', 1), 3, "no JSON"),
                (good.replace(b"folk-mpe-study-1", b"folk-mpe-study-9"), 3, "another format"),
                (changed(lambda r: r.pop("budget")), 3, "key 'budget' not found"),
                (changed(lambda r: r["preys"].pop(1)), 3, "not of the study's"),
                (changed(lambda r: r["preys"].reverse()), 3, "not of the study's"),
                (changed(lambda r: r["preys"][0].update(forced=None)), 3, "'forced' is no list"),
                (changed(lambda r: r["preys"][0]["return"].update(ci95=-1)), 3, "an interval below 0"),
                (changed(lambda r: r["preys"][0]["return"].update(mean="x")), 3, "no record of a study"),
                (changed(lambda r: r.update(seed=2)), 3, "the record of another job, released-simple_tag-expert-sct-2"),
                (changed(lambda r: r.update(budget="paper")), 2, "a study of budget paper, not smoke; give --budget paper")):
            path.write_bytes(content)
            for verb in ("--tables", "--status"):
                with self.subTest(words=words, verb=verb):
                    run = study(root, verb)
                    self.one_line(run, code, words)
                    self.assertIn(str(path), run.stderr)
        self.assertEqual(record["learner"], "sct")
        path.write_bytes(good)
        other = subprocess.run([PROGRAM, "study", "--output", root, "--tables"], capture_output=True, text=True)
        self.one_line(other, 2, "a study of budget smoke, not small; give --budget smoke or another folder")
        self.assertEqual([entry.name for entry in root.iterdir()], ["records"])


@unittest.skipIf(SLOW, "jobs of the study take minutes here")
class Interrupted(Study):
    def start(self, root, *more):
        # Nicer than this test, which is to see what it does.
        process = subprocess.Popen([PROGRAM, "study", "--budget", "smoke", "--output", root, *FEW, "--quiet", *more], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=lambda: os.nice(10),
                                   start_new_session=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def until(self, process, is_there):
        """Waits; false when the process has ended before."""
        while not is_there():
            if process.poll() is not None:
                return False
            time.sleep(0.001)
        return True

    def whole(self):
        run = self.done(self.folder / "whole", *FEW, "--threads", "1", "--quiet")
        return files(self.folder / "whole"), run.stdout

    def test_kill_9_in_any_phase(self):
        whole, told = self.whole()
        root, chance = self.folder / "s", random.Random(3)
        runs, records = root / "work" / "runs", root / "records"
        phases = [lambda: True, lambda: (root / "work").exists(), lambda: any((root / "work" / "data").glob("*.partial"))]
        phases += [lambda job=job: any((runs / job).glob("*.checkpoint")) for job in FEW_JOBS[:2]]
        phases += [lambda job=job: any(records.glob(f"{job}.json*")) for job in FEW_JOBS]
        phases += [lambda: (root / "scores.csv").exists(), lambda: any((root / "pictures").glob("*")),
                   lambda: any((root / "pictures").glob("*.tmp"))]
        for number, phase in enumerate(phases):
            process = self.start(root, "--threads", str(1 + number % 2))
            self.until(process, phase)
            time.sleep(chance.choice((0, 0, 0.01)))
            os.killpg(process.pid, signal.SIGKILL)  # and what draws its pictures, which would go on to write one
            process.wait()
        run = self.done(root, *FEW, "--quiet")
        self.assertEqual((run.stderr, run.stdout), ("", told))
        self.assertEqual(sorted(files(root)), sorted(whole))
        self.assertEqual(files(root), whole)
        self.assertFalse(any(runs.iterdir()))

    def test_a_signal_is_one_line_and_status_knows(self):
        whole, _ = self.whole()
        root = self.folder / "s"
        self.assertEqual(self.done(root, *FEW, "--status").stdout.count(" left\n"), 3)
        self.assertFalse(root.exists())
        for number, job in ((signal.SIGINT, FEW_JOBS[0]), (signal.SIGTERM, FEW_JOBS[1])):
            with self.subTest(job=job):
                process = self.start(root, "--threads", "1")
                self.assertTrue(self.until(process, lambda: any((root / "work" / "runs" / job).glob("*.checkpoint"))))
                process.send_signal(number)
                out, error = process.communicate(timeout=120)
                # All but what the signal came too late for.
                self.assertEqual((process.returncode, out), (4, ""))
                self.assertEqual(error, "mpe-train study: interrupted; the same command goes on from there\n")
                status = self.done(root, *FEW, "--status").stdout
                self.assertRegex(status, r" (begun|done)\n")
                self.assertNotIn("3 of 3 jobs done", status)
                self.assertFalse((root / "study.txt").exists())
        self.done(root, *FEW, "--quiet")
        self.assertEqual(files(root), whole)
        self.assertIn("3 of 3 jobs done", self.done(root, *FEW, "--status").stdout)

    def test_one_process_at_a_time(self):
        root = self.folder / "s"
        self.done(root, "--only", "released,simple_tag,random_play", "--quiet")
        before = files(root)
        with (root / "work" / "lock" / "lock").open("r+") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for more in ((), ("--tables",)):
                self.one_line(study(root, *FEW, *more), 4, "another run is using it")
            self.assertIn("1 of 3 jobs done", self.done(root, *FEW, "--status").stdout)
        self.assertEqual(files(root), before)

    def test_full_disks(self):
        """First the data find no room, then the page; each is a line, and then it goes on."""
        whole, _ = self.whole()
        root = self.folder / "s"
        data = ("--only", "released,simple_tag,expert,omar")

        def run(arguments, size):
            def limit():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

            return study(root, *arguments, "--quiet", preexec_fn=limit)

        self.one_line(run(data, 100_000), 4, ".partial/obs_0.npy: ")
        self.done(root, *data, "--quiet")
        page = (root / "study.html").read_bytes()
        self.one_line(run(FEW, len(whole["study.html"]) - 1), 4, "study.html: cannot be written: ")
        self.assertEqual((root / "study.html").read_bytes(), page)
        self.assertFalse([name for name in files(root) if ".tmp" in name])
        self.done(root, *FEW, "--quiet")
        self.assertEqual(files(root), whole)

    def test_what_a_cut_off_end_left(self):
        """Temporary names of a dead process, and the checkpoints of a job whose record is written."""
        whole, _ = self.whole()
        root = self.folder / "whole"
        for number, part in enumerate(("", "pictures", "latex", "records", "work/policies")):
            (root / part / f".folk-{number:016x}.tmp").write_text("half")
        mine = [root / "notes.tmp", root / "records" / "mine.json", root / f"scores.csv.{os.getpid()}.0.tmp"]
        for path in mine:
            path.write_text("mine")
        (root / "work" / "runs" / FEW_JOBS[0]).mkdir()
        (root / "work" / "runs" / FEW_JOBS[0] / "step-3.checkpoint").write_text("old")
        self.done(root, *FEW, "--quiet")
        for path in mine:
            self.assertEqual(path.read_text(), "mine")
            path.unlink()
        self.assertEqual(files(root), whole)


class Refusals(Study):
    def test_refusals(self):
        root, file = self.folder / "s", self.folder / "file"
        file.write_text("mine")
        for arguments, code, words in (
                (["--output", ""], 2, "where to? Give --output DIR"), (["--output", root, "extra"], 2, "unexpected argument 'extra'"),
                (["--output", root, "--budget", "tiny"], 2, "'tiny' is no budget: expected smoke, small, paper"),
                (["--output", root, "--only", "sct,best"], 2, "'best': no job of the study has this; expected of bc, expert"),
                (["--output", root, "--only", ""], 2, "--only: no word is given"), (["--output", root, "--only", " ,"], 2, "--only: no word"),
                (["--output", root, "--only", "sct,none"], 2, "--only: no job has all of these"),
                (["--output", root, "--budget", "smoke", "--only", "seed2"], 2, "'seed2': no job of the study has this"),
                (["--output", root, "--seeds", "0"], 2, "--seeds '0'"), (["--output", root, "--seeds", "101"], 2, "--seeds '101'"),
                (["--output", root, "--threads", "nan"], 2, "--threads 'nan'"), (["--output", root, "--format", "csv"], 2, "--format"),
                (["--output", file], 4, "it is no folder"), (["--output", file, "--status"], 4, "it is no folder"),
                (["--output", file / "s"], 4, "cannot be made: Not a directory"), (["--output", "/proc/s"], 4, "/proc/s/records: "),
                (["--output", "/dev/full"], 4, "it is no folder")):
            with self.subTest(arguments=arguments):
                self.one_line(subprocess.run([PROGRAM, "study", *arguments], capture_output=True, text=True), code, words)
        self.assertEqual([entry.name for entry in self.folder.iterdir()], ["file"])
        self.assertEqual(file.read_text(), "mine")

    def test_help_has_examples(self):
        text = subprocess.run([PROGRAM, "study", "--help"], capture_output=True, text=True).stdout
        self.assertIn("Examples:\n  mpe-train study --output study\n", text)

    def test_status_of_what_is_not_there(self):
        run = self.done(self.folder / "s", "--status")
        self.assertEqual(run.stderr, "")
        self.assertEqual(run.stdout.count(" left\n"), JOBS)
        self.assertTrue(run.stdout.endswith(f"\n0 of {JOBS} jobs done\n"))
        self.assertFalse((self.folder / "s").exists())

    def test_tables_of_what_is_no_study(self):
        self.one_line(study(self.folder / "s", "--tables"), 2, "s has no records of a study; give the folder of one that was begun")
        (self.folder / "t").mkdir()
        self.one_line(study(self.folder / "t", "--tables"), 2, "t has no records of a study")
        self.assertEqual([str(path.relative_to(self.folder)) for path in self.folder.rglob("*")], ["t"])

    def test_data_of_another_study(self):
        root = self.folder / "s"
        done = subprocess.run([PROGRAM, "collect", "--scenario", "simple_tag", "--level", "expert", "--transitions", "2500", "--output",
                               "set", "--quiet"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        (root / "work" / "data").mkdir(parents=True)
        (self.folder / "set").rename(root / "work" / "data" / "released-simple_tag-expert")
        before = files(root / "work" / "data")
        run = study(root, "--only", "released,simple_tag,expert,omar", "--quiet")
        self.one_line(run, 2, "episodes = 100 there, 200 here")
        self.assertEqual(files(root / "work" / "data"), before)


if __name__ == "__main__":
    unittest.main()
