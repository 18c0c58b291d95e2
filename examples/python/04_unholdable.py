"""What cannot be held is an answer, too: with the reason, and a proof to be checked by hand."""

import numpy as np

import poise

# A cube of 1 kg between two slippery fingers that are not opposite to each other.
cube = poise.Load(weight=9.80665, com=[0, 0])
left = poise.Contact(position=[-0.05, 0.02], normal=[1, 0], friction=0.1)
right = poise.Contact(position=[0.05, -0.02], normal=[-1, 0], friction=0.1)
grasp = poise.Grasp(cube, [left, right])

up = poise.up_at(0)
hold = poise.hold(grasp, up)
print("can be held" if hold.holdable else "cannot be held")
print(poise.reason(grasp, hold))

# The proof is a motion y on which gravity works, and along which no finger can push back.
y = hold.dual
print("the weight drives it:", "yes" if y @ grasp.load(up) > 0 else "no")
z = poise.grasp_matrix(grasp).T @ y  # normal, tangential, ...
friction = np.array([contact.friction for contact in grasp.contacts])
most = np.max(z[0::2] + friction * np.abs(z[1::2]))
print("a finger opposes it:", "yes" if most > 1e-9 * np.linalg.norm(z) else "no")
