"""Tests scripts/setup.sh in a made-up system: what it installs, when it leaves apt-get alone, what it says when it cannot."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SETUP = Path(__file__).resolve().parents[2] / "scripts" / "setup.sh"
REAL_TOOLS = ["bash", "basename", "dirname", "env"]


class SetupTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="folk set-up ")
        self.addCleanup(self.folder.cleanup)
        self.bin = Path(self.folder.name, "bin")
        self.bin.mkdir()
        self.log = Path(self.folder.name, "log")
        self.log.touch()
        for tool in REAL_TOOLS:
            real = subprocess.run(["bash", "-c", f"type -P {tool}"], capture_output=True, text=True, check=True)
            (self.bin / tool).symlink_to(real.stdout.strip())

    def stub(self, name, script):
        path = self.bin / name
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(0o755)

    def system(self, installed=(), user=0, apt=True, sudo=False, apt_fails=False):
        names = " ".join(installed)
        if apt:
            self.stub("dpkg-query", f'[[ " {names} " == *" $3 "* ]] && printf installed || exit 1')
            self.stub("apt-get", f'echo "apt-get $*" >>"{self.log}"; exit {int(apt_fails)}')
        self.stub("id", f"echo {user}")
        if sudo:
            self.stub("sudo", f'echo sudo >>"{self.log}"; exec "$@"')

    def run_setup(self, *groups):
        command = f'set -euo pipefail; source "{SETUP}"; install_packages {" ".join(groups)}; echo ready'
        done = subprocess.run(["bash", "-c", command, "quickstart"], capture_output=True, text=True,
                              env={"PATH": str(self.bin), "LANG": os.environ.get("LANG", "C")})
        return done, self.log.read_text().splitlines()

    def all_packages(self, *groups):
        lines = (SETUP.parent / "packages.txt").read_text().splitlines()
        rows = [line.split(None, 2) for line in lines if line and not line.startswith("#")]
        self.assertTrue(all(len(row) == 3 and row[0] in ("run", "test", "docs", "site", "package", "mpi", "python", "notebooks", "ci") for row in rows), "group, package, why")
        return [row[1] for row in rows if row[0] in groups]

    def test_nothing_missing_leaves_apt_alone_for_any_user(self):
        self.system(installed=self.all_packages("run"), user=1000)
        done, log = self.run_setup("run")
        self.assertEqual((done.returncode, done.stdout, done.stderr, log), (0, "ready\n", "", []))

    def test_only_what_is_missing_is_installed(self):
        installed = [name for name in self.all_packages("run", "test") if name not in ("g++", "python3")]
        self.system(installed=installed)
        done, log = self.run_setup("run", "test")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(log), 2, log)
        self.assertTrue(log[0].endswith(" update"), log)
        self.assertTrue(log[1].endswith(" install --no-install-recommends g++ python3"), log)

    def test_quickstart_does_not_ask_for_what_tests_need(self):
        self.system()
        _, log = self.run_setup("run")
        self.assertTrue(log[1].endswith(" ".join(self.all_packages("run"))), log)

    def test_another_user_goes_through_sudo(self):
        self.system(user=1000, sudo=True)
        done, log = self.run_setup("run")
        self.assertEqual((done.returncode, log.count("sudo")), (0, 2), done.stderr)

    def assert_one_line(self, done, words):
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertNotIn("ready", done.stdout)

    def test_without_root_and_sudo(self):
        self.system(user=1000)
        done, log = self.run_setup("run")
        self.assert_one_line(done, "run this as root")
        self.assertEqual(log, [])

    def test_without_apt(self):
        self.system(apt=False)
        done, _ = self.run_setup("run")
        self.assert_one_line(done, "no apt-get here")

    def test_apt_that_fails(self):
        self.system(apt_fails=True)
        done, log = self.run_setup("run")
        self.assert_one_line(done, "apt-get update failed")
        self.assertEqual(len(log), 1)


if __name__ == "__main__":
    unittest.main()
