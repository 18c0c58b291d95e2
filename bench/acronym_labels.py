"""How far shaking predicts a simulated outcome: acronym_labels.py FILE MESH_ROOT [--max-force N]

FILE is a grasp file of the ACRONYM data set, MESH_ROOT the folder that has its meshes/. For each of
its grasps the hand is closed on the object where both are, and poise.shake() says which
accelerations are withstood, with the weight and the friction of the file and at most N newtons of
the hand. The label is what the simulation of the data set saw: whether the object was still held
after shaking. With python3-h5py it is also told how far the object moved while the hand closed.
"""

import argparse

import numpy as np
import poise

try:
    import h5py
except ImportError:
    h5py = None

UP = [0, 0, 1]  # the data set names no posture; 0.1 N of weight are little against the hand's force


def answer(data, n, most_grip):
    """What is withstood [m/s^2], 0 where nothing is held, and how far apart the fingers are [m]."""
    try:
        file = data.grasp(n)
    except poise.FileError:  # the hand misses the object
        return 0.0, np.nan
    one, other = file.contacts
    along = np.asarray(file.fingers[one.finger]["closing"])
    apart = abs(along @ (one.position - other.position)) / np.linalg.norm(along)
    return poise.shake(file.grasp(), UP, gap=1e-2, most_grip=most_grip).acceleration, apart


def area(scores, held):
    """Under the ROC curve: how often what held has a greater score than what did not."""
    values, ranks = np.unique(scores, return_inverse=True)
    good = np.bincount(ranks[held], minlength=len(values))
    bad = np.bincount(ranks[~held], minlength=len(values))
    return good @ (np.cumsum(bad) - bad / 2) / (good.sum() * bad.sum())


def wrong(called, held):
    """The share of what held that is not called so, and of what was lost that is."""
    return np.mean(~called[held]), np.mean(called[~held])


def show_wrong(words, called, held):
    missed, trusted = wrong(called, held)
    print(
        f"called safe if {words}: misses {missed:.1%} of what held, "
        f"has {trusted:.1%} of what was lost"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("file")
    parser.add_argument("mesh_root")
    parser.add_argument("--max-force", type=float, default=70, help="of the hand [N]: 70")
    options = parser.parse_args()

    data = poise.Acronym(options.file, options.mesh_root)
    held = np.array([data.held(n) for n in range(len(data))])
    answers = [answer(data, n, options.max_force) for n in range(len(data))]
    shakes, apart = map(np.array, zip(*answers))
    print(f"{len(data)} grasps: {held.sum()} held in the simulation, ", end="")
    print(f"{np.sum(shakes > 0)} by shake()")
    print(f"area under the ROC curve {area(shakes, held):.3f}")
    show_wrong("held at all", shakes > 0, held)
    even = np.arange(len(data)) % 2 == 0  # a threshold is not tried where it was found
    best = min(
        np.append(np.unique(shakes), np.inf),
        key=lambda least: sum(wrong(shakes[even] >= least, held[even])),
    )
    show_wrong(f"{best:.0f} m/s^2 are withstood", shakes[~even] >= best, held[~even])

    moved = None
    if h5py is not None:
        with h5py.File(options.file) as file:
            moved = file["grasps/qualities/flex/object_motion_during_closing_linear"][()]
    print("fingers apart  grasps  held  by shake()  area", end="")
    print("  moved in closing: held  lost  area of that" if h5py else "")
    for least, most in [(0, 20), (20, 70), (70, 82)]:
        part = (1e3 * apart >= least) & (1e3 * apart < most)
        if not part.any() or held[part].all() or not held[part].any():
            continue
        print(
            f"{least:2} to {most} mm    {part.sum():6} {held[part].mean():5.0%} "
            f"{np.mean(shakes[part] > 0):11.0%} {area(shakes[part], held[part]):5.2f}",
            end="" if h5py else "\n",
        )
        if h5py:
            medians = [1e3 * np.median(moved[part & which]) for which in (held, ~held)]
            print("{:21.0f} mm {:2.0f} mm".format(*medians), end="")
            print(f" {area(-moved[part], held[part]):13.2f}")
    if h5py:
        for words, which in [("", shakes > 0), ("not ", shakes == 0)]:
            median = 1e3 * np.median(moved[held & which])
            print(f"held, and {words}by shake(): moved by {median:.0f} mm in closing")


main()
