"""simple_tag and simple_world of the multi-agent particle world in plain numpy, as people write it: entities that own
state vectors, a world that loops over entities and pairs, observation(agent) and reward(agent); one episode, float64.
A timing peer of the mpe module, and a second opinion on its rules.

Debian 12: apt-get install python3-numpy, then
    /usr/bin/python3 bench/peers/mpe_numpy.py --scenario simple_tag --steps 2000
prints `simple_tag 3500 steps/s`, say: uniform random actions, episodes of 25 steps, the resets and the observations and
rewards of all agents included; and
    /usr/bin/python3 bench/peers/mpe_numpy.py --replay FILE.csv [FILE.csv ...]
takes every step of a golden file from the state in the row before and prints the largest deviation of state,
observation and reward; of a file of reset seeds, that of the positions. The columns of a golden file are episode, t,
ENTITY.{px,py,vx,vy}, actN.{x,y}, obsN.J and rewN; row t = 0 is the reset. Those of reset seeds are seed, reset_no and
ENTITY.{px,py}.
"""

import argparse
import csv
import time

import numpy as np

TIME_STEP, DAMPING = 0.1, 0.25
CONTACT_FORCE, CONTACT_MARGIN = 100.0, 1e-3
EPISODE = 25


class Entity:
    """A disc; one without an acceleration stays where it is."""

    def __init__(self, name, radius, collides=True, acceleration=None, max_speed=None):
        self.name, self.radius, self.collides = name, radius, collides
        self.acceleration, self.max_speed = acceleration, max_speed
        self.movable = acceleration is not None
        self.mass = 1.0
        self.position, self.velocity = np.zeros(2), np.zeros(2)
        self.action = np.zeros(2)


def distance(a, b):
    return np.sqrt(np.sum(np.square(a.position - b.position)))


def touch(a, b):
    return distance(a, b) < a.radius + b.radius


def boundary_penalty(coordinate):
    if coordinate < 0.9:
        return 0.0
    if coordinate < 1.0:
        return 10 * (coordinate - 0.9)
    return min(np.exp(2 * coordinate - 2), 10)


class World:
    """Three predators, one prey, landmarks. The order of `entities` is the order of every loop, draw and column."""

    def __init__(self, prey_radius, landmarks):
        self.predators = [Entity(f"agent{i}", 0.075, acceleration=3.0, max_speed=1.0) for i in range(3)]
        self.prey = Entity("agent3", prey_radius, acceleration=4.0, max_speed=1.3)
        self.agents = self.predators + [self.prey]
        self.landmarks = landmarks
        self.entities = self.agents + self.landmarks

    def step(self, actions):
        for agent, action in zip(self.agents, actions):
            agent.action = agent.acceleration * action
        forces = self.control_forces()
        self.add_contact_forces(forces)
        self.integrate(forces)
        return self.observe()

    def observe(self):
        return [self.observation(agent) for agent in self.agents], [self.reward(agent) for agent in self.agents]

    def control_forces(self):
        """The acceleration counts twice: in the action and in the force."""
        forces = [np.zeros(2) for _ in self.entities]
        for i, agent in enumerate(self.agents):
            forces[i] = agent.mass * agent.acceleration * agent.action
        return forces

    def add_contact_forces(self, forces):
        for i, a in enumerate(self.entities):
            for j in range(i + 1, len(self.entities)):
                b = self.entities[j]
                if not (a.collides and b.collides and (a.movable or b.movable)):
                    continue
                force = self.contact_force(a, b)
                if a.movable:
                    forces[i] = force + forces[i]
                if b.movable:
                    forces[j] = -force + forces[j]

    def contact_force(self, a, b):
        """The push of b on a: soft, so never quite zero."""
        apart = a.position - b.position
        length = np.sqrt(np.sum(np.square(apart)))
        if length == 0:
            return np.zeros(2)
        overlap = a.radius + b.radius - length
        penetration = CONTACT_MARGIN * np.logaddexp(0, overlap / CONTACT_MARGIN)
        return CONTACT_FORCE * apart / length * penetration

    def integrate(self, forces):
        """The velocity first; the position then follows the new velocity."""
        for entity, force in zip(self.entities, forces):
            if not entity.movable:
                continue
            entity.velocity = entity.velocity * (1 - DAMPING) + force / entity.mass * TIME_STEP
            speed = np.sqrt(np.sum(np.square(entity.velocity)))
            if speed > entity.max_speed:
                entity.velocity = entity.velocity / speed * entity.max_speed
            entity.position = entity.position + entity.velocity * TIME_STEP

    def reset(self, generator):
        for entity in self.entities:
            entity.velocity = np.zeros(2)
        self.place(self.agents, 1.0, generator)
        self.place(self.landmarks, 0.9, generator)

    def place(self, entities, reach, generator):
        for entity in entities:
            entity.position = generator.uniform(-reach, reach, 2)

    def observation(self, agent):
        parts = [agent.velocity, agent.position]
        parts += [landmark.position - agent.position for landmark in self.landmarks]
        parts += [other.position - agent.position for other in self.agents if other is not agent]
        if agent is not self.prey:
            parts.append(self.prey.velocity)
        return np.concatenate(parts)

    def reward(self, agent):
        return self.prey_reward() if agent is self.prey else self.predator_reward()

    def predator_reward(self):
        """Shared: the distances and the catches of all predators."""
        reward = 0.0
        for predator in self.predators:
            reward -= 0.1 * distance(predator, self.prey)
            if touch(predator, self.prey):
                reward += self.catch
        return reward

    def prey_reward(self):
        reward = -self.predator_reward()
        for coordinate in self.prey.position:
            reward -= self.boundary_weight * boundary_penalty(abs(coordinate))
        return reward


class SimpleTag(World):
    catch, boundary_weight = 10, 1

    def __init__(self):
        super().__init__(0.05, [Entity(f"landmark{i}", 0.2) for i in range(2)])


class SimpleWorld(World):
    """One obstacle; food, which the prey may eat; forests, which hide nobody but tell who is inside."""

    catch, boundary_weight = 5, 2

    def __init__(self):
        self.food = [Entity(f"food{i}", 0.03, collides=False) for i in range(2)]
        self.forests = [Entity(f"forest{i}", 0.3, collides=False) for i in range(2)]
        super().__init__(0.045, [Entity("landmark0", 0.2)] + self.food + self.forests)

    def reset(self, generator):
        """Food and forests are drawn twice; the second draw counts."""
        super().reset(generator)
        self.place(self.food, 0.9, generator)
        self.place(self.forests, 0.9, generator)

    def observation(self, agent):
        inside = [1.0 if touch(agent, forest) else -1.0 for forest in self.forests]
        return np.concatenate([super().observation(agent), inside])

    def prey_reward(self):
        """The sign of the last term is the original's: the prey is paid for being far from food."""
        reward = super().prey_reward()
        for food in self.food:
            if touch(self.prey, food):
                reward += 2
        return reward + 0.05 * min(distance(self.prey, food) for food in self.food)


SCENARIOS = {"simple_tag": SimpleTag, "simple_world": SimpleWorld}


def steps_a_second(world, steps):
    generator = np.random.RandomState(1)
    start = time.perf_counter()
    for t in range(steps):
        if t % EPISODE == 0:
            world.reset(generator)
            world.observe()
        world.step(generator.uniform(-1, 1, (len(world.agents), 2)))
    return steps / (time.perf_counter() - start)


class Row:
    """A line of a golden file, by the names in its header; a column that is never asked for is an error."""

    def __init__(self, cells):
        self.cells, self.asked = {name: float(cell) for name, cell in cells.items()}, {"episode", "t"}

    def __call__(self, *names):
        self.asked.update(names)
        return np.array([self.cells[name] for name in names])

    def state(self, entity):
        return self(*(f"{entity.name}.{column}" for column in ("px", "py", "vx", "vy")))

    def unread(self):
        return self.cells.keys() - self.asked


def largest(differences):
    """NaN counts as infinitely far."""
    return max(float(np.max(np.nan_to_num(np.abs(difference), nan=np.inf))) for difference in differences)


def set_state(world, row):
    for entity in world.entities:
        entity.position, entity.velocity = np.split(row.state(entity), 2)


def compare(world, observations, rewards, row):
    """The largest deviation of state, observation and reward."""
    states = [np.concatenate([e.position, e.velocity]) - row.state(e) for e in world.entities]
    expected = [row(*(f"obs{i}.{j}" for j in range(len(o)))) for i, o in enumerate(observations)]
    views = [o - e for o, e in zip(observations, expected)]
    return largest(states), largest(views), largest([rewards - row(*(f"rew{i}" for i in range(len(rewards))))])


def replay_episode(world, rows):
    worst = np.zeros(3)
    before = None
    for row in rows:
        actions = [row(f"act{i}.x", f"act{i}.y") for i in range(len(world.agents))]
        if row("t") == 0:  # a reset: no action, no reward
            set_state(world, row)
            observations, rewards = world.observe()[0], np.zeros(len(world.agents))
        else:
            set_state(world, before)
            observations, rewards = world.step(actions)
        worst = np.maximum(worst, compare(world, observations, rewards, row))
        if row.unread():
            raise SystemExit(f"columns that no rule explains: {sorted(row.unread())}")
        before = row
    return "state {:.1e}, observation {:.1e}, reward {:.1e}".format(*worst)


def replay_resets(world, rows):
    worst = 0.0
    for row in rows:
        if row("reset_no") == 0:
            generator = np.random.RandomState(int(row("seed")[0]))
        world.reset(generator)
        worst = max(worst, largest(e.position - row(f"{e.name}.px", f"{e.name}.py") for e in world.entities))
    return f"reset {worst:.1e}"


def replay(path):
    with open(path, newline="") as file:
        rows = [Row(cells) for cells in csv.DictReader(file)]
    scenario = "simple_world" if "food0.px" in rows[0].cells else "simple_tag"
    check = replay_resets if "seed" in rows[0].cells else replay_episode
    return f"{path} {scenario}, {len(rows)} rows: {check(SCENARIOS[scenario](), rows)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--scenario", choices=SCENARIOS, default="simple_tag")
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--replay", nargs="+", metavar="FILE.csv", help="check golden files instead of timing")
    arguments = parser.parse_args()
    for path in arguments.replay or []:
        print(replay(path))
    if not arguments.replay:
        rate = steps_a_second(SCENARIOS[arguments.scenario](), arguments.steps)
        print(f"{arguments.scenario} {rate:.0f} steps/s")


if __name__ == "__main__":
    main()
