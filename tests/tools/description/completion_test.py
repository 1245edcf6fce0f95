"""Completion as its users have it: in bash, zsh and fish, each with the file that is installed for it, keys typed in a terminal.
FOLK_BIN names the folder of the programs; the files are in share/ beside it. A shell that is not installed is passed over."""

import os
import pty
import re
import select
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"]).resolve()
SHARE = BIN.parent / "share"
ZSH_FOLDER = next((SHARE / "zsh").iterdir())
PROGRAMS = sorted(path.name for path in (SHARE / "bash-completion/completions").iterdir())
MACHINES = "machine forgiver\nc C c d\nd D c d\n\nmachine other\nc C c c\n"
END = "\x05"  # the end of the line


def ask(program, shell, line, breaks=""):
    done = subprocess.run([BIN / program, "--complete", shell, line, breaks], capture_output=True, text=True, timeout=60, check=True)
    return [row.split("\t")[0] for row in done.stdout.split("\n")[:-1]]


class Terminal:
    """An interactive shell in a terminal of its own."""

    def __init__(self, command, setup, folder):
        self.master, slave = pty.openpty()
        environment = {"PATH": f"{BIN}:{os.environ['PATH']}", "HOME": str(folder), "TERM": "dumb", "PS1": "", "LC_ALL": "C.UTF-8"}
        self.process = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave, cwd=folder, env=environment,
                                        start_new_session=True, close_fds=True)
        os.close(slave)
        self.type(setup + "; echo 're''ady'\n")
        self.until("ready")

    def type(self, keys):
        os.write(self.master, keys.encode())

    def until(self, word):
        text, end = "", time.monotonic() + 60
        while word not in text:
            if not select.select([self.master], [], [], max(0, end - time.monotonic()))[0]:
                raise AssertionError(f"no {word!r} in {text!r}")
            text += os.read(self.master, 65536).decode(errors="replace")
        return text

    def completed(self, line):
        """What a line has become after a tab: its words, as the shell then reads them."""
        self.type(line + "\t")
        self.type(f"{END}\x01printf '<%s>' {END}; echo 'do''ne'\n")
        return re.findall(r"<([^<>%]*)>", self.until("done\r\n").rsplit("printf", 1)[-1].split("\n", 1)[-1])

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.master)


class InTheShell:
    """What holds in every shell that has a terminal."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        Path(folder.name, "mine.machines").write_text(MACHINES)
        Path(folder.name, "results").mkdir()
        self.terminal = Terminal(*self.shell(), folder.name)
        self.addCleanup(self.terminal.close)

    def expect(self, line, words):
        self.assertEqual(self.terminal.completed(line), words, line)

    def test_names(self):
        self.expect("ipd-match tit_for_ta", ["ipd-match", "tit_for_tat"])
        self.expect("ipd-match tit_for_tat prob", ["ipd-match", "tit_for_tat", "prob"])  # prober or proba(K)
        self.expect("ipd-match tit_for_tat probe", ["ipd-match", "tit_for_tat", "prober"])

    def test_the_last_item_of_a_spec(self):
        self.expect("ipd-tournament --strategies pavlov,spiteful_c", ["ipd-tournament", "--strategies", "pavlov,spiteful_cc"])
        self.expect('ipd-tournament --strategies "pavlov,spiteful_c', ["ipd-tournament", "--strategies", "pavlov,spiteful_cc"])
        self.expect("ipd-tournament --include hard=mem2_", ["ipd-tournament", "--include", "hard=mem2_sct"])

    def test_values_and_options(self):
        self.expect("ipd-tournament --crit", ["ipd-tournament", "--criterion"])
        self.expect("ipd-tournament --criterion disc", ["ipd-tournament", "--criterion", "discounted:"])
        self.expect("ipd-tournament --criterion=disc", ["ipd-tournament", "--criterion=discounted:"])
        self.expect("ipd-tournament --format j", ["ipd-tournament", "--format", "json"])
        self.expect("ipd-evolve --model birth", ["ipd-evolve", "--model", "birth-death"])

    def test_files(self):
        self.expect("ipd-tournament --include @mi", ["ipd-tournament", "--include", "@mine.machines"])
        self.expect("ipd-match @mine.machines#for", ["ipd-match", "@mine.machines#forgiver"])
        self.expect("ipd-tournament --output res", ["ipd-tournament", "--output", "results/"])

    def test_verbs(self):
        self.expect("mpe-train coll", ["mpe-train", "collect"])
        self.expect("mpe-train collect --level med", ["mpe-train", "collect", "--level", "medium"])
        self.expect("ipd-strategies show pavl", ["ipd-strategies", "show", "pavlov"])


@unittest.skipUnless(shutil.which("bash"), "bash is not installed")
class Bash(InTheShell, unittest.TestCase):

    def shell(self):
        files = SHARE / "bash-completion/completions"
        return ["bash", "--norc", "--noprofile", "-i"], f"set +o history; for f in {files}/*; do . $f; done; bind 'set bell-style none'"


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class Zsh(InTheShell, unittest.TestCase):

    def shell(self):
        return ["zsh", "-f", "-i"], f"unsetopt zle_bracketed_paste prompt_sp; fpath=({ZSH_FOLDER} $fpath); autoload -U compinit; compinit -u -D; bindkey -e"


@unittest.skipUnless(shutil.which("fish"), "fish is not installed")
class Fish(unittest.TestCase):
    def complete(self, line):
        files = SHARE / "fish/vendor_completions.d"
        script = f"for f in {files}/*; source $f; end; complete -C {line!r}"
        with tempfile.TemporaryDirectory() as home:
            done = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, timeout=60, check=True, cwd=home,
                                  env={"PATH": f"{BIN}:{os.environ['PATH']}", "HOME": home, "LC_ALL": "C.UTF-8"})
        return [row.split("\t")[0] for row in done.stdout.split("\n")[:-1]]

    def test_what_it_offers(self):
        self.assertEqual(self.complete("ipd-match tit_"), ["tit_for_tat", "tit_for_two_tats"])
        self.assertEqual(self.complete("ipd-tournament --criterion disc"), ["discounted:"])
        self.assertEqual(self.complete("ipd-tournament --criterion=disc"), ["--criterion=discounted:"])
        self.assertEqual(self.complete("ipd-tournament --strategies pavlov,spiteful_c"), ["pavlov,spiteful_cc"])
        self.assertEqual(self.complete("mpe-train coll"), ["collect"])


class Answers(unittest.TestCase):
    """What the program says, whoever asks."""

    def test_every_name_of_the_registry(self):
        listed = subprocess.run([BIN / "ipd-strategies", "list", "--format", "json"], capture_output=True, text=True, check=True).stdout
        names = set(re.findall(r'"name": "([a-z0-9_-]+)"', listed))
        self.assertGreater(len(names), 30)
        self.assertLessEqual(names, set(ask("ipd-match", "fish", "ipd-match ")))

    def test_where_a_spec_stands_in_brackets(self):
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include 'sample(cla"), ["sample(classics", "sample(classics..."])
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include 'sample(classics;4;"), ["sample(classics;4;seed="])
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include 'bayes(3*pavl"), ["bayes(3*pavlov", "bayes(3*pavlov..."])
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include 'gtft(0"), [])
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include 'gtft(0.1)"), [])
        self.assertEqual(ask("ipd-tournament", "fish", "ipd-tournament --include memo"), ["memory(", "memory(X,Y)"])

    def test_what_stands_alone_ends_a_word_only_where_it_does(self):
        self.assertEqual(ask("ipd-match", "bash", "ipd-match 'pavl"), ["pavlov"])  # bash closes the quotation mark
        self.assertEqual(ask("ipd-match", "bash", "ipd-match pavl"), ["pavlov "])
        self.assertEqual(ask("ipd-match", "bash", "ipd-match 'sample(pavl"), ["sample(pavlov", "sample(pavlov..."])
        self.assertEqual(ask("ipd-match", "zsh", "ipd-match 'sample(pavl"), ["sample(pavlov"])

    def test_payoffs_that_are_not_given_yet(self):
        self.assertEqual(ask("ipd-match", "fish", "ipd-match --payoffs T=5,P=1,"), ["T=5,P=1,R=", "T=5,P=1,S="])

    def test_what_bash_leaves_as_it_is(self):
        self.assertEqual(ask("ipd-tournament", "bash", "ipd-tournament --criterion=disc", " =:"), ["discounted:"])
        self.assertEqual(ask("ipd-tournament", "bash", "ipd-tournament --criterion=disc", " "), ["--criterion=discounted:"])
        self.assertEqual(ask("ipd-tournament", "bash", "ipd-tournament --include samp", " "), ["sample\\(", "sample\\(SPEC\\;N\\;seed=S\\) "])

    def test_words_are_those_of_the_help(self):
        """A word that is offered stands in what the option says of itself."""
        verbs = ask("mpe-train", "fish", "mpe-train ")
        for command in (*PROGRAMS, *("mpe-train " + verb for verb in verbs)):
            program, *verb = command.split()
            options = ask(program, "fish", f"{command} --")
            self.assertGreater(len(options), 2, command)
            page = subprocess.run([BIN / program, *verb, "--man"], capture_output=True, text=True, check=True).stdout
            about = dict(re.findall(r"\\fB\\-\\-(\S+)\\fR(?: \\fI.*?\\fR)?\n((?:[^.].*\n)+)", page))
            for option in options:
                text = about.get(option[2:].replace("-", "\\-"), "").replace("\\", "")
                for word in ask(program, "fish", f"{command} {option} "):
                    if re.fullmatch(r"[a-z][a-z0-9-]*", word) and re.search(r" (NAME|FORMAT)\b", self.parameter(page, option)):
                        self.assertIn(word, text, f"{command} {option}")

    def parameter(self, page, option):
        found = re.search(r"\\fB" + re.escape(option.replace("-", "\\-")) + r"\\fR( .*)?", page)
        return found[0].replace("\\fI", "") if found else ""

    def test_nonsense_is_answered_with_nothing(self):
        for line in ("", "ipd-match", "ipd-match '", 'ipd-match "\\', "ipd-match ((((", "ipd-match " + "(" * 5000, "ipd-match ))),"):
            ask("ipd-match", "bash", line)


if __name__ == "__main__":
    unittest.main()
