"""Strategies by their names, and as machines."""

import json
import os
from typing import Any, Dict, List, Optional, Union

from folk import _folk
from folk._pictures import svg_drawn_to
from folk._records import frame


class Strategy:
    """A strategy of Folk: it may stand wherever a SPEC is. folk.strategy, folk.roster and folk.machine make them.

    name: what it is called; deterministic: False where it draws random numbers; has_machine: False for a player that
    can be played and not looked into (a transformer, a program, a player of yours).
    """

    def __init__(self, held, spec=None):
        self.held = held
        self.spec = spec

    @property
    def name(self) -> str:
        return self.held.name

    @property
    def deterministic(self) -> bool:
        return self.held.deterministic

    @property
    def has_machine(self) -> bool:
        return self.held.has_machine

    @property
    def facts(self) -> Dict[str, Any]:
        """What can be computed of it, as ipd-strategies --format json says it: memory (rounds), states, nice, ...

        >>> import folk
        >>> folk.strategy("pavlov").facts["memory"]
        1
        """
        return json.loads(self.held.facts())

    @property
    def states(self) -> Union[int, str, None]:
        """States of the smallest machine that plays alike, own moves being its own: a number, "infinite", or None for
        more than are counted and for a strategy that has no machine.

        >>> import folk
        >>> folk.strategy("tit_for_tat").states, folk.strategy("gradual").states
        (2, 'infinite')
        """
        return self.facts["states"]

    def minimised(self, any_own_moves=False) -> "Strategy":
        """The smallest machine that plays alike; with any_own_moves also after own moves that are not its own (noise,
        deviations). Raises UsageError where there are infinitely many states, or no machine.

        >>> import folk
        >>> twice = folk.machine("a C a b; b D a c; c D a b", name="twice")
        >>> twice.minimised().text()
        'machine twice\\nc  C  c d\\nd  D  c d\\n'
        """
        return Strategy(self.held.minimised(any_own_moves))

    def text(self, any_own_moves=True) -> str:
        """The smallest machine as a machine file holds it; by default the one for any own moves, as ipd-strategies show
        prints it."""
        return self.held.text(any_own_moves)

    def equivalent(self, other, any_own_moves=False, most_pairs=1_000_000) -> "Comparison":
        """Does `other` (a strategy or a name) answer alike? Proved, or refuted by the shortest play that tells.

        >>> import folk
        >>> folk.strategy("spiteful").equivalent("tf2t")
        <folk.Comparison different: after their moves D (own C): spiteful plays D, tf2t plays C>
        >>> bool(folk.strategy("per_cd").equivalent("per_cd"))
        True
        """
        other = other if isinstance(other, Strategy) else strategy(other)
        return Comparison(json.loads(self.held.difference(other.held, any_own_moves, most_pairs)))

    def draw(self, path, any_own_moves=False, horizon=0) -> None:
        """Draws the smallest automaton into a file, .svg, .png or .pdf; horizon: its first rounds (1 to 100) alone."""
        self.held.draw(self._drawn_name(), os.fspath(path), any_own_moves, horizon)

    def svg(self, any_own_moves=False, horizon=0) -> str:
        """The drawing as SVG text. Raises RendererMissing without Graphviz."""
        return svg_drawn_to(lambda path: self.draw(path, any_own_moves, horizon))

    def dot(self, any_own_moves=False, horizon=0) -> str:
        """The drawing in Graphviz's language."""
        return self.held.dot(self._drawn_name(), any_own_moves, horizon)

    def to_networkx(self, any_own_moves=False) -> Any:
        """The smallest automaton as a networkx.MultiDiGraph: nodes 0 (the start), 1, ... with `cooperation`, P(C); edges
        with `own` and `theirs`, the moves that lead along them. Own moves that its state never plays have no edge unless
        any_own_moves is set. Raises ImportError without networkx."""
        import networkx

        graph = networkx.MultiDiGraph(name=self.name)
        for state, (cooperation, successors) in enumerate(self.held.nodes(any_own_moves)):
            graph.add_node(state, cooperation=cooperation)
            for (own, theirs), successor in zip(("CC", "CD", "DC", "DD"), successors):
                if any_own_moves or (cooperation > 0 if own == "C" else cooperation < 1):
                    graph.add_edge(state, successor, own=own, theirs=theirs)
        return graph

    def _drawn_name(self):
        return self.spec or "@object"

    def _repr_svg_(self) -> Optional[str]:
        """The automaton in a notebook; nothing where there is none to draw."""
        try:
            return self.svg()
        except _folk.Error:
            return None

    def __repr__(self):
        return f"<folk.Strategy {self.name}>"


class Comparison:
    """Whether two strategies answer alike; true where it is proved that they do.

    result: "equivalent", "different" or "undecided"; play: the moves that tell, or None; answers: P(C) of both after it.
    """

    def __init__(self, data):
        self.data = data
        self.result = data["result"]
        self.play = data["play"]
        self.answers = data["answers"]

    def __bool__(self):
        return self.result == "equivalent"

    def __repr__(self):
        return f"<folk.Comparison {self.data['text']}>"


def strategy(spec, payoffs=None) -> Strategy:
    """The strategy of a name: "pavlov", "gtft(0.3)", "@mine.machines#forgiver", "mem12_ccCDCDDCDD", "sct", ...

    payoffs: "T=5,R=3,P=1,S=0" or a dictionary, for the few that depend on them. Raises UsageError, which names the
    nearest names, and InputError for a file.

    >>> import folk
    >>> folk.strategy("tft")
    <folk.Strategy tit_for_tat>
    >>> folk.strategy("tit_fo_tat")
    Traceback (most recent call last):
        ...
    folk.UsageError: unknown strategy 'tit_fo_tat': did you mean tit_for_tat, tf2t?; 'ipd-strategies list' shows all
    """
    from folk._options import Options

    options = Options(payoffs=payoffs)
    spec = options.spec(spec)
    return Strategy(_folk.named(spec, options.values, options.guests), None if options.guests else spec)


def roster(spec, payoffs=None) -> List[Strategy]:
    """All strategies of a SPEC, a list.

    >>> import folk
    >>> [entrant.name for entrant in folk.roster("tit_for_tat,per_cd")]
    ['tit_for_tat', 'per_cd']
    """
    from folk._options import Options

    options = Options(payoffs=payoffs)
    return [Strategy(held, None) for held in _folk.roster(options.spec(spec), options.values, options.guests)]


def strategies(spec=None, payoffs=None) -> Any:
    """Every strategy that has a name, or those of a SPEC, a row each: name, aliases, memory, states, behaviour, reference
    and more (pandas.DataFrame where pandas is installed, else a list of dictionaries)."""
    from folk._options import Options

    options = Options(payoffs=payoffs)
    text = None if spec is None else options.spec(spec)
    return frame(json.loads(_folk.listed(text, options.values, options.guests))["strategies"])


def machine(text, name="machine") -> Strategy:
    """A strategy out of its text: a block of a machine file, or one line without a name.

    >>> import folk
    >>> folk.match(folk.machine("c C c d; d D c d"), "all_d", rounds=3).moves
    ('CDD', 'DDD')
    """
    return Strategy(_folk.read_machine(text, name))
