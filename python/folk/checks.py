"""Claims about equilibria, with certificates."""

import json
from typing import Any, Dict, Optional

from folk import _folk
from folk._options import Options
from folk._results import Result

NOTIONS = ("nash", "subgame_perfect", "self_confirming_unrestricted", "self_confirming_class", "self_confirming_own",
           "beliefs")


class Verdict:
    """A claim that was judged.

    word: "certified", "not refuted (depth 6)" or "refuted"; side: whose gain the margin is, "own" or "theirs"; margin:
    what a deviation gains, in the criterion's unit (for beliefs the largest total variation distance); margin_exact: the
    same as a text, where it is known exactly; witness: the deviation, or the belief, in words, or None; witness_machine:
    the reply that gains, as a machine file holds it, or None; opponent: of an overall verdict, whom it is about.
    """

    def __init__(self, data):
        for name in ("word", "side", "margin", "margin_exact", "witness", "witness_machine"):
            setattr(self, name, data[name])
        self.opponent = data.get("opponent")

    @property
    def refuted(self) -> bool:
        return self.word == "refuted"

    @property
    def certified(self) -> bool:
        return self.word == "certified"

    def __repr__(self):
        return f"<folk.Verdict {self.word}{', gain ' + str(self.margin) if self.refuted else ''}>"


class PairCheck:
    """What was found about the policy and one opponent.

    opponent; score, gaps ({"own": ..., "theirs": ...}; gaps are gains by notion, None where unknown); path, belief (as in
    docs/sce-check.md, or None); verdicts: notion to Verdict or None; thresholds: notion to folk.DiscountSet, or None where
    there are not two deterministic finite machines.
    """

    def __init__(self, data, thresholds):
        self.data = data
        self.opponent = data["opponent"]
        self.score = data["score"]
        self.gaps = data["gaps"]
        self.path = data["path"]
        self.belief = data["belief"]
        self.verdicts = _verdicts(data["verdicts"])
        self.thresholds = thresholds

    def __repr__(self):
        return f"<folk.PairCheck of {self.opponent}>"


class Check(Result):
    """What sce-check tells of a policy (docs/sce-check.md). opponents: a PairCheck each; verdicts: the worst of all
    opponents by notion, one of folk.checks.NOTIONS, each a Verdict or None; belief: of a policy that holds beliefs, of all
    opponents together."""

    def __init__(self, held):
        super().__init__(held)
        self.data = json.loads(held.form("json"))
        self.policy = self.data["policy"]
        self.criterion = self.data["criterion"]
        self.opponents = [PairCheck(pair, sets) for pair, sets in zip(self.data["opponents"], held.thresholds)]
        self.verdicts = _verdicts(self.data["overall"]["verdicts"])
        self.belief = self.data["overall"]["belief"]

    @property
    def gaps(self) -> Dict[str, Any]:
        """Of the only opponent."""
        return self._only.gaps

    @property
    def thresholds(self) -> Optional[Dict[str, Optional[_folk.DiscountSet]]]:
        """Of the only opponent."""
        return self._only.thresholds

    @property
    def _only(self):
        if len(self.opponents) != 1:
            raise _folk.UsageError(f"the check has {len(self.opponents)} opponents: ask one of its opponents")
        return self.opponents[0]

    def holds(self, notion) -> bool:
        """False where it is refuted; notion as --require names it: nash, subgame-perfect, self-confirming, beliefs."""
        return self._held.holds(notion.replace("_", "-"))

    def html(self) -> str:
        """The page that sce-check --output writes."""
        return self._held.html()

    def __repr__(self):
        words = ", ".join(f"{notion} {verdict.word}" for notion, verdict in self.verdicts.items() if verdict)
        return f"<folk.Check of {self.policy}: {words}>"


def _verdicts(data):
    return {notion: None if data[notion] is None else Verdict(data[notion]) for notion in NOTIONS}


def check(policy, opponent=None, opponents=None, rounds=None, criterion=None, end_probability=None, noise=0,
          class_=None, from_=None, side="both", epsilon_belief=None, epsilon_payoff=None, depth=None, horizon=None,
          extract=False, payoffs=None, game=None, sample=False, extrapolate=False, repetitions=None, seed=1, threads=None,
          progress=None) -> Check:
    """Is a policy in equilibrium with its opponents, and are its beliefs true? docs/sce-check.md says what arguments mean.

    policy, opponent: a strategy, a name, a player of yours, for the policy also a policy file; opponents: a SPEC or a list
    instead of the one (default: its training roster, else classics). class_: SPEC of the machines that the other side may
    be believed to be. from_: a round, or "settled". side: both, own or theirs. epsilon_belief, epsilon_payoff: what is
    allowed. Raises UsageError, InputError, and what a player raises.

    >>> import folk
    >>> found = folk.check("pavlov", "pavlov", criterion="discounted:0.6", class_="classics")
    >>> found.verdicts["nash"], found.gaps["own"]["nash"]
    (<folk.Verdict refuted, gain 0.5>, 0.5)
    >>> print(found.thresholds["self_confirming_unrestricted"])
    [1/2, 1)
    """
    options = Options(rounds=rounds, criterion=criterion, end_probability=end_probability, noise=noise, from_=from_,
                      side=side, epsilon_belief=epsilon_belief, epsilon_payoff=epsilon_payoff, depth=depth,
                      horizon=horizon, extract=extract, payoffs=payoffs, game=game, sample=sample,
                      extrapolate=extrapolate, repetitions=repetitions, seed=seed)
    options.values["name"] = tuple(options.spec(player) for player in (policy, opponent) if player is not None)
    options.put_spec("opponents", opponents)
    options.put_spec("class", class_)
    options.settle_threads(threads)
    return Check(_folk.check(options.values, options.guests, progress))


def thresholds(first, second, payoffs=None, game=None, progress=None) -> Dict[str, Optional[_folk.DiscountSet]]:
    """The discount factors at which two deterministic finite machines are in equilibrium, exactly: by notion ("nash",
    "subgame_perfect", "self_confirming_unrestricted") a folk.DiscountSet, or None where it is too large a question.
    docs/equilibrium.md defines the notions. Raises UsageError for what is no such machine.

    >>> import folk
    >>> sets = folk.thresholds("spiteful", "spiteful")
    >>> print(sets["nash"]); sets["nash"].intervals[0][0] == 0.5, 0.6 in sets["nash"]
    [1/2, 1)
    (True, True)
    """
    options = Options(payoffs=payoffs, game=game)
    return _folk.thresholds(options.spec(first), options.spec(second), options.values, options.guests, progress)
