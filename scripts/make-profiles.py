#!/usr/bin/env python3
"""Writes the IES profiles of the scenes: scenes/profiles/street.ies, lantern.ies and downlight.ies. No luminaire was measured for them.

street.ies is a luminaire beside a road, in the convention of roadway lighting: the half-planes of 0 and 180 degrees are along
the road, that of 90 is towards it. Most light leaves at 60 degrees along the road and little behind the luminaire; above 80
degrees it is dark. lantern.ies is an old lantern, which shines around and a little upward. downlight.ies has a
bright core and a dimmer ring, both with hard edges.

Usage: make-profiles.py [FOLDER]
"""

import math
import pathlib
import sys


def smooth_step(x, low, high):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def street(vertical, horizontal):
    """Intensity of a lamp of 1 unit per steradian straight down."""
    along = abs(math.cos(math.radians(horizontal)))
    towards = math.sin(math.radians(horizontal))
    wings = 3.4 * math.exp(-(((vertical - 60) / 13) ** 2)) * along**3
    middle = math.exp(-((vertical / 55) ** 2))
    side = 0.25 + 0.75 * smooth_step(towards, -0.8, 0.35)
    return (wings + middle) * side * (1 - smooth_step(vertical, 68, 82))


def lantern(vertical, _):
    return smooth_step(vertical, 4, 40) * (1 - 0.85 * smooth_step(vertical, 80, 120)) * (1 - smooth_step(vertical, 130, 160))


def downlight(vertical, _):
    return (0.3 + 0.7 * (1 - smooth_step(vertical, 24, 27))) * (1 - smooth_step(vertical, 52, 56))


def write(path, name, intensity, vertical, horizontal, candelas):
    lines = ["IESNA:LM-63-2002", "[TEST] computed by scripts/make-profiles.py", "[MANUFAC] Nusselt",
             f"[LUMINAIRE] {name}", "TILT=NONE",
             f"1 -1 1 {len(vertical)} {len(horizontal)} 1 2 0.3 0.6 0", "1 1 80"]

    def add(numbers):
        for i in range(0, len(numbers), 10):
            lines.append(" ".join(f"{x:g}" for x in numbers[i:i + 10]))

    add(vertical)
    add(horizontal)
    for h in horizontal:
        add([round(candelas * intensity(v, h), 1) for v in vertical])
    path.write_text("\n".join(lines) + "\n")


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "scenes/profiles")
    write(folder / "street.ies", "road luminaire", street, [2.5 * i for i in range(37)],
          [90 + 10 * i for i in range(19)], 900)
    write(folder / "lantern.ies", "lantern", lantern, [5.0 * i for i in range(37)], [0], 90)
    write(folder / "downlight.ies", "downlight", downlight, [1.0 * i for i in range(91)], [0], 1500)


if __name__ == "__main__":
    main()
