"""Stage games: what is played in a round."""

from fractions import Fraction
from typing import Tuple

import numpy

from folk import _folk
from folk._options import number_text


def stage_game(rows, columns=None, title="", players=("row", "column"), actions=None) -> _folk.StageGame:
    """A two-player game from arrays of payoffs of the row and of the column player, shape (rows, columns) each; without
    `columns` the game is symmetric: the column player's payoffs are those of `rows` transposed.

    Payoffs are kept exactly: a float is the decimal that it prints, a Fraction stays one. actions: names, a list for each
    player (default C and D for two, else 1, 2, ...). Raises UsageError where the shapes do not fit.

    >>> import folk
    >>> folk.stage_game([[4, 1], [3, 2]], title="Stag hunt")
    <folk.StageGame Stag hunt, 2 x 2 actions>
    """
    own = _table(rows)
    theirs = [list(row) for row in zip(*own)] if columns is None else _table(columns)
    if not own or [len(row) for row in own] != [len(row) for row in theirs]:
        raise _folk.UsageError("a game needs two tables of payoffs of one shape: a row an action of the row player, a "
                               "column one of the column player")
    if actions is None:
        actions = [_usual_names(len(own)), _usual_names(len(own[0]))]
    return _folk.StageGame(own, theirs, title, list(players), [list(names) for names in actions])


def payoff_arrays(game) -> Tuple[numpy.ndarray, numpy.ndarray]:
    """The payoffs of the row and of the column player, two arrays of shape (rows, columns), as the nearest floats.

    >>> import folk
    >>> folk.payoff_arrays(folk.stage_game([[4, 1], [3, 2]]))[1]
    array([[4., 3.],
           [1., 2.]])
    """
    return tuple(numpy.array([[float(Fraction(text)) for text in row] for row in game.payoffs(second)])
                 for second in (False, True))


def read_game(path) -> _folk.StageGame:
    """The game of a .nfg file, Gambit's format. Raises InputError."""
    return _folk.read_game(str(path))


def _table(payoffs):
    rows = payoffs.tolist() if isinstance(payoffs, numpy.ndarray) else payoffs
    return [[number_text(payoff) for payoff in row] for row in rows]


def _usual_names(count):
    return ["C", "D"] if count == 2 else [str(number + 1) for number in range(count)]
