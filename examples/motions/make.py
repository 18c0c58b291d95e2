#!/usr/bin/env python3
"""Makes the motions of the examples: make.py [FOLDER]"""

import sys
from math import cos, pi, sin
from pathlib import Path


def part(t, begin, end):
    """From 0 to 1 between two times, at rest at both, with the least jerk."""
    s = min(max((t - begin) / (end - begin), 0), 1)
    return s**3 * (10 - 15 * s + 6 * s**2)


def pick_and_place(t):
    """Lifted by 0.15 m, carried 0.8 m along y while it turns by a quarter about the vertical, put down."""
    up = 0.15 * (part(t, 0, 0.5) - part(t, 1, 1.6))
    yaw = pi / 2 * part(t, 0.4, 1.2)
    return 0, 0.8 * part(t, 0.4, 1.2), up, cos(yaw / 2), 0, 0, sin(yaw / 2)


folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
rows = ["t,x,y,z,qw,qx,qy,qz"]
for k in range(81):
    t = k / 50
    rows.append(",".join(f"{value:.9f}".rstrip("0").rstrip(".") for value in (t, *pick_and_place(t))))
(folder / "pick-and-place.csv").write_text("\n".join(rows) + "\n")
