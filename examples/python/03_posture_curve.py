"""The least effort over all postures: a formula on each arc."""

from math import cos, degrees, radians, sin

import poise

# A disk between two fingers, 75 degrees to either side of its top, one of them slippery.
x, y = sin(radians(75)), cos(radians(75))
right = poise.Contact(position=[x, y], normal=[-x, -y], friction=1)
left = poise.Contact(position=[-x, y], normal=[x, -y], friction=0.5773503)
grasp = poise.Grasp(poise.Load(weight=10), [right, left])

curve = poise.posture_curve(grasp)
for held in curve.holdable:
    print(f"can be held from {degrees(held.from_):.2f} to {degrees(held.to):.2f} degrees")
for arc in curve.arcs:
    print(
        f"{degrees(arc.from_):7.2f} to {degrees(arc.to):7.2f}: "
        f"V = {arc.value.c0:.2f} {arc.value.cos2:+.2f} cos 2t {arc.value.sin2:+.2f} sin 2t"
    )
for optimum in curve.optima:
    print(
        f"{'maximum' if optimum.maximum else 'minimum'} at {degrees(optimum.angle):.2f}: "
        f"V = {optimum.value:.2f}, {optimum.kind.value}"
    )
