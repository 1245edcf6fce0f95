"""One training step of the self-confirming transformer at the paper's setting in the iterated prisoner's dilemma, in
PyTorch on the CPU: what `folk-bench --benchmark_filter=sct_training_step` is compared with.

Debian 12: apt-get install python3-torch libopenblas0-pthread, then
    OPENBLAS_CORETYPE=SkylakeX /usr/bin/python3 bench/peers/torch_step.py [--steps N]
(OpenBLAS of Debian 12 does not know the newest processors and falls back on slow kernels unless it is told a core type;
SkylakeX stands for AVX-512, Haswell for AVX2.) Prints, for each number of threads of PyTorch and of OpenBLAS, the best
seconds a step and the rate, a step being counted as 20.0 GFLOP. Both kinds of threads wait actively: measure on a
machine that does nothing else.
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
OBSERVATIONS, ACTIONS, MATCH = 5, 2, 100
ROUND = 4  # tokens: return, observation, belief, action
DROPOUT, RATE, DECAY, CLIP = 0.1, 1e-4, 1e-4, 0.25
NOMINAL_GFLOP = 20.0


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
    """Beliefs are read at the observation, actions at the belief token."""

    def __init__(self):
        super().__init__()
        self.time = nn.Embedding(MATCH, HIDDEN)
        self.returns, self.observation = nn.Linear(1, HIDDEN), nn.Linear(OBSERVATIONS, HIDDEN)
        self.opponent, self.own = nn.Embedding(ACTIONS + 1, HIDDEN), nn.Embedding(ACTIONS + 1, HIDDEN)
        self.norm_in, self.norm_out = nn.LayerNorm(HIDDEN), nn.LayerNorm(HIDDEN)
        self.blocks = nn.ModuleList(Block() for _ in range(LAYERS))
        self.belief, self.action = nn.Linear(HIDDEN, ACTIONS), nn.Linear(HIDDEN, ACTIONS)
        later = torch.ones(CONTEXT * ROUND, CONTEXT * ROUND, dtype=torch.bool).triu(1)
        self.register_buffer("later", later)

    def forward(self, returns, observations, opponent, own, times):
        tokens = [self.returns(returns), self.observation(observations), self.opponent(opponent), self.own(own)]
        x = torch.stack(tokens, dim=2) + self.time(times).unsqueeze(2)
        x = self.norm_in(x.reshape(len(returns), CONTEXT * ROUND, HIDDEN))
        x = functional.dropout(x, DROPOUT, self.training)
        for block in self.blocks:
            x = block(x, self.later)
        x = self.norm_out(x).reshape(len(returns), CONTEXT, ROUND, HIDDEN)
        return self.belief(x[:, :, 1]), self.action(x[:, :, 2])


def batch():
    starts = torch.randint(0, MATCH - CONTEXT + 1, (WINDOWS, 1))
    shape = (WINDOWS, CONTEXT)
    return (
        torch.rand(*shape, 1) * 3,
        functional.one_hot(torch.randint(0, OBSERVATIONS, shape), OBSERVATIONS).float(),
        torch.randint(0, ACTIONS, shape),
        torch.randint(0, ACTIONS, shape),
        starts + torch.arange(CONTEXT),
    )


def step(model, optimiser, inputs):
    belief, action = model(*inputs)
    opponent, own = inputs[2], inputs[3]
    loss = functional.cross_entropy(belief.flatten(0, 1), opponent.flatten())
    loss = loss + functional.cross_entropy(action.flatten(0, 1), own.flatten())
    optimiser.zero_grad(set_to_none=True)
    loss.backward()
    nn.utils.clip_grad_norm_(model.parameters(), CLIP)
    optimiser.step()


def best_seconds(steps):
    torch.manual_seed(1)
    model = Transformer().train()
    optimiser = torch.optim.AdamW(model.parameters(), lr=RATE, weight_decay=DECAY)
    best = float("inf")
    for _ in range(steps):
        inputs = batch()
        start = time.perf_counter()
        step(model, optimiser, inputs)
        best = min(best, time.perf_counter() - start)
    return best


def measure(torch_threads, blas_threads, steps):
    """In a process of its own: OpenBLAS reads its number of threads when it is loaded."""
    command = [sys.executable, "-B", __file__, "--steps", str(steps), "--threads-of-torch", str(torch_threads)]
    environment = dict(os.environ, OPENBLAS_NUM_THREADS=str(blas_threads))
    return float(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--steps", type=int, default=30, help="steps for each setting")
    parser.add_argument("--threads-of-torch", type=int, help="measure only this setting; print seconds")
    arguments = parser.parse_args()
    if arguments.threads_of_torch:
        torch.set_num_threads(arguments.threads_of_torch)
        print(best_seconds(arguments.steps))
        return
    print(f"PyTorch {torch.__version__}, OPENBLAS_CORETYPE={os.environ.get('OPENBLAS_CORETYPE', 'unset')}")
    times = {}
    for setting in itertools.product(range(1, os.cpu_count() + 1), repeat=2):
        times[setting] = measure(*setting, arguments.steps)
        print(line(setting, times[setting]), flush=True)
    best = min(times, key=times.get)
    print("best: " + line(best, times[best]))


def line(setting, seconds):
    rate = NOMINAL_GFLOP / seconds
    return f"torch {setting[0]} threads, OpenBLAS {setting[1]}: {seconds:.4f} s a step, {rate:.1f} GFLOP/s"


if __name__ == "__main__":
    main()
