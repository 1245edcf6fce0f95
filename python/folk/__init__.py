"""Folk, a toolkit for repeated games: tournaments of the iterated prisoner's dilemma, strategies as machines, claims
about equilibria, a transformer that plays on its own beliefs.

Everything is computed by the C++ library that Folk's programs are made of, and comes out as theirs does:

>>> import folk
>>> folk.tournament("classics", include="sct", rounds=100).ranking["name"][0]
'sct'

docs/python.md is the guide; the pages of the programs say what options mean.
"""

import os as _os

from folk import _folk
from folk._folk import (AlgebraicNumber, Cancelled, DiscountSet, EnvironmentError, Error, InputError, RendererMissing,
                        StageGame, UndecidedError, UsageError, __version__)

_folk.use_data_folder(_os.path.join(_os.path.dirname(_os.path.abspath(__file__)), "data"))

from folk import mpe, sct
from folk._pictures import Picture
from folk.checks import Check, Verdict, check, thresholds
from folk.classes import CompleteClass, complete_class
from folk.evolutions import Evolution, evolve
from folk.games import payoff_arrays, read_game, stage_game
from folk.matches import Match, match
from folk.players import AxelrodPlayer, FunctionPlayer, Player, Rules, function_player
from folk.regions import PayoffRegion, payoff_region
from folk.replies import BestReply, MemoryOneReply, best_reply
from folk.strategies import Comparison, Strategy, machine, roster, strategies, strategy
from folk.tournaments import Tournament, tournament

for _class in (AlgebraicNumber, Cancelled, DiscountSet, EnvironmentError, Error, InputError, RendererMissing, StageGame,
               UndecidedError, UsageError):
    _class.__module__ = "folk"

__all__ = [name for name in globals() if not name.startswith("_")]
