"""Round robins."""

import json
from typing import Any, Dict, List

import numpy

from folk import _folk
from folk._options import Options
from folk._pictures import Picture, svg_drawn
from folk._records import frame, frame_of_columns
from folk._results import Result


class Tournament(Result):
    """A tournament that was played, as ipd-tournament tells it (docs/ipd-tournament.md).

    strategies: names, in the order of rows and columns. signature: 16 hexadecimal digits, those that the program prints.
    Matrices are numpy arrays of shape (N, N), row against column, read-only, NaN where two did not meet:

      scores        points of a match: sums for finite and ending, (1-d)-weighted for discounted, per round for mean
      cooperations  moves C of the row against the column, weighted like the score
      normalised    100 x score / mean score of the roster against the column

    Where all entrants behave differently, `scores` and `cooperations` are views of what the library holds. Entrants that
    behave alike are played once and kept once; then the matrix is laid out on first use, and later uses are that array.
    What is kept is always a view: behaviour_scores of shape (B, B), and behaviours of shape (N,), which says whose is
    whose: scores == behaviour_scores[numpy.ix_(behaviours, behaviours)] / score_scale.
    """

    def __init__(self, held):
        super().__init__(held)
        self._kept = {}

    def _once(self, name, make):
        if name not in self._kept:
            self._kept[name] = make()
        return self._kept[name]

    @property
    def strategies(self) -> List[str]:
        return self._once("strategies", lambda: self._held.strategies)

    @property
    def signature(self) -> str:
        return self._held.signature

    @property
    def scores(self) -> numpy.ndarray:
        return self._once("scores", self._held.scores)

    @property
    def cooperations(self) -> numpy.ndarray:
        return self._once("cooperations", self._held.cooperations)

    @property
    def normalised(self) -> numpy.ndarray:
        return self._once("normalised", self._held.normalised)

    @property
    def behaviours(self) -> numpy.ndarray:
        return self._once("behaviours", lambda: numpy.array(self._held.behaviours))

    @property
    def behaviour_scores(self) -> numpy.ndarray:
        return self._held.behaviour_scores

    @property
    def behaviour_cooperations(self) -> numpy.ndarray:
        return self._held.behaviour_cooperations

    @property
    def score_scale(self) -> float:
        """The least common denominator of the payoffs, by which behaviour_scores are multiplied."""
        return self._held.score_scale

    @property
    def summary(self) -> Dict[str, Any]:
        """Settings, notes and ranking: what summary.json holds."""
        return self._once("summary", lambda: json.loads(self._held.form("summary")))

    @property
    def ranking(self) -> Any:
        """Best first: rank, name, total, mean and median (points a round), wins, cooperation_rate, normalised, method and
        more (pandas.DataFrame where pandas is installed, else a list of dictionaries)."""
        return frame(self.summary["ranking"])

    @property
    def pairs(self) -> Any:
        """A row a pair that met: a, b (names), score_a, score_b, the shares CC, CD, DC, DD of its rounds (a's move first),
        figures (how they were obtained), standard_error_a, standard_error_b."""
        columns = self._held.pairs()
        for seat in ("a", "b"):
            columns[seat] = [self.strategies[place] for place in columns[seat]]
        return frame_of_columns(columns)

    def plot(self, what="payoffs") -> Picture:
        """A picture of up to 300 strategies: "payoffs" or "cooperation" (heat maps), or "scores" (boxes). Raises
        RendererMissing without gnuplot."""
        return Picture(svg_drawn(lambda folder: self._held.draw(folder, "svg"), what))

    def __repr__(self):
        return f"<folk.Tournament of {len(self.strategies)} strategies, signature {self.signature}>"


def tournament(strategies="classics", include=None, exclude=None, rounds=None, criterion=None, end_probability=None,
               noise=0, payoffs=None, game=None, self_play=True, sample=False, extrapolate=False, repetitions=None,
               seed=1, threads=None, progress=None) -> Tournament:
    """Plays everyone against everyone, exactly wherever that can be done; docs/ipd-tournament.md says what arguments mean.

    strategies: a SPEC ("classics", "memory(1,2),pavlov"), strategies, players of your own, or a list of all of these.
    include: entrants beside the roster, whom payoffs are not normalised by; exclude: who is left out. rounds (default
    100), criterion ("finite:T", "discounted:d", "mean", "ending:p") or end_probability. noise: the probability that a
    move flips. payoffs: "T=5,R=3,P=1,S=0" or a dictionary; game: a folk.StageGame or the path of a .nfg file. repetitions:
    matches of a pair that can only be sampled. threads: default one a processor, one where somebody is written in Python;
    no result depends on it. progress: None (a bar on a terminal), False, or a function of the finished share. Raises
    UsageError, InputError, and what a player raises.

    >>> import folk
    >>> result = folk.tournament("tit_for_tat,all_d,pavlov", rounds=10)
    >>> result.scores
    array([[30.,  9., 30.],
           [14., 10., 30.],
           [30.,  5., 30.]])
    """
    options = Options(rounds=rounds, criterion=criterion, end_probability=end_probability, noise=noise,
                      payoffs=payoffs, game=game, no_self_play=not self_play, sample=sample, extrapolate=extrapolate,
                      repetitions=repetitions, seed=seed)
    options.put_spec("strategies", strategies)
    options.put_spec("include", include)
    options.put_spec("exclude", exclude)
    options.settle_threads(threads)
    return Tournament(_folk.tournament(options.values, options.guests, progress))
