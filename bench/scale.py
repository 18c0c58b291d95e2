"""The numbers of docs/scale.md, "What it costs": scale.py PROGRAM MANY_GRASPS DATA [COUNT]

DATA is the folder of the ACRONYM files: grasps/Mug*.h5, grasps/Table*.h5 and meshes/. COUNT grasps
of the mug are answered, 100,000 if not told: a quarter of an hour of one core.
"""

import collections
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

program, many_grasps, data = map(os.path.abspath, sys.argv[1:4])
count = int(sys.argv[4]) if len(sys.argv) > 4 else 100_000
(mug,), (table,) = (sorted(Path(data, "grasps").glob(f"{name}*.h5")) for name in ("Mug", "Table"))
DISK = {
    "poise": 1,
    "dimension": 2,
    "object": {"weight": 10, "com": [0.1, 0]},
    "contacts": [
        {"position": [0.8, 0.6], "normal": [-0.8, -0.6], "friction": 1},
        {"position": [-0.8, 0.6], "normal": [0.8, -0.6], "friction": 0.6},
        {"position": [0, -1], "normal": [0, 1], "friction": 0.5},
    ],
}


def outcome(line):
    record = json.loads(line)
    if "error" in record:
        return "bad"
    if "status" not in record:
        return "holdable" if record["holdable"] else "unholdable"
    if record["status"] == "gap":
        return "larger gap" if record["best"] else "undecided"
    return record["status"]


def measure(words, folder, inputs, *options):
    """Answers all grasps, and prints what that takes."""
    out = folder / "answers.jsonl"
    command = [program, "batch", *inputs, "--mesh-root", data, "-o", out, *options]
    begin = time.perf_counter()
    child = subprocess.Popen(list(map(str, command)), stderr=subprocess.DEVNULL)
    megabytes = 0.0
    while True:
        if found := re.search(r"VmHWM:\s*(\d+) kB", Path(f"/proc/{child.pid}/status").read_text()):
            megabytes = int(found[1]) / 1024  # of the program alone, not of what started it
        ended, status, used = os.wait4(child.pid, os.WNOHANG)
        if ended:
            break
        time.sleep(0.005)
    elapsed = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 1):
        sys.exit(f"poise batch ended with {child.returncode}")
    with open(out, encoding="utf-8") as lines:
        counts = collections.Counter(map(outcome, lines))
    records = sum(counts.values())
    seconds = used.ru_utime + used.ru_stime
    print(f"{words}: {records} grasps")
    print(f"  {seconds:.1f} s of processor time, {1e3 * seconds / records:.3f} ms for a grasp")
    print(f"  {elapsed:.1f} s on {len(os.sched_getaffinity(0))} cores")
    print(f"  {megabytes:.1f} MB of memory, {out.stat().st_size / 1e6:.1f} MB of answers")
    print("  " + ", ".join(f"{number} {word}" for word, number in counts.most_common()), flush=True)


with tempfile.TemporaryDirectory() as directory:
    folder = Path(directory)
    many = folder / "many.h5"
    subprocess.run([many_grasps, mug, many, str(count)], check=True)
    plane = folder / "plane.jsonl"
    plane.write_text(f"{json.dumps(DISK)}\n" * 100_000, encoding="utf-8")

    gap = ("--gap", "1e-3")
    both, hdf5 = (mug, table), ("--hdf5", folder / "answers.h5")
    measure("mug and table", folder, both, *gap, *hdf5)
    measure("mug and table, --what hold", folder, both, "--what", "hold")
    measure("mug, --max-holds 200", folder, [mug], *gap, "--max-holds", "200")
    measure("plane, three contacts", folder, [plane])
    measure("many grasps of the mug, --what hold", folder, [many], "--what", "hold")
    measure("many grasps of the mug", folder, [many], *gap, *hdf5)
