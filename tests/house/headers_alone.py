"""Each header compiles alone: it includes all it needs. `python3 headers_alone.py ROOT BUILD [COMPILER]` takes the include
folders from BUILD/compile_commands.json, prints one line a header that does not compile and exits 1 when there is any.

A header that another one includes before anything else is compiled with that one, with nothing before it."""

import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FOLDERS = ["games", "strategies", "analysis", "sct", "mpe", "tools"]


def first_include(header):
    """What a header includes before anything else, as a path from the root; nothing for another library's."""
    found = re.search(r"^#include [<\"](.*?)[>\"]", header.read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1).removeprefix("folk/") if found and found.group(1).startswith("folk/") else None


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


def complaint(header, root, compiler, flags):
    """The first error of a header alone; nothing for a whole one."""
    text = f"#include <folk/{header.relative_to(root).as_posix()}>\n"
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-w", *flags, "-x", "c++", "-"], input=text,
                          capture_output=True, text=True)
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    return None if done.returncode == 0 else (errors or done.stderr.splitlines() or ["?"])[0]


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit("usage: headers_alone.py ROOT BUILD [COMPILER]")
    root, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    compiler = sys.argv[3] if len(sys.argv) == 4 else "c++"
    flags = include_flags(build)
    headers = sorted(header for folder in FOLDERS for header in (root / folder).rglob("*.h"))
    first = {first_include(header) for header in headers}
    alone = [header for header in headers if header.relative_to(root).as_posix() not in first]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda header: complaint(header, root, compiler, flags), alone))
    wrong = [f"{header.relative_to(root)}: {what}" for header, what in zip(alone, found) if what]
    print("\n".join(wrong) if wrong else f"{len(headers)} headers compile alone")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
