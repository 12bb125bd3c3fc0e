"""Random numbers that are the same on every machine, for the scripts that make parts of scenes."""


class Random:
    """Knuth's linear congruential generator of 64 bits, the upper 32 of which are used."""

    def __init__(self, seed):
        self.state = seed

    def uniform(self, low, high):
        self.state = (6364136223846793005 * self.state + 1442695040888963407) % 2**64
        return low + (high - low) * (self.state >> 32) / 2**32
