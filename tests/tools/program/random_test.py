"""Random command lines and damaged files: no program dies of a signal, hangs, prints raw exceptions or leaves files behind what it refuses;
exit codes are 0 to 4, and a refusal is one line. Seeded: a failure says which case it was. FOLK_BIN names the folder of the programs.

FOLK_RANDOM_CASES=20000 FOLK_RANDOM_SEED=7 tries other and more cases than the few hundred of every run."""

import os
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
TREE = Path(__file__).resolve().parents[3]
SEED = int(os.environ.get("FOLK_RANDOM_SEED", "1"))
CASES = int(os.environ.get("FOLK_RANDOM_CASES", "40" if "FOLK_SANITIZED" in os.environ else "200"))
LONGEST = 60 if "FOLK_SANITIZED" in os.environ else 20  # seconds
RAW = re.compile(rb"terminate called|what\(\)|std::|boost|json\.exception|basic_string|filesystem error|bad_alloc|[Aa]ssertion|Sanitizer|runtime error")

TRAINING = ("--hidden", "8", "--layers", "1", "--batch", "4", "--warmup", "1", "--roster", "tit_for_tat,all_d", "--rounds", "5", "--targets", "15,20",
            "--steps", "1", "--threads", "1")
# Command lines that are right and quick; what is tried is these with something changed.
LINES = [
    ("ipd-match", "pavlov", "all_d", "--rounds", "5", "--noise", "0.1", "--seed", "3"),
    ("ipd-match", "f/policy.bin", "bayes(all_c,all_d)", "--rounds", "3", "--format", "json"),
    ("ipd-match", "@f/my.machines#slow_pavlov", "gtft(1/3)", "--payoffs", "T=4,R=3,P=1,S=0"),
    ("ipd-tournament", "--strategies", "x=all_c,all_d,pavlov", "--criterion", "discounted:0.9", "--invasion", "--sub-rosters", "2:2", "--threads",
     "1"),
    ("ipd-tournament", "--strategies", "@f/roster", "--noise", "0.01", "--repetitions", "2", "--rounds", "5", "--output", "w/out", "--threads", "1"),
    ("ipd-judge", "f/play.csv", "--strategies", "x=all_c,gtft(1/3),2*memory(1,2)", "--slips", "0,0.1", "--output", "w/judged", "--threads", "1"),
    ("ipd-strategies", "show", "pavlov"), ("ipd-strategies", "diff", "spiteful", "mem11_cCDDD", "--any-own-moves"),
    ("ipd-strategies", "reply", "pavlov", "--criterion", "discounted:0.9", "--noise", "0.1", "--format", "json"),
    ("strategy-graph", "gradual", "--horizon", "3", "-o", "w/g.dot"), ("payoff-region", "--discount", "0.6", "--format", "json"),
    ("payoff-region", "--game", "f/game.nfg", "--strategies", "all_c,all_d", "--rounds", "5", "--threads", "1"),
    ("sce-check", "pavlov", "pavlov", "--criterion", "discounted:0.6", "--noise", "0.1", "--class", "all_c"),
    ("sce-check", "spiteful", "tit_for_tat", "--criterion", "mean", "--side", "own", "--epsilon-payoff", "0.1", "--require", "nash"),
    ("sce-check", "f/policy.bin", "all_d", "--rounds", "3", "--depth", "1", "--extract", "--output", "w/report", "--threads", "1"),
    ("sct-train", *TRAINING, "--output", "w/p.bin", "--checkpoint", "w/run", "--seeds", "2", "--log", "w/log.csv"),
    ("sct-train", "--config", "f/run.conf", "--output", "w/p.bin", "--threads", "1"),
    ("mpe-evaluate", "--predators", "f/predators", "--prey", "still", "--episodes", "1", "--threads", "1", "--record", "w/e.csv"),
    ("mpe-evaluate", "--replay", "f/recording"), ("mpe-train", "curve", "f/curve.csv", "--output", "w/c.svg"),
    ("mpe-train", "collect", "--predators", "lead_pursuit", "--prey", "still", "--transitions", "25", "--output", "w/set", "--threads", "1"),
    ("mpe-train", "inspect", "f/set", "--threads", "1"), ("mpe-train", "study", "--output", "w/study", "--status"),
]
# Files and who reads them.
READERS = [
    ("game.nfg", "payoff-region", "--game", "m"), ("my.machines", "ipd-match", "@m#slow_pavlov", "all_d", "--rounds", "3"),
    ("roster", "ipd-tournament", "--strategies", "@m", "--rounds", "3", "--threads", "1"), ("policy.bin", "ipd-match", "sct:m", "all_d", "--rounds", "2"),
    ("run.conf", "sct-train", "--config", "m", *TRAINING, "--output", "w/p.bin"), ("recording", "mpe-evaluate", "--replay", "m"),
    ("predators", "mpe-evaluate", "--predators", "m", "--prey", "still", "--episodes", "1", "--threads", "1"),
    ("prey", "mpe-evaluate", "--scenario", "simple_world", "--predators", "lead_pursuit", "--prey", "m", "--episodes", "1", "--threads", "1"),
    ("transformer", "mpe-evaluate", "--predators", "m", "--prey", "still", "--episodes", "1", "--threads", "1"),
    ("play.csv", "ipd-judge", "m", "--strategies", "all_c,memory(1,2)", "--threads", "1"),
    ("curve.csv", "mpe-train", "curve", "m", "--output", "w/c.svg"),
]
NUMBERS = ["0", "1", "-1", "0.5", "1/3", "1e-9", "1e400", "-0", "nan", "inf", "0x10", "1e", "1/0", "18446744073709551616", "1e15", "1e16", "0.1.2",
           "1,5", " 1", "٣", "9" * 400, "1/" + "3" * 300, "1_000", "1e999999999"]
NAMES = ["all_c", "gradual", "sct", "bayes(all_c)", "bayes()", "random(2)", "mem1(c;1,0,1)", "memory(9,9)", "per_", "@f/my.machines", "@f/my.machines#", "@", "@f",
         "@-", "sct:", "sct:f", 'exec:"false"', 'exec("cat";timeout=0.1;start=0.2)', "exec:", 'exec("', "=all_c", "a=b=c", "tit_for_ta", "classics", "", " ", ",", "日本", "\U0001F600",
         "a\nb", "\x1b[31m", "\u202e", "-", "--", "a" * 5000, "(" * 200, "bayes(" * 50, "%s%n", "'", "\\", "\udcff"]
FILES = ["f", "f/none", "w/none/none", "/dev/null", "/dev/full", "-", ".", "f/roster", "f/policy.bin", "f/set", "f/predators", "w/new", "w/new.svg", "w/new.xyz", "w/a/b", "w/" + "n" * 300]
SETTINGS = ["mean", "finite:5", "finite:1e16", "discounted:1", "discounted:2/3", "ending:0.1", "ending:1e-20", "T=5", "T=5,R=3,P=1,S=0,X=1", "T=1e300,R=1,P=0,S=-1e300",
            "text", "csv", "json", "own", "nash", "paper", "smoke", "simple_world", "omar", "blend(2)", "1:1e9:1", "5:1:1", "x"]
# Options that say how much there is to do have small numbers.
WORK = {"--repetitions", "--episodes", "--steps", "--transitions", "--validation-repetitions", "--data-repetitions", "--aggregate-repetitions", "--hidden", "--layers",
        "--batch", "--context", "--most-pairs", "--seeds", "--horizon", "--depth", "--rounds", "--threads", "--first-episode", "--heads", "--criterion"}
BYTES = [b"\0", b"\xff", b"-", b"0", b"1e400", b"nan", b"\n", b'"', b"{", b"]", b",", b"\xef\xbb\xbf", b"\xff" * 8, b"99999999999999999999", b"9" * 400]


def limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (64 << 20, 64 << 20))


def twisted(draw, text):
    i = draw.randrange(len(text) + 1)
    return draw.choice([text[:i] + text[i + 1:], text[:i], text[:i] + text[i:i + 1] + text[i:], text.swapcase(), text[i:] + text[:i],
                        text[:i] + draw.choice("-=:;,.()#@\"'/ \n09eN%é\U0001F600") + text[i:]])


def value(draw, option):
    if option in WORK:
        return draw.choice(["0", "1", "2", "-1", "x", "1.5", "", "1/2", "nan"])
    return draw.choice(draw.choice([NUMBERS, NAMES, FILES, SETTINGS]))


class Random(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)
        files = cls.folder / "f"
        files.mkdir()
        corpus = TREE / "tests/fuzz/corpus"
        for name, source in (("policy.bin", corpus / "policy/smallest"), ("predators", corpus / "particle_policy/predators"), ("prey", corpus / "particle_policy/prey"),
                             ("transformer", corpus / "particle_policy/transformer"), ("curve.csv", corpus / "curve_file/two"), ("play.csv", corpus / "recorded_play/letters"), ("recording", corpus / "recording/tag"),
                             ("game.nfg", TREE / "tests/data/dilemma_9_10.nfg"), ("my.machines", TREE / "examples/my_strategies.machines")):
            shutil.copy(source, files / name)
        (files / "roster").write_text("tit_for_tat\nall_d # a comment\nmem1(c;0.9,0.1,0.6,0.2)\n")
        (files / "run.conf").write_text("".join(f"{key[2:]} = {text}\n" for key, text in zip(TRAINING[0:-2:2], TRAINING[1:-2:2])))
        subprocess.run([BIN / "mpe-train", "collect", "--predators", "lead_pursuit", "--prey", "still", "--transitions", "25", "--output", files / "set"],
                       check=True, capture_output=True)
        cls.known = {}

    def options(self, line):
        """Those of a command's help, with whether each takes a value."""
        words = line[:2] if line[0] == "mpe-train" else line[:1]
        if words not in self.known:
            text = subprocess.run([BIN / words[0], *words[1:], "--help"], capture_output=True, text=True, check=True).stdout
            self.known[words] = [(name, bool(takes)) for name, takes in re.findall(r"^  (?:-\w \[ )?(--[\w-]+)(?: \])?( arg)?", text, re.MULTILINE)]
        return self.known[words]

    def line(self, draw):
        line = draw.choice(LINES)
        options = self.options(line)
        words = list(line[1:])
        for _ in range(draw.choice([1, 1, 1, 2, 3])):
            i = draw.randrange(len(words)) if words else 0
            before = words[i - 1] if i else ""
            kind = draw.randrange(6)
            if kind == 0 or not words:
                name, takes = draw.choice(options)
                words += [name, value(draw, name)] if takes else [name]
            elif kind == 1 and not (words[i] == "study" or before in WORK):
                words[i] = twisted(draw, words[i])
            elif kind == 2:
                words[i] = value(draw, before) if not words[i].startswith("--") else draw.choice(options)[0]
            elif kind == 3 and words[i] not in (*WORK, "--status") and before not in WORK:
                del words[i]
            elif kind == 4:
                words.insert(i, draw.choice(NAMES))
            elif kind == 5:
                words.insert(draw.randrange(len(words) + 1), words[i])
        if words[:1] == ["study"] and "--status" not in words:
            words.append("--status")  # what it does without it takes hours
        if line[0] == "sct-train" and not {"--steps", "f/run.conf"} & set(words):
            words += ["--steps", "1"]  # likewise
        return line[0], words

    def listing(self):
        found = {}
        for path in self.folder.rglob("*"):
            about = path.lstat()
            found[path] = None if path.is_dir() else (about.st_size, about.st_mtime_ns)
        return found

    def attack(self, program, words):
        """Runs it; what is wrong with how it went."""
        shutil.rmtree(self.folder / "w", ignore_errors=True)
        (self.folder / "w").mkdir()
        before = self.listing()
        process = subprocess.Popen([BIN / program, *(word.encode("utf-8", "surrogateescape") for word in words)], cwd=self.folder, preexec_fn=limits,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        try:
            err = process.communicate(timeout=LONGEST)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "it hangs"
        if not 0 <= process.returncode <= 4:
            return f"exit code {process.returncode}: {err}"
        if RAW.search(err):
            return f"a raw exception: {err}"
        if process.returncode < 2:
            return ""
        said = [line for line in err.split(b"\n") if line.startswith(program.encode()) and not re.match(rb"[a-z -]+: (note|no checkpoint)", line)]
        if len(said) != 1 or len(said[0]) > 5000 or not said[0].decode("utf-8").isprintable():
            return f"not one clear line: {err}"
        if process.returncode < 4 and self.listing() != before:
            return f"a refusal leaves files: {sorted(str(path) for path in self.listing().keys() ^ before.keys())}"
        return ""

    def test_command_lines(self):
        for case in range(CASES):
            draw = random.Random(f"{SEED} line {case}")
            program, words = self.line(draw)
            with self.subTest(case=case, command=[program, *words]):
                self.assertEqual(self.attack(program, words), "")

    def test_damaged_files(self):
        for case in range(CASES // 2):
            draw = random.Random(f"{SEED} file {case}")
            name, program, *words = draw.choice(READERS)
            content = bytearray((self.folder / "f" / name).read_bytes())
            for _ in range(draw.choice([1, 1, 2, 4])):
                i = draw.randrange(min(len(content), draw.choice([200, 1 << 20])) + 1)
                kind = draw.randrange(4)
                if kind == 0:
                    content[i:i + 1] = bytes([draw.randrange(256)])
                elif kind == 1:
                    content[i:i] = draw.choice(BYTES)
                elif kind == 2:
                    del content[i:i + draw.choice([1, 8, 1 << 20])]
                else:
                    content[i:i + 8] = draw.choice(BYTES)[:8]
            (self.folder / "m").write_bytes(content)
            with self.subTest(case=case, file=name, command=[program, *words]):
                self.assertEqual(self.attack(program, words), "")


if __name__ == "__main__":
    unittest.main()
