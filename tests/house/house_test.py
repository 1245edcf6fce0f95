"""Tests the house test: a small tree in order passes, and each planted violation is found."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import house

HEADER = "#pragma once\n// What it is.\n"
IN_ORDER = {
    "games/CMakeLists.txt": "folk_library(games DEPENDS fmt::fmt)",
    "games/move.h": HEADER,
    "strategies/CMakeLists.txt": "folk_library(strategies DEPENDS folk::games)",
    "strategies/player.h": HEADER + "#include <folk/games/move.h>\n",
    "strategies/player.cpp": "#include <folk/strategies/player.h>\nint f() { return 0; }  // never calls exit()\n",
    "analysis/CMakeLists.txt": "folk_library(analysis DEPENDS folk::strategies PRIVATE_DEPENDS Eigen3::Eigen)",
    "analysis/tournament/tournament.h": HEADER + "#include <folk/games/move.h>\n#include <folk/strategies/player.h>\n",
    "sct/CMakeLists.txt": "folk_library(sct DEPENDS folk::analysis)",
    "mpe/CMakeLists.txt": "folk_library(mpe DEPENDS folk::sct)",
    "mpe/world/batch.h": HEADER,
    "mpe/players/player.h": HEADER + "#include <folk/mpe/world/batch.h>\n",
    "mpe/online/learner.h": HEADER + "#include <folk/mpe/players/player.h>\n",
    "mpe/data/data_set.h": HEADER,
    "tools/program/program.h": HEADER + "#include <folk/analysis/tournament/tournament.h>\n",
    "tools/ipd_match/main.cpp": "#include <folk/tools/program/program.h>\nint main() { std::cout << 1; }\n",
    "tests/mpe/world/batch_test.cpp": "#include <folk/mpe/world/batch.h>\n",
    "build/games/core/wrong.h": "#include <folk/tools/program/program.h>\n",
}


def found_with(changes):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**IN_ORDER, **changes}.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return house.violations(folder)


class HouseTest(unittest.TestCase):
    def assert_one(self, changes, words):
        found = found_with(changes)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_tree_in_order_passes(self):
        self.assertEqual(found_with({}), [])

    def test_an_include_against_the_arrows(self):
        found = found_with({"games/wrong.cpp": "#include <folk/strategies/player.h>\n"})
        self.assertIn("games/wrong.cpp:1: games includes strategies: the arrows run", found[0])
        self.assertIn("does not link", found[1])

    def test_an_include_against_the_arrows_between_wings(self):
        self.assert_one({"mpe/world/wrong.cpp": "#include <folk/mpe/players/player.h>\n"},
                        "mpe/world/wrong.cpp:1: world includes players: the arrows run world <- network")
        self.assert_one({"mpe/online/wrong.cpp": "\n#include <folk/mpe/data/data_set.h>\n"},
                        "mpe/online/wrong.cpp:2: online includes data")

    def test_a_file_outside_the_wings(self):
        self.assert_one({"mpe/wrong.cpp": ""}, "mpe/wrong.cpp: mpe has the wings")
        self.assert_one({"mpe/misplaced/wrong.cpp": ""}, "mpe/misplaced/wrong.cpp: mpe has the wings")

    def test_an_include_from_a_room_down_to_its_own_floor_and_not_up(self):
        self.assertEqual(found_with({"games/stage_games/nfg.h": HEADER + "#include <folk/games/move.h>\n"}), [])
        self.assert_one({"games/stage_games/nfg.h": HEADER, "games/wrong.cpp": "#include <folk/games/stage_games/nfg.h>\n"},
                        "games/wrong.cpp:1: games includes stage_games: the arrows run games <- stage_games")

    def test_units_in_a_circle(self):
        self.assert_one({"games/move.h": HEADER, "games/a.h": HEADER, "games/a.cpp": "#include <folk/games/b.h>\n",
                         "games/b.h": HEADER + "#include <folk/games/c.h>\n", "games/c.h": HEADER + "#include <folk/games/a.h>\n"},
                        "games/a -> games/b -> games/c -> games/a: units include each other")

    def test_a_folder_that_is_full(self):
        full = {f"games/a{i}.h": HEADER for i in range(19)} | {"games/a1.cpp": ""}
        self.assertEqual(found_with(full), [])
        self.assert_one(full | {"games/z.cpp": ""}, "games: 21 units, at most 20")

    def test_a_test_that_stands_elsewhere(self):
        self.assert_one({"tests/mpe/online/batch_test.cpp": "#include <folk/mpe/world/batch.h>\n"},
                        "tests/mpe/online/batch_test.cpp: mpe/world/batch is what it tests")
        self.assert_one({"tests/mpe/online/golden_test.cpp": "#include <folk/mpe/world/batch.h>\n"},
                        "tests/mpe/online/golden_test.cpp: includes nothing of mpe/online")
        self.assertEqual(found_with({"tests/mpe/world/golden_test.cpp": "#include <folk/mpe/world/batch.h>\n"}), [])

    def test_a_library_that_includes_a_tool(self):
        self.assert_one({"analysis/play/wrong.cpp": "\n#include <folk/tools/program/program.h>\n"},
                        "analysis/play/wrong.cpp:2: analysis includes tools")

    def test_a_commented_include_is_none(self):
        self.assertEqual(found_with({"games/a.cpp": "// #include <folk/analysis/tournament/tournament.h>\n"}), [])

    def test_a_quoted_include_in_a_library(self):
        self.assert_one({"strategies/wrong.cpp": '#include "player.h"\n'}, "form <folk/FOLDER/FILE.h>")

    def test_a_quoted_folk_path_in_a_tool(self):
        self.assert_one({"tools/program/wrong.cpp": '#include "folk/games/move.h"\n'}, "write <folk/games/move.h>")

    def test_an_include_of_nothing(self):
        self.assert_one({"tools/program/wrong.cpp": "#include <folk/games/gone.h>\n"}, "does not exist")

    def test_a_link_against_the_arrows(self):
        self.assert_one({"games/CMakeLists.txt": "folk_library(games PRIVATE_DEPENDS folk::analysis)"},
                        "games/CMakeLists.txt: links folk::analysis")

    def test_an_include_that_is_not_linked(self):
        self.assert_one({"analysis/CMakeLists.txt": "folk_library(analysis DEPENDS folk::games)  # folk::strategies"},
                        "analysis/tournament/tournament.h: includes strategies")

    def test_a_folder_without_a_meaning(self):
        for name in ("util", "common", "core", "misc"):
            self.assert_one({f"bench/{name}/a.h": HEADER}, "its first user")

    def test_a_header_without_pragma_once(self):
        self.assert_one({"tools/program/wrong.h": "// What it is.\n"}, "#pragma once")

    def test_a_header_without_its_opening_comment(self):
        self.assert_one({"games/wrong.h": "#pragma once\n\nint f();\n"}, "comment at its top")

    def test_two_types_of_one_name(self):
        champion = HEADER + "namespace folk%s {\nclass Champion final : public Machine {\n};\n}\n"
        self.assert_one({"strategies/a.h": champion % "", "analysis/classes/a.h": champion % ""}, "folk::Champion is already in")
        self.assertEqual(found_with({"strategies/a.h": champion % "", "mpe/world/a.h": champion % "::mpe"}), [])
        forward = HEADER + "namespace folk {\nclass Champion;\n}\n"
        self.assertEqual(found_with({"strategies/a.h": champion % "", "strategies/b.h": forward}), [])

    def test_what_library_code_never_does(self):
        for line in ("std::cout << 1;", "std::cerr << 1;", 'printf("%d", 1);', 'std::fprintf(stderr, "a");',
                     'fmt::print("a");', "exit(1);", "std::exit(1);", "std::abort();", "std::random_device device;",
                     "int a = std::rand();", "auto t = std::chrono::steady_clock::now();", "std::cin >> a;"):
            self.assert_one({"games/wrong.cpp": f"void f() {{\n  {line}\n}}\n"}, "games/wrong.cpp:2: library code")

    def test_what_only_looks_like_it(self):
        for line in ('auto a = "exit(1)";', "// std::cout", "/* printf(\n) */", "_exit(127);", "std::snprintf(b, 1, c);",
                     "process.terminate();", "child->exit();", 'auto a = R"(std::cout)";', "int brand(int);"):
            self.assertEqual(found_with({"games/right.cpp": line + "\n"}), [], line)


if __name__ == "__main__":
    unittest.main()
