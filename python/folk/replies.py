"""The best that can be earned."""

import json
from typing import Union

from folk import _folk
from folk._options import Options
from folk.strategies import machine


class BestReply:
    """The exact best reply to one machine, as ipd-strategies reply tells it.

    opponent; payoff, in the criterion's unit; exact: the same as a text, or None; residual: no reply earns so much more;
    states of the reply; strategy: the reply itself, a folk.Strategy (None where it has over 1000 states).
    """

    def __init__(self, data):
        self.data = data
        for name in ("opponent", "payoff", "exact", "residual", "horizon", "states"):
            setattr(self, name, data[name])
        self.strategy = None if data["machine"] is None else machine(data["machine"])

    def __repr__(self):
        return f"<folk.BestReply to {self.opponent}: {self.exact or self.payoff}>"


class MemoryOneReply:
    """The best memory-one reply that a search finds to one or several machines.

    opponents: name, weight and payoff of each; strategy: its name, mem1(c;...); payoff: the mean, in the criterion's unit;
    certificate: how it was searched, and what no strategy earns more than (docs/ipd-strategies.md).
    """

    def __init__(self, data):
        self.data = data
        for name in ("opponents", "strategy", "payoff", "certificate"):
            setattr(self, name, data[name])

    def __repr__(self):
        return f"<folk.MemoryOneReply {self.strategy}: {self.payoff}>"


def best_reply(opponents, rounds=None, criterion=None, end_probability=None, noise=0, horizon=None, memory_one=False,
               payoffs=None, game=None, threads=None, progress=None) -> Union[BestReply, MemoryOneReply]:
    """The best reply to a machine, exactly; with memory_one the best memory-one reply that a search finds to one machine
    or several (a SPEC or a list), met equally often. docs/ipd-strategies.md says what arguments mean. Raises UsageError
    for what is no machine.

    >>> import folk
    >>> folk.best_reply("tit_for_tat", criterion="discounted:0.6")
    <folk.BestReply to tit_for_tat: 3.125>
    """
    options = Options(rounds=rounds, criterion=criterion, end_probability=end_probability, noise=noise, horizon=horizon,
                      memory_one=memory_one, payoffs=payoffs, game=game, threads=threads)
    spec = options.spec(opponents)
    data = json.loads(_folk.best_reply(spec, options.values, options.guests, progress))
    return MemoryOneReply(data) if memory_one else BestReply(data)
