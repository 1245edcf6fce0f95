"""Complete classes, whose members are not listed."""

import json
from typing import Any

from folk import _folk
from folk._options import Options
from folk._records import frame


class CompleteClass:
    """All deterministic machines that look back X own and Y other moves; size: how many. folk.complete_class
    makes it."""

    def __init__(self, name):
        self.name = name
        self.size = int(_folk.class_size(name))

    def score(self, entrants="classics", rounds=None, criterion=None, end_probability=None, payoffs=None, game=None,
              most_kinds=None, threads=None, progress=None) -> Any:
        """What entrants (machines without chance) earn against all members, exactly, best first: name, mean (points a
        round), exact_mean (a text), cooperation_rate, beats, ties, loses (shares), best, worst and more, as
        ipd-tournament --class tells it (pandas.DataFrame where pandas is installed, else a list of dictionaries). Who
        tells more than most_kinds of members apart is left out; where that is everyone, UsageError is raised."""
        options = Options(class_=self.name, rounds=rounds, criterion=criterion, end_probability=end_probability, noise=0,
                          payoffs=payoffs, game=game, most_kinds=most_kinds, threads=threads)
        options.put_spec("entrants", entrants)
        return frame(json.loads(_folk.class_scores(options.values, options.guests, progress))["entrants"])

    def __repr__(self):
        return f"<folk.CompleteClass {self.name}, {self.size} members>"


def complete_class(name) -> CompleteClass:
    """The class of a name, up to memory(4,4).

    >>> import folk
    >>> folk.complete_class("memory(1,2)")
    <folk.CompleteClass memory(1,2), 1024 members>
    """
    return CompleteClass(name)
