"""How should the part be turned, so that the fingers press least?"""

import math

import poise

part = poise.Load(weight=0.13 * poise.standard_gravity, com=[0.02, 0.03])
left = poise.Contact(position=[0, 0.045], normal=[1, 0], friction=0.6)
right = poise.Contact(position=[0.02, 0.045], normal=[-1, 0], friction=0.6)
grasp = poise.Grasp(part, [left, right])

answer = poise.best_posture(grasp)
for what, posture in [
    ("best", answer.best),
    ("best pinched", answer.best_pinched),
    ("worst", answer.worst),
]:
    print(
        f"{what}: turned by {math.degrees(posture.optimum.angle):.2f} degrees, "
        f"{posture.manner.value}: grip {poise.grip(grasp, posture.hold):.3f} N"
    )
