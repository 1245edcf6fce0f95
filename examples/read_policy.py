#!/usr/bin/env python3
"""Shows what a policy file holds: its metadata, then name, shape and mean absolute value of each tensor.

    python3 examples/read_policy.py data/policies/sct.bin
"""
import array
import json
import struct
import sys

with open(sys.argv[1], "rb") as file:
    (length,) = struct.unpack("<Q", file.read(8))
    header, data = json.loads(file.read(length)), file.read()
for key, text in header.pop("__metadata__").items():
    print(f"{key}: {text}")
for name, tensor in header.items():
    begin, end = tensor["data_offsets"]
    numbers = array.array("f", data[begin:end])
    if sys.byteorder == "big":
        numbers.byteswap()
    print(name, tensor["shape"], f"{sum(map(abs, numbers)) / len(numbers):.4f}")
