"""Players that are written in Python."""

import copy
import inspect
from typing import NamedTuple, Optional

from folk import _folk


class Rules(NamedTuple):
    """What a player is told before a match (units: points a round).

    payoffs: {"T": 5.0, "R": 3.0, "P": 1.0, "S": 0.0}; criterion: "finite:100"; rounds: 100, or None where no number of
    rounds is fixed; seed: a whole number of 64 bits, another one for each match and seat: random.Random(rules.seed)
    makes a player that plays the same in every run.
    """

    payoffs: dict
    criterion: str
    rounds: Optional[int]
    seed: int


class Player:
    """A strategy of your own: give the class, or an instance, wherever a strategy may be named.

    A match is played by a fresh player: one that the class makes without arguments, or a deep copy of the instance. So
    nothing that happened in an earlier match is left in it.

    >>> import folk
    >>> class Forgiving(folk.Player):
    ...     deterministic = True
    ...     def __init__(self):
    ...         self.patience = 2
    ...     def move(self) -> str:
    ...         return "C" if self.patience > 0 else "D"
    ...     def saw(self, own, theirs) -> None:
    ...         self.patience = 2 if theirs == "C" else self.patience - 1
    >>> folk.match(Forgiving, "all_d", rounds=5).moves
    ('CCDDD', 'DDDDD')

    Attributes of the class:
      name           what it is called (default: the name of the class)
      deterministic  True for one that draws no random numbers: where its opponent draws none either, one match says all
      time_out       seconds that one call may last; None (the default) waits for ever. What it raises then is
                     folk.EnvironmentError. A call in the main thread is interrupted whatever it does; in another
                     thread one that waits outside Python (time.sleep) only when it is back.
    """

    name = None
    deterministic = False
    time_out = None

    def move(self) -> str:
        """The move of the coming round, "C" or "D"; called once a round."""
        raise NotImplementedError("a player needs move(self), which returns 'C' or 'D'")

    def saw(self, own, theirs) -> None:
        """What was really played in the round, after noise: "C" or "D" each."""

    def belief(self) -> Optional[float]:
        """Optional: the probability that the other plays C in the round that move() was last called for; or None."""
        return None

    def new_match(self, rules) -> None:
        """Optional: a match begins; rules is a folk.Rules."""


def is_player(value):
    """True for what may stand where a strategy is named: a player, its class, or a function that plays."""
    return isinstance(value, Player) or callable(value)


def named_player(value):
    """The name of such a value, and what the library plays."""
    if inspect.isclass(value):
        if not issubclass(value, Player):
            raise _folk.UsageError(f"{value.__name__} is no folk.Player: derive it from that, or give a function")
        return _name_and_strategy(value, value.name or value.__name__, value)
    player = value if isinstance(value, Player) else function_player(value)
    return _name_and_strategy(player, player.name or type(player).__name__, lambda: copy.deepcopy(player))


def _name_and_strategy(traits, name, make):
    cls = traits if inspect.isclass(traits) else type(traits)
    time_out = None if traits.time_out is None else float(traits.time_out)
    if time_out is not None and not 0 < time_out < 1e6:
        raise _folk.UsageError(f"{name}: time_out {time_out}: expected seconds, more than 0 and less than a million, or None")
    return name, _folk.player_strategy(name, make, bool(traits.deterministic), cls.belief is not Player.belief,
                                       cls.new_match is not Player.new_match, time_out)


class FunctionPlayer(Player):
    """A function (history) -> move as a player; history is a list of (own, theirs), oldest first."""

    def __init__(self, function, name=None, deterministic=False, time_out=None):
        self.function = function
        self.name = name or getattr(function, "__name__", "function").replace("<lambda>", "function")
        self.deterministic = deterministic
        self.time_out = time_out
        self.history = []

    def __deepcopy__(self, memo):
        twin = FunctionPlayer(self.function, self.name, self.deterministic, self.time_out)
        twin.history = list(self.history)
        return twin

    def move(self) -> str:
        return self.function(self.history)

    def saw(self, own, theirs) -> None:
        self.history.append((own, theirs))


def function_player(function) -> FunctionPlayer:
    """The player of a function (history) -> "C" or "D".

    >>> import folk
    >>> def grudge(history):
    ...     return "D" if ("C", "D") in history else "C"
    >>> folk.match(grudge, "tit_for_tat", rounds=4).moves
    ('CCCC', 'CCCC')
    """
    if len(inspect.signature(function).parameters) != 1:
        raise _folk.UsageError(
            f"{getattr(function, '__name__', function)}: a function that plays takes one argument, the history, "
            "a list of (own, theirs)")
    return FunctionPlayer(function)


class AxelrodPlayer(Player):
    """A player of the library Axelrod-Python, by its documented interface: strategy(opponent), history, reset(), clone().

    The opponent that it is shown has a history and nothing else: who asks more of opponents (their classifier, say)
    raises AttributeError. Without `deterministic` it is taken to draw random numbers unless its classifier says that it
    is not stochastic; `name` is what str(player) says without it.
    """

    def __init__(self, player, name=None, deterministic=None, time_out=None):
        self.player = player
        self.name = name or str(player)
        if deterministic is None:
            deterministic = not getattr(player, "classifier", {}).get("stochastic", True)
        self.deterministic = deterministic
        self.time_out = time_out
        self.opponent = _Opponent()
        self.action = None

    def __deepcopy__(self, memo):
        twin = AxelrodPlayer(self.player.clone(), self.name, self.deterministic, self.time_out)
        # clone() is a player that has played nothing.
        twin.player.history = copy.deepcopy(self.player.history, memo)
        twin.opponent.history = copy.deepcopy(self.opponent.history, memo)
        twin.action = self.action
        return twin

    def new_match(self, rules) -> None:
        self.player.reset()
        if hasattr(self.player, "set_seed"):
            self.player.set_seed(rules.seed % 2**32)
        self.opponent.history = type(self.player.history)()

    def move(self) -> str:
        self.action = self.player.strategy(self.opponent)
        return getattr(self.action, "name", self.action)

    def saw(self, own, theirs) -> None:
        own, theirs = _like(self.action, own), _like(self.action, theirs)
        _append(self.player.history, own, theirs)
        _append(self.opponent.history, theirs, own)


class _Opponent:
    history = ()


def _like(action, letter):
    """The move as that library writes it: a member of its enumeration, or the letter."""
    return letter if isinstance(action, str) else type(action)[letter]


def _append(history, play, coplay):
    """Its histories hold both moves; those of older releases are lists of one's own."""
    if isinstance(history, list):
        history.append(play)
    else:
        history.append(play, coplay)
