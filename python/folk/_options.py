"""Arguments of Python as the options of Folk's programs: what they mean, and how they are refused, is one and the same."""

import re
from fractions import Fraction
from numbers import Integral, Real

from folk import _folk
from folk.players import is_player, named_player
from folk.strategies import Strategy


class Options:
    """Options by their names in the programs, and the objects that stand in a SPEC as "python:NAME"."""

    def __init__(self, **options):
        self.guests = {}
        self.players = {}
        self.values = {}
        for name, value in options.items():
            self.put(name.rstrip("_").replace("_", "-"), value)

    def put(self, option, value):
        """None and False leave an option out; True is one without a value."""
        if value is None or value is False:
            return
        if value is True or isinstance(value, _folk.StageGame):
            self.values[option] = value
        else:
            self.values[option] = number_text(value)

    def put_spec(self, option, value):
        """A SPEC: text, a strategy, a player, or several of them."""
        if value is not None:
            self.values[option] = self.spec(value)

    def spec(self, value):
        if isinstance(value, str):
            return value
        if isinstance(value, Strategy):
            return value.spec if value.spec is not None else self._guest(value.name, value.held)
        if is_player(value):
            return self._player(value)
        return ",".join(self.spec(item) for item in value)

    def _player(self, value):
        """One that is named twice, as in a match with itself, is one strategy."""
        if id(value) not in self.players:
            self.players[id(value)] = (value, *named_player(value))
        return self._guest(*self.players[id(value)][1:])

    def _guest(self, name, held):
        if self.guests.setdefault(name, held) is not held:
            raise _folk.UsageError(f"'{name}' is the name of two objects: give one of them another name")
        if '"' in name or "\n" in name:
            raise _folk.UsageError(f"{name!r}: a name holds no quotation marks and no line ends")
        return "python:" + (name if re.fullmatch(r"[\w.+-]+", name) else '"' + name.replace("\\", "\\\\") + '"')

    def plays_python(self):
        """True where a player is written in Python: threads would only wait for each other."""
        return any(not held.has_machine for held in self.guests.values())

    def settle_threads(self, threads):
        self.put("threads", 1 if threads is None and self.plays_python() else threads)


def number_text(value):
    """A number as it was written: a float is the decimal that it prints, a fraction stays one."""
    if isinstance(value, dict):
        return ",".join(f"{letter}={number_text(number)}" for letter, number in value.items())
    if isinstance(value, tuple):
        return tuple(number_text(item) for item in value)
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real) and not isinstance(value, Fraction):
        return repr(float(value))
    return str(value)
