"""Tests the check of headers: those that include all they need pass, and one that leans on its neighbours is named."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

COMMON = "#include <string>\n#include <vector>\n"
WHOLE = {f"games/whole_{i}.h": f"#pragma once\n{COMMON}inline std::vector<std::string> whole_{i}() {{ return {{}}; }}\n" for i in range(8)}
# Read after one of the others, each of these would compile.
LEANING = {
    "games/forgets_string.h": "#pragma once\n#include <vector>\ninline std::vector<std::string> a() { return {}; }\n",
    "mpe/forgets_all.h": "#pragma once\ninline std::vector<int> b() { return {}; }\n",
    "sct/forgets_whole.h": f"#pragma once\n{COMMON}inline auto c() {{ return whole_3(); }}\n",
}


def check(headers):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder, "folk")
        for name, text in headers.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        Path(folder, "compile_commands.json").write_text(json.dumps([{"command": f"c++ -I{folder} -c a.cpp"}]), encoding="utf-8")
        return subprocess.run([sys.executable, "-B", Path(__file__).parent / "headers_alone.py", root, folder], capture_output=True, text=True)


class HeadersAlone(unittest.TestCase):
    def test_whole_ones_pass(self):
        done = check(WHOLE)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"{len(WHOLE)} headers compile alone\n", ""))

    def test_each_that_leans_is_named(self):
        done = check(WHOLE | LEANING)
        self.assertEqual(done.returncode, 1)
        self.assertEqual([line.split(": ")[0] for line in done.stdout.splitlines()], sorted(LEANING))


if __name__ == "__main__":
    unittest.main()
