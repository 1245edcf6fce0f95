"""Calls of the package beside the programs: what they print as JSON is the same, cell for cell."""

import json
import os
import subprocess
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import folk
import numpy

BIN = Path(os.environ["FOLK_BIN"])
ROOT = Path(__file__).resolve().parents[2]


def program(name, *arguments):
    done = subprocess.run([BIN / name, *map(str, arguments), "--format", "json"], capture_output=True, text=True,
                          check=True)
    return json.loads(done.stdout)


TOURNAMENTS = [
    ({}, []),
    ({"strategies": "tit_for_tat,all_d,pavlov", "rounds": 1000}, ["--strategies", "tit_for_tat,all_d,pavlov", "--rounds", 1000]),
    ({"noise": 0.01}, ["--noise", 0.01]),
    ({"noise": Fraction(1, 3)}, ["--noise", "1/3"]),
    ({"include": "sct"}, ["--include", "sct"]),
    ({"criterion": "discounted:0.95"}, ["--criterion", "discounted:0.95"]),
    ({"criterion": "mean", "exclude": "gradual"}, ["--criterion", "mean", "--exclude", "gradual"]),
    ({"end_probability": 0.01, "self_play": False}, ["--end-probability", 0.01, "--no-self-play"]),
    ({"payoffs": {"T": 4, "R": 3, "P": 1, "S": 0.5}}, ["--payoffs", "T=4,R=3,P=1,S=0.5"]),
    ({"game": ROOT / "examples/stag_hunt.nfg"}, ["--game", ROOT / "examples/stag_hunt.nfg"]),
    ({"strategies": "memory(1,1),random(0.5)", "rounds": 20, "seed": 7}, ["--strategies", "memory(1,1),random(0.5)", "--rounds", 20, "--seed", 7]),
    ({"strategies": "gradual,random(0.5)", "rounds": 20000, "repetitions": 3, "threads": 2},
     ["--strategies", "gradual,random(0.5)", "--rounds", 20000, "--repetitions", 3]),
]
MATCHES = [
    (("tit_for_tat", "prober"), {}, []),
    (("gradual", "random(0.5)"), {"rounds": 100, "seed": 7}, ["--rounds", 100, "--seed", 7]),
    (("pavlov", "pavlov"), {"noise": 0.05}, ["--noise", 0.05]),
    (("sct", "all_d"), {"rounds": 100}, ["--rounds", 100]),
    (("@examples/my_strategies.machines#slow_pavlov", "hard=all_d"), {}, []),
]
CHECKS = [
    (("pavlov", "pavlov"), {"criterion": "discounted:0.6", "class_": "classics"}, ["--criterion", "discounted:0.6", "--class", "classics"]),
    (("spiteful",), {"opponents": "spiteful,tit_for_tat", "criterion": "discounted:2/3", "side": "own"},
     ["--opponents", "spiteful,tit_for_tat", "--criterion", "discounted:2/3", "--side", "own"]),
    (("tit_for_tat", "mistrust"), {"criterion": "discounted:0.9", "from_": "settled"}, ["--criterion", "discounted:0.9", "--from", "settled"]),
    (("sct", "tit_for_tat"), {}, []),
    (("pavlov", "pavlov"), {"criterion": "discounted:0.9", "noise": 0.01}, ["--criterion", "discounted:0.9", "--noise", 0.01]),
]
REPLIES = [
    ("tit_for_tat", {"criterion": "discounted:0.6"}, ["--criterion", "discounted:0.6"]),
    ("gradual", {"rounds": 10}, ["--rounds", 10]),
    ("tit_for_tat,pavlov,all_d", {"memory_one": True, "criterion": "mean"}, ["--memory-one", "--criterion", "mean"]),
]
EVOLUTIONS = [
    ({"rounds": 1000}, ["--rounds", 1000]),
    ({"strategies": "all_c,all_d,tit_for_tat", "model": "birth-death", "stationary": True, "individuals": 20, "exact": True},
     ["--strategies", "all_c,all_d,tit_for_tat", "--model", "birth-death", "--stationary", "--individuals", 20, "--exact"]),
    ({"strategies": "all_d,tit_for_tat", "model": "pairwise", "start": {"all_d": 9, "tit_for_tat": 1}, "runs": 50},
     ["--strategies", "all_d,tit_for_tat", "--model", "pairwise", "--start", "all_d=9,tit_for_tat=1", "--runs", 50]),
]
REGIONS = [
    ({"discount": 0.6}, ["--discount", 0.6]),
    ({"game": ROOT / "examples/abreu_sannikov.nfg", "discount": Fraction(3, 10)},
     ["--game", ROOT / "examples/abreu_sannikov.nfg", "--discount", "3/10"]),
    ({"strategies": "classics", "discount": 0.9}, ["--strategies", "classics", "--discount", 0.9]),
]


class Programs(unittest.TestCase):
    maxDiff = 2000

    @classmethod
    def setUpClass(cls):
        os.chdir(ROOT)

    def test_tournaments(self):
        for given, options in TOURNAMENTS:
            with self.subTest(given):
                found, printed = folk.tournament(**given), program("ipd-tournament", *options)
                self.assertEqual(json.loads(found.json()), printed)
                self.assertEqual(found.signature, printed["signature"])
                for name, matrix in (("scores", found.scores), ("cooperations", found.cooperations),
                                     ("normalised", found.normalised)):
                    expected = numpy.array(printed[name], dtype=float)
                    numpy.testing.assert_array_equal(matrix, expected, err_msg=name)

    def test_matches(self):
        for players, given, options in MATCHES:
            with self.subTest(players):
                found, printed = folk.match(*players, **given), program("ipd-match", *players, *options)
                self.assertEqual(json.loads(found.json()), printed)
                self.assertEqual(list(found.moves), printed["moves"])

    def test_checks(self):
        for policies, given, options in CHECKS:
            with self.subTest(policies):
                found, printed = folk.check(*policies, **given), program("sce-check", *policies, *options)
                self.assertEqual(json.loads(found.json()), printed)
                for pair, one in zip(found.opponents, printed["opponents"]):
                    if one["thresholds_exact"] is not None:
                        texts = {notion: None if one_set is None else [list(ends) for ends in one_set.texts]
                                 for notion, one_set in pair.thresholds.items()}
                        self.assertEqual(texts, one["thresholds_exact"])

    def test_replies(self):
        for opponents, given, options in REPLIES:
            with self.subTest(opponents):
                self.assertEqual(folk.best_reply(opponents, **given).data, program("ipd-strategies", "reply", opponents, *options))

    def test_evolutions(self):
        for given, options in EVOLUTIONS:
            with self.subTest(given):
                self.assertEqual(json.loads(folk.evolve(**given).json()), program("ipd-evolve", *options))

    def test_regions(self):
        for given, options in REGIONS:
            with self.subTest(given):
                self.assertEqual(json.loads(folk.payoff_region(**given).json()), program("payoff-region", *options))

    def test_classes(self):
        found = folk.complete_class("memory(3,3)").score("tit_for_tat,pavlov", rounds=100)
        printed = program("ipd-tournament", "--class", "memory(3,3)", "--entrants", "tit_for_tat,pavlov", "--rounds", 100)
        names = list(found["name"]) if not isinstance(found, list) else [row["name"] for row in found]
        exact = list(found["exact_mean"]) if not isinstance(found, list) else [row["exact_mean"] for row in found]
        self.assertEqual(names, [entrant["name"] for entrant in printed["entrants"]])
        self.assertEqual(exact, [entrant["exact_mean"] for entrant in printed["entrants"]])

    def test_facts_and_comparisons(self):
        printed = program("ipd-strategies", "list")
        self.assertEqual(json.loads(folk._folk.listed(None, {}, {})), printed)
        printed = program("ipd-strategies", "diff", "spiteful", "mem11_cCDDD", "--any-own-moves")
        found = folk.strategy("spiteful").equivalent("mem11_cCDDD", any_own_moves=True).data
        self.assertEqual({key: found[key] for key in printed}, printed)

    def test_drawings(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.dot")
            subprocess.run([BIN / "strategy-graph", "prober", "-o", path], check=True)
            self.assertEqual(folk.strategy("prober").dot(), Path(path).read_text(encoding="utf-8"))

    def test_objects_play_as_their_names(self):
        by_name = folk.tournament("tit_for_tat,pavlov,all_d")
        objects = [folk.machine("c C c d; d D c d", name="tit_for_tat"), folk.strategy("pavlov"), "all_d"]
        self.assertEqual(folk.tournament(objects).signature, by_name.signature)
        hunt = folk.tournament(game=folk.read_game("examples/stag_hunt.nfg"))
        self.assertEqual(hunt.signature, folk.tournament(game="examples/stag_hunt.nfg").signature)


if __name__ == "__main__":
    unittest.main()
