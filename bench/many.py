"""Speed and memory of many grasps: many.py PROGRAM MODULE_DIRECTORY

Every comparison is measured in one run, in turn; other work on the machine disturbs it all the same.
"""

import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

program, module = map(os.path.abspath, sys.argv[1:3])
sys.path.insert(0, module)
import poise  # noqa: E402

CORES = sorted(os.sched_getaffinity(0))[:2]


def random_grasp(rng, dimension):
    """Three contacts on a sphere or circle."""
    points = rng.normal(size=(3, dimension))
    points /= np.linalg.norm(points, axis=1)[:, None]
    com = rng.uniform(-0.2, 0.2, dimension)
    return poise.Grasp(poise.Load(5, com), [poise.Contact(p, -p, 0.7) for p in points])


def write_grasps(path, count, dimension, seed=0):
    rng = np.random.default_rng(seed)
    distinct = min(count, 1000)
    lines = [json.dumps(poise.to_dict(random_grasp(rng, dimension))) for _ in range(distinct)]
    with open(path, "w") as stream:
        for k in range(count):
            stream.write(lines[k % distinct] + "\n")


def start(arguments, cores):
    command = ["taskset", "-c", ",".join(map(str, cores)), *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def seconds(*jobs):
    """How long it takes until all of these (arguments, cores), begun together, have ended."""
    begin = time.perf_counter()
    children = [start(*job) for job in jobs]
    for child in children:
        child.wait()
    return time.perf_counter() - begin


def megabytes(arguments):
    """The most memory that a program has at a time."""
    child = start(arguments, CORES)
    most = 0
    while child.poll() is None:
        try:
            status = Path(f"/proc/{child.pid}/status").read_text()
        except OSError:
            break
        if found := re.search(r"VmHWM:\s*(\d+) kB", status):
            most = int(found[1])  # in the end that of the program, not of what started it
        time.sleep(0.002)
    child.wait()
    return most / 1024


def throughput(folder):
    """One process on two cores against two processes on one core each."""
    for dimension, count in ((2, 40_000), (3, 200)):
        both, one = folder / "both.jsonl", folder / "one.jsonl"
        write_grasps(both, count, dimension)
        write_grasps(one, count // 2, dimension)
        ratios, rates = [], []
        for _ in range(3):
            together = seconds(([program, "batch", both], CORES))
            apart = seconds(*(([program, "batch", one], [core]) for core in CORES))
            ratios.append(apart / together)
            rates.append(count / together)
        where = "plane" if dimension == 2 else "space"
        print(
            f"batch, {where}: {statistics.median(rates):.0f} grasps/s on {len(CORES)} cores, "
            f"{statistics.median(ratios):.2f} of two processes on one core each"
        )


def many():
    """hold_many against a loop over hold."""
    for dimension in (2, 3):
        rng = np.random.default_rng(1)
        grasp = random_grasp(rng, dimension)
        ups = rng.normal(size=(5_000, dimension))
        ratios = []
        for _ in range(5):
            begin = time.perf_counter()
            for up in ups:
                poise.hold(grasp, up)
            middle = time.perf_counter()
            poise.hold_many(grasp, ups)
            ratios.append((middle - begin) / (time.perf_counter() - middle))
        where = "plane" if dimension == 2 else "space"
        print(f"hold_many, {where}: {statistics.median(ratios):.1f} times as fast as a loop")


def start_up():
    environment = {**os.environ, "PYTHONPATH": module}
    for name, command in (
        ("program", [program, "--version"]),
        ("python3 -c 'import numpy'", [sys.executable, "-c", "import numpy"]),
        ("python3 -c 'import poise'", [sys.executable, "-c", "import poise"]),
    ):
        times = []
        for _ in range(11):
            begin = time.perf_counter()
            subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
            times.append(time.perf_counter() - begin)
        print(f"start-up, {name}: {1000 * statistics.median(times):.1f} ms")


def memory(folder):
    used = []
    for count in (10_000, 100_000):
        write_grasps(folder / "in.jsonl", count, 2)
        used.append(megabytes([program, "batch", folder / "in.jsonl", "-o", folder / "out.jsonl"]))
        print(f"memory, {count} records: {used[-1]:.1f} MB")
    print(f"memory: {used[1] - used[0]:+.1f} MB from 10^4 to 10^5 records")


with tempfile.TemporaryDirectory() as directory:
    start_up()
    many()
    throughput(Path(directory))
    memory(Path(directory))
