"""A part between the soft jaws of a gripper, which may carry a tool: how to turn the wrist?"""

import math

import poise

left = poise.Contact([-0.01, 0.03, 0], [0, -1, 0], friction=0.5, finger="left", torsion=0.004)
right = poise.Contact([-0.01, -0.03, 0], [0, 1, 0], friction=0.5, finger="right", torsion=0.004)
bare = poise.Load(weight=8, com=[0.005, 0.002, 0])
with_tool = poise.Load(weight=11, com=[0.03, 0.002, 0])
grasp = poise.Grasp([bare, with_tool], [left, right])

now = [0, 0, 1]
print(f"now: grip {poise.grip(grasp, poise.hold(grasp, now)):.3f} N")

# The posture whose worst load needs least, by at most 60 degrees from the present one.
tilt = poise.Tilt(now, math.radians(60))
answer = poise.best_posture(grasp, gap=1e-4, tilt=tilt)
print(f"{answer.status.value}, proven to {1e-4:.0e} of the effort")
for effort in answer.best.load_efforts:
    print(f"force norm {math.sqrt(effort):.3f} N")
print(
    f"best: grip {poise.grip(grasp, answer.best.hold):.3f} N, "
    f"{answer.best.manner.value}"
)

turn = poise.smallest_turn([1, 0, 0, 0], answer.best.up)
print(f"turn by {math.degrees(2 * math.acos(turn[0])):.1f} degrees")
