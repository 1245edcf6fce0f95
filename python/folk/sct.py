"""The self-confirming transformer (docs/sct.md): policies, what they believe, and their training."""

import csv
import os
from typing import Tuple

import numpy

from folk import _folk
from folk._options import Options
from folk.matches import Match, match
from folk.strategies import Strategy


class Policy:
    """A trained transformer. name; architecture and training: what its file says of it; parameters: a read-only array of
    shape (P,), float32, a view of what the library holds. folk.sct.load makes it."""

    def __init__(self, held):
        self._held = held
        self.name = held.name
        self.architecture = held.architecture
        self.training = held.training

    @property
    def parameters(self) -> numpy.ndarray:
        return self._held.parameters

    def strategy(self, target=None, sample=False, extrapolate=False) -> Strategy:
        """It as a folk.Strategy. target: the return that it is asked for (points of a match; default its own); sample: it
        draws its moves; extrapolate: it also plays games and lengths that it was not trained on."""
        return Strategy(self._held.strategy(target, sample, extrapolate))

    def play(self, opponent, rounds=None, **options) -> Match:
        """A folk.Match against an opponent, by default as long as those it was trained on; options as of folk.match. Its
        beliefs are the match's beliefs[0]."""
        return match(self.strategy(), opponent, rounds=rounds or self.training["rounds"], **options)

    def thoughts(self, own="", theirs="") -> Tuple[str, numpy.ndarray, numpy.ndarray]:
        """What it thinks along a history, two texts of C and D of length T: moves, a text of the moves it means to play;
        beliefs, an array of the probability that the other plays C; tokens, uint8, the belief token that it feeds itself
        (0 is C, 1 is D). Each is of the T rounds and of the one that follows, where the match has one. Raises UsageError
        for a policy without beliefs.

        >>> import folk
        >>> moves, beliefs, tokens = folk.sct.load("sct").thoughts("CC", "CC")
        >>> moves, tokens.tolist(), bool((beliefs > 0.5).all())
        ('CCC', [0, 0, 0], True)
        """
        return self._held.thoughts(own, theirs)

    def __repr__(self):
        return f"<folk.sct.Policy {self.name}, {self.parameters.size} parameters>"


def load(name="sct") -> Policy:
    """The policy of a name (sct, sct-bayes, sct-plan) or of a file that sct-train wrote. Raises InputError."""
    return Policy(_folk.load_policy(os.fspath(name)))


def train(output, log=None, progress=None, threads=None, **options) -> Policy:
    """Trains a policy, writes it to the file `output` and returns it; docs/sct-train.md says what options mean (write
    learning_rate for learning-rate, and config="run.conf" for a file of them). log: a function that is told a dictionary
    for each evaluation, with the columns of sct-train --log. Ended early, by Ctrl-C or by what log or progress raise, it
    leaves no file. Raises UsageError, InputError."""
    given = Options(threads=threads, **options)
    told = None if log is None else lambda heading, row: log(next(csv.DictReader([heading, row])))
    _folk.train(given.values, os.fspath(output), told, progress)
    return load(output)
