#!/usr/bin/env python3
"""Tit for tat as a program of its own, with a belief: how often the opponent has cooperated so far.

    ipd-match 'exec:"python3 examples/tit_for_tat.py"' pavlov --rounds 10
"""
import sys

for line in sys.stdin:
    words = line.split()
    if words[0] == "game":  # a new match: forget the last one
        answer, rounds, cooperated = "C", 0, 0
    elif words[0] == "round":  # what both really played, own move first
        answer = words[2]
        rounds += 1
        cooperated += words[2] == "C"
    elif words[0] == "move":  # the only line that wants an answer
        belief = (cooperated + 1) / (rounds + 2)  # Laplace's rule of succession
        print(answer, belief, flush=True)
    elif words[0] == "end":
        break
