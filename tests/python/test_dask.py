"""poise.dask on two worker processes, one of which is killed in the middle."""

import json
import os
import signal
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import poise

try:
    import distributed
except ImportError:
    distributed = None

PROGRAM = os.environ["POISE_PROGRAM"]
ACRONYM = Path(os.environ.get("POISE_DATA", "/nowhere"), "acronym")


def grasps(count):
    """Lines of random grasps of a sphere, some of which are bad."""
    rng = np.random.default_rng(1)
    for k in range(count):
        if k % 11 == 5:
            yield "{no grasp"
            continue
        points = rng.normal(size=(3, 3 if k % 4 == 0 else 2))
        points /= np.linalg.norm(points, axis=1)[:, None]
        contacts = [poise.Contact(p, -p, friction=0.7) for p in points]
        grasp = poise.Grasp(poise.Load(k + 1, 0.1 * points[0]), contacts)
        yield json.dumps(poise.to_dict(grasp))


@unittest.skipIf(distributed is None, "python3-distributed is not installed")
class Cluster(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = Path(directory.name)
        self.file = self.folder / "in.jsonl"
        self.file.write_text("\n".join(grasps(400)), encoding="utf-8")

    def expected(self):
        """What the program writes."""
        out = self.folder / "program.jsonl"
        subprocess.run(
            [PROGRAM, "batch", self.file, "-o", out, "--gap", "1e-2"],
            stderr=subprocess.DEVNULL,
        )
        return out.read_bytes()

    def test_a_worker_is_killed(self):
        from poise import dask

        parts = dask.partitions(self.file, 10)
        self.assertEqual([part.first for part in parts], list(range(0, 400, 10)))
        self.assertEqual(sum(part.size for part in parts), self.file.stat().st_size)
        with distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            dashboard_address=None,
            local_directory=str(self.folder),
        ) as cluster, distributed.Client(cluster) as client:
            victim = next(iter(client.run(os.getpid).values()))
            answered = threading.Event()
            futures = dask.batch(client, parts, gap=1e-2)
            for future in futures:
                future.add_done_callback(lambda _: answered.set())
            answered.wait()
            self.assertFalse(all(future.done() for future in futures))
            os.kill(victim, signal.SIGKILL)
            out = self.folder / "cluster.jsonl"
            dask.write(futures, out)
        self.assertEqual(out.read_bytes(), self.expected())
        self.assertFalse(Path(f"{out}.part").exists())

    @unittest.skipUnless(ACRONYM.is_dir(), "POISE_DATA has no acronym")
    def test_acronym(self):
        from poise import dask

        files = sorted((ACRONYM / "grasps").glob("*.h5"))
        options = ["--mesh-root", ACRONYM, "--what", "hold", "--up", "0,0,1"]
        run = subprocess.run(
            [PROGRAM, "batch", *files, *options], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        parts = dask.acronym_partitions(files, ACRONYM, 700)
        own = b"".join(dask.answer(part, hold=True, up=[0, 0, 1]) for part in parts)
        self.assertEqual(own, run.stdout)

    def test_partitions_of_strange_files(self):
        from poise import dask

        for text in ["", "\n", "\n\n", "a", "a\n", "a\n\nb", "a\nb\n" * 5]:
            self.file.write_text(text, encoding="utf-8")
            for records in (1, 2, 100):
                parts = dask.partitions(self.file, records)
                own = b"".join(dask.answer(part, gap=1e-2) for part in parts)
                self.assertEqual(own, self.expected())


if __name__ == "__main__":
    unittest.main()
