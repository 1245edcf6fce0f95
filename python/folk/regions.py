"""What repeated play can pay."""

import json

import numpy

from folk import _folk
from folk._options import Options
from folk._pictures import Picture, svg_drawn_to
from folk._results import Result


class PayoffRegion(Result):
    """What payoff-region tells of a game (docs/payoff-region.md); points are pairs (row's, column's), payoffs a round.

    feasible, individually_rational: corners, arrays of shape (K, 2); minmax, stage_equilibria, equilibria, tournament: as
    the page says, equilibria only where a discount factor was given.
    """

    def __init__(self, held):
        super().__init__(held)
        self.data = json.loads(held.form("json"))
        self.feasible = numpy.array(self.data["feasible"], dtype=float)
        self.individually_rational = numpy.array(self.data["individually_rational"], dtype=float).reshape(-1, 2)
        for name in ("minmax", "stage_equilibria", "equilibria", "tournament"):
            setattr(self, name, self.data[name])

    def plot(self) -> Picture:
        """The picture. Raises RendererMissing without gnuplot."""
        return Picture(svg_drawn_to(self._held.draw))

    def __repr__(self):
        return f"<folk.PayoffRegion of {self.data['game']}>"


def payoff_region(game=None, discount=None, payoffs=None, strategies=None, include=None, rounds=None, criterion=None,
                  end_probability=None, noise=None, sample=False, extrapolate=False, seed=None, threads=None,
                  progress=None) -> PayoffRegion:
    """Payoffs a round that a repeated game can have: feasible, individually rational, and with a discount factor (0.9 or
    Fraction(9, 10)) those of its pure subgame-perfect equilibria. game: a folk.StageGame or the path of a .nfg file; or
    payoffs, "T=5,R=3,P=1,S=0". strategies: a tournament's pairs beside it. Raises UsageError, InputError.

    >>> import folk
    >>> folk.payoff_region().minmax["pure"]
    [1.0, 1.0]
    """
    options = Options(game=game, discount=discount, payoffs=payoffs, rounds=rounds, criterion=criterion,
                      end_probability=end_probability, noise=noise, sample=sample, extrapolate=extrapolate, seed=seed)
    options.put_spec("strategies", strategies)
    options.put_spec("include", include)
    if strategies is not None:
        options.settle_threads(threads)
    return PayoffRegion(_folk.payoff_region(options.values, options.guests, progress))
