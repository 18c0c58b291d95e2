"""How hard must the fingers press, as the part is held now?"""

import poise

# An L-shaped part of 0.13 kg, its upright leg between two fingers. Metres, newtons.
part = poise.Load(weight=0.13 * poise.standard_gravity, com=[0.02, 0.03])
left = poise.Contact(position=[0, 0.045], normal=[1, 0], friction=0.6, finger="left")
right = poise.Contact(position=[0.02, 0.045], normal=[-1, 0], friction=0.6, finger="right")
grasp = poise.Grasp(part, [left, right])

# The posture: which direction of the part points up, when it is turned clockwise by 0.2 rad.
hold = poise.hold(grasp, poise.up_at(-0.2))
print(
    f"grip {poise.grip(grasp, hold):.3f} N, "
    f"effort {hold.effort:.2f} N^2, at least {hold.lower_bound:.2f} N^2"
)
for contact, force in zip(grasp.contacts, hold.forces):
    print(
        f"{contact.finger}: normal {force.normal:.3f} N, "
        f"tangential {force.tangential:.3f} N, {force.state.value}"
    )
