"""The rules of the house, read off the source tree: which folder may include and link which, and what library code
never does. `python3 house.py ROOT` prints one line a violation and exits 1 when there is any."""

import re
import sys
from pathlib import Path

# Each library may use itself and those to its left.
LIBRARIES = ["games", "strategies", "analysis", "sct", "mpe"]
# The wings of a folder: each may use itself and those of earlier lines, not its neighbours on the same line; "" is the
# folder's own floor.
WINGS = {
    "games": [[""], ["stage_games"]],
    "strategies": [[""], ["programs"], ["axelrod"], ["standard"]],
    "analysis": [["play"], ["crew"], ["tournament", "replies", "thresholds", "beliefs", "folk_theorem"], ["classes"],
                 ["evolution", "equilibria"], ["judgement", "pictures"]],
    "sct": [["files"], ["network"], ["data"], ["policy"], ["training"]],
    "mpe": [["world"], ["network"], ["players"], ["evaluation"], ["online", "data", "pictures"], ["offline"], ["study"]],
    "tools": [["description"], ["program"], ["choices"],
              ["ipd_match", "ipd_strategies", "ipd_tournament", "ipd_evolve", "ipd_judge", "strategy_graph", "sct_train", "payoff_region",
               "sce_check", "mpe_train", "mpe_evaluate"]],
    "python": [["bindings"], ["players"]],
}
MOST_UNITS = 20  # of a folder; a unit is a header with its source
# Folders that may include any library, but no other folder of this list except their own.
LEAVES = ["tools", "mpi", "python", "tests", "bench", "examples"]
# What of these may be included by another of them: python/ asks what the programs ask, and tests test.
SHARED_LEAVES = {"tests": {"tools"}, "python": {"tools"}}
NAMELESS = {"util", "utils", "utility", "utilities", "common", "core", "misc", "helpers"}
SOURCE_SUFFIXES = {".h", ".cpp"}

# What a library never does: print, exit, read a clock, draw from a global generator.
FORBIDDEN_CALLS = [
    ("prints", re.compile(r"\bstd::(?:cout|cerr|clog|wcout|wcerr|print|println)\b|\bfmt::print|\b(?:v?f?printf|puts|fputs|putchar|perror)\s*\(")),
    ("reads stdin", re.compile(r"\bstd::w?cin\b")),
    ("ends the process", re.compile(r"(?<![\w.>])(?:std::)?(?:exit|_Exit|quick_exit|abort|terminate)\s*\(")),
    ("reads a clock", re.compile(r"\b(?:system_clock|high_resolution_clock|steady_clock|clock_gettime|gettimeofday)\b|\bstd::time\s*\(")),
    ("uses a global generator", re.compile(r"\bstd::random_device\b|(?<![\w.>])(?:std::)?s?rand\s*\(")),
]

# Exceptions, each with its reason.
ALLOWED = {
    ("strategies/programs/child_process.cpp", "reads a clock"): "a silent program must time out",
    ("strategies/programs/pipes.h", "reads a clock"): "a silent program must time out",
    ("strategies/programs/pipes.cpp", "reads a clock"): "a silent program must time out",
}


def is_build_output(path):
    return any(part.startswith(("build", ".")) or part == "__pycache__" for part in path.parts)


def source_files(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.suffix in SOURCE_SUFFIXES and not is_build_output(relative) and path.is_file():
            yield relative, path.read_text(encoding="utf-8")


def without_comments(text, strings_too=False):
    """The text with comments (and the content of string literals) blanked, line numbers kept."""
    token = re.compile(
        r'R"(?P<tag>[^()\\ ]{0,16})\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/', re.S)

    def blank(match):
        found = match.group(0)
        if found.startswith("/"):
            return " " + "\n" * found.count("\n")
        return '""' + "\n" * found.count("\n") if strings_too else found

    return token.sub(blank, text)


def numbered(text):
    return enumerate(text.split("\n"), start=1)


def check_includes(root):
    line_form = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
    for path, text in source_files(root):
        folder = path.parts[0]
        for number, line in numbered(without_comments(text)):
            match = line_form.match(line)
            if not match:
                continue
            bracket, included = match.groups()
            where = f"{path}:{number}"
            if folder in LIBRARIES and bracket == '"':
                yield f'{where}: "{included}": a library includes in the form <folk/FOLDER/FILE.h>'
            if not included.startswith("folk/"):
                continue
            target = Path(included).parts[1]
            if bracket == '"':
                yield f'{where}: "{included}": write <{included}>'
            if not (root / Path(*Path(included).parts[1:])).is_file():
                yield f"{where}: <{included}> does not exist"
            if target not in LIBRARIES and target != folder and target not in SHARED_LEAVES.get(folder, ()):
                yield f"{where}: {folder} includes {target}, which is no library"
            elif folder in LIBRARIES and LIBRARIES.index(target) > LIBRARIES.index(folder):
                yield f"{where}: {folder} includes {target}: the arrows run {' <- '.join(LIBRARIES)}"


def folk_includes(text):
    """(line number, path without suffix) of each <folk/...> include."""
    for number, line in numbered(without_comments(text)):
        match = re.match(r"\s*#\s*include\s*<folk/([\w/]+)\.h>", line)
        if match:
            yield number, match.group(1)


def wing_of(unit):
    parts = unit.split("/")
    return parts[1] if len(parts) > 2 else ""


def check_wings(root):
    for path, text in source_files(root):
        wings = WINGS.get(path.parts[0])
        if wings is None:
            continue
        order = " <- ".join("|".join(name or path.parts[0] for name in names) for names in wings)
        floors = {wing: floor for floor, names in enumerate(wings) for wing in names}
        wing = wing_of(path.with_suffix("").as_posix())
        if wing not in floors:
            yield f"{path}: {path.parts[0]} has the wings {order}: put it into one"
            continue
        for number, included in folk_includes(text):
            target = wing_of(included) if included.split("/")[0] == path.parts[0] else wing
            if target != wing and floors.get(target, len(wings)) >= floors[wing]:
                yield f"{path}:{number}: {wing or path.parts[0]} includes {target or path.parts[0]}: the arrows run {order}"


def check_circles(root):
    """No unit, a header with its source, includes itself through others."""
    graph = {}
    for path, text in source_files(root):
        if path.parts[0] in (*LIBRARIES, "tools", "python"):
            unit = path.with_suffix("").as_posix()
            graph.setdefault(unit, set()).update(included for _, included in folk_includes(text) if included != unit)
    done, walk = set(), []

    def visit(unit):
        if unit in walk:
            yield " -> ".join([*walk[walk.index(unit):], unit]) + ": units include each other in a circle"
        elif unit not in done:
            walk.append(unit)
            for included in sorted(graph.get(unit, ())):
                yield from visit(included)
            walk.pop()
            done.add(unit)

    for unit in sorted(graph):
        yield from visit(unit)


def check_sizes(root):
    units = {}
    for path, _ in source_files(root):
        units.setdefault(path.parent, set()).add(path.stem)
    for folder, names in sorted(units.items()):
        if len(names) > MOST_UNITS:
            yield f"{folder}: {len(names)} units, at most {MOST_UNITS} find room: open another"


def check_tests(root):
    """A test stands at the path of what it tests: a unit of its name, or one of that folder which it includes."""
    units = {path.with_suffix("").as_posix() for path, _ in source_files(root) if path.parts[0] in LIBRARIES}
    for path, text in source_files(root):
        if path.parts[:1] != ("tests",) or path.parts[1] not in LIBRARIES or not path.stem.endswith("_test"):
            continue
        folder = Path(*path.parts[1:]).parent
        name = path.stem.removesuffix("_test")
        homes = sorted(unit for unit in units if unit.split("/")[0] == path.parts[1] and Path(unit).name == name)
        if homes:
            if (folder / name).as_posix() not in homes:
                yield f"{path}: {homes[0]} is what it tests: it stands at tests/{homes[0]}_test.cpp"
        elif not any(Path(included).parent == folder for _, included in folk_includes(text)) and not re.search(
                rf'#\s*include\s*["<]{folder.as_posix()}/', text):
            yield f"{path}: includes nothing of {folder}: it stands where what it tests stands"


def linked_folders(cmake_text):
    """The libraries of Folk that a folder's CMakeLists.txt names after its folk_library(NAME."""
    call = re.search(r"folk_library\(\s*(\w+)([^)]*)\)", re.sub(r"#[^\n]*", "", cmake_text))
    return re.findall(r"\bfolk::(\w+)", call.group(2)) if call else []


def check_links(root):
    """Links point along the arrows, and what a folder includes it also links, directly or through another."""
    reached = {}
    for index, folder in enumerate(LIBRARIES):
        lists = root / folder / "CMakeLists.txt"
        if not lists.is_file():
            continue
        links = linked_folders(lists.read_text(encoding="utf-8"))
        reached[folder] = {folder}.union(links, *(reached.get(link, set()) for link in links))
        for link in links:
            if link not in LIBRARIES[:index]:
                yield f"{folder}/CMakeLists.txt: links folk::{link}: the arrows run {' <- '.join(LIBRARIES)}"
    for path, text in source_files(root):
        folder = path.parts[0]
        if folder not in reached:
            continue
        for target in re.findall(r"#\s*include\s*<folk/(\w+)/", without_comments(text)):
            if target in LIBRARIES and target not in reached[folder]:
                yield f"{path}: includes {target}, which {folder}/CMakeLists.txt does not link"


def check_folders(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.is_dir() and path.name.lower() in NAMELESS and not is_build_output(relative):
            yield f"{relative}: a helper lives where its first user lives, not in a folder of this name"


def check_headers(root):
    for path, text in source_files(root):
        if path.suffix != ".h":
            continue
        lines = text.split("\n")
        if lines[0] != "#pragma once":
            yield f"{path}:1: a header opens with #pragma once"
        if not any(line.startswith("//") for line in lines[:3]):
            yield f"{path}:2: a header says what it is in a comment at its top"


def check_names(root):
    """Two types of one name in one namespace are one to the linker, which takes either's functions for both."""
    known = {}
    for path, text in source_files(root):
        if path.suffix != ".h" or path.parts[0] not in LIBRARIES:
            continue
        plain = without_comments(text, strings_too=True)
        space = re.search(r"^namespace ([\w:]+) \{", plain, re.MULTILINE)
        for match in re.finditer(r"^(?:struct|class|enum class) (\w+)(?: final)?\s*[:{]", plain, re.MULTILINE):
            name = f"{space[1] if space else ''}::{match[1]}"
            if name in known:
                yield f"{path}:{plain.count(chr(10), 0, match.start()) + 1}: {name} is already in {known[name]}"
            known.setdefault(name, path)


def check_library_code(root):
    for path, text in source_files(root):
        if path.parts[0] not in LIBRARIES:
            continue
        for number, line in numbered(without_comments(text, strings_too=True)):
            for deed, form in FORBIDDEN_CALLS:
                match = form.search(line)
                if match and (path.as_posix(), deed) not in ALLOWED:
                    yield f"{path}:{number}: library code {deed}: {match.group(0).strip()}"


CHECKS = [check_includes, check_wings, check_circles, check_sizes, check_tests, check_links, check_folders, check_headers,
          check_names, check_library_code]


def violations(root):
    root = Path(root)
    return [line for check in CHECKS for line in check(root)]


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: house.py ROOT")
    found = violations(sys.argv[1])
    print("\n".join(found) if found else "the house is in order")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
