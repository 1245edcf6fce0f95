#!/usr/bin/env python3
"""A predator or the prey of the particle world as a program of its own.

    mpe-evaluate --predators 'exec:"python3 examples/particle_player.py"' --prey still --episodes 5
"""
import sys

LANDMARKS = {"simple_tag": 2, "simple_world": 5}
AXES = (0, 1)


def clip(x):
    return max(-1.0, min(1.0, x))


def chase(velocity, prey, prey_velocity):
    """To where the prey will be in a moment."""
    return [clip(3 * (prey[k] + 0.2 * prey_velocity[k] - 0.15 * velocity[k])) for k in AXES]


def flee(position, predators):
    """Away from the nearest predator, and back where the arena ends."""
    nearest = min(predators, key=lambda place: place[0] ** 2 + place[1] ** 2)
    return [clip(-3 * nearest[k] - (3 * position[k] if abs(position[k]) > 0.8 else 0)) for k in AXES]


for line in sys.stdin:
    words = line.split()
    if words[0] == "episode":  # episode SCENARIO agent=I steps=N seed=S: a new one begins
        is_prey = words[2] == "agent=3"
        others_begin = 4 + 2 * LANDMARKS[words[1]]
        others_end = others_begin + 2 * 3
    elif words[0] == "act":  # act and what the agent observes: the only line that wants an answer
        seen = [float(word) for word in words[1:]]
        velocity, position = seen[0:2], seen[2:4]
        others = [seen[k:k + 2] for k in range(others_begin, others_end, 2)]  # from where the agent is, the prey last
        if is_prey:
            action = flee(position, others)
        else:
            action = chase(velocity, others[-1], seen[others_end:others_end + 2])
        print(*action, flush=True)
    elif words[0] == "end":
        break
