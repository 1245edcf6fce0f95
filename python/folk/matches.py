"""One match, move by move."""

import json

import numpy

from folk import _folk
from folk._options import Options
from folk._results import Result


class Match(Result):
    """A match that was played, as ipd-match tells it (docs/ipd-match.md): everything is of the two seats, in order.

    players, moves ("CCD..." each), scores (points), means (points a round), cooperation_rates; running_scores, two numpy
    arrays of shape (rounds,); beliefs, for each seat an array (rounds,) of the probability that the other plays C, NaN
    where it told none, or None; slips: the rounds, from 1, in which noise flipped the move; belief_accuracy; notes.
    """

    def __init__(self, held):
        super().__init__(held)
        self.data = json.loads(held.form("json"))
        for name in ("scores", "means", "cooperation_rates", "slips", "belief_accuracy", "moves", "players"):
            setattr(self, name, tuple(self.data[name]))
        self.rounds = self.data["rounds"]
        self.notes = self.data["notes"]

    @property
    def running_scores(self) -> tuple:
        return tuple(numpy.array(scores, dtype=float) for scores in self.data["running_scores"])

    @property
    def beliefs(self) -> tuple:
        return tuple(None if beliefs is None else numpy.array(beliefs, dtype=float) for beliefs in self.data["beliefs"])

    def __repr__(self):
        return "<folk.Match {0[0]} {1[0]}, {0[1]} {1[1]}>".format(self.players, self.scores)


def match(first, second, rounds=30, noise=0, payoffs=None, game=None, sample=False, extrapolate=False, seed=1,
          progress=None) -> Match:
    """Plays one match and keeps every move; what the arguments mean is in docs/ipd-match.md.

    first, second: strategies, names, players of your own. rounds: 1 to 1,000,000. noise: the probability that a move
    flips. payoffs: "T=5,R=3,P=1,S=0" or a dictionary; game: a folk.StageGame or the path of a .nfg file. progress: None
    (a bar on a terminal), False, or a function of the finished share. Raises UsageError, InputError, and what a player
    raises.

    >>> import folk
    >>> folk.match("tit_for_tat", "prober", rounds=10)
    <folk.Match tit_for_tat 29, prober 29>
    """
    options = Options(rounds=rounds, noise=noise, payoffs=payoffs, game=game, sample=sample, extrapolate=extrapolate,
                      seed=seed)
    options.values["player"] = (options.spec(first), options.spec(second))
    return Match(_folk.match(options.values, options.guests, progress))
