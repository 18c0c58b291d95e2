"""Data for the picture of the body C: docs/theory.md, "The farthest point of a convex body".

body.py PROGRAM GRASP HOLDS...: in the plane through the farthest point and the z axis of the object
frame, blocks for gnuplot: C; the farthest point; the polytope after so many holds, for each number.
Forces are in weights. For hard fingers without limits.
"""

import json
import subprocess
import sys

import numpy as np

program, grasp_file, *counts = sys.argv[1:]


def poise(command, *flags):
    run = [program, command, grasp_file, "--json", *flags]
    return json.loads(subprocess.run(run, stdout=subprocess.PIPE, check=False).stdout)


def radius(u):  # of C in the direction u
    hold = poise("hold", "--up", ",".join(map(repr, map(float, u))))
    return W / hold["force_norm"] if hold["holdable"] else 0


def wrench(force, point):
    return np.append(force, np.cross(point, force))


def norm_of_response(y):  # |projection of G^T y onto the cones|: hard fingers without limits
    total = 0
    for c in grasp["contacts"]:
        n, mu = np.array(c["normal"]), c["friction"]
        z = y[:3] + np.cross(y[3:], c["position"])
        a, t = z @ n, np.linalg.norm(z - (z @ n) * n)
        total += a**2 + t**2 if t <= mu * a else max(a + mu * t, 0) ** 2 / (1 + mu**2)
    return total**0.5


grasp = poise("check")
W, com = grasp["loads"][0]["weight"], np.array(grasp["loads"][0]["com"])

best = np.array(poise("best")["best"]["up"])
axis = np.array([0, 0, 1])
across = best - (best @ axis) * axis
across /= np.linalg.norm(across)
for turn in np.linspace(0, 2 * np.pi, 361):
    u = np.sin(turn) * across + np.cos(turn) * axis
    print(radius(u) * np.sin(turn), radius(u) * np.cos(turn))

print("\n")
print(radius(best) * (best @ across), radius(best) * (best @ axis))

for holds in counts:
    polygon = [np.array(p, float) for p in [(-9, -9), (9, -9), (9, 9), (-9, 9)]]
    for cut in poise("best", "--max-holds", holds)["cuts"]:
        y = np.array(cut["y"])
        v = y[:3] + np.cross(y[3:], com)
        a, b = np.array([v @ across, v @ axis]), norm_of_response(y)
        kept = []
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            out_p, out_q = a @ p - b, a @ q - b
            kept += [p] if out_p <= 0 else []
            kept += [p + (q - p) * out_p / (out_p - out_q)] if out_p * out_q < 0 else []
        polygon = kept
    print("\n")
    for p in polygon + polygon[:1]:
        print(*p)
