"""How the ranking of memory(X,Y) grows: how many leaves the joint walk of all its members has (analysis/classes/joint_walk.h), which is
what its time goes by. Without DESCENTS they are counted; with them the number is estimated by random descents that weigh the ways they
did not go (Knuth, Mathematics of Computation 29, 1975), with its standard error.

    python3 bench/class_cost.py X Y [DESCENTS [SEED]]
"""

import random
import sys

BOTH = 0.1  # how often both sides are followed


class Walk:
    """Both players' genes are chosen as play asks for them; where a joint state returns there is a leaf."""

    def __init__(self, own, their):
        self.own, self.their = own, their
        self.openings = max(own, their)
        self.low = (1 << self.openings) - 1

    def gene(self, t, a, b):
        if t < self.openings:
            return t
        return self.openings + (((a & ((1 << self.own) - 1)) << self.their) | (b & ((1 << self.their) - 1)))

    def count(self):
        """All leaves."""
        first, second, seen = {}, {}, set()

        def walk(t, a, b):
            state = (a, b) if t >= self.openings else None
            if state in seen:
                return 1
            if state:
                seen.add(state)
            g, h = self.gene(t, a, b), self.gene(t, b, a)
            leaves = 0
            for x in (first[g],) if g in first else (0, 1):
                new_x = g not in first
                first[g] = x
                for y in (second[h],) if h in second else (0, 1):
                    new_y = h not in second
                    second[h] = y
                    leaves += walk(t + 1, (a << 1 | x) & self.low, (b << 1 | y) & self.low)
                    if new_y:
                        del second[h]
                if new_x:
                    del first[g]
            if state:
                seen.discard(state)
            return leaves

        return walk(0, 0, 0)

    def descent(self, random_number):
        """An estimate whose mean is the number of leaves: of each choice one side is followed and counts twice, or now and then both."""
        first, second, seen = {}, {}, set()

        def sides(genes, gene):
            if gene in genes:
                return (genes[gene],), 1
            if random_number() < BOTH:
                return (0, 1), 1
            return (int(random_number() < 0.5),), 2

        def walk(t, a, b):
            state = (a, b) if t >= self.openings else None
            if state in seen:
                return 1
            if state:
                seen.add(state)
            g, h = self.gene(t, a, b), self.gene(t, b, a)
            leaves = 0
            known = g in first
            moves, counts = sides(first, g)
            for x in moves:
                first[g] = x
                known_too = h in second
                answers, each = sides(second, h)
                for y in answers:
                    second[h] = y
                    leaves += counts * each * walk(t + 1, (a << 1 | x) & self.low, (b << 1 | y) & self.low)
                if not known_too:
                    del second[h]
            if not known:
                del first[g]
            if state:
                seen.discard(state)
            return leaves

        return walk(0, 0, 0)


def main():
    own, their = int(sys.argv[1]), int(sys.argv[2])
    descents = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    walk = Walk(own, their)
    genes = walk.openings + 2 ** (own + their)
    members = f"memory({own},{their}): 2^{genes} members, {32 * 2**genes / 1e9:.3g} GB of totals"
    if not descents:
        print(f"{members}, {walk.count():.4g} leaves")
        return
    random_number = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1).random
    total = squares = 0
    for _ in range(descents):
        weight = walk.descent(random_number)
        total += weight
        squares += weight * weight
    mean = total / descents
    error = ((squares / descents - mean * mean) / descents) ** 0.5
    print(f"{members}, {mean:.4g} +- {error:.2g} leaves ({descents} descents)")


if __name__ == "__main__":
    main()
