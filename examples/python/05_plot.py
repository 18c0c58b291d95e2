"""A grasp file, its best posture, and a picture of its posture curve: 05_plot.py FILE PNG"""

import sys

import matplotlib

import poise

matplotlib.use("Agg")  # no display is needed

file = poise.load(sys.argv[1])
answer = poise.best_posture(file.grasp(), domain=file.domain)
print(f"{file.name}: {answer.best}")

axes = poise.plot(answer.curve)
axes.set_title(file.name)
axes.figure.savefig(sys.argv[2])
