"""What can a gripper hold? A block between two jaws, of which the left presses with at most 25 N."""

import poise

left = poise.Contact([-0.03, 0], [1, 0], friction=0.4, max_normal=25, finger="left")
right = poise.Contact([0.03, 0], [-1, 0], friction=0.6, finger="right")
grasp = poise.Grasp(poise.Load(weight=10), [left, right])
up = poise.up_at(0)

capacity = poise.capacity(grasp, up, safety=1.5)
print(f"greatest weight {capacity.weights.greatest.weight:.3f} N")
print(f"greatest safety on the friction {1 / capacity.friction.factor:.3f}")
print(f"grip to command {capacity.safe.grip:.3f} N")

# What would help? What one more newton of a jaw brings, as the proof says.
decide = poise.deciding(grasp, up, capacity.weights.greatest.dual)
for contact, own in zip(grasp.contacts, decide):
    print(f"{contact.finger}: {own.per_newton:.3f} N more for each newton")
