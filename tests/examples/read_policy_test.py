"""examples/read_policy.py on a file made here from the description in docs/policy-files.md, and on files of Folk."""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SMALLEST = ROOT / "tests" / "fuzz" / "corpus" / "policy" / "smallest"


def shown(path):
    command = [sys.executable, ROOT / "examples" / "read_policy.py", path]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def checksum(metadata, numbers):
    """The checksum as the documentation tells it; `numbers` are the words of all tensors in the file's order."""
    words = []
    for key, text in sorted((key.encode(), text.encode()) for key, text in metadata.items() if key != "checksum"):
        words += [*key, 256, *text, 256]
    state = 0xCBF29CE484222325
    for word in words + numbers:
        state = (state ^ word ^ (word >> 47)) * 0x100000001B3 % 2**64
        state ^= state >> 33
    state = (state ^ (state >> 32)) * 0x9E3779B97F4A7C15 % 2**64
    return f"{state ^ (state >> 29):016x}"


class ReadPolicy(unittest.TestCase):
    def test_a_file_from_the_description(self):
        header = {
            "__metadata__": {"format": "folk-sct-1", "hidden": "2"},
            "a.weight": {"dtype": "F32", "shape": [2, 2], "data_offsets": [0, 16]},
            "a.bias": {"dtype": "F32", "shape": [2], "data_offsets": [16, 24]},
        }
        text = json.dumps(header).encode()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "policy.bin"
            path.write_bytes(struct.pack("<Q", len(text)) + text + struct.pack("<6f", 1, -2, 3, -4, 0.5, 0.25))
            lines = ["format: folk-sct-1", "hidden: 2", "a.weight [2, 2] 2.5000", "a.bias [2] 0.3750"]
            self.assertEqual(shown(path), lines)

    def test_a_file_of_folk(self):
        lines = shown(SMALLEST)
        self.assertIn("token_layout: return observation belief action", lines)
        self.assertIn("return_target: 8.75", lines)
        self.assertIn("embed_timestep.weight [3, 1] 0.0312", lines)  # 1/64, 2/64 and 3/64
        self.assertEqual(sum("[" in line and ":" not in line for line in lines), 27)

    def test_shipped_policies(self):
        for path in (ROOT / "data" / "policies").glob("*.bin"):
            version = 1 if path.stem in ("sct", "sct-bayes") else 2  # which plan
            self.assertIn(f"format: folk-sct-{version}", shown(path))

    def test_the_documented_checksum(self):
        content = SMALLEST.read_bytes()
        (length,) = struct.unpack("<Q", content[:8])
        metadata = json.loads(content[8 : 8 + length])["__metadata__"]
        data = content[8 + length :]
        self.assertEqual(checksum(metadata, list(struct.unpack(f"<{len(data) // 4}I", data))), metadata["checksum"])


if __name__ == "__main__":
    unittest.main()
