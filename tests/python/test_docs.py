"""The Python listings of the documentation, as a reader would try them."""

import contextlib
import importlib.util
import io
import os
import re
import tempfile
import unittest
from pathlib import Path

import matplotlib

ROOT = Path(__file__).parents[2]


class Documentation(unittest.TestCase):
    def check_page(self, page):
        """Runs the listings one after the other; the text after one is what it prints."""
        matplotlib.use("Agg")
        text = page.read_text(encoding="utf-8")
        found = re.findall(r"```(python|text)\n(.*?)```", text, re.DOTALL)
        names, printed, run = {"__name__": "__main__"}, None, 0
        for language, listing in found:
            if language == "python":
                stream = io.StringIO()
                with contextlib.redirect_stdout(stream):
                    exec(compile(listing, page.name, "exec"), names)
                printed = stream.getvalue()
                run += 1
            elif printed is not None:
                self.assertEqual(printed, listing)
                printed = None
        self.assertGreater(run, 0)

    def test_pages(self):
        pages = ["README.md", "docs/python.md"]
        if importlib.util.find_spec("distributed"):
            pages.append("docs/scale.md")
        start = Path.cwd()
        with tempfile.TemporaryDirectory() as directory:
            Path(directory, "examples").symlink_to(ROOT / "examples")
            os.chdir(directory)
            try:
                for page in pages:
                    with self.subTest(page):
                        self.check_page(ROOT / page)
            finally:
                os.chdir(start)


if __name__ == "__main__":
    unittest.main()
