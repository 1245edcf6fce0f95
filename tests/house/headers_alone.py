"""Each header compiles alone: it includes all it needs. `python3 headers_alone.py ROOT BUILD [COMPILER]` takes the include
folders from BUILD/compile_commands.json, prints one line a header that does not compile and exits 1 when there is any.

What many headers include is read once, precompiled, for those that include all of it anyhow: none sees by it what it does not
include."""

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FOLDERS = ["games", "strategies", "analysis", "sct", "mpe", "tools"]


def include_graph(root):
    """What each header of Folk includes, all told: {path from the root: set of names in include lines}."""
    includes = {}
    for folder in FOLDERS:
        for header in (root / folder).rglob("*.h"):
            found = re.findall(r"^#include [<\"](.*?)[>\"]", header.read_text(encoding="utf-8"), re.MULTILINE)
            includes[header.relative_to(root).as_posix()] = [name.removeprefix("folk/") for name in found]

    def add(header, seen):
        for name in includes.get(header, []):
            if name not in seen:
                seen.add(name)
                add(name, seen)
        return seen

    return {header: frozenset(add(header, set())) for header in sorted(includes)}


def shared_starts(graph, weight):
    """What is worth to be read once: {header: the heaviest such set of names of which it includes each, or an empty one}."""
    start = dict.fromkeys(graph, frozenset())
    # What one header includes, as a whole, is what may be a start of others.
    users = {names: [header for header in graph if names <= graph[header]] for names in set(graph.values()) - {frozenset()}}
    load = {names: sum(map(weight.get, names)) for names in users} | {frozenset(): 0}

    def gain(names):  # to precompile them costs about three times what it costs to read them
        return sum(max(0, load[names] - load[start[user]]) for user in users[names]) - 3 * load[names]

    while gain(best := max(users, key=gain)) > 0:
        for user in users[best]:
            start[user] = max(start[user], best, key=load.get)
    return start


def include_flags(build):
    """All include folders that some file is compiled with."""
    flags = []
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        for i, word in enumerate(words):
            found = [word] if word.startswith("-I") and len(word) > 2 else words[i:i + 2] if word in ("-I", "-isystem") else []
            if found and found[-1] not in flags:
                flags += found
    return flags


def included(names, graph):
    return "".join(f"#include <{'folk/' if name in graph else ''}{name}>\n" for name in sorted(names))


def compiled(text, command, *more):
    return subprocess.run([*command, "-x", "c++", *more, "-"], input=text, capture_output=True, text=True)


def first_error(done):
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    return None if done.returncode == 0 else (errors or done.stderr.splitlines() or ["?"])[0]


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: headers_alone.py ROOT BUILD [COMPILER]")
    root, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    command = [sys.argv[3] if len(sys.argv) == 4 else "c++", "-std=c++20", "-w", *include_flags(build)]
    graph = include_graph(root)
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        others = sorted(set().union(*graph.values()) - graph.keys())
        read = pool.map(lambda name: len(compiled(included([name], graph), command, "-E").stdout), others)
        weight = dict(zip(others, read)) | {header: (root / header).stat().st_size for header in graph}
        start = shared_starts(graph, weight)
        files = {names: f"{folder}/{i}.h" for i, names in enumerate(set(start.values()) - {frozenset()})}

        def precompile(names):
            Path(files[names]).write_text(included(names, graph), encoding="utf-8")
            subprocess.run([*command, "-x", "c++-header", files[names]], stderr=subprocess.DEVNULL)  # its errors come again

        def complaint(header):
            begin = ["-include", files[start[header]]] if start[header] else []
            return first_error(compiled(included([header], graph), command, *begin, "-fsyntax-only"))

        list(pool.map(precompile, files))
        wrong = [f"{header}: {what}" for header, what in zip(graph, pool.map(complaint, graph)) if what]
    print("\n".join(wrong) if wrong else f"{len(graph)} headers compile alone")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
