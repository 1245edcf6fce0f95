"""One training step of the self-confirming transformer at the paper's settings, in PyTorch on the CPU: in the iterated
prisoner's dilemma (ipd) what `folk-bench --benchmark_filter=sct_training_step` is compared with, in the particle world
(mpe; three predators, continuous actions) `--benchmark_filter=sct_predators_step`.

Debian 12: apt-get install python3-torch libopenblas0-pthread, then
    OPENBLAS_CORETYPE=SkylakeX /usr/bin/python3 bench/peers/torch_step.py [--setting mpe] [--steps N]
(OpenBLAS of Debian 12 does not know the newest processors and falls back on slow kernels unless it is told a core type;
SkylakeX stands for AVX-512, Haswell for AVX2.) Prints, for each number of threads of PyTorch and of OpenBLAS, the best
seconds a step and the rate, a step being counted as 20.0 GFLOP (ipd) or 44.6 (mpe). Both kinds of threads wait
actively: measure on a machine that does nothing else.
"""

import argparse
import itertools
import os
import subprocess
import sys
import time

import torch
from torch import nn
from torch.nn import functional

WINDOWS, CONTEXT, HIDDEN, LAYERS = 64, 20, 128, 3
DROPOUT, RATE, DECAY, CLIP = 0.1, 1e-4, 1e-4, 0.25


class Block(nn.Module):
    """x += attention(norm(x)); x += mlp(norm(x)), one head."""

    def __init__(self):
        super().__init__()
        self.norm_1, self.norm_2 = nn.LayerNorm(HIDDEN), nn.LayerNorm(HIDDEN)
        self.query_key_value = nn.Linear(HIDDEN, 3 * HIDDEN)
        self.projection = nn.Linear(HIDDEN, HIDDEN)
        self.inner, self.outer = nn.Linear(HIDDEN, 4 * HIDDEN), nn.Linear(4 * HIDDEN, HIDDEN)

    def attention(self, x, hidden_keys):
        query, key, value = self.query_key_value(x).split(HIDDEN, dim=-1)
        scores = torch.bmm(query, key.transpose(1, 2)) * HIDDEN**-0.5
        weights = torch.softmax(scores.masked_fill(hidden_keys, float("-inf")), dim=-1)
        return self.projection(torch.bmm(self.drop(weights), value))

    def drop(self, x):
        return functional.dropout(x, DROPOUT, self.training)

    def forward(self, x, hidden_keys):
        x = x + self.drop(self.attention(self.norm_1(x), hidden_keys))
        return x + self.drop(self.outer(torch.relu(self.inner(self.norm_2(x)))))


class Transformer(nn.Module):
    """The tokens of a round: return, observations, belief, actions. Beliefs are read at the observations."""

    match, observations, agents = 0, 0, 0  # rounds, numbers of one observation, agents with an action token each

    def __init__(self):
        super().__init__()
        self.round = 2 + 2 * self.agents
        self.time = nn.Embedding(self.match, HIDDEN)
        self.returns, self.observation = nn.Linear(1, HIDDEN), nn.Linear(self.observations, HIDDEN)
        self.norm_in, self.norm_out = nn.LayerNorm(HIDDEN), nn.LayerNorm(HIDDEN)
        self.blocks = nn.ModuleList(Block() for _ in range(LAYERS))
        later = torch.ones(CONTEXT * self.round, CONTEXT * self.round, dtype=torch.bool).triu(1)
        self.register_buffer("later", later)

    def forward(self, returns, observations, opponent, own, times):
        x = self.tokens(returns, observations, opponent, own) + self.time(times).unsqueeze(2)
        x = self.norm_in(x.reshape(len(returns), CONTEXT * self.round, HIDDEN))
        x = functional.dropout(x, DROPOUT, self.training)
        for block in self.blocks:
            x = block(x, self.later)
        return self.heads(self.norm_out(x).reshape(len(returns), CONTEXT, self.round, HIDDEN))


class Ipd(Transformer):
    """The action is read at the belief token."""

    match, observations, agents, actions = 100, 5, 1, 2

    def __init__(self):
        super().__init__()
        self.opponent, self.own = (nn.Embedding(self.actions + 1, HIDDEN) for _ in range(2))
        self.belief, self.action = (nn.Linear(HIDDEN, self.actions) for _ in range(2))

    def tokens(self, returns, observations, opponent, own):
        tokens = [self.returns(returns), self.observation(observations), self.opponent(opponent), self.own(own)]
        return torch.stack(tokens, dim=2)

    def heads(self, x):
        return self.belief(x[:, :, 1]), self.action(x[:, :, 2])

    @staticmethod
    def loss(said, played):
        return functional.cross_entropy(said.flatten(0, 1), played.flatten())

    def played(self, agents):
        return torch.randint(0, self.actions, (WINDOWS, CONTEXT))

    def observed(self):
        seen = torch.randint(0, self.observations, (WINDOWS, CONTEXT))
        return functional.one_hot(seen, self.observations).float()


class Mpe(Transformer):
    """Each action is read at the agent's observation and the belief token."""

    match, observations, agents, actions = 26, 16, 3, 2

    def __init__(self):
        super().__init__()
        self.opponent, self.own = (nn.Linear(self.actions, HIDDEN) for _ in range(2))
        self.belief, self.mix = nn.Linear(self.agents * HIDDEN, self.actions), nn.Linear(2 * HIDDEN, HIDDEN)
        self.action = nn.ModuleList(nn.Linear(HIDDEN, self.actions) for _ in range(self.agents))

    def tokens(self, returns, observations, opponent, own):
        alone = [self.returns(returns).unsqueeze(2), self.opponent(opponent)]
        return torch.cat([alone[0], self.observation(observations), alone[1], self.own(own)], dim=2)

    def heads(self, x):
        seen, belief_token = x[:, :, 1 : 1 + self.agents], x[:, :, 1 + self.agents]
        belief = torch.tanh(self.belief(seen.flatten(2))).unsqueeze(2)
        mixed = self.mix(torch.cat([seen, belief_token.unsqueeze(2).expand_as(seen)], dim=3))
        actions = [torch.tanh(head(mixed[:, :, agent])) for agent, head in enumerate(self.action)]
        return belief, torch.stack(actions, dim=2)

    loss = staticmethod(functional.mse_loss)

    def played(self, agents):
        return torch.rand(WINDOWS, CONTEXT, agents, self.actions) * 2 - 1

    def observed(self):
        return torch.rand(WINDOWS, CONTEXT, self.agents, self.observations) * 2 - 1


SETTINGS = {"ipd": (Ipd, 20.0), "mpe": (Mpe, 44.6)}  # and what a step is counted as, in GFLOP


def batch(model):
    starts = torch.randint(0, model.match - CONTEXT + 1, (WINDOWS, 1))
    returns = torch.rand(WINDOWS, CONTEXT, 1) * 3
    return returns, model.observed(), model.played(1), model.played(model.agents), starts + torch.arange(CONTEXT)


def step(model, optimiser, inputs):
    belief, action = model(*inputs)
    opponent, own = inputs[2], inputs[3]
    loss = model.loss(belief, opponent) + model.loss(action, own)
    optimiser.zero_grad(set_to_none=True)
    loss.backward()
    nn.utils.clip_grad_norm_(model.parameters(), CLIP)
    optimiser.step()


def best_seconds(setting, steps):
    torch.manual_seed(1)
    model = SETTINGS[setting][0]().train()
    optimiser = torch.optim.AdamW(model.parameters(), lr=RATE, weight_decay=DECAY)
    best = float("inf")
    for _ in range(steps):
        inputs = batch(model)
        start = time.perf_counter()
        step(model, optimiser, inputs)
        best = min(best, time.perf_counter() - start)
    return best


def measure(setting, threads, steps):
    """In a process of its own: OpenBLAS reads its number of threads when it is loaded."""
    command = [sys.executable, "-B", __file__, "--setting", setting, "--steps", str(steps)]
    command += ["--threads-of-torch", str(threads[0])]
    environment = dict(os.environ, OPENBLAS_NUM_THREADS=str(threads[1]))
    return float(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--setting", choices=SETTINGS, default="ipd")
    parser.add_argument("--steps", type=int, default=30, help="steps for each number of threads")
    parser.add_argument("--threads-of-torch", type=int, help="measure only this number; print seconds")
    arguments = parser.parse_args()
    if arguments.threads_of_torch:
        torch.set_num_threads(arguments.threads_of_torch)
        print(best_seconds(arguments.setting, arguments.steps))
        return
    print(f"PyTorch {torch.__version__}, OPENBLAS_CORETYPE={os.environ.get('OPENBLAS_CORETYPE', 'unset')}")
    times = {}
    for threads in itertools.product(range(1, os.cpu_count() + 1), repeat=2):
        times[threads] = measure(arguments.setting, threads, arguments.steps)
        print(line(arguments.setting, threads, times[threads]), flush=True)
    best = min(times, key=times.get)
    print("best: " + line(arguments.setting, best, times[best]))


def line(setting, threads, seconds):
    rate = SETTINGS[setting][1] / seconds
    return f"torch {threads[0]} threads, OpenBLAS {threads[1]}: {seconds:.4f} s a step, {rate:.1f} GFLOP/s"


if __name__ == "__main__":
    main()
