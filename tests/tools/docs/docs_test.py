"""Every command that README and docs/ show, run as it stands: what it prints is what the page says. FOLK_BIN names the folder of the
programs; with FOLK_DOCS_UPDATE=1 the pages are rewritten instead.

A command is a line of a fenced block that begins with "$ "; the lines up to the next are its output, in which a line of three dots
stands for any lines; a command without any must only succeed. The commands of a page share a folder. Blocks that are opened with ```console long take minutes, or are about
Folk's own scripts: they are not run.

Examples without output, indented lines of a page and those at the end of --help, must succeed too. Trainings, and what takes long or
needs what they make, are run with --threads 0, which must be the first thing that is wrong with them."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
TREE = Path(__file__).resolve().parents[3]
PAGES = [TREE / "README.md", *sorted((TREE / "docs").glob("*.md"))]
UPDATE = os.environ.get("FOLK_DOCS_UPDATE") == "1"
BLOCK = re.compile(r"^```(.*)\n((?:(?!```).*\n)*)```$", re.MULTILINE)
LONG = "console long"
# What a page takes for granted.
PROGRAMS = ("ipd-judge", "ipd-match", "ipd-strategies", "ipd-tournament", "mpe-evaluate", "mpe-train", "payoff-region", "sce-check", "sct-train",
            "strategy-graph")
# As mpirun may be run by anybody on any machine.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
WITHOUT_MPI = not shutil.which("mpirun") or not list(BIN.resolve().parent.glob("lib*/**/libfolk_mpi.so"))
VERBS = ("collect", "curve", "inspect", "offline", "online", "study")  # of mpe-train
DRY = re.compile(r"sct-train|mpe-train (online|offline|study|collect|inspect)|sce-check (sct|policy\.bin)|ipd-tournament .*(sct:|exec:|--plot)|ipd-evolve --strategies 'memory.2,2.'|"
                 r"payoff-region .*sct|mpe-evaluate .*(exec:|(mine|predators|sct)\.safetensors)")
FILES = {"ipd-tournament.md": {"bad.machines": "machine bad\nc C c d\n"}}


def commands(block):
    """(command, output) of a block's text, from its first command on."""
    parts = re.split(r"^\$ (.*)\n", block, flags=re.MULTILINE)
    return list(zip(parts[1::2], parts[2::2]))


def run(command, folder):
    done = subprocess.run(command, shell=True, cwd=folder, text=True, timeout=300, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                          env={**os.environ, **MPI, "PATH": f"{BIN}:{os.environ['PATH']}", "COLUMNS": "80"})
    return done.returncode, done.stdout


def pattern(shown):
    """A regular expression for the output that is shown. The last bits of what was rounded depend on the processor's vector
    instructions, and with them a signature and the way of a search."""
    lines = []
    for line in shown.rstrip("\n").split("\n"):
        if line.strip() == "...":
            lines.append(r"(?:.*\n)*?")
        else:
            text = re.sub(r"(?<=signature )[0-9a-f]{16}", "[0-9a-f]{16}", re.escape(line).replace(r"\ ", " "))
            lines.append(re.sub(r"^(  searched +)\d+", r"\1\\d+", text) + "[ ]*\n")
    return re.compile("".join(lines) + r"\n*\Z")


def indented_examples(text):
    """The commands of a page that are indented, outside of fenced blocks. A word in capitals stands for another: a form, no example."""
    for line in re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL).split("\n"):
        command = re.match(r"    ((?:%s) (?:\S| (?! ))+)" % "|".join(PROGRAMS), line)
        if command and not re.search(r" [A-Z]+\b", command[1]):
            yield command[1]


def examples_of_help(words):
    text = subprocess.run([BIN / words[0], *words[1:], "--help"], capture_output=True, text=True, check=True).stdout
    examples = re.search(r"^Examples:\n((?:  .*\n)+)", text, re.MULTILINE)[1]
    return [re.sub(r"  +#.*", "", line.strip()) for line in examples.rstrip("\n").split("\n")]


class Examples(unittest.TestCase):
    def folder_of_files(self):
        """All that examples take for granted."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        folder = Path(scratch.name)
        for name in ("examples", "tests", "data"):
            (folder / name).symlink_to(TREE / name)
        for name, source in (("my_player", "tit_for_tat"), ("my_model.py", "tit_for_tat"), ("my_prey", "particle_player")):
            shutil.copy(TREE / "examples" / f"{source}.py", folder / name)
            (folder / name).chmod(0o755)
        (folder / "policy.bin").symlink_to(TREE / "data/policies/sct-bayes.bin")
        (folder / "run.conf").write_text("hidden = 8\n")
        for run in range(1, 4):
            (folder / f"run-{run}.csv").symlink_to(TREE / "tests/fuzz/corpus/curve_file/two")
        return folder

    def test_all_do_what_they_should(self):
        examples = [example for page in PAGES for example in indented_examples(page.read_text())]
        self.assertGreater(len(examples), 10)
        for program in PROGRAMS:
            examples += examples_of_help([program])
        for verb in VERBS:
            examples += examples_of_help(["mpe-train", verb])
        shown = {command for page in PAGES for info, block in BLOCK.findall(page.read_text()) if info != LONG
                 for command, _ in commands(block)}
        folder = self.folder_of_files()
        for example in dict.fromkeys(examples):
            if example in shown:
                continue  # run with its page
            if WITHOUT_MPI and "mpirun" in example:
                continue
            with self.subTest(example=example):
                if DRY.match(example):
                    code, printed = run(f"{example} --threads 0", folder)
                    self.assertEqual(code, 2, printed)
                    self.assertIn("--threads '0'", printed)
                else:
                    code, printed = run(example, folder)
                    self.assertEqual(code, 0, printed)


class Docs(unittest.TestCase):
    maxDiff = None

    def check(self, page, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name in ("examples", "tests", "data"):
            (Path(folder.name) / name).symlink_to(TREE / name)
        for name, content in FILES.get(page.name, {}).items():
            (Path(folder.name) / name).write_text(content)
        count = 0

        def checked(block):
            nonlocal count
            if block[1] == LONG or not commands(block[2]) or (WITHOUT_MPI and "mpirun" in block[2]):
                return block[0]
            count += 1
            new = block[2][:re.search(r"^\$ ", block[2], re.MULTILINE).start()]
            for command, shown in commands(block[2]):
                code, printed = run(command, folder.name)
                new += f"$ {command}\n" + (printed if shown.strip() and "..." not in shown else shown)
                with self.subTest(page=page.name, command=command):
                    if not shown.strip():  # what it prints is not shown
                        self.assertEqual(code, 0, printed)
                        continue
                    if not UPDATE and not pattern(shown).match(printed.rstrip("\n") + "\n"):
                        self.assertEqual(printed, shown)
            return f"```{block[1]}\n{new.rstrip(chr(10))}\n```"

        new = BLOCK.sub(checked, text)
        if UPDATE and new != text:
            page.write_text(new)
        return count

    def test_long_ones_are_few(self):
        """Nothing is left out but trainings, the study, the largest classes and scripts."""
        for page in PAGES:
            for info, block in BLOCK.findall(page.read_text()):
                for command, _ in commands(block) if info == LONG else ():
                    self.assertRegex(command, r"^(scripts/|mpe-train |sct-train |mpe-evaluate --predators sct\.|cat |ls |rm |sce-check (sct|@report/)|ipd-tournament (.*(sct:small|@report/)|--class 'memory.4,4.)|ipd-strategies champion --class 'memory.3,3.|ipd-evolve --strategies 'memory.2,2.)")


for one in PAGES:
    content = one.read_text()
    if any(commands(block) and info != LONG for info, block in BLOCK.findall(content)):
        name = "test_" + re.sub(r"\W", "_", one.stem)
        setattr(Docs, name, lambda self, page=one, text=content: self.assertGreater(self.check(page, text) + WITHOUT_MPI, 0))


if __name__ == "__main__":
    if "FOLK_SANITIZED" in os.environ:
        print("the programs' own tests run under a sanitizer")
    else:
        unittest.main()
