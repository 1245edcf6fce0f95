"""Players that are written in Python."""

import gc
import os
import signal
import threading
import time
import unittest

import folk

SANITIZED = "FOLK_SANITIZED" in os.environ


class TitForTat(folk.Player):
    deterministic = True

    def __init__(self):
        self.last = "C"

    def move(self):
        return self.last

    def saw(self, own, theirs):
        self.last = theirs


class Believer(TitForTat):
    def belief(self):
        return 1.0


class Random(folk.Player):
    def new_match(self, rules):
        import random
        self.random = random.Random(rules.seed)

    def move(self):
        return self.random.choice("CD")


def threads(expected=None):
    """How many there are; one that was joined may stand in /proc for a moment more."""
    for _ in range(200):
        count = len(os.listdir("/proc/self/task"))
        if expected is None or count == expected:
            break
        time.sleep(0.01)
    return count


class Action:
    """Stands for the members of Axelrod-Python's enumeration: they have names and are looked up by them."""

    def __init__(self, name):
        self.name = name

    def __class_getitem__(cls, name):
        return {"C": cls.C, "D": cls.D}[name]


Action.C, Action.D = Action("C"), Action("D")


class History:
    def __init__(self):
        self.plays, self.coplays = [], []

    def append(self, play, coplay):
        self.plays.append(play)
        self.coplays.append(coplay)

    def __getitem__(self, place):
        return self.plays[place]

    def __len__(self):
        return len(self.plays)


class AxelrodTitForTat:
    """Stands for a player of Axelrod-Python, by its documented interface."""

    name = "Tit For Tat"
    classifier = {"stochastic": False}

    def __init__(self):
        self.history = History()

    def strategy(self, opponent):
        if not self.history:
            return Action.C
        return Action.D if opponent.history[-1] is Action.D else Action.C

    def reset(self):
        self.history = History()

    def clone(self):
        return AxelrodTitForTat()

    def __str__(self):
        return self.name


class Players(unittest.TestCase):
    def test_plays_as_the_strategy_does(self):
        ours = folk.tournament([TitForTat, "pavlov", "prober", "all_d"], rounds=100)
        theirs = folk.tournament("tit_for_tat,pavlov,prober,all_d", rounds=100)
        self.assertEqual(ours.scores.tolist(), theirs.scores.tolist())
        self.assertEqual(ours.strategies[0], "TitForTat")

    def test_instances_and_functions_play(self):
        named = TitForTat()
        named.name = "mine"
        self.assertEqual(folk.match(named, "prober").moves, folk.match("tit_for_tat", "prober").moves)
        answer = lambda history: history[-1][1] if history else "C"
        self.assertEqual(folk.match(answer, "prober").moves, folk.match("tit_for_tat", "prober").moves)
        self.assertEqual(folk.tournament([named, answer], rounds=5).strategies, ["mine", "function"])

    def test_an_adapted_player_plays(self):
        adapted = folk.AxelrodPlayer(AxelrodTitForTat())
        self.assertTrue(adapted.deterministic)
        self.assertEqual(folk.match(adapted, "prober").moves, folk.match("tit_for_tat", "prober").moves)
        self.assertEqual(folk.match(adapted, adapted, rounds=3).moves, ("CCC", "CCC"))
        found = folk.check(adapted, "tit_for_tat", rounds=10)
        self.assertTrue(found.verdicts["nash"].refuted)

    def test_random_players_repeat_with_the_seed(self):
        first, second = (folk.match(Random, "all_d", seed=3).moves for _ in range(2))
        self.assertEqual(first, second)
        self.assertNotEqual(first, folk.match(Random, "all_d", seed=4).moves)

    def test_beliefs_get_verdicts(self):
        found = folk.check(Believer, "tit_for_tat", rounds=20)
        self.assertTrue(found.verdicts["beliefs"].certified)
        self.assertEqual(found.verdicts["nash"].margin, 2)
        self.assertEqual(folk.match(Believer, "all_d", rounds=4).beliefs[0].tolist(), [1, 1, 1, 1])

    def test_what_a_player_raises_arrives(self):
        class Raises(TitForTat):
            def move(self):
                raise KeyError("spilt")

        before = threads()
        for play in (lambda: folk.match(Raises, "all_d"), lambda: folk.tournament([Raises, "all_d"], threads=2),
                     lambda: folk.check(Raises, "tit_for_tat", rounds=5), lambda: folk.evolve([Raises, "all_d"])):
            with self.assertRaisesRegex(KeyError, "spilt"):
                play()
        self.assertEqual(threads(before), before)

    def test_nonsense_is_one_clear_error(self):
        class Nonsense(TitForTat):
            def move(self):
                return 7

        class BadBelief(TitForTat):
            def belief(self):
                return 3

        with self.assertRaisesRegex(folk.EnvironmentError, r"^Nonsense: move\(\) returned 7: expected 'C' or 'D'$"):
            folk.match(Nonsense, "all_d")
        with self.assertRaisesRegex(folk.EnvironmentError, r"^BadBelief: belief\(\) returned 3: expected a probability"):
            folk.match(BadBelief, "all_d")
        with self.assertRaisesRegex(folk.UsageError, "takes one argument, the history"):
            folk.match(lambda a, b: "C", "all_d")
        with self.assertRaisesRegex(folk.UsageError, "'TitForTat' is the name of two objects"):
            folk.match(TitForTat(), TitForTat())

    def test_one_that_never_returns_is_interrupted(self):
        class Waits(TitForTat):
            time_out = 0.2

            def move(self):
                time.sleep(1000)

        class Spins(TitForTat):
            time_out = 0.2

            def move(self):
                while True:
                    pass

        before, handler = threads(), signal.getsignal(signal.SIGINT)
        for player in (Waits, Spins):
            with self.assertRaisesRegex(folk.EnvironmentError, r"move\(\) did not return within 0.2 s"):
                folk.tournament([player, "all_d"], rounds=5)
        self.assertEqual(threads(before), before)
        self.assertIs(signal.getsignal(signal.SIGINT), handler)

        class Stubborn(Waits):
            def move(self):
                try:
                    time.sleep(1000)
                except KeyboardInterrupt:  # as if the signal had come before the wait began
                    time.sleep(1000)

        used = time.process_time()
        with self.assertRaisesRegex(folk.EnvironmentError, r"move\(\) did not return within 0.2 s"):
            folk.match(Stubborn, "all_d")
        if not SANITIZED:
            self.assertLess(time.process_time() - used, 0.5)  # nobody spins meanwhile
        raised = []

        def in_a_thread():
            try:
                folk.match(Spins, "all_d")
            except folk.EnvironmentError as error:
                raised.append(str(error))

        thread = threading.Thread(target=in_a_thread)
        thread.start()
        thread.join(20)
        self.assertEqual(len(raised), 1)
        self.assertEqual(threads(before), before)

    def test_names_may_be_any_text(self):
        odd = TitForTat()
        odd.name = "Tit, for: Tat (mine=1)"
        result = folk.tournament([odd, "all_d"], rounds=5)
        self.assertEqual(result.strategies, [odd.name, "all_d"])
        odd.name = 'a "b"'
        self.assertRaises(folk.UsageError, folk.match, odd, "all_d")
        odd.name, odd.time_out = "odd", -1
        self.assertRaises(folk.UsageError, folk.match, odd, "all_d")

    def test_players_go_when_they_are_done(self):
        alive = []

        class Counted(TitForTat):
            def __init__(self):
                super().__init__()
                alive.append(1)

            def __del__(self):
                alive.pop()

        folk.tournament([Counted, "all_d", "pavlov"], rounds=5)
        gc.collect()
        self.assertEqual(alive, [])


if __name__ == "__main__":
    unittest.main()
