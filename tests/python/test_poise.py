"""The module against the program, against laws, and against misuse."""

import json
import math
import os
import pickle
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import poise

ROOT = Path(__file__).parents[2]
PROGRAM = os.environ["POISE_PROGRAM"]
ACRONYM = Path(os.environ.get("POISE_DATA", "/nowhere"), "acronym")


def disk(mu1=1.0, mu2=1 / math.sqrt(3), phi=math.radians(75), weight=10.0):
    """The paper's disk between two fingers."""
    x, y = math.sin(phi), math.cos(phi)
    right = poise.Contact([x, y], [-x, -y], mu1, finger="right")
    left = poise.Contact([-x, y], [x, -y], mu2, finger="left")
    return poise.Grasp(poise.Load(weight), [right, left])


def random_grasp(rng, contacts):
    """Contacts on an ellipse, pressing inwards."""
    a, b = rng.uniform(0.5, 2, 2)
    phi = rng.uniform(0, 2 * np.pi, contacts)
    return poise.Grasp(
        poise.Load(rng.uniform(1, 10), rng.uniform(-0.2, 0.2, 2)),
        [
            poise.Contact(
                [a * np.cos(t), b * np.sin(t)],
                [-np.cos(t) / a, -np.sin(t) / b],
                friction=rng.uniform(0.1, 1.5),
                share=rng.uniform(0.5, 1),
            )
            for t in phi
        ],
    )


def random_spatial_grasp(rng, contacts):
    """Contacts on an ellipsoid, pressing inwards, every other one soft."""
    radii = rng.uniform(0.5, 2, 3)
    on_sphere = rng.normal(size=(contacts, 3))
    on_sphere /= np.linalg.norm(on_sphere, axis=1)[:, None]
    return poise.Grasp(
        poise.Load(rng.uniform(1, 10), rng.uniform(-0.2, 0.2, 3)),
        [
            poise.Contact(
                radii * u,
                -u / radii,
                friction=rng.uniform(0.2, 1.2),
                share=rng.uniform(0.5, 1),
                torsion=rng.uniform(0.05, 0.2) * (k % 2),
            )
            for k, u in enumerate(on_sphere)
        ],
    )


def random_loads(rng, count):
    """Weights in space that are accelerated while something else acts."""
    return [
        poise.Load(
            rng.uniform(1, 5),
            rng.uniform(-0.2, 0.2, 3),
            fixed=rng.uniform(-0.3, 0.3, 6),
            lift=rng.uniform(-2, 2),
            acceleration=rng.uniform(-1, 1, 3),
            name=f"load {k}",
        )
        for k in range(count)
    ]


def answer(*arguments):
    """The JSON document that the program prints."""
    run = subprocess.run([PROGRAM, *arguments, "--json"], stdout=subprocess.PIPE, check=False)
    return json.loads(run.stdout)


class AgainstTheProgram(unittest.TestCase):
    def check_optimum(self, grasp, posture, expected):
        hold = posture.hold
        self.assertEqual(hold.effort, expected["effort"])
        self.assertEqual(hold.lower_bound, expected["lower_bound"])
        self.assertEqual(hold.dual.tolist(), expected.get("dual", expected.get("y")))
        self.assertAlmostEqual(
            math.degrees(posture.optimum.angle), expected["angle_deg"], delta=1e-12 * 180
        )
        self.assertEqual(posture.manner.value, expected["manner"])
        self.assertEqual(posture.optimum.kind.value, expected["kind"])
        self.assertEqual(poise.grip(grasp, hold), expected["grip"])
        for force, contact in zip(hold.forces, expected["contacts"]):
            self.assertEqual(force.normal, contact["normal_force"])
            self.assertEqual(force.tangential, contact["tangential_force"])
            self.assertEqual(force.friction_used, contact["friction_used"])
            self.assertEqual(force.state.value, contact["state"])
            self.assertEqual(force.limit.value, contact["limit"])
        for finger, shown in zip(poise.finger_forces(grasp, hold), expected["fingers"]):
            self.assertEqual(finger.normal, shown["normal_force"])
            self.assertEqual(finger.force.tolist(), shown["force"])

    def check_best(self, file):
        for objective in poise.Objective.effort, poise.Objective.grip:
            self.check_best_for(file, objective)

    def check_best_for(self, file, objective):
        read = poise.load(file)
        grasp = read.grasp()
        best = poise.best_posture(grasp, domain=read.domain, objective=objective)
        expected = answer("best", file, "--objective", objective.value)
        self.assertEqual(len(best.minima), len(expected["minima"]))
        for posture, minimum in zip(best.minima, expected["minima"]):
            self.check_optimum(grasp, posture, minimum)
        if best.holdable:
            self.check_optimum(grasp, best.best, expected["best"])
            self.check_optimum(grasp, best.worst, expected["worst"])
            self.assertEqual(best.lower_bound, expected["lower_bound"])
        for arc, shown in zip(best.curve.arcs, expected["arcs"]):
            for name, value in shown.get("V", shown.get("F")).items():
                self.assertEqual(getattr(arc.value, name), value)
        self.assertEqual(len(best.curve.arcs), len(expected["arcs"]))

    def test_examples(self):
        for file in sorted((ROOT / "examples").glob("*.yaml")):
            if poise_dimension(file) == 2:
                with self.subTest(file.name):
                    self.check_best(file)

    def check_force(self, contact, force, expected):
        self.assertEqual(force.normal, expected["normal_force"])
        tangential = np.linalg.norm(force.tangential)
        self.assertAlmostEqual(tangential, expected["tangential_force"], delta=1e-14 * tangential)
        self.assertEqual(force.torsion_moment, expected.get("torsion_moment", 0))
        self.assertEqual("torsion_moment" in expected, contact.torsion > 0)
        self.assertEqual(force.friction_used, expected["friction_used"])
        self.assertEqual(force.state.value, expected["state"])
        self.assertEqual(force.limit.value, expected["limit"])

    def check_spatial(self, grasp, posture, expected):
        hold = posture.hold
        self.assertEqual(posture.up.tolist(), expected["up"])
        self.assertEqual(hold.effort, expected["effort"])
        self.assertEqual(hold.lower_bound, expected["lower_bound"])
        self.assertEqual(hold.dual.tolist(), expected.get("dual", expected.get("y")))
        self.assertEqual(posture.manner.value, expected["manner"])
        self.assertEqual(poise.grip(grasp, hold), expected["grip"])
        self.check_loads(posture, expected)
        for contact, force, shown in zip(grasp.contacts, hold.forces, expected["contacts"]):
            self.check_force(contact, force, shown)
        for finger, shown in zip(poise.finger_forces(grasp, hold), expected["fingers"]):
            self.assertEqual(finger.normal, shown["normal_force"])
            self.assertEqual(finger.force.tolist(), shown["force"])

    def check_loads(self, posture, expected):
        """Those of the document, which tells of them where there are several."""
        self.assertEqual(posture.load, expected.get("load", 0))
        self.assertEqual(repr(posture.hold), repr(posture.holds[posture.load]))
        if "load" not in expected:
            self.assertEqual(len(posture.holds), 1)
            return
        for name in ["load_efforts", "load_grips"]:
            if name in expected:
                told = [math.inf if each is None else each for each in expected[name]]
                self.assertEqual(getattr(posture, name), told)
        self.assertEqual(posture.load_grips is None, "load_grips" not in expected)
        for k, shown in enumerate(expected["load_holds"]):
            if shown is not None:
                self.assertEqual(posture.holds[k].lower_bound, shown["lower_bound"])
                self.assertEqual(posture.load_efforts[k], shown["effort"])

    def check_best_in_space(self, file, gap):
        for objective in poise.Objective.effort, poise.Objective.grip:
            self.check_best_in_space_for(file, gap, objective)

    def check_best_in_space_for(self, file, gap, objective):
        read = poise.load(file)
        grasp = read.grasp()
        by_pads = any(contact.pad is not None for contact in read.contacts)
        by_limits = any(drive["max"] is not None for drive in answer("hold", file).get("drives", []))
        # The program looks for other minima of the effort alone, without pads or limits of drives.
        alone = objective == poise.Objective.effort and not by_pads and not by_limits
        more = {} if alone else {"starts": 0}
        best = poise.best_posture(grasp, tilt=read.tilt, gap=gap, objective=objective, **more)
        expected = answer("best", file, "--gap", str(gap), "--objective", objective.value)
        self.assertEqual(best.status.value, expected["status"])
        if by_pads:  # symmetric: rounding decides which of two mirror images comes first
            value = "grip" if objective == poise.Objective.grip else "effort"
            found = getattr(best.best.hold, value)
            self.assertAlmostEqual(expected["best"][value], found, delta=2 * gap * found)
            return
        self.assertEqual(best.holds, expected["holds"])
        self.assertEqual(len(best.cuts), len(expected["cuts"]))
        for cut, shown in zip(best.cuts, expected["cuts"]):
            if "n" in shown:
                self.assertEqual(cut.n.tolist(), shown["n"])
            else:
                self.assertEqual((cut.y.tolist(), cut.n), (shown["y"], None))
                self.assertEqual(cut.load, shown["load"])
        # The program knows the present posture, and names of ties the least turn from it.
        first = expected["minima"][:1]
        if first and first[0]["up"] != best.minima[0].up.tolist():
            self.assertIsNotNone(read.up)
            value = "grip" if objective == poise.Objective.grip else "effort"
            self.assertAlmostEqual(first[0][value] / getattr(best.best.hold, value), 1, delta=2e-6)
            return
        self.assertEqual(len(best.minima), len(expected["minima"]))
        for posture, minimum in zip(best.minima, expected["minima"]):
            self.check_spatial(grasp, posture, minimum)
        if expected["best"] is None:
            self.assertIsNone(best.best)
            return
        self.check_spatial(grasp, best.best, expected["best"])
        self.assertEqual(best.lower_bound, expected["lower_bound"])
        self.assertEqual(best.relative_gap, expected["relative_gap"])
        self.assertEqual(best.best_pinched is None, expected["best_pinched"] is None)
        if read.up is None:
            shown = expected["turn"]["rotation"]
            turn = poise.smallest_turn([1, 0, 0, 0], best.best.up)
            np.testing.assert_allclose(turn, [shown[key] for key in "wxyz"], rtol=1e-14)

    def test_examples_in_space(self):
        for file in sorted((ROOT / "examples").glob("*.yaml")):
            if poise_dimension(file) == 3:
                with self.subTest(file.name):
                    self.check_best_in_space(file, 1e-3)

    def test_random_grasps_in_space(self):
        rng = np.random.default_rng(11)
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for contacts in [1, 2, 3, 4, 6]:
                grasp = random_spatial_grasp(rng, contacts)
                poise.save(grasp, file)
                self.check_best_in_space(file, 1e-3)
                up = rng.normal(size=3)
                where = ",".join(map(str, up))
                expected = answer("hold", file, "--up", where, "--objective", "effort")
                hold = poise.hold(grasp, up)
                self.assertEqual(hold.holdable, expected["holdable"])
                self.assertAlmostEqual(hold.lower_bound / expected["lower_bound"], 1, delta=1e-9)
                self.assertEqual(poise.force_closure(grasp), answer("check", file)["force_closure"])

    def test_random_loads(self):
        rng = np.random.default_rng(53)
        held = 0
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for count in [1, 2, 3]:
                contacts = random_spatial_grasp(rng, 5).contacts
                poise.save(poise.Grasp(random_loads(rng, count), contacts), file)
                grasp = poise.load(file).grasp()  # normals may be normalised once more
                for load, shown in zip(grasp.loads, answer("check", file)["loads"], strict=True):
                    self.assertEqual((load.name, load.weight), (shown["name"], shown["weight"]))
                    self.assertEqual((load.com.tolist(), load.lift), (shown["com"], shown["lift"]))
                    self.assertEqual(load.acceleration.tolist(), shown["acceleration"])
                    self.assertEqual(load.fixed.tolist(), shown["fixed"])
                self.check_best_in_space(file, 1e-2)
                for objective in poise.Objective:
                    for up in [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]:
                        where = ["--up", ",".join(map(str, up)), "--objective", objective.value]
                        expected = answer("hold", file, *where)
                        posture = poise.posture_at(grasp, up, objective=objective)
                        self.assertEqual(posture.holdable, expected["holdable"])
                        self.check_loads(posture, expected)
                        hold = poise.hold(grasp, up, objective=objective)
                        self.assertEqual(hold.holdable, posture.holdable)
                        self.assertTrue(poise.verify(grasp, expected))
                        if not posture.holdable:
                            continue
                        held += 1
                        self.assertEqual(hold.effort, expected["effort"])
                        manner = poise.manner(grasp, up, hold, load=posture.load)
                        self.assertEqual(manner.value, expected["manner"])
                        for k, each in enumerate(posture.holds):
                            self.assertTrue(poise.verify(grasp, each, up, load=k))
                            other = poise.verify(grasp, each, up, load=(k + 1) % count)
                            self.assertFalse(other and count > 1)
        self.assertGreater(held, 5)

    def test_random_grasps(self):
        rng = np.random.default_rng(7)
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for contacts in [1, 2, 2, 2, 3, 3, 4, 5, 8]:
                poise.save(random_grasp(rng, contacts), file)
                self.check_best(file)

    def test_check(self):
        file = ROOT / "examples" / "l-part.yaml"
        grasp = poise.load(file).grasp()
        expected = answer("check", file)
        (load,), (shown,) = grasp.loads, expected["loads"]
        self.assertEqual(load.weight, shown["weight"])
        self.assertEqual(load.com.tolist(), shown["com"])
        self.assertEqual(poise.force_closure(grasp), expected["force_closure"])
        wedge = poise.fork_wedge(grasp)
        np.testing.assert_allclose(np.degrees([wedge.from_, wedge.to]), expected["fork_deg"])
        for contact, shown in zip(grasp.contacts, expected["contacts"]):
            self.assertEqual(contact.finger, shown["finger"])
            self.assertEqual(contact.position.tolist(), shown["position"])
            self.assertEqual(contact.normal.tolist(), shown["normal"])
            self.assertEqual(contact.friction, shown["friction"])


def poise_dimension(file):
    return 3 if "dimension: 3" in file.read_text(encoding="utf-8") else 2


class Paper(unittest.TestCase):
    """The paper's disk: phi, mu, and where and what its minimum b is."""

    def test_efforts(self):
        third, low = math.pi / 3, 1 / math.sqrt(3)
        rows = [
            (third, math.sqrt(3), math.sqrt(3), 0, 200),
            (third, 1, 1, 0, 746.4102),
            (5 * math.pi / 12, 1, 1, 0, 200),
            (math.pi / 4, 1.01, 1.01, 0, 2020100),
            (5 * math.pi / 12, 1, low, 30, 300),
        ]
        for phi, mu1, mu2, degrees, effort in rows:
            grasp = disk(mu1, mu2, phi)
            best = poise.best_posture(grasp, domain=poise.Domain.pinching_up)
            efforts = {
                round(math.degrees(posture.optimum.angle), 6): posture.hold.effort
                for posture in best.minima
            }
            self.assertAlmostEqual(efforts[degrees] / effort, 1, delta=1e-6)
            self.assertAlmostEqual(best.best.hold.effort / 100, 1, delta=1e-9)


class Holding(unittest.TestCase):
    def test_forces_balance_the_load_in_their_cones(self):
        rng = np.random.default_rng(1)
        held = 0
        for contacts in [2, 3, 4, 20]:
            for _ in range(20):
                grasp = random_grasp(rng, contacts)
                up = rng.normal(size=2)
                hold = poise.hold(grasp, up)
                if not hold.holdable:
                    self.assertEqual(hold.forces, [])
                    self.assertTrue(poise.reason(grasp, hold))
                    continue
                held += 1
                f = np.array([[force.normal, force.tangential] for force in hold.forces])
                share = np.array([contact.share for contact in grasp.contacts])
                mu = np.array([contact.friction for contact in grasp.contacts])
                load = grasp.load(up)
                self.assertAlmostEqual(np.linalg.norm(load[:2]), grasp.loads[0].weight)
                np.testing.assert_allclose(
                    poise.grasp_matrix(grasp) @ f.ravel(), load, atol=1e-9 * grasp.loads[0].weight
                )
                self.assertAlmostEqual(np.sum(f**2 / share[:, None]) / hold.effort, 1)
                self.assertAlmostEqual(hold.lower_bound / hold.effort, 1)
                self.assertTrue(np.all(np.abs(f[:, 1]) <= mu * f[:, 0] * (1 + 1e-9) + 1e-12))
                again = poise.hold(grasp, load, hold.dual)
                self.assertAlmostEqual(again.effort / hold.effort, 1, delta=1e-9)
        self.assertGreater(held, 30)

    def test_forces_in_space_balance_the_load_in_their_cones(self):
        rng = np.random.default_rng(4)
        held = 0
        for contacts in [2, 3, 4, 8, 20]:
            for _ in range(10):
                grasp = random_spatial_grasp(rng, contacts)
                up = rng.normal(size=3)
                hold = poise.hold(grasp, up)
                self.assertEqual(grasp.dimension, 3)
                self.assertEqual(hold.dual.shape, (6,))
                if not hold.holdable:
                    self.assertEqual(hold.forces, [])
                    self.assertTrue(poise.reason(grasp, hold))
                    continue
                held += 1
                wrench, squares = np.zeros(6), 0
                for contact, force in zip(grasp.contacts, hold.forces):
                    n, t = contact.normal, force.tangential
                    self.assertAlmostEqual(n @ t, 0, delta=1e-12 * grasp.loads[0].weight)
                    total = force.normal * n + t
                    moment = force.torsion_moment
                    wrench += np.concatenate([total, np.cross(contact.position, total) + moment * n])
                    soft = contact.friction / contact.torsion if contact.torsion else 0
                    used = np.hypot(np.linalg.norm(t), moment * soft)
                    most = contact.friction * force.normal
                    self.assertLessEqual(used, most * (1 + 1e-9) + 1e-12)
                    squares += (force.normal**2 + used**2) / contact.share
                np.testing.assert_allclose(
                    wrench, grasp.load(up), atol=1e-9 * grasp.loads[0].weight * (1 + grasp.radius)
                )
                self.assertAlmostEqual(squares / hold.effort, 1)
                self.assertAlmostEqual(hold.lower_bound / hold.effort, 1)
                again = poise.hold(grasp, grasp.load(up), hold.dual)
                self.assertAlmostEqual(again.effort / hold.effort, 1, delta=1e-9)
        self.assertGreater(held, 15)

    def test_grasp_matrix_in_space(self):
        grasp = random_spatial_grasp(np.random.default_rng(6), 3)
        G = poise.grasp_matrix(grasp)
        self.assertEqual(G.shape, (6, 12))
        for k, contact in enumerate(grasp.contacts):
            a, b = poise.tangents(contact.normal).T
            np.testing.assert_allclose(np.cross(contact.normal, a), b, atol=1e-15)
            for column, axis in zip(G.T[4 * k :], (contact.normal, a, b)):
                np.testing.assert_allclose(
                    column, np.concatenate([axis, np.cross(contact.position, axis)]), atol=1e-15
                )
            np.testing.assert_allclose(G[3:, 4 * k + 3], contact.normal, atol=1e-15)

    def test_many_in_space_is_each_in_order(self):
        grasp = random_spatial_grasp(np.random.default_rng(8), 4)
        ups = np.random.default_rng(9).normal(size=(500, 3))
        holds = poise.hold_many(grasp, ups)
        each = [poise.hold(grasp, up) for up in ups]
        self.assertEqual([hold.effort for hold in holds], [hold.effort for hold in each])
        self.assertEqual(holds.holdable.tolist(), [hold.holdable for hold in each])
        self.assertEqual(holds.tangential.shape, (500, 4, 3))
        for k in np.flatnonzero(holds.holdable)[:20].tolist():
            forces = holds[k].forces
            self.assertEqual(holds.normal[k].tolist(), [force.normal for force in forces])
            self.assertEqual(
                holds.tangential[k].tolist(), [force.tangential.tolist() for force in forces]
            )
            self.assertEqual(
                holds.torsion_moment[k].tolist(), [force.torsion_moment for force in forces]
            )

    def test_many_is_each_in_order(self):
        grasp = disk()
        angles = np.linspace(-math.pi, math.pi, 1001)
        ups = np.column_stack([np.sin(angles), np.cos(angles)])
        holds = poise.hold_many(grasp, ups)
        each = [poise.hold(grasp, up) for up in ups]
        self.assertEqual(len(holds), len(each))
        self.assertEqual([hold.effort for hold in holds], [hold.effort for hold in each])
        self.assertEqual(holds.effort.tolist(), [hold.effort for hold in each])
        self.assertEqual(holds.lower_bound.tolist(), [hold.lower_bound for hold in each])
        self.assertTrue(holds.holdable.all())
        for k in (0, 500, -1):
            self.assertEqual(
                holds.normal[k].tolist(), [force.normal for force in holds[k].forces]
            )
            self.assertEqual(
                holds.tangential[k].tolist(), [force.tangential for force in holds[k].forces]
            )
        with self.assertRaises(IndexError):
            holds[1001]
        self.assertEqual(len(poise.hold_many(grasp, np.zeros((0, 2)))), 0)

    def test_many_unholdable(self):
        slippery = disk(0.1, 0.1)
        holds = poise.hold_many(slippery, [[0, 1], [0, -1]])
        self.assertEqual(holds.holdable.tolist(), [False, True])
        self.assertEqual(holds.effort[0], math.inf)
        self.assertEqual(holds.normal[0].tolist(), [0, 0])

    def test_force_cap(self):
        grasp = disk()
        norm = math.sqrt(poise.hold(grasp, [0, 1]).effort) / grasp.loads[0].weight
        self.assertTrue(poise.hold(grasp, [0, 1], force_cap=norm * 1.01).holdable)
        self.assertFalse(poise.hold(grasp, [0, 1], force_cap=norm / 1.01).holdable)

    def check_that_others_run_meanwhile(self, work):
        done = []
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1e6)  # a thread that does not let go runs to its end
        try:
            worker = threading.Thread(target=lambda: (work(), done.append(True)))
            worker.start()
            finished_first = bool(done)
            worker.join()
        finally:
            sys.setswitchinterval(interval)
        self.assertFalse(finished_first)

    def test_other_threads_run_meanwhile(self):
        grasp = random_grasp(np.random.default_rng(2), 30)
        ups = np.random.default_rng(3).normal(size=(100_000, 2))
        self.check_that_others_run_meanwhile(lambda: poise.hold_many(grasp, ups))

    def test_forces_of_another_grasp(self):
        hold = poise.hold(random_grasp(np.random.default_rng(1), 20), [0, 1])
        with self.assertRaises(poise.InvalidGrasp):
            poise.grip(disk(), hold)


class Loads(unittest.TestCase):
    """What acts on the object besides its weight."""

    def test_the_wrench_is_that_of_the_forces(self):
        rng = np.random.default_rng(59)
        contacts = random_spatial_grasp(rng, 3).contacts
        loads = random_loads(rng, 2)
        grasp = poise.Grasp(loads, contacts)
        up = rng.normal(size=3)
        up /= np.linalg.norm(up)
        for k, load in enumerate(loads):
            mass = load.weight / poise.standard_gravity
            force = mass * ((poise.standard_gravity + load.lift) * up + load.acceleration)
            wrench = np.append(force, np.cross(load.com, force)) + load.fixed
            np.testing.assert_allclose(grasp.load(up, k), wrench, rtol=1e-12)
            alone = poise.Grasp(load, contacts)
            self.assertEqual(alone.load(up).tolist(), grasp.load(up, load=k).tolist())

    def test_wrenches(self):
        self.assertEqual(poise.wrench_of([2, 3], [5, 7]).tolist(), [2, 3, 5 * 3 - 7 * 2])
        wrench = poise.wrench_of([1, 2, 3], [4, 5, 6])
        self.assertEqual(wrench.tolist(), [1, 2, 3, *np.cross([4, 5, 6], [1, 2, 3])])

    def jaws(self, load):
        """Across them two jaws, 60 mm from each other, hold a force F with F / (2 mu)."""
        left = poise.Contact((-0.03, 0, 0), (1, 0, 0), friction=0.4, torsion=0.01)
        right = poise.Contact((0.03, 0, 0), (-1, 0, 0), friction=0.4, torsion=0.01)
        return poise.Grasp(load, [left, right])

    def test_jaws_in_closed_form(self):
        g, origin = poise.standard_gravity, (0, 0, 0)
        pushed = -poise.wrench_of([0, 0, -3], origin)  # a tool pushes it down by 3 N
        for load, force in [
            (poise.Load(8, origin), 8),
            (poise.Load(8, origin, lift=2), 8 * (1 + 2 / g)),
            (poise.Load(8, origin, acceleration=[0, 5, 0]), math.hypot(8, 8 * 5 / g)),
            (poise.Load(8, origin, fixed=pushed), 8 + 3),
            (poise.Load(0, origin, fixed=pushed), 3),
            ([poise.Load(8, origin), poise.Load(0, origin, fixed=3 * pushed)], 9),
        ]:
            grip = poise.least_grip(self.jaws(load), (0, 0, 1)).grip
            self.assertAlmostEqual(grip / (force / (2 * 0.4)), 1, delta=1e-6)

    def test_the_best_posture_is_for_all_of_them(self):
        file = poise.load(ROOT / "examples" / "bottle.yaml")
        self.assertEqual([load.name for load in file.loads], ["full", "nearly empty"])
        grasp = file.grasp()
        best = poise.best_posture(grasp).best
        alone = [poise.Grasp(load, file.contacts) for load in file.loads]
        efforts = [poise.hold(each, best.up).effort for each in alone]
        np.testing.assert_allclose(best.load_efforts, efforts, rtol=1e-9)
        self.assertEqual(best.load, int(np.argmax(efforts)))
        self.assertAlmostEqual(poise.hold(grasp, best.up).effort / max(efforts), 1, delta=1e-9)
        # Each by itself would be held with less in another posture.
        for each in alone:
            self.assertLess(poise.best_posture(each).lower_bound, 0.99 * best.effort)

    def test_what_capacity_says_of_each(self):
        rng = np.random.default_rng(61)
        contacts = random_spatial_grasp(rng, 5).contacts
        for contact in contacts:
            contact.max_normal = 20.0
        loads = [poise.Load(1, [0, 0, z]) for z in (0, 0.1)]
        grasp = poise.Grasp(loads, contacts)
        for k, load in enumerate(loads):
            one, up = poise.Grasp(load, contacts), [0, 0, 1]
            least = [poise.least_friction(one, up), poise.least_friction(grasp, up, load=k)]
            self.assertAlmostEqual(least[0].factor / least[1].factor, 1, delta=1e-6)
            most = [poise.weight_range(one, up), poise.weight_range(grasp, up, load=k)]
            weights = [each.greatest.weight for each in most]
            self.assertAlmostEqual(weights[0] / weights[1], 1, delta=1e-6)

    def check_round_trip(self, loads, contacts):
        grasp = poise.Grasp(loads, contacts)
        for again in [
            pickle.loads(pickle.dumps(grasp)),
            poise.from_dict(poise.to_dict(grasp)).grasp(),
            poise.from_dict(poise.to_dict(poise.GraspFile(loads, contacts))).grasp(),
        ]:
            self.assertEqual(repr(again.loads), repr(loads))

    def test_round_trips(self):
        plane = [poise.Contact([1, 0], [-1, 0], 0.5), poise.Contact([-1, 0], [1, 0], 0.5)]
        self.check_round_trip([poise.Load(3.5, [0.1, 0.2])], plane)
        self.check_round_trip([poise.Load(3.5, [0.1, 0.2], name="Tee 🫖")], plane)
        many = [
            poise.Load(3.5, [0.1, 0.2], lift=1.5),
            poise.Load(3.5, [0.1, 0.2], fixed=[1, -2, 0.25]),
            poise.Load(0, [0, 0], fixed=[0.5, -0.25, 1]),
            poise.Load(2, [0.1, 0.2], acceleration=[0, -3], lift=-1, name="down"),
        ]
        self.check_round_trip(many, plane)
        space = random_spatial_grasp(np.random.default_rng(67), 3).contacts
        self.check_round_trip(random_loads(np.random.default_rng(71), 3), space)

    def test_files_say_what_acts_on_the_object(self):
        values = poise.to_dict(random_spatial_grasp(np.random.default_rng(73), 4))
        values["object"] = {"weight": 4, "com": [0, 0, 0.1]}
        force, at, moment = [1, 2, 3], [0.1, 0, 0.2], [0.5, 0, 0]
        values["loads"] = [
            {"force": force, "at": at, "moment": moment, "name": "tool"},
            {"acceleration": {"up": 2, "fixed": [0, 1, 0]}},
            {"acceleration": [1, 0, 0], "weight": 5},
        ]
        tool, up, fixed = poise.from_dict(values).loads
        acting = poise.wrench_of(force, at) + np.append([0, 0, 0], moment)
        np.testing.assert_allclose(tool.fixed, -acting, rtol=1e-15)
        self.assertEqual((tool.name, tool.weight), ("tool", 4))
        self.assertEqual((up.lift, up.acceleration.tolist()), (2, [0, 1, 0]))
        self.assertEqual((fixed.weight, fixed.acceleration.tolist()), (5, [1, 0, 0]))
        values["loads"] = [{"acceleration": {"any": 2}}]
        loads = poise.from_dict(values).loads
        self.assertEqual(len(loads), 32)
        # Every acceleration of that size lies between theirs.
        directions = np.random.default_rng(79).normal(size=(1000, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        corners = np.array([load.acceleration for load in loads])
        self.assertGreater((directions @ corners.T).max(axis=1).min(), 2)


class Curves(unittest.TestCase):
    def test_formulas_are_the_efforts(self):
        grasp = disk()
        for arc in poise.posture_curve(grasp).arcs:
            theta = np.linspace(arc.from_, arc.to, 7)
            efforts = [poise.hold(grasp, poise.up_at(each)).effort for each in theta]
            np.testing.assert_allclose(arc.value(theta), efforts, rtol=1e-9)
            self.assertAlmostEqual(arc.value(theta[3]), efforts[3], delta=1e-9 * efforts[3])
            slope = (arc.value(theta + 1e-6) - arc.value(theta - 1e-6)) / 2e-6
            np.testing.assert_allclose(arc.value.slope(theta), slope, atol=1e-4)

    def test_domains(self):
        grasp = disk()
        wedge = poise.fork_wedge(grasp)
        domain = poise.domain_interval(grasp, poise.Domain.pinching_up)
        self.assertAlmostEqual(wedge.to - wedge.from_ + domain.to - domain.from_, 2 * math.pi)
        curve = poise.posture_curve(grasp, domain=poise.Domain.pinching_up)
        self.assertEqual(curve.domain.from_, domain.from_)
        self.assertEqual(curve.optima[0].kind, poise.Kind.boundary)
        self.assertEqual(len(curve.states), 2 * len(curve.arcs))

    def test_best_many_is_each_in_order(self):
        rng = np.random.default_rng(5)
        grasps = [random_grasp(rng, contacts) for contacts in [1, 2, 3, 4, 5] * 8]
        for many, grasp in zip(poise.best_many(grasps), grasps):
            one = poise.best_posture(grasp)
            self.assertEqual(many.lower_bound, one.lower_bound)
            self.assertEqual(
                [posture.hold.effort for posture in many.minima],
                [posture.hold.effort for posture in one.minima],
            )

    def test_parts_outlive_the_whole(self):
        best = poise.best_posture(disk()).best  # the answer itself is gone
        self.assertAlmostEqual(best.hold.effort, 80.3847577, places=6)
        again = poise.minimum_at(disk(), best.optimum)
        self.assertEqual(again.hold.effort, best.hold.effort)

    def test_edges_meet_above_the_centre_of_mass(self):
        best = poise.best_posture(disk(), domain=poise.Domain.pinching_up).best_pinched
        self.assertTrue(best.two_slipping)
        up = poise.up_at(best.optimum.angle)
        self.assertAlmostEqual(np.cross(best.edges_meet, up), 0)

    def test_best_many_in_space_is_each_in_order(self):
        rng = np.random.default_rng(12)
        spheres = [poise.Contact(u, -u, 0.8, torsion=0.1) for u in rng.normal(size=(4, 3))]
        loads = [poise.Load(weight, [0, 0, 0.1]) for weight in (1, 3)]
        both = poise.Grasp(loads, spheres)
        grasps = [random_spatial_grasp(rng, 3), both, disk(), random_spatial_grasp(rng, 4)]
        many = poise.best_many(grasps, gap=1e-2, starts=4)
        for one, grasp in zip(many, grasps):
            again = poise.best_posture(grasp, gap=1e-2, starts=4)
            self.assertEqual(one.lower_bound, again.lower_bound)
            self.assertEqual(repr(one), repr(again))
        self.assertEqual(many[1].best.load, 1)
        self.assertAlmostEqual(np.divide(*many[1].best.load_efforts), 1 / 9)

    def test_best_in_space_is_below_all_samples(self):
        rng = np.random.default_rng(13)
        grasp = random_spatial_grasp(rng, 5)
        answer = poise.best_posture(grasp)
        self.assertEqual(answer.status, poise.Status.optimal)
        ups = rng.normal(size=(20_000, 3))
        self.assertLessEqual(answer.lower_bound, poise.hold_many(grasp, ups).effort.min())
        self.assertGreater(answer.lower_bound, 0.999 * answer.best.effort)
        tilted = poise.best_posture(grasp, tilt=poise.Tilt(-answer.best.up, 1), gap=1e-2)
        if tilted.best is not None:
            self.assertGreaterEqual(tilted.best.effort, answer.best.effort * (1 - 1e-6))
            self.assertGreaterEqual(tilted.best.up @ -answer.best.up, np.cos(1) - 1e-9)

    def test_smallest_turn(self):
        rng = np.random.default_rng(14)
        for _ in range(20):
            up, q = rng.normal(size=3), rng.normal(size=4)
            q /= np.linalg.norm(q)
            turn = poise.smallest_turn(q, up)
            before = rotate(q, up / np.linalg.norm(up))
            np.testing.assert_allclose(rotate(turn, before), [0, 0, 1], atol=1e-12)
            self.assertAlmostEqual(2 * np.arccos(turn[0]), np.arccos(before[2]))

    def test_plot_of_the_sphere(self):
        import matplotlib

        matplotlib.use("Agg")
        grasp = random_spatial_grasp(np.random.default_rng(15), 3)
        best = poise.best_posture(grasp, gap=1e-2)
        axes = poise.plot(grasp, best=best)
        half = [image.get_array() for image in axes.images]
        u, v = 2 * (np.array([150, 90]) + 0.5) / 241 - 1  # a pixel, and its posture by hand
        scale = math.sqrt(2 - u * u - v * v)
        for sign, picture in zip((1, -1), half):
            effort = poise.hold(
                grasp, [sign * u * scale, v * scale, sign * (1 - u * u - v * v)]
            ).effort
            drawn = picture[90, 150]
            if effort == 0:
                self.assertTrue(np.ma.is_masked(drawn))
            else:
                self.assertAlmostEqual(drawn**2 / effort, 1)
        self.assertEqual(len(axes.lines), len(best.minima))
        self.assertEqual(axes.images[0].get_clim()[0], math.sqrt(best.best.effort))
        self.assertEqual(poise.plot(disk()).get_xlim(), (-180, 180))

    def test_plot(self):
        import matplotlib

        matplotlib.use("Agg")
        for grasp in [disk(), disk(0.3, 0.3)]:
            curve = poise.posture_curve(grasp)
            axes = poise.plot(curve)
            self.assertEqual(axes.get_xlim(), (-180, 180))
            drawn = [line for line in axes.lines if len(line.get_xdata()) > 1]
            self.assertEqual(len(drawn), 3 * len(curve.arcs))
            x, y = drawn[0].get_data()
            grip = poise.hold(grasp, poise.up_at(math.radians(x[3]))).effort
            self.assertAlmostEqual(y[3] ** 2 / grip, 1, delta=1e-9)
            with tempfile.TemporaryDirectory() as directory:
                file = Path(directory, "curve.png")
                axes.figure.savefig(file)
                self.assertGreater(file.stat().st_size, 5000)


class Turns(unittest.TestCase):
    """Turns against the program, and against holds of the postures between."""

    def test_upside_down_is_half_a_turn(self):
        for up in [[-1e-17, -1], [0.0, -1], [-0.0, -1]]:
            self.assertEqual(poise.angle_of(up), math.pi)
            self.assertTrue(poise.verify(disk(), poise.hold(disk(), up), up))

    def check_hold(self, posture, shown):
        self.assertEqual(posture.holdable, shown["holdable"])
        self.assertEqual(posture.up.tolist(), shown["up"])
        self.assertEqual(posture.load, shown.get("load", 0))
        self.assertEqual(posture.hold.lower_bound, shown["lower_bound"])
        if not posture.holdable:
            self.assertEqual(posture.value, math.inf)
            return
        value = shown["grip"] if shown["objective"] == "grip" else shown["effort"]
        self.assertEqual(posture.value, value)
        self.assertEqual(posture.hold.effort, shown["effort"])
        self.assertEqual(posture.manner.value, shown["manner"])

    def check_peak(self, turn, shown):
        self.assertAlmostEqual(math.degrees(turn.angle), shown["turn_deg"], delta=1e-10)
        self.assertEqual(len(turn.unholdable), len(shown["unholdable"]))
        for stretch, expected in zip(turn.unholdable, shown["unholdable"]):
            ends = np.degrees([stretch.from_, stretch.to, stretch.at])
            told = [expected["from_deg"], expected["to_deg"], expected["posture"]["turn_deg"]]
            np.testing.assert_allclose(ends, told, atol=1e-10)
            self.check_hold(stretch.posture, expected["posture"])
            self.assertEqual(stretch.reason, expected["posture"]["reason"])
        if shown["peak"] is None:
            self.assertEqual((turn.peak, turn.lower_bound), (math.inf, math.inf))
            self.assertFalse(turn.posture.holdable)
            return
        self.assertEqual(turn.peak, shown["peak"])
        self.assertEqual(turn.lower_bound, shown["lower_bound"])
        self.assertAlmostEqual(math.degrees(turn.at), shown["peak_at"]["turn_deg"], delta=1e-10)
        self.check_hold(turn.posture, shown["peak_at"])

    def check_planar(self, file, to, objective):
        read = poise.load(file)
        options = ["--to", str(to), "--objective", objective.value]
        shown = answer("turn", file, *options)
        turn = poise.turn(
            read.grasp(),
            to * math.pi / 180,
            read.angle,
            domain=read.domain,
            objective=objective,
        )
        self.assertIsInstance(turn, poise.PlanarTurn)
        self.assertEqual(turn.from_, read.angle or 0)
        self.check_hold(turn.now, shown["now"])
        self.check_hold(turn.then, shown["then"])
        self.check_peak(turn, shown["turn"])
        self.assertEqual(turn.other is None, shown["turn"]["other_way"] is None)
        if turn.other is not None:
            self.check_peak(turn.other, shown["turn"]["other_way"])
        verdict = poise.verify(read.grasp(), shown)
        self.assertTrue(verdict, verdict.refuted)
        verdict = poise.verify(read.grasp(), turn)
        self.assertTrue(verdict, verdict.refuted)

    def test_examples(self):
        for file in sorted((ROOT / "examples").glob("*.yaml")):
            if poise_dimension(file) == 2:
                for to in [131.99, -40, 180]:
                    for objective in poise.Objective:
                        with self.subTest(f"{file.name} {to} {objective.value}"):
                            self.check_planar(file, to, objective)

    def test_random_grasps(self):
        rng = np.random.default_rng(31)
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for contacts in [1, 2, 2, 3, 4]:
                poise.save(random_grasp(rng, contacts), file)
                for objective in poise.Objective:
                    self.check_planar(file, rng.uniform(-180, 180), objective)

    def check_spatial(self, file, to, objective):
        read = poise.load(file)
        options = ["--to", ",".join(map(str, to)), "--orientation", "1,0,0,0"]
        options += ["--objective", objective.value, "--gap", "1e-2", "--max-holds", "400"]
        shown = answer("turn", file, *options)
        limits = {"gap": 1e-2, "max_holds": 400, "tilt": read.tilt}
        turn = poise.turn(read.grasp(), to, [1, 0, 0, 0], objective=objective, **limits)
        self.assertIsInstance(turn, poise.SpatialTurn)
        verdict = poise.verify(turn.grasp, shown)
        self.assertTrue(verdict, verdict.refuted)
        verdict = poise.verify(turn.grasp, turn)
        self.assertTrue(verdict, verdict.refuted)
        if any(contact.pad is not None for contact in read.contacts):  # placed with rounding
            self.assertAlmostEqual(turn.peak / shown["turn"]["peak"], 1, delta=2e-2)
            self.assertAlmostEqual(turn.way.peak / shown["turn"]["way"]["peak"], 1, delta=2e-2)
            return
        self.check_hold(turn.now, shown["now"])
        self.check_hold(turn.then, shown["then"])
        shown = shown["turn"]
        self.check_peak(turn, shown)
        self.assertEqual(turn.from_.tolist(), [1, 0, 0, 0])
        self.assertEqual(turn.rotation.tolist(), [shown["rotation"][key] for key in "wxyz"])
        self.assertEqual(turn.orientation.tolist(), [shown["orientation"][key] for key in "wxyz"])
        self.assertEqual(turn.way is None, shown["way"] is None)
        if turn.way is not None:
            self.check_way(turn.way, shown["way"])

    def check_way(self, way, shown):
        self.assertEqual(way.status.value, shown["status"])
        self.assertEqual(way.holds, shown["holds"])
        self.assertEqual(way.peak, math.inf if shown["peak"] is None else shown["peak"])
        bound = math.inf if shown["lower_bound"] is None else shown["lower_bound"]
        self.assertEqual(way.lower_bound, bound)
        self.assertEqual(way.orientations.shape, (len(way.ups), 4))
        told = [[each[key] for key in "wxyz"] for each in shown["orientations"]]
        self.assertEqual(way.orientations.tolist(), told)
        for orientation, up in zip(way.orientations, way.ups):
            np.testing.assert_allclose(rotate(orientation, up), [0, 0, 1], atol=1e-12)
        self.assertEqual(len(way.wall), len(shown["wall"]))
        for part, expected in zip(way.wall, shown["wall"]):
            self.assertEqual(part.up.tolist(), expected["up"])
            if "n" in expected:
                self.assertEqual(part.cut.n.tolist(), expected["n"])
            else:
                self.assertEqual(part.cut.y.tolist(), expected["y"])

    def test_examples_in_space(self):
        for file in sorted((ROOT / "examples").glob("*.yaml")):
            if poise_dimension(file) == 3:
                for objective in poise.Objective:
                    with self.subTest(f"{file.name} {objective.value}"):
                        self.check_spatial(file, [0.1, -0.2, 0.6], objective)

    def test_random_grasps_in_space(self):
        rng = np.random.default_rng(37)
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for contacts in [2, 3, 4, 6]:
                poise.save(random_spatial_grasp(rng, contacts), file)
                for objective in poise.Objective:
                    self.check_spatial(file, rng.normal(size=3).tolist(), objective)

    def test_the_part_of_the_readme(self):
        grasp = poise.load(ROOT / "examples" / "l-part.yaml").grasp()
        best = poise.best_posture(grasp, objective=poise.Objective.grip).best
        turn = poise.turn(grasp, best.optimum.angle, objective=poise.Objective.grip)
        self.assertAlmostEqual(turn.now.value, 2.125, delta=5e-4)
        self.assertAlmostEqual(turn.peak, 3.57, delta=5e-3)
        self.assertAlmostEqual(math.degrees(turn.at), 53, delta=0.5)
        self.assertAlmostEqual(turn.other.peak, 2.87, delta=5e-3)
        self.assertAlmostEqual(math.degrees(turn.other.at), -90, delta=0.5)
        self.assertAlmostEqual(turn.then.value, 1.184, delta=5e-4)

    def test_postures_may_be_told_by_directions(self):
        rng = np.random.default_rng(41)
        grasp = disk()
        one = poise.turn(grasp, 2.5, -0.75)
        for to, from_ in [
            (2.5 - 2 * math.pi, -0.75 + 4 * math.pi),
            (poise.up_at(2.5) * 3, [-math.sin(0.75), math.cos(0.75)]),
        ]:
            again = poise.turn(grasp, to, from_)
            self.assertAlmostEqual(again.from_, -0.75)
            self.assertAlmostEqual(again.angle, one.angle)
            self.assertAlmostEqual(again.peak / one.peak, 1)
        self.assertEqual(poise.turn(grasp, 1).from_, 0)
        spatial = random_spatial_grasp(rng, 4)
        now, then = rng.normal(size=(2, 3))
        turn = poise.turn(spatial, then, now, gap=1e-2)
        again = poise.turn(spatial, 7 * then, 5 * turn.from_, gap=1e-2)
        self.assertAlmostEqual(turn.angle, again.angle)
        self.assertAlmostEqual(turn.now.up @ now, np.linalg.norm(now))
        whole = poise.smallest_turn(turn.from_, then)
        np.testing.assert_allclose(turn.rotation, whole, atol=1e-12)
        self.assertEqual(poise.turn(spatial, then, gap=1e-2).from_.tolist(), [1, 0, 0, 0])

    def test_no_posture_between_needs_more_than_the_peak(self):
        rng = np.random.default_rng(43)
        for contacts in [3, 4, 5]:
            grasp = random_spatial_grasp(rng, contacts)
            ups = rng.normal(size=(20, 3))
            held = [up for up in ups if poise.hold(grasp, up).holdable]
            if len(held) < 2:
                continue
            turn = poise.turn(grasp, held[1], held[0])
            self.assertLessEqual(turn.way.lower_bound, turn.peak * (1 + 1e-9))
            self.assertLessEqual(turn.way.peak, turn.peak * (1 + 2e-3))
            for peak, bound, corners in [
                (turn.peak, turn.lower_bound, np.array([turn.now.up, turn.then.up])),
                (turn.way.peak, 0, turn.way.ups),
            ]:
                between = [
                    a * math.cos(t) + b * math.sin(t)
                    for a, b in zip(corners, corners[1:])
                    for t in np.linspace(0, math.pi / 2, 200)
                ]
                most = poise.hold_many(grasp, between).effort.max()
                self.assertLessEqual(most, peak * (1 + 1e-9))
                self.assertGreaterEqual(most, bound * (1 - 1e-2))

    def test_a_turn_through_postures_that_cannot_be_held(self):
        slippery = disk(0.1, 0.1)
        turn = poise.turn(slippery, math.radians(170), math.radians(-170))
        self.assertAlmostEqual(math.degrees(turn.angle), -20)
        self.assertTrue(math.isfinite(turn.peak))
        self.assertEqual(turn.other.peak, math.inf)
        (stretch,) = turn.other.unholdable
        self.assertIn("unholdable", repr(turn.other))
        self.assertIn("unholdable", repr(stretch.posture))
        self.assertLess(0, stretch.from_)
        self.assertLess(stretch.from_, stretch.at)
        self.assertEqual(stretch.reason, poise.reason(slippery, stretch.posture.hold))
        for end, held in [(stretch.from_ - 1e-3, True), (stretch.from_ + 1e-3, False)]:
            up = poise.up_at(turn.from_ + end)
            self.assertEqual(poise.hold(slippery, up).holdable, held)

    def test_an_end_that_cannot_be_held(self):
        turn = poise.turn(disk(0.1, 0.1), 0, math.pi)
        self.assertFalse(turn.then.holdable)
        self.assertEqual(turn.peak, math.inf)
        lid = poise.Contact([0, 0, 1], [0, 0, -1], 0.5, max_normal=5)
        table = poise.Contact([0, 0, -1], [0, 0, 1], 0.5)
        grasp = poise.Grasp(poise.Load(1, [0, 0, 0]), [lid, table])
        turn = poise.turn(grasp, [1, 0, 0.1])
        self.assertTrue(turn.now.holdable)
        weak = poise.Grasp(poise.Load(20, [0, 0, 0]), [lid, table])
        turn = poise.turn(weak, [0, 0, -1])
        self.assertTrue(turn.now.holdable)
        self.assertFalse(turn.then.holdable)
        self.assertIsNone(turn.way)
        self.assertEqual(turn.peak, math.inf)
        self.assertTrue(turn.unholdable[-1].reason)
        with self.assertRaises(poise.InvalidGrasp) as caught:
            poise.best_reachable(weak, [0, 0, -1], [0, 0, 1])
        self.assertEqual(str(caught.exception), "from_: cannot be held")
        with self.assertRaises(poise.InvalidGrasp) as caught:
            poise.best_reachable(disk(0.1, 0.1), 0)
        self.assertEqual(str(caught.exception), "from_: cannot be held")

    def test_best_reachable_is_that_of_the_program(self):
        seen = 0
        rng = np.random.default_rng(47)
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "grasp.json")
            for contacts in [2, 3, 3, 4, 4]:
                grasp = random_grasp(rng, contacts)
                values = poise.to_dict(grasp)
                values["angle_deg"] = float(rng.integers(-180, 180))
                values["objective"] = "effort"
                file.write_text(json.dumps(values))
                shown = answer("best", file).get("without_pressing_harder")
                if not shown:
                    continue
                seen += 1
                from_ = poise.load(file).angle
                found = poise.best_reachable(grasp, from_)
                told = [shown[f"{key}_deg"] for key in ("turn", "least_turn", "most_turn")]
                angles = [found.angle, found.least_angle, found.most_angle]
                np.testing.assert_allclose(np.degrees(angles), told, atol=1e-9)
                np.testing.assert_allclose(found.posture.value, shown["effort"], rtol=1e-12)
                between = from_ + np.linspace(found.least_angle, found.most_angle, 200)
                ups = np.column_stack([np.sin(between), np.cos(between)])
                now = poise.hold(grasp, poise.up_at(from_)).effort
                self.assertLessEqual(poise.hold_many(grasp, ups).effort.max(), now * (1 + 1e-6))
        self.assertGreater(seen, 0)

    def test_best_reachable_in_space_is_that_of_the_program(self):
        file = ROOT / "examples" / "drill-three-fingers.yaml"
        for objective in poise.Objective:
            shown = answer("best", file, "--objective", objective.value)
            near = shown["without_pressing_harder"]
            start = [shown["options"]["orientation"][key] for key in "wxyz"]
            found = poise.best_reachable(
                poise.load(file).grasp(), start, shown["best"]["up"], objective=objective
            )
            np.testing.assert_allclose(found.posture.up, near["up"], atol=1e-9)
            self.assertAlmostEqual(found.lower_bound, near["reachable_bound"])
            self.assertAlmostEqual(found.way.peak, near["peak"])
            self.assertEqual(found.way.status.value, near["status"])
            told = [[each[key] for key in "wxyz"] for each in near["orientations"]]
            np.testing.assert_allclose(found.way.orientations, told, atol=1e-9)

    def test_documents_that_are_spoilt_are_refuted(self):
        file = ROOT / "examples" / "l-part.yaml"
        grasp = poise.load(file).grasp()
        shown = answer("turn", file, "--to", "131.99")
        self.assertTrue(poise.verify(grasp, json.dumps(shown)))
        shown["turn"]["peak"] *= 0.99
        self.assertIn("turn.peak", [each.path for each in poise.verify(grasp, shown).refuted])
        turn = poise.turn(grasp, 2)
        self.assertFalse(poise.verify(poise.with_weight(grasp, 2), turn))

    def test_plot(self):
        import matplotlib

        matplotlib.use("Agg")
        grip = poise.Objective.grip
        grasp = poise.load(ROOT / "examples" / "l-part.yaml").grasp()
        turn = poise.turn(grasp, math.radians(131.99), objective=grip)
        axes = poise.plot.turn(turn)
        for line, way in zip(axes.lines, [turn, turn.other]):
            x, y = line.get_data()
            self.assertAlmostEqual(y.max() / way.peak, 1, delta=1e-3)
            self.assertAlmostEqual(max(abs(x)), abs(math.degrees(way.angle)))
            at = poise.up_at(math.radians(x[40]))
            self.assertAlmostEqual(y[40] / poise.least_grip(grasp, at).grip, 1, delta=1e-6)
        self.assertEqual(axes.get_ylabel(), "grip to command")

        slippery = poise.turn(disk(0.1, 0.1), math.radians(170), math.radians(-170))
        axes = poise.plot.turn(slippery)
        self.assertEqual(len(axes.patches), 1)
        shaded = axes.patches[0].get_extents().transformed(axes.transData.inverted())
        (stretch,) = slippery.other.unholdable
        np.testing.assert_allclose(
            shaded.intervalx, np.degrees([stretch.from_, stretch.to]), atol=1e-6
        )

        rng = np.random.default_rng(15)
        grasp = random_spatial_grasp(rng, 4)
        for objective in poise.Objective:
            turn = poise.turn(grasp, rng.normal(size=3), rng.normal(size=3), objective=objective)
            axes = poise.plot.turn(turn)
            if not math.isfinite(turn.peak):
                continue
            x, y = axes.lines[0].get_data()
            value = y**2 if objective == poise.Objective.effort else y
            self.assertAlmostEqual(value.max() / turn.peak, 1, delta=2e-3)
            self.assertAlmostEqual(x[-1], math.degrees(turn.angle))
            with tempfile.TemporaryDirectory() as directory:
                file = Path(directory, "turn.png")
                axes.figure.savefig(file)
                self.assertGreater(file.stat().st_size, 5000)


class Grips(unittest.TestCase):
    """The number to command."""

    def jaws(self, **more):
        contacts = [
            poise.Contact((-0.03, 0, 0), (1, 0, 0), friction=0.4, finger="left"),
            poise.Contact((0.03, 0, 0), (-1, 0, 0), friction=0.4, finger="right"),
        ]
        return poise.Grasp(poise.Load(8, (0, 0, 0)), contacts, **more)

    def test_two_fingers_press_with_the_weight_over_twice_the_friction(self):
        hold = poise.least_grip(self.jaws(), (0, 0, 1))
        self.assertAlmostEqual(hold.grip, 10, delta=1e-7)
        self.assertEqual(hold.objective, poise.Objective.grip)
        self.assertAlmostEqual(sum(hold.rates), 1)
        self.assertAlmostEqual(hold.lower_bound, 10, delta=1e-7)

    def test_a_force_that_drives_do_not_give_is_no_hold(self):
        limits = {"left": {"max_force": 9.9}, "right": {"max_force": 9.9}}
        grasp = self.jaws(fingers=limits)
        for objective in poise.Objective:
            hold = poise.hold(grasp, (0, 0, 1), objective=objective)
            self.assertFalse(hold.holdable)
            self.assertIn("gives 9.9 N at most", poise.reason(grasp, hold))
        self.assertAlmostEqual(poise.least_grip(grasp, (0, 0, 1)).grip, 10, delta=1e-7)

    def test_the_best_posture_for_grip_needs_no_more_than_others(self):
        rng = np.random.default_rng(5)
        for _ in range(5):
            grasp = random_spatial_grasp(rng, 4)
            best = poise.best_posture(grasp, objective=poise.Objective.grip, starts=0)
            if best.status == poise.Status.unholdable:
                continue
            for up in rng.normal(size=(50, 3)):
                hold = poise.least_grip(grasp, up)
                self.assertTrue(not hold.holdable or best.lower_bound <= hold.grip * (1 + 1e-7))

    def test_mechanisms_survive_files_and_pickles(self):
        pad = poise.Pad([(0, 0.01, 0), (0, -0.01, 0)], reach=(0, 0.01))
        contacts = [
            poise.Contact((-0.03, 0, 0), (1, 0, 0), friction=0.4, finger="left", pad=pad),
            poise.Contact((0.03, 0, 0), (-1, 0, 0), friction=0.4, finger="right"),
        ]
        drives = [
            {"name": "screw", "moves": ["left", "right"], "along": [1, 0, 0]},
            {
                "name": "pin",
                "moves": ["right"],
                "about": {"axis": [0, 1, 0], "through": [0.1, 0, 0]},
                "max": 2.0,
            },
        ]
        grasp = poise.Grasp(poise.Load(8, (0, 0, 0)), contacts, drives=drives)
        for again in (
            pickle.loads(pickle.dumps(grasp)),
            poise.from_dict(poise.to_dict(grasp)).grasp(),
        ):
            self.assertEqual(again.mechanism, grasp.mechanism)
            np.testing.assert_allclose(again.contacts[0].pad.points, pad.points, atol=1e-15)
        with self.assertRaisesRegex(poise.InvalidGrasp, "drives"):
            poise.Grasp(poise.Load(8, (0, 0, 0)), contacts, drives="every")


class Capacities(unittest.TestCase):
    def check_hold(self, hold, shown):
        self.assertEqual(hold.effort, shown["effort"])
        for force, contact in zip(hold.forces, shown["contacts"]):
            self.assertEqual(force.normal, contact["normal_force"])

    def check_weights(self, grasp, up, load, weights, shown):
        self.assertEqual(weights.holdable, shown["holdable"])
        for end, name in [(weights.greatest, "greatest"), (weights.least, "least")]:
            self.assertEqual(end.dual.tolist(), shown[f"{name}_dual"])
            if shown[f"{name}_bound"] is not None:
                self.assertEqual(end.bound, shown[f"{name}_bound"])
            if f"{name}_hold" in shown:
                self.check_hold(end.hold, shown[f"{name}_hold"])
        if not weights.holdable:
            return
        self.assertEqual(math.isinf(weights.greatest.weight), shown["any"])
        if not shown["any"]:
            self.assertEqual(weights.greatest.weight, shown["greatest"])
            proof = weights.greatest.dual, weights.greatest.rates
            self.assertEqual(proof[1].tolist(), shown.get("greatest_rates", []))
            decide = poise.deciding(grasp, up, *proof, load=load)
            for contact, expected in zip(decide, shown["contacts"], strict=True):
                self.assertEqual(contact.per_newton, expected["per_newton"])
                self.assertEqual(contact.slipping, expected["slipping"])
            drives = poise.deciding_drives(grasp, up, *proof, load=load)
            self.assertEqual(drives, [drive["per_newton"] for drive in shown["drives"]])

    def check_file(self, file):
        """As the program says, in a posture that both have without rounding."""
        grasp = poise.load(file).grasp()
        up = [0] * (grasp.dimension - 1) + [1]
        options = ["--safety", "2", "--up", ",".join(map(str, up))]
        capacities = answer("capacity", file, *options)["capacities"]
        self.assertEqual(len(capacities), len(grasp.loads))
        for shown in capacities:
            self.assertEqual(shown["up"], up)
            load = shown.get("load")
            capacity = poise.capacity(grasp, up, 2, load=load)
            self.check_weights(grasp, up, load, capacity.weights, shown["weight"])
            if shown["friction"]["factor"] is not None:
                self.assertEqual(capacity.friction.factor, shown["friction"]["factor"])
                self.check_hold(capacity.friction.hold, shown["friction"]["hold"])
            self.assertEqual(capacity.friction.bound, shown["friction"]["bound"])
            self.assertEqual(capacity.friction.dual.tolist(), shown["friction"]["dual"])
            self.assertEqual(
                capacity.friction.rates.tolist(), shown["friction"].get("rates", [])
            )
            self.assertEqual(capacity.safe.holdable, shown["command"]["holdable"])
            if capacity.safe.holdable:
                self.check_hold(capacity.safe, shown["command"])
                self.assertEqual(capacity.safe.grip, shown["command"]["grip"])

    def check_proof(self, found, shown):
        self.assertEqual(found.proven, shown.get("proven", True))
        near = {"rtol": 1e-6, "atol": 1e-6}
        np.testing.assert_allclose(found.cut.y, shown["proof"]["y"], **near)
        rates = found.cut.rates if found.cut.rates.any() else []
        np.testing.assert_allclose(rates, shown["proof"].get("rates", []), **near)
        held = found.held[0] if found.held else []
        self.assertEqual(len(held), len(shown["proof"]["held"]))
        if len(held):
            np.testing.assert_allclose(held, shown["proof"]["held"], **near)

    def check_shake(self, file):
        """Of each load alone, as the program says."""
        read = poise.load(file)
        loads = read.loads
        up = [0] * (read.grasp().dimension - 1) + [1]
        for shown in answer("capacity", file, "--up", ",".join(map(str, up)))["capacities"]:
            read.loads = [loads[shown.get("load", 0)]]
            found, told = poise.shake(read.grasp(), up), shown["shake"]
            for number, expected in [
                (found.acceleration, told["acceleration"]),
                (found.bound, told["bound"]),
            ]:
                expected = math.inf if expected is None else expected
                np.testing.assert_allclose(number, expected, rtol=1e-7)
            if told["direction"] is not None:
                np.testing.assert_allclose(found.direction, told["direction"], atol=1e-6)
            self.check_proof(found, told)
            tilted, told = poise.tilting(read.grasp(), up), shown["tilt"]
            self.assertAlmostEqual(math.degrees(tilted.angle), shown["tilt_deg"], delta=1e-5)
            self.assertAlmostEqual(math.degrees(tilted.bound), told["bound_deg"], delta=1e-5)
            if told["weakest"] is not None:
                np.testing.assert_allclose(tilted.up, told["weakest"], atol=1e-6)
            self.check_proof(tilted, told)
            holdable = poise.hold(read.grasp(), up).holdable
            self.assertEqual([found.holdable, tilted.holdable], [holdable, holdable])

    def test_shake_and_tilt_are_those_of_the_program(self):
        names = ["hexagon-three-fingers", "tray", "box-soft-jaws", "bottle", "mug-parallel-jaw"]
        for name in names:
            with self.subTest(name):
                self.check_shake(ROOT / "examples" / f"{name}.yaml")

    def test_the_sturdiest_posture_is_that_of_the_program(self):
        for name in ["hexagon-three-fingers", "mug-parallel-jaw"]:
            file = ROOT / "examples" / f"{name}.yaml"
            read = poise.load(file)
            told = answer("best", file, "--objective", "sturdy")
            planar = told["options"].get("domain") == "all" and "angle_deg" in told
            now = [math.sin(read.angle), math.cos(read.angle)] if planar else read.up
            found = poise.sturdiest_posture(read.grasp(), present=now)
            self.assertEqual(found.status.value, told["status"])
            self.assertEqual(found.up.tolist(), told["up"])
            self.assertEqual((found.acceleration, found.bound), (told["acceleration"], told["bound"]))
            self.assertEqual([cut.y.tolist() for cut in found.cuts], [cut["y"] for cut in told["cuts"]])
            self.assertEqual([shake.bound for shake in found.shakes], [told["shakes"][0]["bound"]])
            self.assertTrue(poise.verify(read.grasp(), told))
        with self.assertRaises(poise.InvalidGrasp):
            poise.sturdiest_posture(read.grasp(), domain=poise.Domain.pinching_up)

    def test_a_shaken_block_takes_what_is_left_of_friction(self):
        mass, friction, most = 2, 0.5, 80
        weight = mass * poise.standard_gravity
        fingers = [poise.Contact([s, 0], [-s, 0], friction) for s in (-1, 1)]
        grasp = poise.Grasp(poise.Load(weight, [0, 0]), fingers)
        expected = (2 * friction * most - weight) / math.sqrt(1 + 4 * friction**2) / mass
        found = poise.shake(grasp, [0, 1], most_grip=most, gap=1e-4)
        self.assertTrue(found.holdable and found.proven)
        self.assertLessEqual(found.acceleration, expected * (1 + 1e-9))
        self.assertGreaterEqual(found.bound, expected * (1 - 1e-9))
        self.assertLess(found.bound / found.acceleration, 1 + 1e-4)
        self.assertAlmostEqual(np.linalg.norm(found.direction), 1, delta=1e-12)
        self.assertEqual(found.held[0].shape[1], 2)
        self.assertEqual(poise.shake(grasp, [0, 1]).acceleration, math.inf)
        self.assertEqual(poise.tilting(grasp, [0, 1]).angle, math.pi)
        self.assertFalse(poise.shake(grasp, [0, 1], most_grip=weight / 2).holdable)
        with self.assertRaises(poise.InvalidGrasp):
            poise.shake(grasp, [0, 1], gap=0)

    def test_they_are_those_of_the_program(self):
        names = ["hexagon-three-fingers", "ito-fig6", "tray", "box-hard-jaws", "box-soft-jaws"]
        for name in [*names, "bottle"]:
            with self.subTest(name):
                self.check_file(ROOT / "examples" / f"{name}.yaml")

    def test_those_of_limited_drives_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "jaws.yaml"
            file.write_text(
                "poise: 1\ndimension: 2\nobject: {weight: 10, com: [0, 0]}\ndrives: coupled\n"
                "fingers: {left: {max_force: 20}}\ncontacts:\n"
                "  - {position: [-1, 0], normal: [1, 0], friction: 0.3, finger: left}\n"
                "  - {position: [1, 0], normal: [-1, 0], friction: 0.3, finger: right}\n"
            )
            self.check_file(file)
            capacity = poise.capacity(poise.load(file).grasp(), [0, 1], 1.5)
            self.assertAlmostEqual(capacity.weights.greatest.bound, 2 * 20 * 0.3, delta=1e-7)
            self.assertAlmostEqual(capacity.safe.grip, 1.5 * 10 / (2 * 0.3), delta=1e-6)

    def test_two_opposed_fingers_hold_twice_their_friction(self):
        for zero in [[], [0]]:
            contacts = [
                poise.Contact([s, 0, *zero], [-s, 0, *zero], 0.4, max_normal=25) for s in (-1, 1)
            ]
            grasp, up = poise.Grasp(poise.Load(10, [0, 0, *zero]), contacts), [0, 3, *zero]
            weights = poise.weight_range(grasp, up)
            self.assertEqual(weights.least.weight, 0)
            self.assertAlmostEqual(weights.greatest.weight, 2 * 0.4 * 25, delta=1e-5)
            self.assertAlmostEqual(poise.least_friction(grasp, up).factor, 0.5, delta=1e-6)
            for contact in poise.deciding(grasp, up, weights.greatest.dual):
                self.assertAlmostEqual(contact.per_newton, 0.4, delta=1e-6)
                self.assertTrue(contact.slipping)

    def test_grasps_like_another(self):
        lid = poise.Contact([0, 1], [0, -1], 0.5, min_normal=2, max_normal=3)
        grasp = poise.Grasp(poise.Load(10), [lid, poise.Contact([0, -1], [0, 1], 0.3)])
        self.assertEqual(poise.with_weight(grasp, 4).loads[0].weight, 4)
        rough = poise.with_friction(grasp, 2).contacts
        self.assertEqual([contact.friction for contact in rough], [1, 0.6])
        free = poise.without_limits(grasp).contacts
        self.assertEqual([(c.min_normal, c.max_normal) for c in free], [(0, 0), (0, math.inf)])


class Verify(unittest.TestCase):
    def test_answers_are_confirmed_and_spoilt_ones_are_not(self):
        rng = np.random.default_rng(23)
        tilt = poise.Tilt([0, 0, 1], 0.5)
        for grasp, settings in [
            (disk(), {}),
            (disk(), {"domain": poise.Domain.pinching_up}),
            (random_grasp(rng, 3), {}),
            (random_spatial_grasp(rng, 4), {}),
            (random_spatial_grasp(rng, 4), {"gap": 1e-2, "tilt": tilt}),
        ]:
            best = poise.best_posture(grasp, **settings)
            verdict = poise.verify(grasp, best, **settings)
            self.assertTrue(verdict, verdict.refuted)
            heavier = poise.with_weight(grasp, 1.01 * grasp.loads[0].weight)
            refuted = poise.verify(heavier, best, **settings)
            self.assertFalse(refuted)
            self.assertGreater(refuted.refuted[0].off, refuted.refuted[0].allowed)
            up = rng.normal(size=grasp.dimension)
            hold = poise.hold(grasp, up)
            self.assertTrue(poise.verify(grasp, hold, up).confirmed)
            self.assertFalse(poise.verify(grasp, hold, -up).confirmed)

    def test_documents(self):
        for name in ["l-part", "bottle", "tray"]:
            file = poise.load(ROOT / "examples" / f"{name}.yaml")
            grasp = file.grasp()
            for command in ["check", "hold", "best", "capacity"]:
                document = answer(command, ROOT / "examples" / f"{name}.yaml")
                verdict = poise.verify(grasp, document)
                self.assertTrue(verdict, (name, command))
                if command == "check":
                    self.assertIn(("force_closure", "follows from the file"), verdict.unchecked)
                self.assertTrue(poise.verify(grasp, json.dumps(document)))
            document["capacities"][0]["weight"]["given"] *= 2
            self.assertIn("capacities[0]", repr(poise.verify(grasp, document)))
        with self.assertRaises(poise.FileError):
            poise.verify(grasp, "{}")

    def test_bounds(self):
        rng = np.random.default_rng(29)
        for grasp in [random_grasp(rng, 3), random_spatial_grasp(rng, 4)]:
            up = rng.normal(size=grasp.dimension)
            load = grasp.load(up)
            hold = poise.hold(grasp, up)
            for y in [hold.dual, *rng.normal(size=(20, len(load)))]:
                bound = poise.bound(grasp, load, y)
                self.assertAlmostEqual(bound, 2 * (y @ load - poise.phi(grasp, y)))
                if hold.holdable:
                    self.assertLessEqual(bound, hold.effort * (1 + 1e-9))


class Records(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        rng = np.random.default_rng(19)
        grasps = [random_grasp(rng, 3), random_spatial_grasp(rng, 3), disk(0, 0), disk()]
        values = [poise.to_dict(grasp) for grasp in grasps]
        values[3]["object"]["weight"] = -1
        texts = [json.dumps(each) for each in values] + ["", "{"]
        for flags, options in [
            ([], {}),
            (["--gap", "1e-2", "--max-holds", "20"], {"gap": 1e-2, "max_holds": 20}),
            (["--domain", "pinching-up"], {"domain": poise.Domain.pinching_up}),
            (["--what", "hold", "--up", "1,-2,0.5"], {"hold": True, "up": [1, -2, 0.5]}),
            (["--what", "hold", "--angle", "20"], {"hold": True, "angle_deg": 20}),
        ]:
            run = subprocess.run(
                [PROGRAM, "batch", "-", *flags],
                input="\n".join(texts).encode(),
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
            )
            own = [poise.answer_record(text, k, **options) for k, text in enumerate(texts)]
            self.assertEqual("".join(own), run.stdout.decode())
        with self.assertRaises(poise.InvalidGrasp):
            poise.answer_record(texts[0], 0, hold=True, up=[0, 0])


def rotate(q, v):
    """The vector v turned by the quaternion w, x, y, z."""
    w, axis = q[0], q[1:]
    return v + 2 * np.cross(axis, np.cross(axis, v) + w * v)


class Files(unittest.TestCase):
    def test_round_trip(self):
        with tempfile.TemporaryDirectory() as directory:
            copy = Path(directory, "copy.yaml")
            for name in sorted((ROOT / "examples").glob("*.yaml")):
                file = poise.load(name)
                poise.save(file, copy)
                again = poise.load(copy)
                self.assertEqual(poise.to_dict(file), poise.to_dict(again))
                self.assertEqual(again.name, file.name)
                self.assertEqual(type(again.shape), type(file.shape))
                if file.angle is not None:
                    self.assertAlmostEqual(again.angle, file.angle)

    def test_all_keys(self):
        file = poise.GraspFile(
            [poise.Load(3.5, [0.1, 0.2])],
            [poise.Contact([1, 0], [-1, 0], 0.5, 0.25, 8, 0.75, "Daumen 👍")],
            name="alles",
            safety=1.5,
            angle=0.5,
            domain=poise.Domain.pinching_up,
            shape=poise.Ellipse([1, 2]),
        )
        again = poise.from_dict(poise.to_dict(file))
        self.assertEqual(repr(again.loads), repr(file.loads))
        self.assertEqual(repr(again.contacts), repr(file.contacts))
        self.assertEqual(repr(again.shape), repr(file.shape))
        self.assertEqual((again.name, again.safety, again.domain), ("alles", 1.5, file.domain))
        self.assertAlmostEqual(again.angle, 0.5)

    def test_numpy_values(self):
        values = poise.to_dict(disk())
        values["object"]["com"] = np.array([0.0, 0.1])
        values["object"]["weight"] = np.float64(3)
        self.assertEqual(poise.from_dict(values).loads[0].com.tolist(), [0, 0.1])

    def test_warnings(self):
        values = poise.to_dict(disk())
        values["contacts"][0]["normal"] = [1, 0]
        values["object"]["shape"] = {"disk": {"radius": 1}}
        self.assertIn("contacts[0].normal", poise.from_dict(values).warnings[0])

    def test_errors_tell_the_place(self):
        with tempfile.TemporaryDirectory() as directory:
            file = Path(directory, "bad.yaml")
            file.write_text(
                "poise: 1\ndimension: 2\nobject: {weight: -1, com: [0, 0]}\n"
                "contacts: [{position: [0, 1], normal: [0, -1], friction: 1}]\n"
            )
            with self.assertRaises(poise.FileError) as caught:
                poise.load(file)
            error = caught.exception
            self.assertEqual((error.line, error.column), (3, 18))
            self.assertEqual(error.path, "object.weight")
            self.assertEqual(str(error), f"{file}:3:18: object.weight: {error.problem}")
            with self.assertRaises(poise.FileError):
                poise.load(Path(directory, "none.yaml"))

    def test_all_keys_in_space(self):
        soft = poise.Contact([1, 0, 0], [-1, 0, 0], 0.5, 0.25, 8, 0.75, "thumb", 0.125)
        for shape in [
            poise.Box([1, 2, 3]),
            poise.Cylinder(1.0, 2.0),
            poise.Sphere(1.0),
            poise.Ellipsoid([1, 2, 3]),
        ]:
            file = poise.GraspFile(
                [poise.Load(3.5, [0.1, 0.2, 0.3]), poise.Load(2, [0, 0, 0])],
                [soft],
                shape=shape,
                up=np.array([0, 0, 1.0]),
                tilt=poise.Tilt([0, 1, 0], 0.5),
            )
            again = poise.from_dict(poise.to_dict(file))
            again.warnings = []
            again.tilt.most = round(again.tilt.most, 12)
            self.assertEqual(repr(again), repr(file))
            self.assertEqual(repr(file.grasp().loads), repr(file.loads))

    def test_pickles(self):
        rng = np.random.default_rng(16)
        named = [poise.Contact([1, 0], [-1, 0], 1, finger="1"), poise.Contact([-1, 0], [1, 0], 1)]
        for grasp in [
            disk(),
            poise.Grasp(poise.Load(2), named, safety=2),
            random_spatial_grasp(rng, 3),
        ]:
            again = pickle.loads(pickle.dumps(grasp))
            self.assertEqual(repr(again), repr(grasp))
            self.assertEqual(again.finger_of(1), grasp.finger_of(1))
            up = rng.normal(size=grasp.dimension)
            efforts = [poise.hold(each, up).effort for each in (again, grasp)]
            self.assertAlmostEqual(efforts[0], efforts[1], delta=1e-12 * efforts[1])
        for path in sorted((ROOT / "examples").glob("*.yaml")):
            file = poise.load(path)
            self.assertEqual(repr(pickle.loads(pickle.dumps(file))), repr(file))

    def test_errors_of_dictionaries_tell_the_path(self):
        for wrong in [-1, math.nan, math.inf, "much", None]:
            values = poise.to_dict(disk())
            values["contacts"][1]["friction"] = wrong
            with self.assertRaises(poise.FileError) as caught:
                poise.from_dict(values)
            self.assertEqual(caught.exception.path, "contacts[1].friction")
            self.assertTrue(str(caught.exception).startswith("contacts[1].friction: "))


class Motions(unittest.TestCase):
    """Two soft fingers of friction 0.5 that lift half a kilogram at 2 t."""

    def setUp(self):
        self.mass, self.most = 0.5, 30
        jaw = [
            poise.Contact([x, 0, 0], [-np.sign(x), 0, 0], 0.5, torsion=0.01, finger=finger)
            for x, finger in [(-0.04, "left"), (0.04, "right")]
        ]
        self.grasp = poise.Grasp(
            poise.Load(self.mass * poise.standard_gravity, [0, 0, 0]),
            jaw,
            1,
            "coupled",
            {"left": {"max_force": self.most}},
        )
        self.t = np.linspace(0, 1, 101)
        self.up = np.outer(self.t**3 / 3, [0, 0, 1])
        self.level = np.tile([1, 0, 0, 0], (101, 1))

    def test_a_lift_is_the_closed_form(self):
        motion = poise.motion(self.grasp, self.t, self.up, self.level)
        needed = self.mass * (poise.standard_gravity + 2 * self.t)
        np.testing.assert_allclose(motion.values, needed, rtol=1e-6)
        np.testing.assert_allclose(motion.accelerations[:, 2], 2 * self.t, atol=1e-8)
        self.assertTrue((motion.lower_bounds <= motion.values * (1 + 1e-12)).all())
        self.assertTrue(motion.held.all())
        self.assertIsNone(motion.slip)
        self.assertEqual(motion.peak, 100)
        self.assertEqual(motion.cause, "weight")
        self.assertAlmostEqual(motion.without["linear"], needed[0], 5)
        self.assertAlmostEqual(motion.hold.grip, needed[-1], 6)
        factor = math.sqrt((self.most / self.mass - poise.standard_gravity) / 2)
        self.assertAlmostEqual(motion.speed.factor, factor, 5)
        self.assertAlmostEqual(motion.speed.bound, factor, 5)
        given = poise.motion(self.grasp, self.t, self.up, self.level, accelerations=0 * self.up)
        np.testing.assert_allclose(given.values, needed[0], rtol=1e-6)

    def test_turning_about_the_vertical_takes_the_moment(self):
        half = self.t / 2
        turned = np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=1)
        inertia = np.diag([0.1, 0.1, 0.1])
        point = poise.motion(self.grasp, self.t, 0 * self.up, turned)
        body = poise.motion(self.grasp, self.t, 0 * self.up, turned, inertia=inertia)
        np.testing.assert_allclose(point.values, body.values, rtol=1e-3)
        with self.assertRaisesRegex(poise.InvalidGrasp, "principal moment"):
            poise.motion(self.grasp, self.t, self.up, self.level, inertia=np.diag([1, 1, 3]))

    def test_rows_along_a_path_are_the_closed_form(self):
        pose = [[0, 0, 0, 1, 0, 0, 0]]
        upwards = [[[0, 0, 1, 0, 0, 0], [0, 0, 0, 0, 0, 0]]]
        [limits] = poise.path_limits(self.grasp, pose, upwards)
        self.assertTrue(limits.holdable)
        a, b, c = limits.rows[np.abs(limits.rows[:, 0]) > 1e-9].T
        bounds = c / a
        strongest = self.most / self.mass
        self.assertAlmostEqual(bounds[a > 0].min(), strongest - poise.standard_gravity, 1)
        self.assertAlmostEqual(bounds[a < 0].max(), -strongest - poise.standard_gravity, 1)
        with self.assertRaises(poise.InvalidGrasp):
            poise.path_limits(self.grasp, pose, [[[0, 0, 1], [0, 0, 0]]])

    def test_the_wrist_is_turned_so_that_one_finger_carries(self):
        found = poise.best_offset(self.grasp, self.t, self.up, self.level, gap=0.05)
        self.assertLessEqual(found.value, found.now)
        self.assertLessEqual(found.lower_bound, found.value)
        self.assertAlmostEqual(np.linalg.norm(found.rotation), 1, 12)


@unittest.skipUnless(ACRONYM.is_dir(), "POISE_DATA has no acronym")
class AcronymGrasps(unittest.TestCase):
    def test_they_are_those_of_import(self):
        file = str(min((ACRONYM / "grasps").glob("Mug*.h5")))
        data = poise.Acronym(file, str(ACRONYM))
        self.assertEqual(len(data), 2000)
        held = 0
        for n in range(0, 2000, 100):
            command = [PROGRAM, "import", "acronym", file, "--mesh-root", ACRONYM, "--grasp", n]
            with tempfile.TemporaryDirectory() as folder:
                out = Path(folder) / "grasp.yaml"
                run = subprocess.run(
                    [*map(str, command), "-o", out], capture_output=True, check=True
                )
                expected = poise.load(out)
            grasp = data.grasp(n)
            self.assertEqual(grasp.name, expected.name)
            self.assertEqual(len(grasp.contacts), len(expected.contacts))
            for contact, other in zip(grasp.contacts, expected.contacts):
                np.testing.assert_allclose(contact.position, other.position, atol=1e-12)
                np.testing.assert_allclose(contact.normal, other.normal, atol=1e-12)
            self.assertEqual(data.held(n), b"did not hold the object" not in run.stderr)
            held += data.held(n)
        self.assertTrue(0 < held < 20)
        for call in data.grasp, data.held:
            with self.assertRaises(IndexError):
                call(2000)


class Misuse(unittest.TestCase):
    def check(self, path, call, *arguments, **options):
        with self.assertRaises(poise.InvalidGrasp) as caught:
            call(*arguments, **options)
        self.assertIsInstance(caught.exception, poise.PoiseError)
        self.assertIsInstance(caught.exception, ValueError)
        self.assertEqual(caught.exception.path, path)
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual(str(again), f"{path}: {caught.exception.problem}")

    def test_grasps(self):
        down = poise.Contact([0, 1], [0, -1], 0.5)
        self.check("contacts", poise.Grasp, poise.Load(), [])
        self.check("loads[0].weight", poise.Grasp, poise.Load(0), [down])
        self.check("loads[0].com[1]", poise.Grasp, poise.Load(1, [0, math.nan]), [down])
        self.check("loads[0].com", poise.Grasp, poise.Load(1, [1, 2, 3, 4]), [down])
        slip = poise.Contact([0, 1], [0, -1], -0.5)
        self.check("contacts[1].friction", poise.Grasp, poise.Load(), [down, slip])
        flat = poise.Contact([0, 1], [0, 0], 0.5)
        self.check("contacts[0].normal", poise.Grasp, poise.Load(), [flat])
        line = poise.Contact([0], [0, 1], 0.5)
        self.check("contacts[0].position", poise.Grasp, poise.Load(), [line])
        apart = poise.Contact([0, 0, 1], [0, 0, -1], 0.5)
        self.check("loads[0].com", poise.Grasp, poise.Load(), [apart])
        self.check("contacts[1].position", poise.Grasp, poise.Load(), [down, apart])
        soft = poise.Contact([0, 1], [0, -1], 0.5, torsion=0.1)
        self.check("contacts[0].torsion", poise.Grasp, poise.Load(), [soft])
        self.check("safety", poise.Grasp, poise.Load(), [down], safety=0.5)

    def test_loads(self):
        contacts = random_spatial_grasp(np.random.default_rng(83), 3).contacts
        good, origin = poise.Load(1, [0, 0, 0]), [0, 0, 0]
        for path, wrong in [
            ("weight", poise.Load(-1, origin)),
            ("weight", poise.Load(0, origin)),
            ("weight", poise.Load(2, origin, lift=-poise.standard_gravity)),
            ("com", poise.Load(2, [0, 0])),
            ("com[2]", poise.Load(2, [0, 0, math.inf])),
            ("fixed", poise.Load(2, origin, fixed=[0, 0, 1])),
            ("fixed", poise.Load(2, origin, fixed=[0, 0, 1, math.nan, 0, 0])),
            ("lift", poise.Load(2, origin, lift=math.nan)),
            ("acceleration", poise.Load(2, origin, acceleration=[0, 1])),
            ("acceleration[0]", poise.Load(2, origin, acceleration=[math.inf, 1, 0])),
        ]:
            self.check(f"loads[1].{path}", poise.Grasp, [good, wrong], contacts)
            self.check(f"loads[0].{path}", poise.Grasp, wrong, contacts)
        self.check("loads", poise.Grasp, [], contacts)
        self.check("at", poise.wrench_of, [1, 0], [1, 0, 0])
        self.check("force", poise.wrench_of, [1, 0, 0, 0], [1, 0, 0])

    def test_several_loads(self):
        contacts = random_spatial_grasp(np.random.default_rng(89), 3).contacts
        grasp = poise.Grasp([poise.Load(w, [0, 0, 0]) for w in (1, 2)], contacts)
        up = [0, 0, 1]
        hold = poise.hold(grasp, up)
        dual = np.zeros(6)
        for call, arguments in [
            (grasp.load, (up,)),
            (poise.manner, (grasp, up, hold)),
            (poise.verify, (grasp, hold, up)),
            (poise.capacity, (grasp, up, 1)),
            (poise.weight_range, (grasp, up)),
            (poise.least_friction, (grasp, up)),
            (poise.deciding, (grasp, up, dual)),
            (poise.deciding_drives, (grasp, up, dual)),
        ]:
            self.check("load", call, *arguments)
            call(*arguments, load=1)
            with self.assertRaises(IndexError):
                call(*arguments, load=2)
            with self.assertRaises(TypeError):
                call(*arguments, load=-1)

    def test_postures(self):
        grasp = disk()
        for up in [[0, 0], [math.nan, 1], [math.inf, 0]]:
            self.check("up", poise.hold, grasp, up)
        self.check("ups[1]", poise.hold_many, grasp, [[0, 1], [0, 0]])
        self.check("load", poise.hold, grasp, [0, math.nan, 0], [0, 0, 0])
        for cap in [0, -1, math.nan, 1e10]:
            self.check("force_cap", poise.hold, grasp, [0, 1], force_cap=cap)
            self.check("force_cap", poise.posture_curve, grasp, force_cap=cap)
            self.check("force_cap", poise.best_many, [grasp], force_cap=cap)
        self.check("up", poise.hold, grasp, [0, 1, 2])
        self.check("load", poise.hold, grasp, [0, 1], [0, 0, 0])
        self.check("y", poise.hold, grasp, [0, 1, 0], [0, 0])
        with self.assertRaises(TypeError):
            poise.best_posture(grasp, domain="pinching-up")
        with self.assertRaises(IndexError):
            grasp.finger_of(2)

    def test_capacities(self):
        grasp = disk()
        for safety in [0.5, math.nan, math.inf]:
            self.check("safety", poise.capacity, grasp, [0, 1], safety)
        self.check("up", poise.weight_range, grasp, [0, 0])
        self.check("up", poise.least_friction, grasp, [0, 1, 0])
        self.check("force_cap", poise.weight_range, grasp, [0, 1], force_cap=0)
        self.check("dual", poise.deciding, grasp, [0, 1], [0, 1])
        self.check("dual", poise.deciding, grasp, [0, 1], [0, 1, math.nan])
        self.check("loads[0].weight", poise.with_weight, grasp, 0)
        self.check("contacts[0].friction", poise.with_friction, grasp, -1)

    def test_dimensions(self):
        planar, spatial = disk(), random_spatial_grasp(np.random.default_rng(17), 3)
        self.check("grasp", poise.posture_curve, spatial)
        self.check("tilt", poise.best_posture, planar, tilt=poise.Tilt([0, 0, 1], 0.5))
        self.check("domain", poise.best_posture, spatial, domain=poise.Domain.pinching_up)
        self.check("hold", poise.grip, planar, poise.hold(spatial, [0, 0, 1]))
        self.check("ups[0]", poise.hold_many, spatial, [[0, 1], [1, 0]])
        self.check("gap", poise.best_posture, spatial, gap=0)
        self.check("tilt.from_", poise.best_posture, spatial, tilt=poise.Tilt([0, 0, 0], 0.5))
        self.check("orientation", poise.smallest_turn, [0, 0, 0, 0], [0, 0, 1])

    def test_turns(self):
        planar, spatial = disk(), random_spatial_grasp(np.random.default_rng(17), 3)
        for wrong in [math.nan, math.inf, [0, 0], [math.nan, 1], [0, 1, 0]]:
            self.check("to", poise.turn, planar, wrong)
            self.check("from_", poise.turn, planar, 1, wrong)
            self.check("from_", poise.best_reachable, planar, wrong)
        for wrong in [1.0, [0, 1], [0, 0, 0], [0, math.nan, 1]]:
            self.check("to", poise.turn, spatial, wrong)
            self.check("from_", poise.turn, spatial, [0, 0, 1], wrong)
            self.check("from_", poise.best_reachable, spatial, wrong, [0, 0, 1])
            self.check("towards", poise.best_reachable, spatial, [0, 0, 1], wrong)
        for wrong in [[0, 0, 0, 0], [1, 0, math.inf, 0], [1, 0, 0, 0, 0]]:
            self.check("from_", poise.turn, spatial, [0, 0, 1], wrong)
        self.check("to", poise.turn, spatial, [1, 0, 0, 0])
        self.check("towards", poise.best_reachable, spatial, [0, 0, 1])
        self.check("towards", poise.best_reachable, planar, 0, [0, 0, 1])
        self.check("tilt", poise.turn, planar, 1, tilt=poise.Tilt([0, 0, 1], 0.5))
        domain = poise.Domain.pinching_up
        self.check("domain", poise.turn, spatial, [0, 1, 1], domain=domain)
        for call in poise.turn, poise.best_reachable:
            for gap in [0, 1, math.nan]:
                self.check("gap", call, spatial, [0, 1, 1], [0, 0, 1], gap=gap)
            self.check("max_holds", call, spatial, [0, 1, 1], [0, 0, 1], max_holds=0)
            self.check("force_cap", call, spatial, [0, 1, 1], [0, 0, 1], force_cap=0)
            self.check("force_cap", call, planar, 1, force_cap=math.nan)
        for wrong in ["up", None, [[0, 1], [1, 0]]]:
            with self.assertRaises(TypeError):
                poise.turn(planar, wrong)

    def test_reprs(self):
        grasp = disk()
        best = poise.best_posture(grasp)
        self.assertEqual(
            repr(grasp), "Grasp(load of 10 N, 2 contacts, fingers=['right', 'left'])"
        )
        self.assertEqual(
            repr(best.best), "PlanarPosture(165.00 deg, value=80.3848, cradled, kink)"
        )
        for value in [best, best.curve, best.best.hold, best.curve.arcs[0], best.curve.domain]:
            self.assertRegex(repr(value), r"^\w+\(.*\)$")
        grasp = random_spatial_grasp(np.random.default_rng(18), 4)
        best = poise.best_posture(grasp, gap=1e-2)
        hold = best.best.hold
        capacity = poise.capacity(grasp, [0, 0, 1], 1)
        parts = [capacity, capacity.weights, capacity.weights.greatest, capacity.friction]
        parts += poise.deciding(grasp, [0, 0, 1], capacity.weights.greatest.dual)
        tilt = poise.Tilt([0, 0, 1], 1)
        turn = poise.turn(grasp, [0, 1, 0])
        parts += [turn, turn.now, poise.turn(disk(), 1), poise.best_reachable(disk(), 1)]
        if turn.way is not None:
            parts += [turn.way, *turn.way.wall[:1]]
            parts.append(poise.best_reachable(grasp, [0, 1, 0], best.best.up))
        for value in [best, best.best, best.cuts[0], hold, hold.forces[0], tilt, *parts]:
            self.assertRegex(repr(value), r"^\w+\(.*\)$")
            self.assertNotIn("object at", repr(value))


if __name__ == "__main__":
    unittest.main()
