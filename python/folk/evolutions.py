"""What becomes of populations."""

import json
from typing import Any

from folk import _folk
from folk._options import Options
from folk._pictures import Picture, svg_drawn
from folk._records import frame
from folk._results import Result


class Evolution(Result):
    """What ipd-evolve tells of a population (docs/ipd-evolve.md). data: all of it. Of an evolution: strategies, names;
    generations; ranking, survivors; signature; populations, an array of shape (K, N) of the generations that were kept,
    which kept_generations, (K,), numbers. Of runs, fixation and stationary only data."""

    def __init__(self, held):
        super().__init__(held)
        self.data = json.loads(held.form("json"))
        self.strategies = held.names
        self.kept_generations, self.populations = held.history()
        for name in ("generations", "survivors", "signature"):
            setattr(self, name, self.data.get(name))

    @property
    def ranking(self) -> Any:
        """rank, name, population, extinct_at_generation (pandas.DataFrame where pandas is installed, else a list of
        dictionaries)."""
        return frame(self.data["ranking"])

    def plot(self, what=None) -> Picture:
        """A picture: "populations" (the default) or "stack", "cooperation" where it is known, "simplex" of three
        strategies; of fixation and stationary "fixation". Raises RendererMissing without gnuplot or Graphviz."""
        what = what or ("populations" if len(self.kept_generations) else "fixation")
        return Picture(svg_drawn(lambda folder: self._held.draw(folder, "svg"), what))

    def __repr__(self):
        return f"<folk.Evolution of {len(self.strategies)} strategies>"


def evolve(strategies="classics", model=None, include=None, exclude=None, rounds=None, criterion=None,
           end_probability=None, noise=0, payoffs=None, game=None, population=None, individuals=None, start=None,
           generations=None, income=None, meets_itself=False, resilience=None, tolerance=None, mutation=None,
           intensity=None, fitness=None, runs=None, fixation=False, stationary=False, exact=False, sample=False,
           extrapolate=False, repetitions=None, tournament=None, seed=1, threads=None, progress=None) -> Evolution:
    """What becomes of a population of strategies; docs/ipd-evolve.md says what arguments mean. start: "NAME=N,..." or a
    dictionary. tournament: a file of scores instead of strategies. Raises UsageError, InputError, and what a player
    raises.

    >>> import folk
    >>> folk.evolve("all_c,all_d,tit_for_tat", rounds=100).survivors
    ['tit_for_tat', 'all_c']
    """
    options = Options(model=model, rounds=rounds, criterion=criterion, end_probability=end_probability, payoffs=payoffs,
                      game=game, population=population, individuals=individuals, start=start, generations=generations,
                      income=income, meets_itself=meets_itself, resilience=resilience, tolerance=tolerance,
                      mutation=mutation, intensity=intensity, fitness=fitness, runs=runs, fixation=fixation,
                      stationary=stationary, exact=exact, sample=sample, extrapolate=extrapolate, repetitions=repetitions,
                      tournament=tournament, seed=seed)
    if tournament is None:
        options.put("noise", noise)
        options.put_spec("strategies", strategies)
    options.put_spec("include", include)
    options.put_spec("exclude", exclude)
    options.settle_threads(threads)
    return Evolution(_folk.evolve(options.values, options.guests, progress))
