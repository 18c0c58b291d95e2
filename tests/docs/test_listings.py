"""Every listing of the pages that people read, as a reader would try it.

A listing is tested by its language. One that nothing here can test fails, so whatever stands on a
page has been tried.
"""

import contextlib
import io
import json
import math
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "site"))

import hypertext  # noqa: E402

PROGRAM = Path(os.environ["POISE_PROGRAM"])
STAGE = Path(os.environ["POISE_STAGE"])  # where Poise is installed
COMPILER = os.environ["POISE_CXX"]
SAMPLE = os.environ["POISE_ACRONYM_SAMPLE"]  # writes a small data set

# These install, or start what goes on; tests/install and tests/python do it elsewhere.
ONLY_READ = {"cmake", "ctest", "sudo", "cpack", "/usr/bin/python3", "python3"}
ONLY_READ |= {"dask-scheduler", "srun"}


def run(command, check=True, **options):
    done = subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        **options,
    )
    if check and done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def options_of(command):
    """The options of a command, each a set of its spellings."""
    found = re.findall(r"^  (-[\w,-]+)", run([PROGRAM, command, "--help"]), re.MULTILINE)
    if command == "import":
        found = re.findall(r"^  (-[\w,-]+)", run([PROGRAM, command, "acronym", "--help"]), re.MULTILINE)
    return [set(each.split(",")) for each in found]


class Listings(unittest.TestCase):
    """Those of one page, from top to bottom, in a folder of their own."""

    def setUp(self):
        matplotlib.use("Agg")
        self.tested = 0

    def try_page(self, page):
        self.names = {"__name__": "__main__"}
        self.printed = None  # by the program above
        self.above = None  # the grasp above
        for listing in hypertext.listings(page):
            with self.subTest(listing.place):
                kind = getattr(self, f"try_{listing.language}", None)
                self.assertIsNotNone(kind, f"nothing tests a listing in '{listing.language}'")
                kind(listing)
                self.tested += 1

    def test_pages(self):
        start = Path.cwd()
        for page in hypertext.pages():
            with tempfile.TemporaryDirectory() as directory:
                folder = Path(directory)
                (folder / "examples").symlink_to(ROOT / "examples")
                (folder / "build").mkdir()
                (folder / "build/poise").symlink_to(PROGRAM)
                (folder / "build/paper").symlink_to(PROGRAM.with_name("paper"))
                os.chdir(folder)
                try:
                    self.try_page(page)
                finally:
                    os.chdir(start)
        self.assertGreater(self.tested, 40)

    def try_console(self, listing):
        """Commands after `$ `, and what they print."""
        printed = ""
        for line in listing.text.splitlines():
            if line.startswith("$ "):
                printed += line + "\n" + run(["bash", "-c", line[2:]], check=False)
        self.assertEqual(printed, listing.text)

    def try_sh(self, listing):
        """Commands of Poise are run; of others it is seen that the shell can read them."""
        run(["bash", "-n", "-c", listing.text])
        programs = set()
        for line in listing.text.splitlines():
            words = [word.strip("()") for word in shlex.split(line, comments=True)]
            if words[:1] == ["cd"]:
                words = words[words.index("&&") + 1 :]
            if not words:
                continue
            programs.add(words[0])
            if words[0] == "./dev":
                commands = run([ROOT / "dev", "help"], cwd=ROOT)
                self.assertIn(f"./dev {words[1]} ", commands)
            if "--preset" in words:
                presets = json.loads((ROOT / "CMakePresets.json").read_text())
                names = [each["name"] for each in presets["configurePresets"]]
                self.assertIn(words[words.index("--preset") + 1], names)
        if programs <= {"poise", "build/poise", "build/paper"}:
            self.put_data_sets()
            path = f"{PROGRAM.parent}:{os.environ['PATH']}"
            run(["bash", "-e", "-c", listing.text], env={**os.environ, "PATH": path})
        else:
            self.assertLessEqual(programs - {"./dev"}, ONLY_READ)

    def put_data_sets(self):
        """grasps.jsonl, and grasps/ with files of ACRONYM."""
        if Path("grasps.jsonl").exists():
            return
        grasp = {"poise": 1, "dimension": 2, "object": {"weight": 1, "com": [0, 0]}}
        grasp["contacts"] = [
            {"position": [x, 0], "normal": [-x, 0], "friction": 0.5} for x in (-1, 1)
        ]
        Path("grasps.jsonl").write_text(3 * (json.dumps(grasp) + "\n"))
        run([SAMPLE, "."])

    def try_yaml(self, listing):
        """A grasp file without warnings; that of the README is an example."""
        if listing.page.name == "README.md":
            self.assertEqual(listing.text, Path("examples/l-part.yaml").read_text())
        Path("listing.yaml").write_text(listing.text, encoding="utf-8")
        self.above = run([PROGRAM, "check", "listing.yaml", "--json"])
        self.assertEqual(json.loads(self.above)["warnings"], [])

    def try_json(self, listing):
        """A grasp file, the same as that above; or a record of `poise batch`."""
        said = json.loads(listing.text)
        if "poise" in said:
            Path("listing.json").write_text(listing.text, encoding="utf-8")
            self.assertEqual(run([PROGRAM, "check", "listing.json", "--json"]), self.above)
            return
        part = Path("examples/l-part.yaml").read_text(encoding="utf-8")
        Path("parts").mkdir(exist_ok=True)
        Path("parts/l-part.yaml").write_text(part, encoding="utf-8")
        Path("parts/m-part.yaml").write_text(part.replace("mass: 0.13", "mass: -0.13"))
        run([PROGRAM, "batch", "parts", "-o", "records.jsonl"], check=False)
        records = Path("records.jsonl").read_text(encoding="utf-8").splitlines()
        self.assert_alike(json.loads(records[said["record"]]), said)

    def assert_alike(self, real, said):
        """Equal, but for numbers of four digits."""
        if isinstance(said, dict):
            self.assertEqual(list(real), list(said))
            real, said = list(real.values()), list(said.values())
        if isinstance(said, list):
            self.assertEqual(len(real), len(said))
            for pair in zip(real, said):
                self.assert_alike(*pair)
        elif isinstance(said, float):
            self.assertTrue(math.isclose(real, said, rel_tol=5e-4, abs_tol=1e-12), f"{real}, {said}")
        else:
            self.assertEqual(real, said)

    def try_python(self, listing):
        """One program from the top of the page on; one that takes arguments is the verifier."""
        if "sys.argv" in listing.text:
            Path("verify.py").write_text(listing.text, encoding="utf-8")
            for example, command in [("l-part", "hold"), ("l-part", "best"), ("bottle", "best")]:
                file = f"examples/{example}.yaml"
                Path("grasp.json").write_text(run([PROGRAM, "check", file, "--json"]))
                asked = [command, file, "--objective", "effort", "--json"]
                Path("result.json").write_text(run([PROGRAM, *asked]))
                command = [sys.executable, "verify.py", "grasp.json", "result.json"]
                self.assertEqual(run(command), "confirmed\n")
            return
        stream = io.StringIO()
        with contextlib.redirect_stdout(stream):
            exec(compile(listing.text, listing.place, "exec"), self.names)
        self.printed = stream.getvalue()

    def try_cpp(self, listing):
        """A program, built on what is installed."""
        Path("listing.cpp").write_text(listing.text, encoding="utf-8")
        (pc,) = STAGE.rglob("poise.pc")
        environment = {**os.environ, "PKG_CONFIG_PATH": str(pc.parent)}
        flags = run(["pkg-config", "--cflags", "--libs", "poise"], env=environment).split()
        run([COMPILER, "-std=c++20", "listing.cpp", *flags, "-o", "listing"])
        self.printed = run(["./listing"])

    def try_cmake(self, listing):
        """Part of a project whose program is the listing in C++ above."""
        Path("CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.20)\nproject(reader CXX)\n"
            "add_executable(your_program listing.cpp)\n" + listing.text
        )
        where = [f"-DCMAKE_PREFIX_PATH={STAGE}", f"-DCMAKE_CXX_COMPILER={COMPILER}"]
        run(["cmake", "-S", ".", "-B", "project", *where])
        run(["cmake", "--build", "project"])
        run(["project/your_program"])

    def try_text(self, listing):
        """What the program above prints; or how the commands are called."""
        if self.printed is not None:
            self.assertEqual(self.printed, listing.text)
            self.printed = None
            return
        uses = re.findall(r"^poise (\w+)(.*(?:\n +.*)*)", listing.text, re.MULTILINE)
        commands = re.search(r"^Commands:\n((?:  .*\n)+)", run([PROGRAM, "--help"]), re.MULTILINE)
        self.assertEqual(
            sorted(name for name, _ in uses), sorted(re.findall(r"^  (\w+)", commands[1], re.MULTILINE))
        )
        for name, use in uses:
            said = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", use))
            known = options_of(name)
            self.assertLessEqual(said, set().union(*known), name)
            for option in known:
                if not option & {"--help", "--json"}:
                    self.assertTrue(option & said, f"poise {name}: {option} is not on the page")


if __name__ == "__main__":
    unittest.main()
