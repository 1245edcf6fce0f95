"""One training update of MATD3 (Ackermann et al. 2019) at the sizes of simple_tag, in PyTorch on the CPU, as people
write it: three predators, each with an actor and two centralised critics, against a prey that does not learn. A timing
peer of the mpe module.

Debian 12: apt-get install python3-torch libopenblas0-pthread, then
    OPENBLAS_CORETYPE=SkylakeX /usr/bin/python3 bench/peers/mpe_torch_update.py [--updates N] [--threads 2]
(torch_step.py says what the core type is for.) Prints the milliseconds of an update of all three predators, median and
mean, the threads and PyTorch's version. The threads are PyTorch's; OpenBLAS has one unless OPENBLAS_NUM_THREADS says
otherwise, for two pools that wait actively take each other's processors. Without OpenBLAS, as the line then says, the
same update takes many times as long.

The batches are random tensors drawn beforehand: sampling a replay buffer is not timed, nor is the prey, whose next
action is a part of the data. With --actor-every 2, the default, every second update moves the actors and the targets; a
time is then that of two successive updates, halved. Measure on a machine that does nothing else.
"""

import argparse
import copy
import os
import statistics
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read when it is loaded, with torch

import torch
from torch import nn
from torch.nn import functional

PREDATORS, OBSERVATIONS, ACTIONS = 3, (16, 16, 16, 14), 2
HIDDEN, RATE, CLIP = 64, 1e-2, 0.5
DISCOUNT, POLYAK = 0.95, 0.01
NOISE, NOISE_CLIP, PREACTIVATION_COST = 0.2, 0.5, 1e-3
BATCHES, WARM_UP = 8, 10


def network(inputs, outputs):
    return nn.Sequential(
        nn.Linear(inputs, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, outputs)
    )


class Predator:
    """Actors give actions before the tanh; critics see the observations and actions of all four agents."""

    def __init__(self, index):
        self.index = index
        joint = sum(OBSERVATIONS) + ACTIONS * len(OBSERVATIONS)
        self.networks = nn.ModuleDict(
            {"actor": network(OBSERVATIONS[index], ACTIONS), "q1": network(joint, 1), "q2": network(joint, 1)}
        )
        self.targets = copy.deepcopy(self.networks)
        self.actor, self.q1, self.q2 = (self.networks[name] for name in ("actor", "q1", "q2"))
        self.actor_optimiser = torch.optim.Adam(self.actor.parameters(), lr=RATE)
        self.critic_optimiser = torch.optim.Adam([*self.q1.parameters(), *self.q2.parameters()], lr=RATE)

    def target_action(self, observation):
        action = torch.tanh(self.targets["actor"](observation))
        noise = (NOISE * torch.randn_like(action)).clamp(-NOISE_CLIP, NOISE_CLIP)
        return (action + noise).clamp(-1, 1)

    def update_critics(self, predators, batch):
        with torch.no_grad():
            actions = [p.target_action(o) for p, o in zip(predators, batch["next_observations"])]
            joint = torch.cat([*batch["next_observations"], *actions, batch["next_prey_action"]], dim=1)
            value = torch.min(self.targets["q1"](joint), self.targets["q2"](joint))
            goal = batch["rewards"][self.index] + DISCOUNT * value
        joint = torch.cat([*batch["observations"], *batch["actions"]], dim=1)
        loss = functional.mse_loss(self.q1(joint), goal) + functional.mse_loss(self.q2(joint), goal)
        self.critic_optimiser.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(self.q1.parameters(), CLIP)
        nn.utils.clip_grad_norm_(self.q2.parameters(), CLIP)
        self.critic_optimiser.step()

    def update_actor(self, batch):
        before_tanh = self.actor(batch["observations"][self.index])
        actions = list(batch["actions"])
        actions[self.index] = torch.tanh(before_tanh)
        value = self.q1(torch.cat([*batch["observations"], *actions], dim=1))
        loss = -value.mean() + PREACTIVATION_COST * before_tanh.square().mean()
        self.actor_optimiser.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(self.actor.parameters(), CLIP)
        self.actor_optimiser.step()

    def update_targets(self):
        with torch.no_grad():
            for target, source in zip(self.targets.parameters(), self.networks.parameters()):
                target.lerp_(source, POLYAK)


def random_batch(prey, size):
    observations, next_observations = ([torch.randn(size, n) for n in OBSERVATIONS] for _ in range(2))
    with torch.no_grad():
        next_prey_action = prey(next_observations[-1]).clamp(-1, 1)
    return {
        "observations": observations,
        "actions": [torch.rand(size, ACTIONS) * 2 - 1 for _ in OBSERVATIONS],
        "rewards": [torch.randn(size, 1) for _ in range(PREDATORS)],
        "next_observations": next_observations,
        "next_prey_action": next_prey_action,
    }


def update(predators, batches, with_actors):
    """Each predator in turn, on a batch of its own."""
    for predator, batch in zip(predators, batches):
        predator.update_critics(predators, batch)
        if with_actors:
            predator.update_actor(batch)
            predator.update_targets()


def milliseconds(updates, size, actor_every):
    """Of each group of `actor_every` updates, the last of which moves the actors: milliseconds an update."""
    torch.manual_seed(1)
    predators = [Predator(i) for i in range(PREDATORS)]
    prey = network(OBSERVATIONS[-1], ACTIONS)
    batches = [[random_batch(prey, size) for _ in predators] for _ in range(BATCHES)]
    times = []
    count = 0
    while count < WARM_UP + updates:
        start = time.perf_counter()
        for i in range(actor_every):
            update(predators, batches[count % BATCHES], i == actor_every - 1)
            count += 1
        if count > WARM_UP:
            times.append(1000 * (time.perf_counter() - start) / actor_every)
    return times


def blas():
    """What multiplies matrices: Debian's PyTorch uses whatever libblas it finds."""
    with open("/proc/self/maps") as file:
        found = "openblas" in file.read()
    return f"OpenBLAS threads {os.environ['OPENBLAS_NUM_THREADS']}" if found else "no OpenBLAS"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--updates", type=int, default=200, help="updates that are timed")
    parser.add_argument("--threads", type=int, default=2, help="of PyTorch")
    parser.add_argument("--batch", type=int, default=1024, help="transitions in a batch")
    parser.add_argument("--actor-every", type=int, choices=(1, 2), default=2, help="critic updates to an actor update")
    arguments = parser.parse_args()
    torch.set_num_threads(arguments.threads)
    times = milliseconds(arguments.updates, arguments.batch, arguments.actor_every)
    print(
        f"matd3_update median {statistics.median(times):.2f} ms, mean {statistics.mean(times):.2f} ms, "
        f"batch {arguments.batch}, actor every {arguments.actor_every}, {arguments.threads} threads, {blas()}, "
        f"PyTorch {torch.__version__}"
    )


if __name__ == "__main__":
    main()
