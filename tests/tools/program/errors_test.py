"""What every program says to bad input: one line on stderr, nothing on stdout, the right exit code. FOLK_BIN names the
folder of the programs. Exit codes: 2 wrong usage, 3 bad input file, 4 anything else."""

import os
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

BIN = Path(os.environ["FOLK_BIN"])
PROGRAMS = ("ipd-tournament", "ipd-evolve", "ipd-judge", "ipd-match", "ipd-strategies", "strategy-graph", "sct-train", "mpe-evaluate")

# What each program needs to run at all, so that one wrong thing more is the only wrong thing.
ENOUGH = {
    "ipd-tournament": (),
    "ipd-evolve": ("--strategies", "all_c,all_d"),
    "ipd-judge": (str(Path(__file__).resolve().parents[3] / "examples/language_model.csv"),),
    "ipd-match": ("all_c", "all_d"),
    "ipd-strategies": ("list",),
    "strategy-graph": ("pavlov", "-o", "/dev/null"),
    "sct-train": ("--hidden", "8", "--layers", "1", "--steps", "1", "--roster", "all_c,all_d", "--rounds", "5",
                  "--output", "/dev/null", "--quiet"),
    "mpe-evaluate": ("--predators", "still", "--episodes", "1"),
}


def run(program, *arguments, **how):
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
    return subprocess.run([BIN / program, *arguments], text=True, timeout=60, **how)


class Errors(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return str(path)

    def refused(self, code, *arguments, program="ipd-tournament", says=(), **how):
        """One line on stderr that names the program and holds `says`, nothing on stdout, the exit code."""
        done = run(program, *arguments, **how)
        self.assertEqual(done.returncode, code, done)
        self.assertFalse(done.stdout, done)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, done)
        self.assertTrue(lines[0].startswith(f"{program}: "), lines[0])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in (says,) if isinstance(says, str) else says:
            self.assertIn(word, lines[0])
        return lines[0]


class WrongUsage(Errors):
    def test_unknown_strategies_get_the_nearest_names(self):
        self.refused(2, "--strategies", "tit_for_tut", says=("'tit_for_tut'", "did you mean tit_for_tat"))
        self.refused(2, "--include", "gradul", says="gradual")
        self.refused(2, "--exclude", "pavlow", says="pavlov")
        self.refused(2, "--strategies", "clasics", says="classics")
        self.refused(2, "--strategies", "qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq", says="ipd-strategies list")
        self.refused(2, "--strategies", "tit\nfor\x1b[31mtut")
        self.refused(2, "tit_for_tut", "all_d", program="ipd-match", says="tit_for_tat")
        self.refused(2, "show", "tit_for_tut", program="ipd-strategies", says="tit_for_tat")
        self.refused(2, "diff", "pavlow", "pavlov", program="ipd-strategies", says="pavlov")
        self.refused(2, "pavlow", "-o", "x.svg", program="strategy-graph", says="pavlov")

    def test_names_with_wrong_parameters(self):
        for name in ("random(4/3)", "gtft(1/0)", "zd_extort(4;1/16)", "random(1.5)", "random(nan)", "random()", "random(0.5", "gtft(x)", "zd_extort(0.5)", "per_",
                     "per_cx", "mem12_ccCDCD", "memory(2,3)", "pavlov,memory(2,2)", "memory(9,9)", "memory(-1,1)", "memory(a,b)", "memory()",
                     "mem1(c;0.9,0.1,0.8)"):
            self.refused(2, "--strategies", name)

    def test_payoffs_that_are_no_dilemma(self):
        for payoffs in ("T=1,R=2,P=3,S=4", "T=3,R=3,P=1,S=0"):
            self.refused(2, "--payoffs", payoffs, says="T > R > P > S")
        for payoffs in ("", "T=5,R=3,P=1", "T=5,R=3,P=1,S=x", "T=5,R=3,P=1,S=nan", "T=5,R=3,P=1,S=0,T=5", "5,3,1,0",
                        "T=5,R=3,P=1,S=1/0"):
            self.refused(2, "--payoffs", payoffs, says="T=5,R=3,P=1,S=0")

    def test_noise(self):
        for noise in ("1.5", "-0.1", "nan", "NaN", "inf", "abc", "", "0.1x", "0,1", "1e400", "1e999999999", "4/3", "1/0",
                      "1/3/5", "-1/3"):
            self.refused(2, "--noise", noise, says=("--noise", "from 0 to 1"))

    def test_rounds(self):
        for rounds in ("0", "-1", "1e30", "", "nan", "abc", "1.5", "10000000000000000", "99999999999999999999999"):
            self.refused(2, "--rounds", rounds, says=(f"'{rounds}'", "whole number from 1 to"))
            self.refused(2, "--criterion", f"finite:{rounds}")
        self.refused(2, "all_c", "all_d", "--rounds", "-1", program="ipd-match", says="'-1'")

    def test_criteria(self):
        for criterion in ("", "foo", "finite", "discounted:1", "discounted:0", "discounted:nan", "discounted:-1",
                          "mean:1", "ending:0", "ending:2", "ending:nan"):
            self.refused(2, "--criterion", criterion)
        for probability in ("0", "2", "-1", "nan", "x", ""):
            self.refused(2, "--end-probability", probability)
        self.refused(2, "--rounds", "10", "--criterion", "finite:20", says="give one of them")

    def test_whole_numbers(self):
        for option in ("--threads", "--repetitions"):
            for number in ("0", "-1", "x", "", "1.5", "1e30", "1e999999999", "nan", "1/2", "99999999999999999999999"):
                self.refused(2, option, number, says=(option, "expected a whole number from 1 to"))
        for seed in ("x", "-1", "", "18446744073709551616"):
            self.refused(2, "--seed", seed, says=("--seed", f"'{seed}'"))

    def test_empty_rosters(self):
        self.refused(2, "--strategies", "", says="empty")
        self.refused(2, "--strategies", " , ,", says="empty")
        self.refused(2, "--exclude", "classics", says="empty")
        self.refused(2, "--include", "", says="empty")
        self.refused(2, "--strategies", "pavlov", "--no-self-play", says="nothing to play")
        nobody = self.file("nobody.machines", "# nothing but a comment\n")
        self.refused(3, "--strategies", "@" + nobody)

    def test_names_given_twice(self):
        self.refused(2, "--strategies", "all_c,all_d,AllC", says="'all_c' is given twice")
        self.refused(2, "--strategies", "classics,pavlov", says="'pavlov' is given twice")
        self.refused(2, "--include", "win_stay_lose_shift", says="'pavlov' is given twice")
        self.refused(2, "--include", "random(0.5),random(0.5)", says="given twice")
        self.refused(2, "--strategies", "classics,Classics", says="'Classics' is given twice")
        self.refused(2, "--include", "classics", says="'classics' is given twice")
        self.refused(2, "--strategies", "periodic(2),per_cd", says="'per_cd' is given twice")
        mine = self.file("mine.machines", "machine pavlov; c C c c\n")
        self.refused(2, "--include", "@" + mine, says="'pavlov' is given twice")
        # Nothing was made for a tournament that was not played.
        self.refused(2, "--include", "pavlov", "--output", str(self.folder / "results"))
        self.assertFalse((self.folder / "results").exists())

    def test_labels(self):
        self.refused(2, "--strategies", "a=classics", says=("'a=classics'", "a label names one strategy, not 17"))
        self.refused(2, "--strategies", "a=pavlov,A=tft", says="'A' is given twice")
        self.refused(2, "--strategies", "pavlov=tft,pavlov", says="'pavlov' is given twice")
        self.refused(2, "--strategies", "=pavlov", says="is no label; use at most 100 letters, digits and _ . - +")
        self.refused(2, "--strategies", "my pavlov=pavlov", says="'my pavlov' is no label")
        self.refused(2, "--strategies", "a=", says="write LABEL=NAME, as in hard=random(0.2)")
        self.refused(2, "--strategies", "a=pavlow", says="did you mean pavlov")
        self.refused(2, "--strategies", "a=pavlov", "--include", "a=tft", says="'a' is given twice")

    def test_the_standard_input_is_read_once(self):
        machine = "machine a; c C c c\nmachine b; d D d d\n"
        for program, *arguments in (("ipd-match", "@-#a", "@-#b"), ("ipd-strategies", "diff", "@-#a", "@-#b"),
                                    ("ipd-tournament", "--strategies", "@-,x=@-#a"),
                                    ("ipd-tournament", "--strategies", "@-", "--include", "@-")):
            self.refused(2, *arguments, program=program, input=machine,
                         says="@-: the standard input can be read once, and another @- has read it; name a file")
        game = 'NFG 1 R "Stag hunt" { "A" "B" } { 2 2 }\n4 4 0 3 3 0 2 2\n'
        self.refused(2, "--game", "-", "--strategies", "@-", input=game,
                     says="@-: the standard input can be read once, and --game - has read it; name a file")

    def test_options_no_program_has(self):
        for program in PROGRAMS:
            enough = ENOUGH[program]
            self.refused(2, *enough, "--nosuch", program=program, says="--nosuch")
            self.refused(2, *enough, "--nosuch=3", program=program, says="--nosuch")
            self.refused(2, *enough, "--quie", program=program, says="did you mean --quiet?")

    def test_help_names_every_value(self):
        for program in (*PROGRAMS, "sce-check", "payoff-region"):
            for option in ("--help", "-h"):
                text = run(program, option).stdout
                self.assertIn("-h [ --help ]", text)
                self.assertNotRegex(text, r"--[a-z-]+ (arg|VALUE|\(=)")
        for verb in ("collect", "inspect", "offline", "online", "curve", "study"):
            self.assertNotRegex(run("mpe-train", verb, "--help").stdout, r"--[a-z-]+ (arg|VALUE|\(=)")
        self.assertEqual(run("ipd-match", "-V").stdout, run("ipd-match", "--version").stdout)

    def test_arguments_that_nobody_wants(self):
        self.refused(2, "stray", says=("unexpected argument 'stray'", "ipd-tournament [options]"))
        self.refused(2, "pavlov", "tit_for_tat", says="'pavlov'")
        self.refused(2, "all_c", "all_d", "third", program="ipd-match", says="'third'")
        self.refused(2, "pavlov", "second", "-o", "x.svg", program="strategy-graph", says="'second'")
        self.refused(2, "list", "all_c", "all_d", program="ipd-strategies")
        self.refused(2, "--", "--rounds", says="'--rounds'")

    def test_values_that_are_missing_or_too_many(self):
        for option in ("--strategies", "--rounds", "--noise", "--payoffs", "--game", "--output", "--format", "--seed"):
            self.refused(2, option, says=option)
        self.refused(2, "--rounds", "--seed", "3", says=("--rounds has no value", "'--seed' follows"))
        self.refused(2, "--output", "--plot=png", says=("--output has no value", "'--plot=png' follows"))
        self.refused(2, "pavlov", "-o", "--quiet", program="strategy-graph", says="-o has no value")
        self.refused(2, "--rounds=", says="--rounds")
        self.refused(2, "--rounds", "10", "--rounds", "20", says="--rounds")
        self.refused(2, "--no-self-play=yes", says="--no-self-play")

    def test_formats(self):
        for program in ("ipd-tournament", "ipd-evolve", "ipd-judge", "ipd-match", "ipd-strategies"):
            for form in ("xml", "", "JSON"):
                arguments = (*ENOUGH[program], "--format", form)
                self.refused(2, *arguments, program=program, says=("--format", "text, csv, json"))

    def test_pictures(self):
        self.refused(2, "--plot", says="--output DIR")
        self.refused(2, "--plot=gif", "--output", str(self.folder), says="svg, png or pdf")
        if run("ipd-tournament", "--strategies", "all_c", "--plot", "--output", str(self.folder)).returncode == 0:
            results = self.folder / "results"
            self.refused(2, "--strategies", "memory(1,2)", "--plot", "--output", str(results), says="at most 300")
            self.assertFalse(results.exists())  # refused before it was played
        self.refused(2, "pavlov", "-o", "x.gif", program="strategy-graph")

    def test_what_cannot_be_counted(self):
        self.refused(2, "--rounds", "1000000000000", says=("all_d against gradual", "leave one of them out"))
        self.refused(2, "--exclude", "gradual", "--rounds", "1000000000000000", "--payoffs", "T=5000,R=3,P=1,S=0",
                     "--quiet", says="fewer")


class BadInputFiles(Errors):
    def test_machines_have_line_numbers(self):
        faults = {
            "machine a\nc C c d\n": ":2: unknown state 'd'",
            "machine a\nc C c\n": ":2: ",
            "machine a\nc 1.5 c c\n": ":2: move '1.5'",
            "machine a\n\n\nmachine b; c C c c\n": ":1: machine 'a' has no state",
            "machine a; c C c c\nmachine A_; c C c c\n": ":2: machine 'A_' has the name",
            "c C c c\n": ":1: ",
            "machine a\nc C c c\nc D c c\n": ":3: ",
            "machine a\nc C c c\x01\n": ":2: ",
        }
        for text, says in faults.items():
            path = self.file("bad.machines", text)
            self.refused(3, "--strategies", "@" + path, says=path + says)
            self.refused(3, "all_c", "@" + path, program="ipd-match", says=path + says)
            self.refused(3, "show", "@" + path, program="ipd-strategies", says=path + says)
            self.refused(3, "@" + path, "-o", "x.svg", program="strategy-graph", says=path + says)

    def test_what_is_wrong_on_the_standard_input(self):
        self.refused(3, "--strategies", "@-", input="machine a\nc C c d\n", says="standard input:2: unknown state 'd'")
        self.refused(3, "--strategies", "@-#b", input="machine a\nc C c c\n", says="standard input: no machine of that")
        self.refused(3, "--strategies", "@-", input="", says="standard input:1: no machine in this file")
        self.refused(3, "--game", "-", input="hello", says="standard input:1:")

    def test_files_that_are_not_there(self):
        for option, name in (("--strategies", "@nosuch"), ("--include", "@nosuch"), ("--game", "nosuch")):
            self.refused(3, option, name, says="nosuch: no such file")
        self.refused(3, "--game", "")
        self.refused(2, "--strategies", "@", says="needs the name of a file")

    def test_a_directory_where_a_file_belongs(self):
        folder = str(self.folder)
        self.refused(3, "--strategies", "@" + folder, says="is a directory")
        self.refused(3, "--include", f"@{folder}#a", says="is a directory")
        self.refused(3, "--game", folder, says="is a directory")
        self.refused(3, "all_c", "all_d", "--game", folder, program="ipd-match", says="is a directory")

    def test_a_file_without_end(self):
        path = self.file("huge.machines", "machine a; c C c c\n")
        os.truncate(path, 10 * 2**30)  # a hole, it takes no room
        self.refused(3, "--strategies", "@" + path, says="larger than 64 MiB")
        self.refused(3, "--game", path, says="larger than 64 MiB")
        self.refused(3, "--strategies", "@/dev/zero", says="larger than 64 MiB")

    def test_games_that_make_no_sense(self):
        faults = {
            "": "",
            "hello": ":1:",
            'NFG 1 R "x" { "a" "b" } { 2 2 }\n1 2 3': ":",
            'NFG 1 R "three" { "a" "b" "c" } { 2 2 2 }\n' + "0 " * 24: "",
            'NFG 1 R "not symmetric" { "a" "b" } { 2 2 }\n1 2 3 4 5 6 7 8\n': "symmetric",
            'NFG 1 R "3x3" { "a" "b" } { 3 3 }\n' + "0 " * 18: "2x2",
        }
        for text, says in faults.items():
            path = self.file("bad.nfg", text)
            done = run("ipd-tournament", "--game", path)
            self.assertIn(done.returncode, (2, 3), done)
            self.refused(done.returncode, "--game", path, says=says)


class TheWorldOutside(Errors):
    def test_outputs_that_cannot_be_written(self):
        occupied = self.file("occupied", "a file, not a folder")
        for output in (occupied, occupied + "/results", "/proc/results", "/dev/null", "/dev/null/x", ""):
            self.refused(4, "--output", output, says=f"--output '{output}'")
        (self.folder / "folder.svg").mkdir()
        for output in (occupied + "/x.svg", str(self.folder / "folder.svg"), "/proc/x.svg"):
            self.refused(4, "pavlov", "-o", output, program="strategy-graph")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_that_may_not_be_written(self):
        self.folder.chmod(stat.S_IRUSR | stat.S_IXUSR)
        self.refused(4, "--output", str(self.folder), says="Permission denied")
        self.refused(4, "--output", str(self.folder / "results"), says="Permission denied")

    def test_a_file_of_the_output_in_the_way(self):
        (self.folder / "scores.csv").mkdir()
        self.refused(4, "--output", str(self.folder), says="scores.csv")
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.endswith(".tmp")], [])

    def test_programs_that_are_dead(self):
        for command in ("exit 3", "false", "kill -9 $$", "read line; exit 0"):
            self.refused(4, "--include", f'exec:"{command}"', says=(f'exec:"{command}"', "in the middle of a match"))
            self.refused(4, "all_c", f'exec:"{command}"', program="ipd-match", says="in the middle of a match")
        # The shell has its say too: stderr is shared with the program.
        done = run("ipd-tournament", "--include", 'exec:"/no/such/program"')
        self.assertEqual((done.returncode, done.stdout), (4, ""), done)
        own = [line for line in done.stderr.splitlines() if line.startswith("ipd-tournament: ")]
        self.assertEqual(len(own), 1)
        self.assertIn("the shell found no such command", own[0])

    def test_programs_that_talk_nonsense(self):
        self.refused(4, "--include", 'exec:"while read line; do echo maybe; done"', says="'maybe'")
        self.refused(4, "--include", 'exec:"yes"')
        self.refused(2, "--include", 'exec:""', says="no command")

    def test_programs_that_are_silent(self):
        self.refused(4, "--strategies", 'all_c,exec("sleep 1000";timeout=0.3;start=0.3)', says="silent for 0.3 s")

    def test_programs_that_draw_are_missing(self):
        nowhere = {**os.environ, "PATH": str(self.folder)}
        results = self.folder / "results"
        self.refused(4, "--output", str(results), "--plot", env=nowhere, says="apt-get install gnuplot-nox")
        self.assertFalse(results.exists())  # said before it was played
        self.refused(4, "pavlov", "-o", str(self.folder / "x.svg"), program="strategy-graph", env=nowhere,
                     says="apt-get install graphviz")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_gnuplot_that_fails_and_one_that_writes_half(self):
        stand_in = self.folder / "gnuplot"
        results = self.folder / "results"
        arguments = ("--strategies", "all_c", "--output", str(results), "--plot")
        for script, says in (
            ("exit 0", "is the disk full?"),
            ("[ $1 = --version ] || { echo 'line 3: no such thing' >&2; exit 1; }", "line 3: no such thing"),
            ("exit 7", "gnuplot failed (exit code 7)"),
        ):
            stand_in.write_text(f"#!/bin/sh\n{script}\n")
            stand_in.chmod(0o755)
            path = f"{self.folder}:{os.environ['PATH']}"
            self.refused(4, *arguments, env={**os.environ, "PATH": path}, says=says)
            self.assertFalse([file for file in results.glob("*") if file.suffix not in (".csv", ".json")])

    def test_a_standard_output_that_is_full(self):
        for program in PROGRAMS:
            for arguments in (ENOUGH[program], ("--help",), ("--version",)):
                if program == "strategy-graph" and arguments == ENOUGH[program]:
                    continue  # prints nothing
                with open("/dev/full", "w") as full:
                    self.refused(4, *arguments, program=program, stdout=full, says="No space left on device")
        with open("/dev/full", "w") as full:
            self.refused(4, "--strategies", "memory(1,1)", "--format", "json", stdout=full, says="No space left")

    def test_a_standard_output_that_is_closed(self):
        done = subprocess.run(["/bin/sh", "-c", '"$0" >&-', BIN / "ipd-tournament"], capture_output=True, text=True)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (4, 1), done)

    def test_a_reader_that_goes_away(self):
        with subprocess.Popen([BIN / "ipd-tournament", "--strategies", "memory(1,1),memory(1,2)", "--format", "json"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            self.assertEqual(program.stdout.readline(), "{\n")
            program.stdout.close()
            self.assertEqual(program.wait(60), 0)
            self.assertEqual(program.stderr.read(), "")

    def test_a_standard_error_that_is_full_or_closed(self):
        for redirection in ("2>/dev/full", "2>&-"):
            for arguments, code in (("--rounds 0", 2), ("--payoffs T=9,R=3,P=1,S=0", 0), ("--strategies @nosuch", 3)):
                command = f'"$0" {arguments} {redirection}'
                done = subprocess.run(["/bin/sh", "-c", command, BIN / "ipd-tournament"], stdout=subprocess.DEVNULL)
                self.assertEqual(done.returncode, code, command)


if __name__ == "__main__":
    unittest.main()
