"""The hand-written _core.pyi against the module: by mypy, and the names that mypy does not see."""

import ast
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import poise
from poise import _core

ROOT = Path(__file__).parents[2]
STUB = Path(_core.__file__).with_name("_core.pyi")


def signatures(docstring):
    """The arguments' names of each signature that pybind11 writes at the top of a docstring."""
    for line in docstring.splitlines():
        if found := re.match(r"(?:\d+\. )?\w+\((.*)\) -> ", line):
            if not found[1].startswith("*args"):
                plain = re.sub(r"<[^>]*>", "", found[1])
                yield re.findall(r"(\w+): ", plain)


def stubbed(function):
    arguments = function.args
    return [a.arg for a in arguments.posonlyargs + arguments.args + arguments.kwonlyargs]


class Stub(unittest.TestCase):
    def test_mypy(self):
        # What pybind11's classes have and no stub should say: their metaclass and general __init__.
        allowed = r"poise\._core\.[A-Z]\w*(\.__init__)?" + "\n"
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as allowlist:
            allowlist.write(allowed)
            allowlist.flush()
            command = [sys.executable, "-m", "mypy.stubtest", "poise._core"]
            command += ["--mypy-config-file", ROOT / "pyproject.toml"]
            command += ["--allowlist", allowlist.name, "--ignore-unused-allowlist"]
            run = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=STUB.parents[1]
            )
        self.assertEqual(run.returncode, 0, run.stdout.decode())

    def test_package_is_typed(self):
        command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "-p", "poise"]
        command += ["--config-file", ROOT / "pyproject.toml"]
        with tempfile.TemporaryDirectory() as cache:
            run = subprocess.run(
                command + ["--cache-dir", cache],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                cwd=STUB.parents[1],
            )
        self.assertEqual(run.returncode, 0, run.stdout.decode())

    def test_names(self):
        checked = 0
        tree = ast.parse(STUB.read_text(encoding="utf-8"))
        functions = {}
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                functions.setdefault(node.name, []).append(stubbed(node))
            if isinstance(node, ast.ClassDef):
                members = {each.name for each in node.body}
                present = vars(getattr(_core, node.name))
                public = {name for name in present if not name.startswith("_")}
                self.assertLessEqual(public, members, node.name)
                self.assertLessEqual(members, set(present), node.name)
                for each in node.body:
                    if each.decorator_list:
                        continue
                    (names,) = signatures(present[each.name].__doc__)
                    self.assertEqual(names, stubbed(each)[-len(names) :], each.name)
                    checked += 1
        for name, expected in functions.items():
            self.assertEqual(list(signatures(getattr(_core, name).__doc__)), expected, name)
            checked += 1
        classes = {name for name, value in vars(_core).items() if isinstance(value, type)}
        self.assertEqual(classes, {n.name for n in tree.body if isinstance(n, ast.ClassDef)})
        self.assertGreater(checked, 25)

    def test_everything_is_documented(self):
        for name, value in vars(_core).items():
            if name.startswith("_") or not callable(value):
                continue
            text = value.__doc__ if isinstance(value, type) else value.__doc__.split("\n", 1)[1]
            self.assertTrue(text.strip(), name)

    def test_names_are_those_of_cpp(self):
        # Settings are keywords, linear algebra is numpy's, words of enumerations are their names.
        # A hand with its loads is a Grasp.
        elsewhere = {"CurveSettings", "HoldSettings", "SpatialSettings", "Hand"}
        elsewhere |= {"posture_of", "Minimum", "Best", "Proof", "force_vector"}
        # turn() has them all.
        elsewhere |= {"Turn", "turn_to", "orientation_of", "turn_peak", "ways_round"}
        elsewhere |= {"least_peak_way", "TurnSettings", "Reachable"}
        elsewhere |= {"for_each_contact_field", "Drive", "DriveEffort", "DriveKind", "Finger"}
        elsewhere |= {"GripUnit", "Mechanism", "grip_bound", "grip_unit", "has_grip", "most_grip"}
        elsewhere |= {"SmallVector", "Twist", "Vector", "Wrench", "to_string"}
        elsewhere |= {"contact_size", "wrench_size"}
        # Pulls are made by files, motion() has the motions.
        elsewhere |= {"Pull", "add_pulls", "Body", "MotionState", "MotionLoad", "MotionNeed"}
        elsewhere |= {"MotionAnswer", "MotionSettings", "LoadTerm", "Trajectory", "OffsetSettings"}
        elsewhere |= {"motion_load", "motion_through", "inertia_problem", "most_speed"}
        elsewhere |= {"speed_limit", "PathPoint", "PathRow", "PathLimits", "ShakeSettings"}
        found = set()
        for header in (ROOT / "include" / "poise").glob("*.hpp"):
            for line in header.read_text(encoding="utf-8").splitlines():
                pattern = r"(?:struct|class|enum class|using) (\w+)|inline constexpr \w+ (\w+)"
                pattern += r"|(?!struct|class|template|static|using|return)\w[\w:<>, *]* [*&]?(\w+)\("
                if name := re.match(pattern, line):
                    found.add(name[1] or name[2] or name[3])
        self.assertGreater(len(found), 60)
        self.assertLessEqual({"Grasp", "hold", "up_at", "manner", "capacity"}, found)
        self.assertEqual({name for name in found - elsewhere if not hasattr(poise, name)}, set())


if __name__ == "__main__":
    unittest.main()
