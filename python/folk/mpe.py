"""The particle world (docs/mpe.md): three predators chase a prey. A batch of environments for who trains fast, and one
environment in PettingZoo's parallel interface."""

import numpy

from folk import _folk


class BatchEnv:
    """n environments of a scenario, stepped together.

    n: up to 64, or a multiple of 64. scenario: "simple_tag" or "simple_world"; reward_rule: "program" or "paper". The
    arrays are made once, and every reset and step writes into them: they are the world's own memory, in blocks of (up to)
    64 environments, so that environment e stands at [e // 64, e % 64]. All are float64:

      observations  of each agent an array (B, L, size)
      rewards       (B, L, agents), of the last step
      actions       (B, L, agents, 2): write them before a step; a force from -1 to 1 by axis, not clipped; they stay

    Raises UsageError.

    >>> from folk import mpe
    >>> env = mpe.BatchEnv("simple_tag", 128)
    >>> env.reset(seed=1)
    >>> env.actions[:] = 0.5
    >>> env.step()
    >>> env.agents, env.observations[0].shape, env.rewards.shape
    (['agent0', 'agent1', 'agent2', 'agent3'], (2, 64, 16), (2, 64, 4))
    """

    def __init__(self, scenario="simple_tag", n=64, reward_rule="program", threads=1):
        self._batch = _folk.Batch(scenario, n, reward_rule, threads)
        self.n = n
        self.agents = self._batch.agents
        self.episode_steps = self._batch.episode_steps
        self.observations = tuple(self._batch.observations(agent) for agent in range(len(self.agents)))
        self.rewards = self._batch.rewards()
        actions = self._batch.actions()
        blocks, lanes, numbers = actions.shape
        self.actions = numpy.lib.stride_tricks.as_strided(
            actions, (blocks, lanes, numbers // 2, 2), (*actions.strides[:2], 2 * actions.strides[2], actions.strides[2]))
        self.step = self._batch.step

    def reset(self, seed=1, first=0) -> None:
        """Environment e becomes number first + e of this seed's episodes."""
        self._batch.reset(seed, first)

    def flat(self, array) -> numpy.ndarray:
        """One of the arrays as (n, ...), a copy."""
        return array.reshape(self.n, *array.shape[2:])


class Box:
    """A space of real arrays: low, high, shape, dtype, sample(), contains()."""

    def __init__(self, low, high, shape, seed=None):
        self.low, self.high, self.shape, self.dtype = low, high, shape, numpy.dtype(numpy.float64)
        self._random = numpy.random.default_rng(seed)

    def sample(self) -> numpy.ndarray:
        bound = 1.0 if numpy.isinf(self.high) else self.high
        return self._random.uniform(-bound, bound, self.shape)

    def contains(self, value) -> bool:
        value = numpy.asarray(value)
        return value.shape == self.shape and bool(numpy.all((value >= self.low) & (value <= self.high)))

    def __repr__(self):
        return f"Box({self.low}, {self.high}, {self.shape}, {self.dtype})"


class ParallelEnv:
    """One environment in PettingZoo's parallel interface; that package is not needed. folk.mpe.parallel_env makes it."""

    metadata = {"name": "folk_mpe", "render_modes": []}
    render_mode = None

    def __init__(self, scenario, reward_rule):
        self._env = BatchEnv(scenario, 1, reward_rule)
        self.possible_agents = list(self._env.agents)
        self.agents = []
        sizes = [observations.shape[2] for observations in self._env.observations]
        self.observation_spaces = {agent: Box(-numpy.inf, numpy.inf, (size,))
                                   for agent, size in zip(self.possible_agents, sizes)}
        self.action_spaces = {agent: Box(-1.0, 1.0, (2,)) for agent in self.possible_agents}
        self.max_num_agents = len(self.possible_agents)
        self._next_episode = (1, 0)

    @property
    def num_agents(self) -> int:
        return len(self.agents)

    @property
    def unwrapped(self):
        return self

    def observation_space(self, agent) -> Box:
        return self.observation_spaces[agent]

    def action_space(self, agent) -> Box:
        return self.action_spaces[agent]

    def reset(self, seed=None, options=None):
        """Begins the first episode of a seed, or without one the next."""
        seed, number = self._next_episode if seed is None else (seed, 0)
        self._next_episode = (seed, number + 1)
        self._env.reset(seed, number)
        self.agents = list(self.possible_agents)
        self._steps = 0
        return self._observations(), {agent: {} for agent in self.agents}

    def step(self, actions):
        """actions: by agent two numbers from -1 to 1. Returns observations, rewards, terminations, truncations and infos
        by agent. Nobody's episode ends before its last step, when all are truncated."""
        if not self.agents:
            raise _folk.UsageError("the episode is over: reset() begins another")
        for place, agent in enumerate(self.possible_agents):
            self._env.actions[0, 0, place] = actions[agent]
        self._env.step()
        self._steps += 1
        over = self._steps >= self._env.episode_steps
        stepped, rewards = self.agents, self._env.rewards[0, 0]
        if over:
            self.agents = []
        return (self._observations(), {agent: float(reward) for agent, reward in zip(stepped, rewards)},
                dict.fromkeys(stepped, False), dict.fromkeys(stepped, over), {agent: {} for agent in stepped})

    def _observations(self):
        return {agent: observations[0, 0].copy()
                for agent, observations in zip(self.possible_agents, self._env.observations)}

    def render(self):
        """Nothing is drawn: mpe-evaluate --render draws episodes."""

    def close(self):
        """There is nothing to close."""

    def state(self) -> numpy.ndarray:
        """What all agents observe, one after the other."""
        return numpy.concatenate(list(self._observations().values()))


def parallel_env(scenario="simple_tag", reward_rule="program") -> ParallelEnv:
    """An environment with possible_agents, observation_space, action_space, reset and step, as PettingZoo's parallel
    interface has them.

    >>> from folk import mpe
    >>> env = mpe.parallel_env("simple_tag")
    >>> observations, infos = env.reset(seed=1)
    >>> observations, rewards, terminations, truncations, infos = env.step(dict.fromkeys(env.agents, (0.0, 1.0)))
    >>> sorted(rewards), observations["agent3"].shape
    (['agent0', 'agent1', 'agent2', 'agent3'], (14,))
    """
    return ParallelEnv(scenario, reward_rule)
