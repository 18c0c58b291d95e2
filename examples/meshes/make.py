#!/usr/bin/env python3
"""Makes the meshes of the examples, in millimetres: make.py [FOLDER]"""

import sys
from math import cos, pi, sin
from pathlib import Path


class Body:
    """A closed surface: vertices, and faces counter-clockwise seen from outside."""

    def __init__(self):
        self.vertices, self.faces = [], []

    def add(self, *point):
        self.vertices.append(point)
        return len(self.vertices) - 1

    def turned(self, profile, sides):
        """A body of revolution about z: points (r, z) from the lower end to the upper one, both on
        the axis. Returns its rings."""
        lower, upper = self.add(0, 0, profile[0][1]), self.add(0, 0, profile[-1][1])
        rings = [
            [self.add(r * cos(a), r * sin(a), z) for a in (2 * pi * k / sides for k in range(sides))]
            for r, z in profile[1:-1]
        ]
        for k in range(sides):
            n = (k + 1) % sides
            self.faces.append([lower, rings[0][n], rings[0][k]])
            for ring, above in zip(rings, rings[1:]):
                self.faces.append([ring[k], ring[n], above[n], above[k]])
            self.faces.append([rings[-1][k], rings[-1][n], upper])
        return rings

    def opened(self, rings, rows, columns):
        """Takes a patch of the faces between rings away; returns its rim, counter-clockwise."""
        low, high = rows
        patch = [rings[i][k] for i in range(low, high + 1) for k in columns]
        self.faces = [face for face in self.faces if not all(v in patch for v in face)]
        return (
            [rings[low][k] for k in columns]
            + [rings[i][columns[-1]] for i in range(low + 1, high)]
            + [rings[high][k] for k in reversed(columns)]
            + [rings[i][columns[0]] for i in range(high - 1, low, -1)]
        )

    def tube(self, rim, section):
        """A wall from a rim to the next section; returns that."""
        section = [self.add(*point) for point in section]
        self.joined(rim, section)
        return section

    def joined(self, rim, other):
        """A wall from a rim to another one, vertex to vertex."""
        for k in range(len(rim)):
            n = (k + 1) % len(rim)
            self.faces.append([rim[k], rim[n], other[n], other[k]])

    def write(self, path):
        lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in self.vertices]
        for first, *rest in self.faces:  # as triangles
            lines += [f"f {first + 1} {a + 1} {b + 1}" for a, b in zip(rest, rest[1:])]
        path.write_text("\n".join(lines) + "\n", encoding="ascii")


def mug():
    """A mug: 80 mm wide and 95 mm high, its wall 4 mm and its bottom 6 mm thick; a handle on +x."""
    body = Body()
    heights = [0, 22, 32, 63, 73, 95]
    rings = body.turned(
        [(0, 0)] + [(40, z) for z in heights] + [(36, 95), (36, 6), (0, 6)], sides=48
    )
    columns = [47, 0, 1]
    lower = body.opened(rings, (1, 2), columns)
    upper = body.opened(rings, (3, 4), columns)

    def section(angle):
        """Across the handle, half an ellipse round (42, 0, 47.5)."""
        points = []
        for vertex in lower:
            _, y, z = body.vertices[vertex]
            off = 47.5 - 27 - 0.8 * (z - 27)
            points.append((42 + 1.4 * off * sin(angle), y, 47.5 - off * cos(angle)))
        return points

    rim = lower
    for k in range(1, 12):
        rim = body.tube(rim, section(pi * k / 12))

    def place(vertex):
        _, y, z = body.vertices[vertex]
        return round(y, 6), round(abs(z - 47.5), 6)

    # The rim of the upper patch is that of the lower one, mirrored in height.
    mirrored = {place(vertex): vertex for vertex in upper}
    body.joined(rim, [mirrored[place(vertex)] for vertex in lower])
    return body


def drill():
    """A part like a drill: a barrel of 50 mm along z with a chuck, and a handle that leaves it at
    -y."""
    body = Body()
    heights = [0, 30, 60, 90, 120]
    profile = [(0, 0)] + [(25, z) for z in heights] + [(15, 135), (15, 160), (6, 165), (6, 200), (0, 200)]
    rings = body.turned(profile, sides=32)
    rim = body.opened(rings, (1, 2), [21, 22, 23, 24, 25, 26, 27])
    around = [body.vertices[v] for v in rim]
    for depth in (60, 100, 140):
        lean = 0.15 * (depth - 25)  # towards the back
        rim = body.tube(rim, [(0.9 * x, -depth, z - lean) for x, y, z in around])
    for k in range(6):  # the end, seven vertices below and seven above
        body.faces.append([rim[k], rim[k + 1], rim[12 - k], rim[13 - k]])
    return body


def bracket():
    """An L-bracket: legs of 100 and 80 mm, 12 mm thick, 40 mm wide; its centre of mass lies in the
    corner between them."""
    body = Body()
    outline = [(0, 0), (100, 0), (100, 12), (12, 12), (12, 80), (0, 80)]
    back = [body.add(x, -20, z) for x, z in outline]
    front = [body.add(x, 20, z) for x, z in outline]
    for k in range(6):
        n = (k + 1) % 6
        body.faces.append([back[k], front[k], front[n], back[n]])
    for a, b, c, d in ((0, 1, 2, 3), (0, 3, 4, 5)):
        body.faces.append([back[a], back[b], back[c], back[d]])
        body.faces.append([front[d], front[c], front[b], front[a]])
    return body


folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
for make in (mug, drill, bracket):
    make().write(folder / f"{make.__name__}.obj")
