"""The transformer and the particle world from Python."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import folk
import numpy

SMALL = {"hidden": 8, "layers": 1, "steps": 20, "evaluate_every": 10, "roster": "tit_for_tat,all_d", "rounds": 10}


class Transformer(unittest.TestCase):
    def test_thoughts_are_those_of_its_matches(self):
        policy = folk.sct.load("sct")
        for opponent in ("prober", "per_ccd"):
            match = policy.play(opponent)
            moves, beliefs, tokens = policy.thoughts(*match.moves)
            self.assertEqual(moves, match.moves[0])
            numpy.testing.assert_array_equal(beliefs, match.beliefs[0])
            numpy.testing.assert_array_equal(tokens, beliefs < 0.5)
        self.assertFalse(policy.parameters.flags.owndata)
        self.assertEqual(folk.match(policy.strategy(), "prober", rounds=100).moves, folk.match("sct", "prober", rounds=100).moves)

    def test_trains_to_the_bytes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            log = []
            policy = folk.sct.train(os.path.join(folder, "ours.bin"), log=log.append, **SMALL)
            options = [f"--{name.replace('_', '-')}={value}" for name, value in SMALL.items()]
            subprocess.run([os.path.join(os.environ["FOLK_BIN"], "sct-train"), *options, "--quiet", "--output",
                            os.path.join(folder, "theirs.bin")], check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(Path(folder, "ours.bin").read_bytes(), Path(folder, "theirs.bin").read_bytes())
            self.assertEqual([row["step"] for row in log], ["10", "20"])
            self.assertEqual(policy.architecture["hidden"], 8)

    def test_what_log_raises_ends_the_training(self):
        def stop(row):
            raise RuntimeError("enough")

        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(RuntimeError, "enough"):
                folk.sct.train(os.path.join(folder, "none.bin"), log=stop, **SMALL)
            self.assertEqual(os.listdir(folder), [])
        with self.assertRaises(folk.UsageError):
            folk.sct.train("none.bin", steps=0)
        with self.assertRaises(folk.InputError):
            folk.sct.load("/no/such.bin")


class ParticleWorld(unittest.TestCase):
    def test_a_batch_is_its_environments(self):
        for scenario in ("simple_tag", "simple_world"):
            batch, env = folk.mpe.BatchEnv(scenario, 128, threads=2), folk.mpe.parallel_env(scenario)
            batch.reset(seed=5)
            batch.actions[:] = numpy.random.default_rng(1).uniform(-1, 1, batch.actions.shape)
            actions = {agent: batch.actions[0, 0, place] for place, agent in enumerate(batch.agents)}
            observations, _ = env.reset(seed=5)
            for step in range(batch.episode_steps):
                for place, agent in enumerate(batch.agents):
                    numpy.testing.assert_array_equal(batch.observations[place][0, 0], observations[agent])
                batch.step()
                observations, rewards, _, truncations, _ = env.step(actions)
                self.assertEqual(list(rewards.values()), batch.rewards[0, 0].tolist())
            self.assertTrue(all(truncations.values()))
            self.assertEqual(env.agents, [])

    def test_arrays_stay_where_they_are(self):
        env = folk.mpe.BatchEnv("simple_tag", 64)
        first = env.observations[0]
        env.reset(seed=1)
        before = first.copy()
        env.actions[:] = 1
        env.step()
        self.assertIs(env.observations[0], first)
        self.assertTrue((first != before).any())
        self.assertEqual(env.flat(env.rewards).shape, (64, 4))
        del env
        self.assertTrue(numpy.isfinite(first).all())

    def test_refuses_what_is_none(self):
        for make in (lambda: folk.mpe.BatchEnv("simple_tagg"), lambda: folk.mpe.BatchEnv("simple_tag", 65),
                     lambda: folk.mpe.BatchEnv("simple_tag", 0), lambda: folk.mpe.BatchEnv(reward_rule="mine")):
            self.assertRaises(folk.UsageError, make)
        env = folk.mpe.BatchEnv("simple_tag", 1)
        env.actions[:] = numpy.nan
        with self.assertRaisesRegex(folk.UsageError, "action of agent 0 in episode 0: expected finite numbers"):
            env.step()
        self.assertRaises(folk.UsageError, folk.mpe.parallel_env().step, {})


if __name__ == "__main__":
    unittest.main()
